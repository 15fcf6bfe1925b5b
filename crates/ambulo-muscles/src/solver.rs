//! Muscle forces of one posture: paths, strengths, static optimisation.
//!
//! | step | result |
//! |---|---|
//! | paths | length, lengthening speed and moment arms of each muscle |
//! | strength | its active force at activation 1 |
//! | optimisation | activations and reserves that give the generalised forces |
//!
//! The equations stand for the free coordinates. A coordinate that follows another one adds its generalised force times
//! the slope of the coupler to that of its leader; locked and prescribed ones have no equation.

use crate::body::dynamics::BodyLoad;
use crate::body::kinematics::Posture;
use crate::body::model::{CoordinateId, Model};
use crate::optimization::Convergence;
use crate::set::MuscleSet;
use crate::settings::{MuscleError, MuscleSettings};

/// Computes muscle forces frame after frame. Made once for a model, its muscles and settings; frames allocate nothing.
#[derive(Debug, Clone)]
pub struct MuscleSolver {
    coordinates: Vec<CoordinateId>,
    frame: FrameValues,
}

/// Results of one frame. Slices have one entry per muscle, in the order of [`MuscleSet::muscles`], unless stated
/// otherwise.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FrameValues {
    /// Activations.
    pub activations: Vec<f64>,
    /// Tensions: active forces along the tendon [N].
    pub forces: Vec<f64>,
    /// Forces at activation 1 [N].
    pub strengths: Vec<f64>,
    /// Lengths of the paths [m].
    pub lengths: Vec<f64>,
    /// Lengthening speeds of the paths [m/s].
    pub speeds: Vec<f64>,
    /// Generalised force of the motors at each coordinate of [`MuscleSolver::coordinates`] [N.m or N].
    pub reserves: Vec<f64>,
    /// Part of the generalised force at each of these coordinates that nothing could exert [N.m or N]; 0 unless motors
    /// are missing or limited.
    pub unmet: Vec<f64>,
    /// Load of all tensions on each body that muscles touch.
    pub body_loads: Vec<BodyLoad>,
    /// How the optimisation ended; `None` before the first frame.
    pub convergence: Option<Convergence>,
}

impl MuscleSolver {
    /// Prepares a model and its muscles.
    ///
    /// # Errors
    /// No muscles, curves that cannot be made, weights or motors for names that do not exist: see [`MuscleError`].
    pub fn new(model: &Model, set: &MuscleSet, settings: &MuscleSettings) -> Result<MuscleSolver, MuscleError> {
        let _ = (model, set, settings);
        Err(MuscleError::NoMuscles)
    }

    /// The free coordinates, in the order of [`FrameValues::reserves`].
    #[must_use]
    pub fn coordinates(&self) -> &[CoordinateId] {
        &self.coordinates
    }

    /// Muscle forces of a posture with the generalised forces [N.m or N] of inverse dynamics, one per coordinate of the
    /// model. The last frame is where the optimisation starts; the result does not depend on it.
    ///
    /// # Panics
    /// If the length of a slice differs from the number of coordinates.
    pub fn frame(&mut self, posture: Posture<'_>, generalized: &[f64]) -> &FrameValues {
        let _ = (posture, generalized);
        &self.frame
    }
}
