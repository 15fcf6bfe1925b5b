//! Folders and lists of recordings: which files are trials, which other files belong to each, and the job of each.

mod found_file;
mod manifest;
pub(crate) mod participants;
mod plan;
mod recorded_person;

pub use found_file::{FoundFile, Wanted};
pub use plan::{Content, LIST, Listing, Plan, PlannedTrial, TrialFolder, relative};

use super::{ForceFiles, Job, ModelChoice};
use crate::study::StatedSize;
use std::path::PathBuf;

/// The files of a trial, and the size of its person.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrialFiles {
    /// The recording.
    pub recording: PathBuf,
    /// The number of the trial in a `.b3d`.
    pub trial: Option<String>,
    /// The same person standing still.
    pub standing: Option<PathBuf>,
    /// The same person in a movement of hips and knees that shows the joints.
    pub functional: Option<PathBuf>,
    /// The model.
    pub model: Option<PathBuf>,
    /// The table of ground forces.
    pub grf: Option<PathBuf>,
    /// The external loads.
    pub loads: Option<PathBuf>,
    /// Body mass and stature.
    pub size: StatedSize,
}

impl TrialFiles {
    /// The job of the trial: the job of all trials, with the files of this one where the job names none. The size of
    /// the trial counts before the size of all trials.
    #[must_use]
    pub fn job(&self, of_all: &Job) -> Job {
        let TrialFiles { recording, trial, standing, functional, model, grf, loads, size } = self.clone();
        let given = of_all.clone();
        Job {
            recording: Some(recording),
            trial: given.trial.or(trial),
            standing: given.standing.or(standing),
            functional: given.functional.or(functional),
            model: given.model.or(model.map(ModelChoice::from)),
            size: StatedSize {
                mass_kg: size.mass_kg.or(given.size.mass_kg),
                height_m: size.height_m.or(given.size.height_m),
            },
            forces: ForceFiles {
                table: given.forces.table.or(grf),
                loads: given.forces.loads.or(loads),
                ..given.forces
            },
            ..given
        }
    }
}
