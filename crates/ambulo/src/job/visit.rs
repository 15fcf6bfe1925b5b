//! The trials of a visit, computed with one body.
//!
//! 1. Every trial is computed with its own body.
//! 2. Where the bodies are the same, because a model or a standing trial with a known mass gives them, this is all.
//! 3. Otherwise the mass is the median of the trials whose data are not bad. The body is calibrated once with this
//!    mass, from the standing trial or, without one, from the trial whose markers lie nearest to their body; the other
//!    trials are computed again with it.

use super::Job;
use super::trials::PlannedTrial;
use crate::analysis::Subject;
use crate::model::Marker;
use crate::numerics::median;
use crate::study::{GroundSettings, Outcome, QualityState, Tracking};
use std::path::Path;

/// A trial to be computed, and what is known of its body.
#[derive(Debug, Clone, Default)]
pub struct VisitRun {
    /// Number of the trial.
    pub trial: usize,
    /// The mass of the body [kg]; `None` takes the mass of the job.
    pub mass_kg: Option<f64>,
    /// The body; `None` takes the body of the job.
    pub body: Option<Subject>,
}

/// Computes some trials of a visit, in any order; the results are in the order of the argument.
pub type ComputeRuns<'a, R> = dyn FnMut(&[VisitRun]) -> Vec<Result<R, String>> + 'a;

/// A visit whose trials were computed: each with one body, or with the reason why not.
pub struct ComputedVisit<R> {
    /// The trials, in their order.
    pub runs: Vec<Result<R, String>>,
    /// Where the body comes from, such as `built-in, calibrated from Static1.c3d`.
    pub body: String,
}

impl VisitRun {
    /// The job of a trial: `of_trial` with the mass of the visit, if there is one.
    #[must_use]
    pub fn job(&self, of_trial: &Job) -> Job {
        let mut job = of_trial.clone();
        job.size.mass_kg = self.mass_kg.or(job.size.mass_kg);
        job
    }
}

/// The job of all trials of a visit: ground forces are predicted, alongside measured ones.
#[must_use]
pub fn of_all_trials(mut job: Job) -> Job {
    if job.settings.ground == GroundSettings::MeasuredOrPredicted {
        job.settings.ground = GroundSettings::Predicted;
    }
    job
}

/// Computes the trials of a visit.
pub fn compute<R: AsRef<Outcome>>(
    root: &Path,
    trials: &[&PlannedTrial],
    run: &mut ComputeRuns<'_, R>,
) -> ComputedVisit<R> {
    let alone: Vec<VisitRun> = (0..trials.len()).map(|trial| VisitRun { trial, ..VisitRun::default() }).collect();
    let runs = run(&alone);
    let Some(first) = first_of(&runs) else { return ComputedVisit { runs, body: String::new() } };
    let runs = match has_one_body(&runs) {
        true => runs,
        false => again_with_one_body(first, runs, trials, run),
    };
    let body = runs[first].as_ref().map_or(String::new(), |run| source_of_body(root, trials[first], run.as_ref()));
    ComputedVisit { runs, body }
}

/// Whether all trials that were computed have the same body, with the same markers on it.
fn has_one_body<R: AsRef<Outcome>>(runs: &[Result<R, String>]) -> bool {
    let mut outcomes = runs.iter().flatten().map(AsRef::as_ref);
    let Some(first) = outcomes.next().map(every_number) else { return true };
    outcomes.all(|outcome| every_number(outcome) == first)
}

/// All numbers and names of a body, without the markers that a trial adds to the calibration.
fn every_number(outcome: &Outcome) -> String {
    let calibrated = subject(outcome).and_then(|subject| subject.calibration.as_ref());
    let is_shared =
        |marker: &&Marker| calibrated.is_none_or(|report| report.markers.iter().any(|own| own.name == marker.name));
    let markers = outcome.body.markers().iter().filter(is_shared).cloned().collect();
    format!("{:?}", outcome.body.with_markers(markers))
}

/// The trial that gives the body: among trials whose data are not bad, the one with the smallest distance between
/// markers and body.
fn first_of<R: AsRef<Outcome>>(runs: &[Result<R, String>]) -> Option<usize> {
    let rank = |k: &usize| {
        let outcome = runs[*k].as_ref().ok()?.as_ref();
        let is_bad = outcome.quality.state == QualityState::Bad;
        Some((is_bad, marker_rms_m(outcome)))
    };
    let computed = (0..runs.len()).filter(|k| runs[*k].is_ok());
    computed.min_by(|a, b| {
        let (a, b) = (rank(a).unwrap_or((true, f64::MAX)), rank(b).unwrap_or((true, f64::MAX)));
        a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
    })
}

fn again_with_one_body<R: AsRef<Outcome>>(
    first: usize,
    runs: Vec<Result<R, String>>,
    trials: &[&PlannedTrial],
    run: &mut ComputeRuns<'_, R>,
) -> Vec<Result<R, String>> {
    let mass_kg = median_mass(&runs);
    let of_first = VisitRun { trial: first, mass_kg, body: None };
    let Some(own) = run(&[of_first]).pop() else { return runs };
    let body = own.as_ref().ok().and_then(|run| subject(run.as_ref())).cloned();
    let mass_kg = mass_kg.filter(|_| body.is_none());
    let others = (0..runs.len()).filter(|k| *k != first && runs[*k].is_ok());
    let others: Vec<VisitRun> = others.map(|trial| VisitRun { trial, mass_kg, body: body.clone() }).collect();
    let mut runs = runs;
    for (order, found) in others.iter().zip(run(&others)) {
        runs[order.trial] = found;
    }
    runs[first] = own;
    let of_first = runs[first].as_ref().ok().map(|run| every_number(run.as_ref()));
    let refused = runs.into_iter().map(|run| match run {
        Ok(run) if Some(every_number(run.as_ref())) != of_first => Err(format!(
            "its body is another one than that of {}: a session has one body. hint: state the same model for all \
             trials, or leave this one out (`exclude` in trials.toml)",
            trials[first].name
        )),
        run => run,
    });
    refused.collect()
}

/// `built-in, calibrated from Static1.c3d`
fn source_of_body(root: &Path, trial: &PlannedTrial, outcome: &Outcome) -> String {
    let shown = |path: &Path| path.strip_prefix(root).unwrap_or(path).display().to_string().replace('\\', "/");
    match (subject(outcome), &trial.files.standing) {
        (Some(subject), Some(standing)) if subject.calibration.is_some() => {
            format!("built-in, calibrated from {}", shown(standing))
        }
        (Some(subject), None) if subject.calibration.is_some() => {
            format!("built-in, calibrated from {}, without a standing trial", trial.name)
        }
        (Some(_), Some(standing)) => format!("{}, scaled by {}", outcome.body.name(), shown(standing)),
        _ => outcome.body.name().to_owned(),
    }
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
fn median_mass<R: AsRef<Outcome>>(runs: &[Result<R, String>]) -> Option<f64> {
    let masses = |is_counted: fn(&Outcome) -> bool| {
        let counted = runs.iter().flatten().map(|run| run.as_ref()).filter(|outcome| is_counted(outcome));
        median(counted.map(|outcome| outcome.body.mass()))
    };
    masses(|outcome| outcome.quality.state != QualityState::Bad).or_else(|| masses(|_| true))
}
