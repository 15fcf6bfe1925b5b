//! `ambulo calibrate`: what force plates show about the predicted ground forces of a person.

use super::forces;
use crate::args::{CalibrateArgs, Outputs, PrintArgs};
use crate::caller::Caller;
use crate::{Completion, files, printer};
use ambulo::ground::predict::PersonalErrors;
use ambulo::job::Job;
use ambulo::study::{Outcome, personal_errors};
use anyhow::{Error, Result};
use std::path::PathBuf;

pub(crate) fn run(args: &CalibrateArgs) -> Result<Completion> {
    let inputs: Vec<_> = args.trials.iter().chain(&args.subject.still).chain(&args.model).cloned().collect();
    files::check_target(&args.output, &inputs, args.replace.existing())?;
    let person = compute(&args.trials, &args.job(), args.print, &Caller::default())?;
    files::write(&args.output, person.to_toml().as_bytes())?;
    printer::calibrate(&person, args.trials.len(), &args.output, args.print)?;
    Ok(Completion::Passed)
}

/// The calibration that the trials show.
pub(crate) fn compute(trials: &[PathBuf], of_all: &Job, print: PrintArgs, caller: &Caller) -> Result<PersonalErrors> {
    let mut outcomes: Vec<Outcome> = Vec::new();
    for trial in trials {
        printer::progress(&format!("predicting {}", trial.display()), print);
        let job = Job { recording: Some(trial.clone()), ..of_all.clone() };
        outcomes.push(forces::compute(&job, Outputs::default(), caller)?.into_outcome());
    }
    personal_errors(&outcomes).map_err(|error| {
        let trial = error.trial().map(|number| trials[number].display().to_string());
        let error = Error::new(error);
        match trial {
            Some(trial) => error.context(trial),
            None => error,
        }
    })
}
