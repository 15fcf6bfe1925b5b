//! Why a skeleton cannot be read.

/// Why a skeleton cannot be read.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SkeletonError {
    /// Joints of the legs were not recognised.
    #[error(
        "no joint was recognised as {missing}; expected the joints of both legs, in names such as LeftUpLeg, LeftLeg, \
         LeftFoot (HumanIK, CMU, Mixamo, Biped and others). Found: {found}"
    )]
    Names {
        /// The missing joints.
        missing: String,
        /// The joint names of the file.
        found: String,
    },
    /// Too few frames.
    #[error("the file has a skeleton but no frames; expected at least two")]
    NoFrames,
    /// Legs without length.
    #[error("thigh and shank are {length} long together, in the file's unit; expected a length above zero")]
    NoLegs {
        /// Mean of both sides.
        length: f64,
    },
    /// No usual unit gives a plausible leg length.
    #[error(
        "thigh and shank together are {length:.4} long, which is not a plausible human leg length in any of {units}; \
         expected the stature of the person"
    )]
    Unit {
        /// Mean of both sides, in the file's unit.
        length: f64,
        /// The units that were tried.
        units: String,
    },
    /// Hips that are never above the ankles.
    #[error("the hips are not above the ankles, so the upward direction is not known; expected an upright person")]
    Up,
    /// Values that a BVH file cannot store.
    #[error(transparent)]
    Format(#[from] ambulo_formats::Error),
    /// The built-in table of names cannot be read.
    #[error(transparent)]
    Table(#[from] crate::toml_reader::TomlError),
}
