//! Why poses of segments cannot be used.

use crate::motion::marker_recording::MarkerError;

/// Smallest share of frames that the file must have between the first and the last.
pub(super) const ONE_IN: u64 = 10;

/// Why poses of segments, or the markers in their place, cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SegmentPoseError {
    /// Segments of the legs that are not there.
    #[error(
        "the file has poses of {found}, but none of {missing}; expected pelvis, thigh, shank and foot of both sides"
    )]
    Incomplete {
        /// The labels in the file.
        found: String,
        /// The missing segments.
        missing: String,
    },
    /// Segments without a pose in any frame.
    #[error(
        "no frame has poses of pelvis, thighs, shanks and feet together; expected at least one. hint: check that the \
         person was tracked in this trial"
    )]
    NeverSeen,
    /// Legs that were not measured.
    #[error(
        "the legs were not measured: their segments are turned as the pelvis in every frame{configuration}; expected a \
         recording with sensors on pelvis, thighs, shanks and feet"
    )]
    LegsNotMeasured {
        /// Which sensors were worn, in words of the file.
        configuration: String,
    },
    /// Most frames are missing.
    #[error(
        "frames {first} to {last} are {found} frames; expected at least one in {ONE_IN}. hint: check the numbers of \
         the frames, or export the file again"
    )]
    FewFrames {
        /// Number of the first frame.
        first: u64,
        /// Number of the last frame.
        last: u64,
        /// Number of frames found.
        found: usize,
    },
    /// Axes that fit no person.
    #[error(
        "the axes of the segments are not those of a person: {what} is {found}; expected {expected}. hint: export \
         poses whose segments have their origin in the upper joint, as Theia3D does"
    )]
    Axes {
        /// The point and its segment.
        what: String,
        /// Place found.
        found: String,
        /// Place in a person.
        expected: &'static str,
    },
    /// Markers of a file without poses.
    #[error(transparent)]
    Markers(#[from] MarkerError),
}
