//! Adds the file or the field concerned to errors of the computation.

use super::Job;
use super::error::{Field, JobError};
use crate::study::{Input, StudyError};
use std::path::Path;

/// An error with the file concerned in front; `ground` is the table of ground forces.
pub(super) fn located(error: StudyError, job: &Job, ground: Option<&Path>) -> JobError {
    let shown = |path: &Path| path.display().to_string();
    let motion = job.shown();
    let ground_file = ground.map_or_else(|| motion.clone(), shown);
    let about = |field: Field, error: StudyError| JobError::new(&[field], error).within(field.name());
    match (error.input(), &error) {
        (_, StudyError::MassUnknown) => {
            JobError::new(&[Field::Mass], format!("{error}; expected a body mass in kg")).within(motion)
        }
        (_, StudyError::NoSuchPlate { plate, count: 0 }) => {
            let found = format!("{motion} has no force plates; expected a C3D with force plates");
            JobError::new(&[Field::Plates], found).within(format!("plate {}", plate + 1))
        }
        (_, StudyError::NoSuchPlate { plate, count }) => {
            let found = format!("{motion} has {count} force plates; expected a plate from 1 to {count}");
            let hint = "hint: `ambulo info` lists them";
            JobError::new(&[Field::Plates], format!("{found}. {hint}")).within(format!("plate {}", plate + 1))
        }
        (_, StudyError::ForceTable(_)) => {
            let loads = job.forces.loads.as_deref();
            let loads = loads.map_or_else(String::new, |loads| format!(" with {}", loads.display()));
            JobError::new(&[], error).within(format!("{ground_file}{loads}"))
        }
        (_, StudyError::UnknownBody { .. } | StudyError::AddedMass(_)) => about(Field::AddedMass, error),
        (_, StudyError::ResidualReduction(_)) => about(Field::ResidualReduction, error),
        (_, StudyError::Tracking(_)) => about(Field::Ground, error),
        (_, StudyError::MuscleSet(_) | StudyError::BuiltInMuscles(_) | StudyError::Muscles(_)) => {
            about(Field::Muscles, error)
        }
        (Some(Input::StandingTrial), _) => {
            JobError::new(&[], error).within(job.standing.as_deref().map_or(motion, shown))
        }
        (Some(Input::Forces), _) => JobError::new(&[], error).within(ground_file),
        (Some(Input::Device), _) => {
            JobError::new(&[], error).within(job.device.as_deref().map_or_else(String::new, shown))
        }
        (Some(Input::Motion), _) => JobError::new(&[], error).within(motion),
        (None, _) => JobError::new(&[], error),
    }
}
