//! Why a recording gives no body.

use crate::model::anthropometry::BuildError;

/// Why a recording gives no body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// Markers without which no body can be placed.
    #[error(
        "the {part} cannot be found: {needed} are needed; found {found}. hint: docs/MARKERS.md lists what a body needs; a standing trial often has markers that the walk lacks"
    )]
    Markers {
        /// Which part of the body.
        part: String,
        /// The landmarks that are needed.
        needed: String,
        /// The landmarks that the recording has.
        found: String,
    },
    /// All markers are there by name, but never together.
    #[error(
        "the markers of the {part} were seen together in {seen} of {frames} frames; expected at least {expected}. hint: use another trial, or fill gaps"
    )]
    Unseen {
        /// Which part of the body.
        part: String,
        /// Frames with all of them.
        seen: usize,
        /// All frames.
        frames: usize,
        /// How many are needed.
        expected: usize,
    },
    /// A length that no walker has.
    #[error("the {part} would be {found_m:.3} m long; expected {least_m:.2} to {most_m:.2} m. hint: {hint}")]
    Length {
        /// Which part of the body.
        part: String,
        /// What the markers say [m].
        found_m: f64,
        /// Shortest [m].
        least_m: f64,
        /// Longest [m].
        most_m: f64,
        /// What may be wrong.
        hint: &'static str,
    },
    /// A table that does not split the trunk.
    #[error("the table {table} has no pelvis; expected de-leva-male or de-leva-female for a body that follows markers")]
    NoPelvis {
        /// The table.
        table: &'static str,
    },
    /// No body of this mass and stature.
    #[error(transparent)]
    Build(#[from] BuildError),
}
