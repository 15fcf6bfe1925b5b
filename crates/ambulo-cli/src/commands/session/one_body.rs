//! Computes the trials of a person with one body.
//!
//! 1. Every trial is computed as `ambulo forces` does, with its own body.
//! 2. Where the bodies are the same, because a model or a standing trial with a known mass gives them, this is all.
//! 3. Otherwise the mass is the median of the trials whose data are not bad. The body is calibrated once with this mass, from the standing trial or,
//!    without one, from the trial whose markers lie nearest to their body; the other trials are computed again with it.

use crate::args::ForcesArgs;
use crate::caller::Caller;
use crate::commands::forces::{self, Shared};
use crate::commands::run_files::MotionRun;
use crate::commands::side_by_side::side_by_side;
use crate::commands::trials::{PlannedTrial, sentence};
use crate::printer;
use crate::record::hash;
use ambulo::analysis::Subject;
use ambulo::numerics::median;
use ambulo::study::{Outcome, QualityState, Tracking};
use anyhow::{Error, Result};
use std::ffi::OsString;
use std::path::Path;

/// The trials of a person and how they are computed.
pub(super) struct Visit<'a> {
    /// The folder that names of trials begin at.
    pub(super) root: &'a Path,
    pub(super) trials: &'a [&'a PlannedTrial],
    /// Options of `ambulo forces`.
    pub(super) words: &'a [OsString],
    pub(super) threads: usize,
    /// Who may stop the computation.
    pub(super) caller: &'a Caller,
}

/// Every trial, computed with one body or with the reason why not.
pub(super) struct ComputedVisit {
    pub(super) runs: Vec<Result<MotionRun, String>>,
    /// Where the body comes from.
    pub(super) body: String,
}

