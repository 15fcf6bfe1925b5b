//! Settings of muscle forces, and why they cannot be computed.

use crate::curves::CurveError;
use crate::optimization::OptimizationError;
use crate::set::CoordinateActuator;
use crate::strength::Pennation;
use crate::wrap::WrapRule;

/// How muscle forces are computed. The defaults are those of OpenSim's static optimisation, except that paths over
/// surfaces are exact.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleSettings {
    /// Exponent p of the activations in the cost, more than 1 and at most 10.
    pub exponent: f64,
    /// Weights of muscles in the cost; all others have weight 1.
    pub weights: Vec<MuscleWeight>,
    /// Whose pennation reduces the force of Millard's muscles.
    pub pennation: Pennation,
    /// Motors that help the muscles.
    pub reserves: Reserves,
    /// How paths run over surfaces.
    pub wraps: WrapRule,
}

/// The weight of a muscle in the cost.
#[derive(Debug, Clone, PartialEq)]
pub struct MuscleWeight {
    /// Name of the muscle.
    pub muscle: String,
    /// Its weight, more than 0.
    pub weight: f64,
}

/// Motors at coordinates that help where muscles are too weak or missing. Their cost is (force / optimal force)ᵖ. The
/// motors of the model are always there, within their control ranges.
#[derive(Debug, Clone, PartialEq)]
pub enum Reserves {
    /// An unlimited motor at every free coordinate that has none in the model.
    Everywhere {
        /// Optimal force of the coordinates of joints between bodies [N.m or N].
        joints: f64,
        /// Optimal force of the coordinates of joints to ground [N.m or N].
        root: f64,
    },
    /// These, and no others.
    Listed(Vec<CoordinateActuator>),
}

impl Default for MuscleSettings {
    fn default() -> MuscleSettings {
        MuscleSettings {
            exponent: 2.0,
            weights: Vec::new(),
            pennation: Pennation::default(),
            reserves: Reserves::default(),
            wraps: WrapRule::default(),
        }
    }
}

impl Default for Reserves {
    /// 1 N.m at joints, 1000 N.m and N at the root.
    fn default() -> Reserves {
        Reserves::Everywhere { joints: 1.0, root: 1000.0 }
    }
}

/// Why muscle forces cannot be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SolverError {
    /// A model without muscles.
    #[error("the model has no muscles; expected at least one")]
    NoMuscles,
    /// A parameter that is not a positive number.
    #[error("`{name}` of muscle `{muscle}` is {found}; expected {expected}")]
    Parameter {
        /// The muscle.
        muscle: String,
        /// The parameter.
        name: &'static str,
        /// Found value.
        found: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// Curves that cannot be made.
    #[error("muscle `{muscle}`: {source}")]
    Curve {
        /// The muscle.
        muscle: String,
        /// Why.
        source: CurveError,
    },
    /// A weight for a muscle that the model does not have.
    #[error("a weight is given for muscle `{muscle}`, which the model does not have")]
    UnknownMuscle {
        /// The name.
        muscle: String,
    },
    /// A motor at a coordinate that is not free, or with an impossible force.
    #[error("motor `{name}` at coordinate `{coordinate}`: {found}; expected {expected}")]
    Motor {
        /// The motor.
        name: String,
        /// Its coordinate.
        coordinate: String,
        /// Found value.
        found: String,
        /// What is allowed.
        expected: &'static str,
    },
    /// An exponent or a weight without a unique optimum.
    #[error(transparent)]
    Optimization(#[from] OptimizationError),
}
