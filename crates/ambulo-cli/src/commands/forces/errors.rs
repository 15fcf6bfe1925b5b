//! Adds the file concerned and the options that help to errors of the library.

use crate::args::ForcesArgs;
use ambulo::study::{Input, StudyError};
use anyhow::{Error, anyhow};
use std::path::Path;

/// An error with the file concerned in front; `ground` is the table of ground forces.
pub(super) fn with_file(error: StudyError, args: &ForcesArgs, ground: Option<&Path>) -> Error {
    let shown = |path: &Path| path.display().to_string();
    let motion = shown(args.recording());
    let ground_file = ground.map_or_else(|| motion.clone(), shown);
    match (error.input(), &error) {
        (_, StudyError::MassUnknown) => anyhow!("{error}; expected --mass KG").context(motion),
        (_, StudyError::NoSuchPlate { plate, count: 0 }) => {
            anyhow!("--plate {}: {motion} has no force plates; expected a C3D with force plates", plate + 1)
        }
        (_, StudyError::NoSuchPlate { plate, count }) => anyhow!(
            "--plate {}: {motion} has {count} force plates; expected a plate from 1 to {count}. hint: `ambulo info` lists them",
            plate + 1
        ),
        (_, StudyError::ForceTable(_)) => {
            let loads = args.loads.as_deref().map_or_else(String::new, |loads| format!(" with {}", loads.display()));
            Error::new(error).context(format!("{ground_file}{loads}"))
        }
        (_, StudyError::UnknownBody { .. } | StudyError::AddedMass(_)) => Error::new(error).context("--add-mass"),
        (_, StudyError::ResidualReduction(_)) => Error::new(error).context("--consistent"),
        (_, StudyError::Tracking(_)) => {
            anyhow!("{error}. hint: `--predict` needs no motion that feet can make").context("--track")
        }
        (Some(Input::StandingTrial), _) => {
            let still = args.subject.still.as_deref().map_or(motion, shown);
            Error::new(error).context(still)
        }
        (Some(Input::Forces), _) => Error::new(error).context(ground_file),
        (Some(Input::Device), _) => Error::new(error).context(args.device.as_deref().map_or_else(String::new, shown)),
        (Some(Input::Motion), _) => Error::new(error).context(motion),
        (None, _) => Error::new(error),
    }
}
