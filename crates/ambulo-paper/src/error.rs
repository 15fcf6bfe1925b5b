//! Errors of the reproduction of the paper.

use ambulo_body::model::anthropometry::BuildError;
use ambulo_body::toml_reader::TomlError;
use ambulo_walk::gait::GaitError;
use ambulo_walk::walking::WalkingError;

/// A walk could not be made.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ReproductionError {
    /// The figure is not possible.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// The gait is not possible.
    #[error(transparent)]
    Gait(#[from] GaitError),
    /// The walk could not be simulated.
    #[error(transparent)]
    Walking(#[from] WalkingError),
    /// The setting cannot be read.
    #[error("the setting: {0}")]
    Setting(#[from] TomlError),
    /// A mode could not make the walk.
    #[error("the walk `{gait}` could not be made: {reason}")]
    Mode {
        /// Name of the gait.
        gait: String,
        /// Cause.
        reason: String,
    },
    /// The recording is too short.
    #[error("the walk `{gait}` has {found} whole cycles; expected at least {expected}")]
    Cycles {
        /// Name of the gait.
        gait: String,
        /// Number of whole cycles.
        found: usize,
        /// Smallest number of cycles.
        expected: usize,
    },
}
