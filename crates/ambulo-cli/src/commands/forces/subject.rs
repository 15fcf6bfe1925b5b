//! Reads a trial of an AddBiomechanics subject (`.b3d`). Header and trial are read alone, so that files of any size can be used.

use super::{Reading, added_mass, markers, run_one, size};
use crate::args::{ForcesArgs, SubjectArgs};
use crate::caller::Caller;
use crate::commands::forces::check_range;
use crate::{Completion, files};
use ambulo::motion::{B3dTrial, Window};
use ambulo::study::Source;
use ambulo_formats::b3d::{Header, LENGTH_BYTES};
use anyhow::{Context, Result, bail};
use std::path::Path;

/// The model of a trial in summaries, if none was given.
pub(super) const OWN_MODEL: &str = "the file's own";
/// Most trials that a message lists.
const LISTED: usize = 8;

pub(super) fn read(args: &ForcesArgs, reading: &mut Reading) -> Result<Source> {
    let shown = args.recording().display().to_string();
    check_options(args)?;
    let header = read_header(&reading.caller, args.recording())?;
    let trial = chosen(&header, args.trial.as_deref()).context(shown.clone())?;
    let bytes = match header.trial_place(trial) {
        Some(place) => files::read_part(&reading.caller, args.recording(), place)?,
        None => bail!("{shown}: its header states more bytes than any file has. Is it damaged?"),
    };
    let frames = header.read_trial(trial, &bytes).with_context(|| shown.clone())?;
    drop(bytes);
    reading.clock.lap("read_trial");
    let name = format!("{shown}, trial {}", header.trials[trial].name);
    let of_file = B3dTrial { header: &header, trial, frames: &frames, name: &name };
    let window = Window { from_s: args.from, to_s: args.to };
    let source = match args.has_chosen_body() {
        false => Source::of_b3d(&of_file, window, &mut reading.findings),
        true => {
            let body = markers::body(args, reading)?;
            Source::of_b3d_markers(&of_file, body, window, &mut reading.findings)
        }
    };
    let source = source.context(name)?;
    Ok(Source { added_mass: added_mass(args), stated: size::stated(&args.subject), ..source })
}

/// The header of a file.
pub(crate) fn read_header(caller: &Caller, path: &Path) -> Result<Header> {
    let shown = || path.display().to_string();
    let first = files::read_start(caller, path, LENGTH_BYTES)?;
    let length = Header::length(&first).with_context(shown)?;
    Header::read(&files::read_start(caller, path, length)?).with_context(shown)
}

/// The trial with this name or number; without either the only one.
fn chosen(header: &Header, wanted: Option<&str>) -> Result<usize> {
    let trials = &header.trials;
    let listed = || {
        let names = trials.iter().take(LISTED).enumerate().map(|(k, trial)| format!("{} ({})", k + 1, trial.name));
        let more = if trials.len() > LISTED { ", ..." } else { "" };
        format!("{}{more}", names.collect::<Vec<_>>().join(", "))
    };
    if trials.is_empty() {
        bail!("the file has no trials");
    }
    let Some(wanted) = wanted else {
        return match trials.len() {
            1 => Ok(0),
            count => bail!("the file has {count} trials; expected --trial with one of {}, or `all`", listed()),
        };
    };
    let number = wanted.parse().ok().filter(|number| (1..=trials.len()).contains(number));
    let found = trials.iter().position(|trial| trial.name == wanted).or(number.map(|number| number - 1));
    found.with_context(|| format!("--trial {wanted}: the file has no such trial; expected one of {}", listed()))
}

/// Rejects options without effect.
fn check_options(args: &ForcesArgs) -> Result<()> {
    let SubjectArgs { still, plate, markers: set, fit, figure, .. } = &args.subject;
    let never = [
        ("--grf", args.grf.is_some()),
        ("--loads", args.loads.is_some()),
        ("--static", still.is_some()),
        ("--plate", !plate.is_empty()),
    ];
    let of_markers =
        [("--markers", set.is_some()), ("--figure", figure != SubjectArgs::DEFAULT_FIGURE), ("--fit", fit.is_some())];
    let shown = args.recording().display();
    if let Some((option, _)) = never.iter().find(|(_, given)| *given) {
        bail!("{shown}: {option} has no effect for a .b3d, which has its own ground forces");
    }
    if args.has_chosen_body() {
        return markers::check_options(args);
    }
    match of_markers.iter().find(|(_, given)| *given) {
        Some((option, _)) => bail!(
            "{shown}: {option} is for markers, but the file's own model and coordinates are used; expected --model built-in or --model FILE to fit the markers"
        ),
        None => size::check(&args.subject),
    }
}

/// Computes every trial into a separate folder.
pub(super) fn run_all(args: &ForcesArgs) -> Result<Completion> {
    check_range(args)?;
    let header = read_header(&Caller::default(), args.recording())?;
    let count = header.trials.len();
    let digits = count.to_string().len();
    let (mut failures, mut is_refused) = (Vec::new(), false);
    for (k, trial) in header.trials.iter().enumerate() {
        let number = k + 1;
        let folder = args.output.join(format!("{number:0digits$}-{}", file_name(&trial.name)));
        let of_trial = ForcesArgs { trial: Some(number.to_string()), output: folder, ..args.clone() };
        match run_one(&of_trial) {
            Ok(completion) => is_refused |= completion == Completion::Failed,
            Err(error) => failures.push(format!("trial {number} (`{}`): {error:#}", trial.name)),
        }
    }
    if !failures.is_empty() {
        bail!(
            "{}: {} of {count} trials gave no results:\n{}",
            args.recording().display(),
            failures.len(),
            failures.join("\n")
        );
    }
    Ok(if is_refused { Completion::Failed } else { Completion::Passed })
}

/// A name without characters that file systems refuse.
fn file_name(name: &str) -> String {
    let is_safe = |c: char| c.is_ascii_alphanumeric() || "-_".contains(c);
    name.chars().take(60).map(|c| if is_safe(c) { c } else { '_' }).collect()
}
