//! `ambulo calibrate`: calibrates the predicted ground forces of a person by force plates.

use super::forces;
use crate::args::{Handling, Outputs, PrintArgs};
use crate::caller::Caller;
use crate::request::CalibrateRequest;
use crate::{Completion, files, printer};
use ambulo::findings::{Finding, Findings};
use ambulo::ground::predict::PersonalErrors;
use ambulo::job::{Job, Processing};
use ambulo::study::{GroundSettings, Outcome, personal_errors};
use anyhow::{Error, Result};
use std::path::Path;

pub(crate) fn run(request: &CalibrateRequest, how: Handling) -> Result<Completion> {
    let CalibrateRequest { trials, output, .. } = request;
    let inputs: Vec<_> = request.files().map(Path::to_path_buf).collect();
    files::check_target(output, &inputs, how.replace.existing())?;
    let (person, _) = compute(request, how.print, &Caller::default())?;
    files::write(output, person.to_toml().as_bytes())?;
    printer::calibrate(&person, trials.len(), output, how.print)?;
    Ok(Completion::Passed)
}

/// The calibration that the trials show, and the findings of all trials, each with the name of its trial.
pub(crate) fn compute(
    request: &CalibrateRequest,
    print: PrintArgs,
    caller: &Caller,
) -> Result<(PersonalErrors, Findings)> {
    let trials = &request.trials;
    let mut outcomes: Vec<Outcome> = Vec::new();
    let mut findings = Findings::default();
    for (trial, of_trial) in trials.iter().zip(request.jobs()?) {
        printer::progress(&format!("predicting {}", trial.display()), print);
        let settings = Processing { ground: GroundSettings::Predicted, ..of_trial.settings.clone() };
        let job = Job { settings, ..of_trial };
        job.check()?;
        let run = forces::compute(&job, Outputs::default(), caller)?;
        printer::warnings_of_trial(trial, run.findings.as_slice(), print);
        for finding in run.findings.as_slice() {
            let message = format!("{}: {}", trial.display(), finding.message);
            findings.add(Finding { message, ..finding.clone() });
        }
        outcomes.push(run.into_outcome());
    }
    let person = personal_errors(&outcomes).map_err(|error| {
        let trial = error.trial().map(|number| trials[number].display().to_string());
        let error = Error::new(error);
        match trial {
            Some(trial) => error.context(trial),
            None => error,
        }
    })?;
    Ok((person, findings))
}
