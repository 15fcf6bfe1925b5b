//! Why a skeleton makes no body.

/// Why a skeleton makes no body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonError {
    /// Joints of the legs were not recognised.
    #[error(
        "no joint was recognised as {missing}; expected the joints of both legs, in names such as LeftUpLeg, LeftLeg, LeftFoot (HumanIK, CMU, Mixamo, Biped and others). Found: {found}"
    )]
    Names {
        /// What was looked for.
        missing: String,
        /// The names of the file.
        found: String,
    },
    /// No frame.
    #[error("the file has a skeleton but no frames; expected at least two")]
    NoFrames,
    /// A leg of no length.
    #[error("thigh and shank are {length} long together, in the file's unit; expected a length above zero")]
    NoLegs {
        /// Mean of both sides.
        length: f64,
    },
    /// No usual unit fits.
    #[error(
        "thigh and shank together are {length:.4} long, which is not a plausible human leg length in any of {units}; expected the stature of the person"
    )]
    Unit {
        /// Mean of both sides, in the file's unit.
        length: f64,
        /// What was tried.
        units: String,
    },
    /// Hips that are nowhere above the ankles.
    #[error("the hips are nowhere above the ankles, so up is not known; expected a person on their feet")]
    Up,
    /// The table of names of the crate.
    #[error(transparent)]
    Table(#[from] crate::toml_reader::TomlError),
}
