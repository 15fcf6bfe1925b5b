//! Why a recording cannot calibrate a body.

use crate::model::anthropometry::BuildError;

/// Why a recording cannot calibrate a body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CalibrationError {
    /// Required markers are missing.
    #[error(
        "the {part} cannot be found: {needed} are needed; found {found}. hint: docs/MARKERS.md lists the markers that \
         a body needs; a standing trial often has markers that the walk lacks"
    )]
    Markers {
        /// The part of the body.
        part: String,
        /// The landmarks that are needed.
        needed: String,
        /// The landmarks that the recording has.
        found: String,
    },
    /// The markers exist but are not visible together in enough frames.
    #[error(
        "the markers of the {part} are visible together in {seen} of {frames} frames; expected at least {expected}. \
         hint: use another trial, or fill the gaps"
    )]
    Unseen {
        /// The part of the body.
        part: String,
        /// Frames with all of them.
        seen: usize,
        /// All frames.
        frames: usize,
        /// Number of frames that are needed.
        expected: usize,
    },
    /// An implausible length.
    #[error("the {part} would be {found_m:.3} m long; expected {least_m:.2} to {most_m:.2} m. hint: {hint}")]
    Length {
        /// The part of the body.
        part: String,
        /// Length from the markers [m].
        found_m: f64,
        /// Shortest [m].
        least_m: f64,
        /// Longest [m].
        most_m: f64,
        /// Possible cause.
        hint: &'static str,
    },
    /// A segment table without a separate pelvis.
    #[error("the table {table} has no pelvis; expected de-leva-male or de-leva-female for a body that follows markers")]
    NoPelvis {
        /// The table.
        table: &'static str,
    },
    /// A body of this mass and stature cannot be built.
    #[error(transparent)]
    Build(#[from] BuildError),
}
