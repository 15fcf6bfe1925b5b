//! What the ground does to the feet, from the motion alone.
//!
//! Newton's and Euler's laws for the whole body give the total wrench of the ground ([`total`]); the feet's own motion says when each
//! stands ([`super::footfalls`]). While one foot stands it takes all. While both stand six equations face twelve unknowns, and a rule
//! divides ([`hand_over`]): its name goes with every result.
//! Pinned by: tests/ground_predict.rs

mod hand_over;
mod known;
mod total;

use super::footfalls::{Footfalls, footfalls};
use super::plates::foot_bodies;
use super::sole::Sole;
use super::{GroundForces, upward};
use crate::findings::Findings;
use crate::kinematics::Trajectory;
use crate::model::{Model, Side};
use crate::spatial::{Vec3, Wrench};
pub use known::Known;
pub use total::total_wrench;

/// Forces under the feet that no plate measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Prediction {
    /// What the ground does: one entry a foot, right and left.
    pub ground: GroundForces,
    /// How far it may be off: right and left.
    pub deviations: Vec<FootDeviation>,
    /// When the feet stand.
    pub footfalls: Footfalls,
    /// Of the ground on the body, by Newton's law alone: force [N] and moment about the world's origin [N.m], one entry a frame.
    pub total: Vec<Wrench>,
    /// How double support was divided, in words.
    pub rule: &'static str,
}

/// Standard deviations of what was predicted for a foot, one entry a frame; zero while it is unloaded.
#[derive(Debug, Clone, PartialEq)]
pub struct FootDeviation {
    /// Which foot.
    pub side: Side,
    /// Of the force [N].
    pub force: Vec<Vec3>,
    /// Of the centre of pressure [m].
    pub center: Vec<Vec3>,
    /// Of the free moment [N.m].
    pub free_moment: Vec<f64>,
}

/// How forces are predicted.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PredictSettings {
    /// What is known from elsewhere and need not be found.
    pub known: Known,
}

/// Why no forces can be predicted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PredictError {
    /// A model without feet.
    #[error(
        "the model `{model}` has no bodies called calcn_r and calcn_l, foot_r and foot_l or talus_r and talus_l; expected feet for the ground to act on. hint: --no-ground computes a motion without contact, --grf gives measured forces"
    )]
    NoFeet {
        /// Its name.
        model: String,
    },
    /// A foot without a sole.
    #[error(
        "the {side} sole of the model `{model}` is not known: it has no body calcn_{letter} below a coordinate ankle_angle_{letter}; expected both feet. hint: --no-ground computes a motion without contact, --grf gives measured forces", letter = side.letter()
    )]
    NoSole {
        /// Its name.
        model: String,
        /// Which foot.
        side: Side,
    },
    /// What is known has another number of frames than the motion.
    #[error("the known {what} has {found} frames; expected {expected}, as many as the motion")]
    Shape {
        /// What is known.
        what: &'static str,
        /// How many frames it has.
        found: usize,
        /// How many it should have.
        expected: usize,
    },
}

/// Predicts the forces under both feet. `soles` are those of the right and the left foot.
///
/// # Errors
/// A model without feet or soles, known numbers of another length than the motion: see [`PredictError`].
pub fn predict(
    model: &Model,
    trajectory: &Trajectory,
    soles: &[Option<Sole>; 2],
    settings: &PredictSettings,
    findings: &mut Findings,
) -> Result<Prediction, PredictError> {
    let name = || model.name().to_owned();
    let bodies = foot_bodies(model).ok_or_else(|| PredictError::NoFeet { model: name() })?;
    let sole = |side: Side| soles[side as usize].ok_or_else(|| PredictError::NoSole { model: name(), side });
    let soles = [sole(Side::Right)?, sole(Side::Left)?];
    settings.known.check(trajectory.grid().frames)?;
    let footfalls = match &settings.known.footfalls {
        Some(known) => known.clone(),
        None => footfalls(model, trajectory, &soles.map(Some), findings),
    };
    let total = settings.known.total(total_wrench(model, trajectory));
    let divided = hand_over::divide(model, trajectory, &soles, &footfalls, &total, &settings.known);
    let up = upward(model);
    let ground = bodies.into_iter().zip(&divided).map(|(body, foot)| foot.on(body, up));
    let ground = GroundForces { bodies: ground.collect() };
    let deviations = Side::BOTH.into_iter().zip(&ground.bodies);
    let deviations = deviations.map(|(side, foot)| hand_over::deviation(model, side, foot)).collect();
    Ok(Prediction { ground, deviations, footfalls, total, rule: hand_over::RULE })
}
