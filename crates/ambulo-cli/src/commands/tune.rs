//! `ambulo tune`: tunes the gains of a figure that walks by its own torques.

use super::side_by_side::{processors, side_by_side};
use super::simulate::{read_named, read_scene};
use crate::args::{Existing, TuneArgs};
use crate::caller::Caller;
use crate::printer::{self, TunedGains};
use crate::record::run_id;
use crate::{Completion, files};
use ambulo::findings::Findings;
use ambulo::simulation::control::tuning::{Gain, PushSettings, Task, TrialOutcome, Tuning, TuningProblem};
use ambulo::simulation::scene::ControlledFigure;
use anyhow::{Context, Result, bail};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Forces of the report as shares of the largest one of the search.
const REPORTED: [f64; 3] = [0.5, 0.75, 1.0];

pub(crate) fn run(args: &TuneArgs, caller: &Caller) -> Result<Completion> {
    let gains = if args.gains.is_empty() { None } else { Some(Gain::named(&args.gains).context("--gains")?) };
    let mut inputs = vec![args.scene.clone()];
    let state = args.output.with_extension("state.json");
    check_targets(args, &state)?;
    let figure = controlled(args, caller, &mut inputs)?;
    for path in [&args.output, &state] {
        // An input is refused whatever the options.
        files::check_target(path, &inputs, Existing::Replaced)?;
    }
    let shown = || format!("{}: {}", args.scene.display(), figure.place.error("").to_string().trim_end_matches(": "));
    let is_spatial = figure.human.model.coordinate("pelvis_tz").is_some();
    if !is_spatial && gains.iter().flatten().any(|gain| gain.name == "sideways") {
        bail!("--gains: `sideways` has no effect on a figure in the plane; expected other gains");
    }
    let gains = gains.unwrap_or_else(|| Gain::usual(is_spatial));
    let problem = TuningProblem::new(&figure.human, &figure.plan, figure.step, &figure.settings, &gains);
    let problem = problem.with_context(shown)?;
    let pushes = PushSettings {
        seed: u64::from(args.seed),
        force_n: args.push,
        count: args.pushes as usize,
        all_around: is_spatial,
    };
    let saved = SavedTuning {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        inputs: run_id("tune", &inputs, &Caller::default())?,
        figure: figure.name.clone(),
        gains: gains.iter().map(|gain| gain.name.to_owned()).collect(),
        tuning: Tuning::new(&gains, pushes),
    };
    // A run that ended before its first generation has saved no state, so the search restarts.
    let saved = if args.resume && state.exists() { saved.resumed(&state)? } else { saved };
    let run = TuneRun { args, caller, problem: &problem, torques: figure.torques, state, saved };
    run.finish()?;
    Ok(Completion::Passed)
}

/// Refuses files that are in the way, before anything is computed.
fn check_targets(args: &TuneArgs, state: &Path) -> Result<()> {
    let is_continued = args.resume && state.exists();
    let existing = if is_continued { Existing::Replaced } else { args.replace.existing() };
    [&args.output, state]
        .into_iter()
        .try_for_each(|path| files::check_target(path, std::slice::from_ref(&args.scene), existing))
}

/// The figure with its plan; adds the files that its walk names to `inputs`.
fn controlled(args: &TuneArgs, caller: &Caller, inputs: &mut Vec<PathBuf>) -> Result<ControlledFigure> {
    let file = read_scene(&args.scene, caller)?;
    let mut load = |path: &str| read_named(&args.scene, path, caller, inputs);
    printer::progress("planning the walk", args.print);
    let observer = caller.observer(|_| ());
    ControlledFigure::of(&file, args.figure.as_deref(), &mut load, &observer, &mut Findings::default())
        .with_context(|| args.scene.display().to_string())
}

/// The state of a run, as it is saved.
#[derive(Debug, Serialize, Deserialize)]
struct SavedTuning {
    version: String,
    /// Hash of the scene and its files.
    inputs: String,
    figure: String,
    gains: Vec<String>,
    tuning: Tuning,
}

impl SavedTuning {
    /// The saved state of a run with the same settings as this new one.
    fn resumed(self, path: &Path) -> Result<SavedTuning> {
        let shown = path.display();
        let saved: SavedTuning = serde_json::from_slice(&files::read(path)?)
            .with_context(|| format!("{shown}: this file was not written by `ambulo tune`"))?;
        if saved.version != self.version || saved.inputs != self.inputs {
            bail!(
                "{shown}: that run had another scene, or another version of Ambulo; a run continues only with the \
                 same. hint: leave out --resume and use --force to start anew"
            );
        }
        let ([was, is], [had, has]) = ([&saved, &self].map(|run| run.tuning.pushes()), [&saved, &self]);
        for (option, was, is) in [
            ("--figure", had.figure.clone(), has.figure.clone()),
            ("--gains", had.gains.join(","), has.gains.join(",")),
            ("--seed", was.seed.to_string(), is.seed.to_string()),
            ("--push", was.force_n.to_string(), is.force_n.to_string()),
            ("--pushes", was.count.to_string(), is.count.to_string()),
        ] {
            if was != is {
                bail!("{shown}: found {option} {is}; expected {was}, as in the run that is continued");
            }
        }
        if !saved.tuning.is_valid(self.gains.len()) {
            bail!("{shown}: the numbers of the search are not those of `ambulo tune`; the file was changed");
        }
        Ok(saved)
    }
}

