//! Why a figure cannot walk.

use crate::contact::ShapeError;
use crate::dynamics::LinkError;
use crate::kinematics::TrajectoryError;
use crate::simulation::WorldError;

/// Why a figure cannot walk.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WalkingError {
    /// A joint that does not keep to the plane.
    #[error(
        "joint `{joint}`: {found}; expected one hinge about z, and for the root a turn about z with slides along x and y"
    )]
    Joint {
        /// The joint.
        joint: String,
        /// What it has.
        found: String,
    },
    /// Signals for another model.
    #[error("{found} signals for {expected} coordinates; expected one each")]
    Signals {
        /// How many there are.
        found: usize,
        /// How many there should be.
        expected: usize,
    },
    /// No time to walk.
    #[error("{duration_s} s in steps of {step_s} s; expected at least one whole step")]
    Duration {
        /// What was asked for [s].
        duration_s: f64,
        /// Step [s].
        step_s: f64,
    },
    /// A sole that is no sphere.
    #[error(transparent)]
    Sole(#[from] ShapeError),
    /// A world that makes no sense.
    #[error(transparent)]
    World(#[from] WorldError),
    /// Joints that are no tree.
    #[error(transparent)]
    Link(#[from] LinkError),
    /// Motion that is no number.
    #[error("the walk came to nothing that can be numbered")]
    Motion(#[from] TrajectoryError),
}
