//! Converts a request to words of the command line.

use super::words::{Words, quoted, split};
use super::{
    Args, Command, DemoArgs, FigureArgs, GaitArgs, Handling, SessionArgs, SimulateArgs, WalkArgs, WalkMode,
    words_of_job,
};
use crate::request::{ForcesRequest, Request, Verb};
use ambulo::job::Job;
use ambulo::optimal::{Load, LoadPlace};
use anyhow::{Result, bail};
use clap::{Parser, ValueEnum};
use std::ffi::OsString;
use std::path::Path;

/// The command line of a request with further options, as it is typed.
pub(crate) fn line(request: &Request, options: &str) -> Result<String> {
    let Parts { own, output, of_trials } = parts(request)?;
    let as_typed = |words: &[OsString]| words.iter().map(|word| quoted(&word.to_string_lossy())).collect::<Vec<_>>();
    let mut options = Vec::from_iter(Some(options.trim().to_owned()).filter(|options| !options.is_empty()));
    let mut line = vec!["ambulo".to_owned()];
    line.extend(as_typed(&own));
    if of_trials.is_none() {
        line.append(&mut options);
    }
    line.extend(output.into_iter().flat_map(|output| ["-o".to_owned(), quoted(&output.display().to_string())]));
    let last: Vec<String> = as_typed(&of_trials.unwrap_or_default()).into_iter().chain(options).collect();
    if !last.is_empty() {
        line.push("--".to_owned());
        line.extend(last);
    }
    Ok(line.join(" "))
}

/// The command of a request with further options, as they are typed.
pub(crate) fn with_options(request: &Request, options: &str, how: Handling) -> Result<Option<Command>> {
    let Parts { own, output, of_trials } = parts(request)?;
    let mut words = Words(vec!["ambulo".into()]);
    words.0.extend(own);
    if of_trials.is_none() {
        words.0.extend(split(options));
    }
    words.path("--output", output.map(Path::to_path_buf).as_ref());
    words.flag("--force", how.replace.force);
    words.flag("--check", how.check.check);
    words.flag("--json", how.print.json);
    words.flag("--quiet", how.print.quiet);
    words.flag("--verbose", how.print.verbose);
    if let Some(of_trials) = of_trials {
        words.0.push("--".into());
        words.0.extend(of_trials.into_iter().chain(split(options)));
    }
    Ok(Args::try_parse_from(words.0)?.command)
}

/// The words of everything in a request that differs from the defaults.
struct Parts<'r> {
    own: Vec<OsString>,
    /// The folder for the results.
    output: Option<&'r Path>,
    /// The words after `--`, for a verb whose options are those of every trial.
    of_trials: Option<Vec<OsString>>,
}

fn parts(request: &Request) -> Result<Parts<'_>> {
    let mut of_trials = None;
    let mut words = Words(Vec::new());
    let output = match &request.0 {
        Verb::Forces(request) => {
            of_forces(request, &mut words);
            Some(request.output.as_path())
        }
        Verb::Walk(args) => {
            of_walk(args, &mut words);
            args.output.as_deref()
        }
        Verb::Simulate(args) => {
            of_simulate(args, &mut words);
            Some(args.output.as_path())
        }
        Verb::Demo(args) => {
            of_demo(args, &mut words);
            Some(args.output.as_path())
        }
        Verb::Session(request) => {
            of_session(&request.own, &mut words);
            of_trials = Some(words_of_job::words(&request.job, &request.outputs()));
            Some(request.own.output.as_path())
        }
        _ => bail!(
            "found a request of another verb; expected forces, session, walk, simulate or demo, which take options"
        ),
    };
    Ok(Parts { own: words.0, output, of_trials })
}

