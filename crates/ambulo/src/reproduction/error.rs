//! Why the paper cannot be reproduced.

use crate::gait::GaitError;
use crate::model::anthropometry::BuildError;
use crate::simulation::walking::WalkingError;

/// Why a run failed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReproductionError {
    /// The figure.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The gait.
    #[error(transparent)]
    Gait(#[from] GaitError),
    /// The walk.
    #[error(transparent)]
    Walking(#[from] WalkingError),
    /// A mode of the caller's.
    #[error("the walk `{gait}` failed in its mode: {reason}")]
    Mode {
        /// Name of the gait.
        gait: String,
        /// Why.
        reason: String,
    },
    /// A recording that is too short.
    #[error("the walk `{gait}` has {found} whole cycles; expected at least {expected}")]
    Cycles {
        /// Name of the gait.
        gait: String,
        /// How many there are.
        found: usize,
        /// How many are needed.
        expected: usize,
    },
}
