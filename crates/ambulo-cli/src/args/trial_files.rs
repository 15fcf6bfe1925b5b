//! The files of a trial of a folder, and the options by which it is computed.

use super::forces::{ForcesArgs, SubjectArgs};
use std::ffi::OsString;
use std::path::PathBuf;

/// The files of a trial, and what is stated about its person.
#[derive(Debug, Clone, Default)]
pub(crate) struct TrialFiles {
    pub(crate) recording: PathBuf,
    /// The number of the trial in a .b3d.
    pub(crate) trial: Option<String>,
    pub(crate) standing: Option<PathBuf>,
    pub(crate) model: Option<PathBuf>,
    pub(crate) grf: Option<PathBuf>,
    pub(crate) loads: Option<PathBuf>,
    pub(crate) mass: Option<f64>,
    pub(crate) height: Option<f64>,
}

impl TrialFiles {
    /// The options by which `ambulo forces` computes the trial: these words, with the files of the trial where the words name none.
    pub(crate) fn options(&self, words: &[OsString]) -> Result<ForcesArgs, clap::Error> {
        let given = ForcesArgs::of(&self.recording, words)?;
        let TrialFiles { trial, standing, model, grf, loads, mass, height, .. } = self.clone();
        let subject = SubjectArgs {
            still: given.subject.still.or(standing),
            mass: mass.or(given.subject.mass),
            height: height.or(given.subject.height),
            ..given.subject
        };
        let (model, grf, loads) = (given.model.or(model), given.grf.or(grf), given.loads.or(loads));
        Ok(ForcesArgs { subject, trial: given.trial.or(trial), model, grf, loads, ..given })
    }
}