impl Visit<'_> {
    /// The options of a trial. Ground forces are predicted, alongside measured ones.
    fn options(&self, trial: &PlannedTrial) -> Result<ForcesArgs> {
        // The parser also prints the usage line of another command.
        let args = trial.files.options(self.words).map_err(|refused| {
            let text = refused.render().to_string();
            let first = text.lines().next().unwrap_or_default();
            Error::msg(format!("options after `--`: {}", first.trim_start_matches("error: ")))
        })?;
        let predict = !args.no_ground && !args.track;
        Ok(ForcesArgs { predict: args.predict || predict, ..args })
    }

    /// Checks the options without computing anything.
    pub(super) fn check(&self) -> Result<()> {
        let Some(first) = self.trials.first() else { return Ok(()) };
        let (options, defaults) = (self.options(first)?, ForcesArgs::of(&first.files.recording, &[])?);
        if options.output != defaults.output || options.keep != defaults.keep {
            anyhow::bail!("options after `--`: a session writes its own files. hint: give -o before `--`");
        }
        Ok(())
    }

    /// Computes all trials.
    pub(super) fn compute(&self, said: &(dyn Fn(usize) + Sync)) -> ComputedVisit {
        let shared = Shared::default();
        let runs = side_by_side(self.trials.len(), self.threads, |k| {
            said(k);
            self.run(self.trials[k], None, &shared)
        });
        let bodies: Vec<String> = runs.iter().flatten().map(|run| fingerprint(&run.outcome)).collect();
        let first = self.first_of(&runs);
        if bodies.windows(2).all(|pair| pair[0] == pair[1]) {
            return ComputedVisit { body: first.map_or(String::new(), |k| self.words_for(k, &runs)), runs };
        }
        match first {
            Some(first) => self.again_with_one_body(first, runs),
            None => ComputedVisit { runs, body: String::new() },
        }
    }

    /// A trial, with a stated mass or with a body that was calibrated before.
    fn run(&self, trial: &PlannedTrial, mass_kg: Option<f64>, shared: &Shared) -> Result<MotionRun, String> {
        let computed = match &trial.broken {
            Some(reason) => Err(Error::msg(reason.clone())),
            None => self.options(trial).and_then(|mut args| {
                args.subject.mass = mass_kg.or(args.subject.mass);
                forces::compute_with(&args, self.caller, shared)
            }),
        };
        computed.map_err(|error| {
            let (message, hint) = printer::error_parts(&error);
            sentence(&message, hint, &trial.files.recording, self.root)
        })
    }

    /// The trial that gives the body: of those whose data are not bad the one whose markers lie nearest to their body.
    fn first_of(&self, runs: &[Result<MotionRun, String>]) -> Option<usize> {
        let rank = |k: &usize| {
            let outcome = &runs[*k].as_ref().ok()?.outcome;
            let is_bad = outcome.quality.state == QualityState::Bad;
            Some((is_bad, marker_rms_m(outcome)))
        };
        let computed = (0..runs.len()).filter(|k| runs[*k].is_ok());
        computed.min_by(|a, b| {
            let (a, b) = (rank(a).unwrap_or((true, f64::MAX)), rank(b).unwrap_or((true, f64::MAX)));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        })
    }

    fn again_with_one_body(&self, first: usize, runs: Vec<Result<MotionRun, String>>) -> ComputedVisit {
        let mass_kg = median_mass(&runs);
        let own = self.run(self.trials[first], mass_kg, &Shared::default());
        let body = own.as_ref().ok().and_then(|run| subject(&run.outcome)).cloned();
        let mass_of_others = mass_kg.filter(|_| body.is_none());
        let shared = Shared { body, ..Shared::default() };
        let own = std::sync::Mutex::new(Some(own));
        let again = side_by_side(runs.len(), self.threads, |k| match &runs[k] {
            Err(error) => Err(error.clone()),
            Ok(_) if k == first => {
                let taken = own.lock().unwrap_or_else(std::sync::PoisonError::into_inner).take();
                taken.unwrap_or_else(|| self.run(self.trials[first], mass_kg, &Shared::default()))
            }
            Ok(_) => self.run(self.trials[k], mass_of_others, &shared),
        });
        let of_first = again[first].as_ref().ok().map(|run| fingerprint(&run.outcome));
        let differs = |run: &MotionRun| Some(fingerprint(&run.outcome)) != of_first;
        let refused = again.into_iter().map(|run| match run {
            Ok(run) if differs(&run) => Err(format!(
                "its body is another one than that of {}: a session has one body. hint: state the same model for all trials, or leave this one out (`exclude` in trials.toml)",
                self.trials[first].name
            )),
            run => run,
        });
        let runs: Vec<Result<MotionRun, String>> = refused.collect();
        ComputedVisit { body: self.words_for(first, &runs), runs }
    }

    /// `built-in, calibrated from Static1.c3d; 83.4 kg`
    fn words_for(&self, first: usize, runs: &[Result<MotionRun, String>]) -> String {
        let Ok(run) = &runs[first] else { return String::new() };
        let files = &self.trials[first].files;
        let shown = |path: &Path| path.strip_prefix(self.root).unwrap_or(path).display().to_string().replace('\\', "/");
        match (subject(&run.outcome), &files.standing) {
            (Some(subject), Some(standing)) if subject.calibration.is_some() => {
                format!("built-in, calibrated from {}", shown(standing))
            }
            (Some(subject), None) if subject.calibration.is_some() => {
                format!("built-in, calibrated from {}, without a standing trial", self.trials[first].name)
            }
            (Some(_), Some(standing)) => format!("{}, scaled by {}", run.outcome.body.name(), shown(standing)),
            _ => run.outcome.body.name().to_owned(),
        }
    }
}

/// The body and the markers on it, as a hash.
fn fingerprint(outcome: &Outcome) -> String {
    hash(format!("{:?}", outcome.body).as_bytes())
}

/// The body that followed markers.
fn subject(outcome: &Outcome) -> Option<&Subject> {
    match &outcome.tracking {
        Some(Tracking::Markers(markers)) => Some(&markers.body.subject),
        _ => None,
    }
}

/// Median distance of the markers from the body over the frames [m]; infinite without markers.
fn marker_rms_m(outcome: &Outcome) -> f64 {
    match &outcome.tracking {
        Some(Tracking::Markers(markers)) => {
            let known = markers.body.fit.rms_m.iter().copied().filter(|rms_m| rms_m.is_finite());
            median(known).unwrap_or(f64::INFINITY)
        }
        _ => f64::INFINITY,
    }
}

/// Median mass of the trials whose data are not bad, or of all.
fn median_mass(runs: &[Result<MotionRun, String>]) -> Option<f64> {
    let masses = |is_counted: fn(&Outcome) -> bool| {
        let counted = runs.iter().flatten().map(|run| &run.outcome).filter(|outcome| is_counted(outcome));
        median(counted.map(|outcome| outcome.body.mass()))
    };
    masses(|outcome| outcome.quality.state != QualityState::Bad).or_else(|| masses(|_| true))
}
