//! A request for muscle forces.

use crate::model::Model;
use crate::muscles::emg::EmgRecording;
use crate::muscles::set::MuscleSet;
use crate::muscles::settings::MuscleSettings;
use ambulo_formats::osim::OsimForceSet;
use std::sync::Arc;

/// A request for muscle forces.
#[derive(Debug, Clone)]
pub struct MuscleRequest {
    /// The muscles.
    pub muscles: MuscleSource,
    /// How their forces are found.
    pub settings: MuscleSettings,
    /// Motors that help them; `None` takes those of the settings.
    pub reserves: Option<OsimForceSet>,
    /// Distance between the contacts of both condyles of a knee [m]; `None` takes it from the width of each knee
    /// in the recording, or from stature.
    pub condyles_m: Option<f64>,
    /// Electromyograms of the recording.
    pub emg: Option<EmgRecording>,
}

/// Whose muscles.
#[derive(Debug, Clone)]
pub enum MuscleSource {
    /// The muscles of a model, with the model as in its file. They are scaled as the body is.
    Model(Arc<ModelMuscles>),
    /// Those of the built-in body.
    BuiltIn,
}

/// A model with its muscles.
#[derive(Debug, Clone)]
pub struct ModelMuscles {
    /// The model as in its file.
    pub model: Model,
    /// Its muscles.
    pub set: MuscleSet,
}
