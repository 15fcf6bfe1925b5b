//! Converts a result folder to the formats of other programs.

use super::glb::glb;
use super::long_table::long_table;
use super::skeleton::skeleton_of;
use crate::stage::{FolderMotion, Stage, folder_motion};
use ambulo::kinematics::rig::RigError;
use ambulo::kinematics::{Trajectory, TrajectoryError};
use ambulo::model::Model;
use ambulo::model::marker_set::MarkerSetError;
use ambulo::motion::skeleton::SkeletonError;
use ambulo_results::{Folder, ResultsError};

/// Why a folder, a motion or a figure cannot be converted or drawn.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// A file of the folder cannot be read.
    #[error(transparent)]
    Folder(#[from] ResultsError),
    /// The folder lacks the required data.
    #[error("{folder}: {reason}")]
    Nothing {
        /// The folder.
        folder: String,
        /// Missing data, in a sentence.
        reason: String,
    },
    /// The format cannot store the data.
    #[error(transparent)]
    Format(#[from] ambulo_formats::Error),
    /// The animation file cannot be read.
    #[error(transparent)]
    Skeleton(#[from] SkeletonError),
    /// The folder is not the result of the animation file.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A built-in marker set cannot be read.
    #[error(transparent)]
    Markers(#[from] MarkerSetError),
    /// The posture of the figure is not possible.
    #[error(transparent)]
    Posture(#[from] TrajectoryError),
    /// Data that JSON cannot store.
    #[error("the description could not be written: {0}")]
    Data(#[from] serde_json::Error),
}

/// An animated glTF file (`.glb`) of a result folder: the figure or the scene, ground forces as arrows; and the number
/// of arrows.
///
/// # Errors
/// A folder without moving bodies, or with a file that cannot be read.
pub fn glb_of_folder(folder: &Folder<'_>) -> Result<(Vec<u8>, usize), ExchangeError> {
    let stage = Stage::of_folder(folder)?.map_err(|reason| nothing(folder, reason))?;
    Ok((glb(&stage, &folder.name)?, stage.forces.len()))
}

/// An animated glTF file (`.glb`) of a model's motion.
///
/// # Errors
/// A motion with numbers beyond the limit for drawing; data that JSON cannot store.
pub fn glb_of_motion(model: &Model, trajectory: &Trajectory) -> Result<Vec<u8>, ExchangeError> {
    let stage = Stage::of_motion(model, trajectory, None);
    if let Some(reason) = stage.defect() {
        return Err(ExchangeError::Nothing { folder: model.name().to_owned(), reason });
    }
    Ok(glb(&stage, model.name())?)
}

/// A BVH skeleton of a result folder's figure.
///
/// # Errors
/// A folder without a moving figure, or with a file that cannot be read; bodies that BVH cannot store.
pub fn bvh_of_folder(folder: &Folder<'_>) -> Result<Vec<u8>, ExchangeError> {
    let FolderMotion { model, trajectory, .. } = folder_motion(folder)?.map_err(|reason| nothing(folder, reason))?;
    Ok(skeleton_of(&model, &trajectory)?.write())
}

/// The results of a folder over time as one long table: `time,quantity,unit,value`.
///
/// # Errors
/// A folder without results over time, or with a file that cannot be read.
pub fn csv_of_folder(folder: &Folder<'_>) -> Result<String, ExchangeError> {
    long_table(folder)?.map_err(|reason| nothing(folder, reason))
}

pub(super) fn nothing(folder: &Folder<'_>, reason: String) -> ExchangeError {
    ExchangeError::Nothing { folder: folder.name.clone(), reason }
}
