//! `ambulo forces`: joint moments, powers, reactions and ground forces of a recording.

mod every_trial;
mod record;

use super::run_files::MotionRun;
use super::stopwatch::Stopwatch;
use crate::Completion;
use crate::args::{Handling, Outputs};
use crate::caller::Caller;
use crate::files::FilesOf;
use crate::replacement::ResultTarget;
use crate::request::ForcesRequest;
use ambulo::findings::{Code, Findings};
use ambulo::job::{Job, ModelChoice, Reader, Shared, ending};
use ambulo::motion::SubjectParameters;
use ambulo::study::{ForceOrigin, Outcome, Recording, Stage};
use ambulo_results::{GroundSource, Input, Keep, OutputFile, SUBJECT};
use anyhow::{Result, bail};
use std::ops::ControlFlow;
use std::path::Path;

/// The model of a trial in summaries, if none was given.
const OWN_MODEL: &str = "the file's own";

pub(crate) fn run(request: &ForcesRequest, how: Handling) -> Result<Completion> {
    request.job.check()?;
    if request.chooses_all_trials() {
        return every_trial::run(request, how);
    }
    run_one(request, how)
}

/// Computes one recording into one folder.
fn run_one(request: &ForcesRequest, how: Handling) -> Result<Completion> {
    let target = ResultTarget::for_run(&request.output, how.replace.existing())?;
    compute(&request.job, request.outputs(), &Caller::default())?.write(&target, how.print, how.check)
}

/// Reads the recording and computes its forces.
pub(crate) fn compute(job: &Job, outputs: Outputs, caller: &Caller) -> Result<MotionRun> {
    compute_with(job, outputs, caller, &Shared::default())
}

/// As [`compute`], with what other recordings share.
pub(crate) fn compute_with(job: &Job, outputs: Outputs, caller: &Caller, shared: &Shared) -> Result<MotionRun> {
    check_recording(job.recording())?;
    let mut findings = Findings::default();
    let mut clock = Stopwatch::new();
    let mut files = FilesOf(caller);
    let progress = &mut |part: &'static str| clock.lap(part);
    let read = job.read_with(Reader { files: &mut files, shared, findings: &mut findings, progress })?;
    let stated = match &read.source.recording {
        Recording::Markers(markers) => markers.trial.subject.clone(),
        Recording::Coordinates { .. }
        | Recording::Skeleton { .. }
        | Recording::Sensors(_)
        | Recording::Complete { .. } => SubjectParameters::default(),
    };
    let (job, paths, ground) = (read.job.clone(), read.files.clone(), read.ground.clone());
    let mut watch = |stage: Stage| {
        clock.lap(stage.word());
        if caller.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let outcome = read.run_observed(&mut findings, &mut watch)?;
    let body = body_file(&outcome, &mut findings);
    Ok(MotionRun {
        input: input(&job, ground.as_deref(), stated, &outcome),
        outcome,
        convention: outputs.convention,
        walk: None,
        files: body.into_iter().collect(),
        keep: Keep::of_names(&outputs.keep),
        more: Box::new(|_| Ok(Vec::new())),
        read: paths,
        caller: caller.clone(),
        options: record::options(&job, &outputs),
        findings,
        clock,
    })
}

/// Rejects what is no file.
fn check_recording(recording: &Path) -> Result<()> {
    let shown = recording.display();
    if recording.as_os_str() == "-" {
        bail!("{shown}: standard input is not read; expected the path of a recording");
    }
    if recording.is_dir() {
        bail!(
            "{shown}: this is a folder; expected the path of a recording. hint: `ambulo session {shown}` computes the \
             trials of a visit, `ambulo batch {shown}` all recordings of a folder"
        );
    }
    Ok(())
}

/// The body that was used as an OpenSim model; a note if it cannot be written.
fn body_file(outcome: &Outcome, findings: &mut Findings) -> Option<OutputFile<'static>> {
    let muscles = outcome.muscles.as_ref().map(|found| &found.set);
    match OutputFile::body(SUBJECT, &outcome.body, muscles) {
        Ok(file) => Some(file),
        Err(reason) => {
            findings.report(Code::SubjectNotWritten, format!("{SUBJECT} was not written: {reason}"));
            None
        }
    }
}

/// The input files, for the summary.
fn input(job: &Job, ground: Option<&Path>, stated: SubjectParameters, outcome: &Outcome) -> Input {
    let shown = |path: &Path| path.display().to_string();
    let is_measured = matches!(outcome.force_origin, ForceOrigin::Measured | ForceOrigin::Mixed { .. })
        || outcome.prediction.as_ref().is_some_and(|prediction| prediction.measured.is_some());
    let is_subject = ending(job.recording()) == "b3d";
    let in_recording = ((outcome.tracking.is_some() || is_subject) && is_measured).then_some(job.recording());
    let of_trial = job.trial.as_ref().map_or_else(String::new, |trial| format!(", trial {trial}"));
    let own = if is_subject && job.model.is_none() { OWN_MODEL } else { ModelChoice::BUILT_IN };
    Input {
        motion: format!("{}{of_trial}", shown(job.recording())),
        person: stated.name,
        recorded_on: stated.recorded_on,
        model: job.model_file().map_or(own.into(), shown),
        standing: job.standing.as_deref().map(shown),
        ground: ground.or(in_recording).map(shown),
        loads: job.forces.loads.as_deref().map(shown),
        device: job.device.as_deref().map(shown),
        added_mass: job.added_mass.iter().map(ToString::to_string).collect(),
        ground_source: GroundSource::None,
    }
}