struct TuneRun<'a> {
    args: &'a TuneArgs,
    caller: &'a Caller,
    problem: &'a TuningProblem,
    /// The file of torque curves that the scene names.
    torques: Option<String>,
    state: PathBuf,
    saved: SavedTuning,
}

impl TuneRun<'_> {
    fn finish(mut self) -> Result<()> {
        let (clock, before) = (Instant::now(), self.saved.tuning.evaluations());
        let most = self.args.evaluations as usize;
        let of_generation = Tuning::tasks(self.problem.gains().len());
        while self.saved.tuning.evaluations() + of_generation <= most {
            let tasks = self.saved.tuning.ask(self.problem);
            let outcomes = self.outcomes(&tasks)?;
            self.saved.tuning.tell(&tasks, &outcomes);
            self.write(&[])?;
            let done = self.saved.tuning.evaluations();
            let left = (most - done) / of_generation * of_generation;
            let left_s = clock.elapsed().as_secs_f64() * left as f64 / (done - before) as f64;
            let [_, candidates @ ..] = &outcomes[..] else { break };
            printer::tuning(&self.saved.tuning, candidates, [done, most], left_s, self.args.print);
        }
        let mean = self.saved.tuning.mean(self.problem);
        let outcome = self.outcomes(std::slice::from_ref(&mean))?;
        self.saved.tuning.judge(&mean, outcome[0]);
        let report = self.report()?;
        self.write(&report)?;
        let tuned = self.tuned(&report).context("no gains were judged")?;
        printer::tune(&tuned, &self.args.output, &self.state, self.args.print)
    }

    fn outcomes(&self, tasks: &[Task]) -> Result<Vec<TrialOutcome>> {
        let threads = self.args.jobs.map_or_else(processors, |jobs| jobs as usize);
        let of = |k: usize| match self.caller.is_stopped() {
            true => bail!("the search was stopped; what it has found is saved. hint: --resume continues"),
            false => Ok(self.problem.outcome(&tasks[k].settings, &tasks[k].pushes)?),
        };
        side_by_side(tasks.len(), threads, of).into_iter().collect()
    }

    /// Force [N], and what becomes of the pushes of the report with the gains of the scene and with the tuned ones.
    fn report(&self) -> Result<Vec<(f64, [TrialOutcome; 2])>> {
        let tuning = &self.saved.tuning;
        let (Some(start), Some(best)) = (tuning.start(), tuning.best()) else { return Ok(Vec::new()) };
        printer::progress("pushing with the gains of the scene and with the tuned ones", self.args.print);
        // Each is tried once if they are the same.
        let judged = if best == start { vec![start] } else { vec![start, best] };
        let mut tasks = Vec::new();
        for share in REPORTED {
            tasks.extend(judged.iter().map(|own| tuning.report(self.problem, &own.point, share)));
        }
        let outcomes = self.outcomes(&tasks)?;
        let pairs = outcomes.chunks(judged.len()).map(|own| [own[0], own[own.len() - 1]]);
        let forces = REPORTED.map(|share| share * self.args.push);
        Ok(forces.into_iter().zip(pairs).collect())
    }

    fn tuned<'r>(&'r self, report: &'r [(f64, [TrialOutcome; 2])]) -> Option<TunedGains<'r>> {
        let tuning = &self.saved.tuning;
        let (start, best) = (tuning.start()?, tuning.best()?);
        let (settings, _) = self.problem.settings_at(&best.point);
        Some(TunedGains {
            figure: &self.saved.figure,
            scene: self.args.scene.display().to_string(),
            evaluations: tuning.evaluations(),
            of_generation: Tuning::tasks(self.problem.gains().len()),
            pushes: tuning.pushes(),
            control: Gain::table(&settings, self.torques.as_deref(), self.problem.gains()),
            is_better: best != start,
            choice: [start.outcome, best.outcome],
            report,
        })
    }

    /// Writes the gains, and first the state from which they follow.
    fn write(&self, report: &[(f64, [TrialOutcome; 2])]) -> Result<()> {
        files::write(&self.state, &serde_json::to_vec(&self.saved)?)?;
        let text = self.tuned(report).map(|tuned| tuned.file());
        text.map_or(Ok(()), |text| files::write(&self.args.output, text.as_bytes()))
    }
}
