//! A result folder in the formats of other programs.

use super::glb::glb;
use super::long_table::long_table;
use super::skeleton::skeleton_of;
use crate::stage::{FolderMotion, Stage, folder_motion};
use ambulo::kinematics::Trajectory;
use ambulo::model::Model;
use ambulo_results::{Folder, ResultsError};

/// Why a folder, or a motion, makes no file.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ExchangeError {
    /// A file of the folder that is not what its name says.
    #[error(transparent)]
    Folder(#[from] ResultsError),
    /// A folder that lacks what the file is made of.
    #[error("{folder}: {reason}")]
    Nothing {
        /// The folder.
        folder: String,
        /// What is missing, in a sentence.
        reason: String,
    },
    /// What the format cannot hold.
    #[error(transparent)]
    Format(#[from] ambulo_formats::Error),
    /// Data that JSON cannot hold.
    #[error("the description could not be written: {0}")]
    Data(#[from] serde_json::Error),
}

/// An animated glTF file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Glb {
    /// The file.
    pub bytes: Vec<u8>,
    /// How many forces are arrows in it.
    pub arrows: usize,
}

/// An animated glTF file (`.glb`) of a result folder: the figure or the scene, ground forces as arrows.
///
/// # Errors
/// A folder without bodies in motion, or with a file that is not what its name says.
pub fn glb_of_folder(folder: &Folder<'_>) -> Result<Glb, ExchangeError> {
    let stage = Stage::of_folder(folder)?.map_err(|reason| nothing(folder, reason))?;
    Ok(Glb { bytes: glb(&stage, &folder.name)?, arrows: stage.forces.len() })
}

/// An animated glTF file (`.glb`) of a model's motion.
///
/// # Errors
/// A motion that leads out of what can be drawn, data that JSON cannot hold.
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
/// A folder without a figure in motion, or with a file that is not what its name says; bodies that a skeleton cannot hold.
pub fn bvh_of_folder(folder: &Folder<'_>) -> Result<Vec<u8>, ExchangeError> {
    let FolderMotion { model, trajectory, .. } = folder_motion(folder)?.map_err(|reason| nothing(folder, reason))?;
    Ok(skeleton_of(&model, &trajectory)?.write())
}

/// The results of a folder over time as one long table: `time,quantity,unit,value`.
///
/// # Errors
/// A folder without results over time, or with a file that is not what its name says.
pub fn csv_of_folder(folder: &Folder<'_>) -> Result<String, ExchangeError> {
    long_table(folder)?.map_err(|reason| nothing(folder, reason))
}

fn nothing(folder: &Folder<'_>, reason: String) -> ExchangeError {
    ExchangeError::Nothing { folder: folder.name.clone(), reason }
}