fn of_session(args: &SessionArgs, words: &mut Words) {
    words.0.push("session".into());
    args.source.iter().for_each(|source| words.input(source));
    words.path("--compare", args.compare.as_ref());
    words.path("--norm", args.norm.as_ref());
    words.value("--name", args.name.as_ref());
    words.value("--date", args.date.as_ref());
    words.flag("--anonymous", args.anonymous);
    words.flag("--dry-run", args.dry_run);
    words.value("--jobs", args.jobs);
}

fn of_forces(request: &ForcesRequest, words: &mut Words) {
    words.0.push("forces".into());
    if let Some(recording) = &request.job.recording {
        words.input(recording);
    }
    words.0.extend(words_of_job::words(&request.job, &request.outputs()));
    of_keep(&request.keep, words);
}

fn of_walk(args: &WalkArgs, words: &mut Words) {
    let defaults = WalkArgs::default();
    words.0.push("walk".into());
    of_gait(&args.gait, words);
    of_figure(&args.figure, words);
    let conditions = &args.conditions;
    words.value("--slope", conditions.slope);
    words.value("--load", conditions.load.map(load));
    conditions.weak.iter().for_each(|(joint, share)| words.value("--weak", Some(format!("{joint}={share}"))));
    words.path("--device", conditions.device.as_ref());
    words.value("--step-width", conditions.step_width);
    words.flag("--asymmetric", conditions.asymmetric);
    words.flag("--free-cadence", conditions.free_cadence);
    words.value("--mode", args.mode.and_then(|mode: WalkMode| word(&mode)));
    words.flag("--planar", args.planar);
    let convention = Some(args.convention).filter(|used| *used != defaults.convention);
    words.value("--convention", convention.and_then(|used| word(&used)));
    words.path("--torques", args.torques.as_ref());
    words.value("--cycles", Some(args.cycles).filter(|cycles| *cycles != defaults.cycles));
    words.value("--rate", Some(args.rate).filter(|rate| rate.to_bits() != defaults.rate.to_bits()));
    words.flag("--states", args.states);
    words.path("--thresholds", args.thresholds.as_ref());
    of_keep(&args.keep, words);
}

fn of_gait(args: &GaitArgs, words: &mut Words) {
    words.value("--gait", args.gait.as_ref());
    words.value("--speed", args.speed);
    words.value("--step-length", args.step_length);
    words.value("--cadence", args.cadence);
    args.speed_change.iter().for_each(|change| words.value("--speed-change", Some(change)));
    args.step_length_change.iter().for_each(|change| words.value("--step-length-change", Some(change)));
    args.cadence_change.iter().for_each(|change| words.value("--cadence-change", Some(change)));
    words.value("--step-height", args.step_height);
    words.value("--style", args.style.as_ref());
}

fn of_figure(args: &FigureArgs, words: &mut Words) {
    words.value("--figure", Some(&args.figure).filter(|figure| *figure != Job::SEGMENTS.name()));
    words.value("--mass", args.mass);
    words.value("--height", args.height);
    words.flag("--no-toe-joint", args.no_toe_joint);
}

fn of_simulate(args: &SimulateArgs, words: &mut Words) {
    words.0.push("simulate".into());
    words.input(&args.scene);
    of_keep(&args.keep, words);
    words.value("--duration", args.duration);
    words.value("--step", args.step);
    words.path("--save", args.save.as_ref());
    words.path("--resume", args.resume.as_ref());
}

fn of_demo(args: &DemoArgs, words: &mut Words) {
    words.0.push("demo".into());
    of_keep(&args.keep, words);
}

fn of_keep(keep: &[String], words: &mut Words) {
    words.value("--keep", Some(keep.join(",")).filter(|names| !names.is_empty()));
}

fn word(value: &impl ValueEnum) -> Option<String> {
    value.to_possible_value().map(|value| value.get_name().to_owned())
}

/// A load as it is typed.
fn load(Load { mass, place }: Load) -> String {
    let place = LoadPlace::ALL.iter().find(|(_, known)| *known == place).map_or("", |(name, _)| name);
    format!("{mass}:{place}")
}
