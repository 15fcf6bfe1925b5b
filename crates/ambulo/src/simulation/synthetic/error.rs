//! Why no walk can be made.

use super::order::{MOST_CYCLES, RATES_HZ};
use crate::gait::GaitError;
use crate::kinematics::TrajectoryError;
use crate::model::anthropometry::BuildError;
use crate::simulation::consistent_walk::ConsistentWalkError;
use crate::simulation::walking::WalkingError;

/// Why no walk can be made.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SyntheticError {
    /// A number of cycles that is no walk.
    #[error("found {found} cycles; expected 1 to {MOST_CYCLES}")]
    Cycles {
        /// What was asked for.
        found: usize,
    },
    /// A rate that shows no walk.
    #[error("found a rate of {found_hz} Hz; expected {} to {} Hz", RATES_HZ[0], RATES_HZ[1])]
    Rate {
        /// What was asked for [Hz].
        found_hz: f64,
    },
    /// The figure.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The gait.
    #[error(transparent)]
    Gait(#[from] GaitError),
    /// Making it consistent.
    #[error(transparent)]
    Consistency(#[from] ConsistentWalkError),
    /// Stepping it through time.
    #[error(transparent)]
    Walking(#[from] WalkingError),
    /// A walk that came to nothing that can be numbered.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
}
