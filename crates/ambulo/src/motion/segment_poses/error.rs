//! Why poses of segments cannot be used.

/// Why poses of segments cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SegmentPoseError {
    /// Segments of the legs that are not there.
    #[error(
        "the file has poses of {found} (group ROTATION), but none of {missing}; expected pelvis, thigh, shank and foot of both sides"
    )]
    Incomplete {
        /// The labels in the file.
        found: String,
        /// The missing segments.
        missing: String,
    },
    /// Segments without a pose in any frame.
    #[error(
        "no frame has poses of pelvis, thighs, shanks and feet together; expected at least one. hint: check that the person was tracked in this trial"
    )]
    NeverSeen,
    /// Axes that fit no person.
    #[error(
        "the axes of the segments are not those of a person: {what} is {found}; expected {expected}. hint: export poses whose segments have their origin in the upper joint, as Theia3D does"
    )]
    Axes {
        /// The point and its segment.
        what: String,
        /// Where it is.
        found: String,
        /// Where it is in a person.
        expected: &'static str,
    },
}
