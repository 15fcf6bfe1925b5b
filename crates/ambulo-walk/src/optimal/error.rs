//! Why a figure cannot walk.

use super::solution::Unbalanced;
use crate::dynamics::CurvedJointError;
use crate::model::ModelError;
use crate::model::anthropometry::BuildError;
use crate::numerics::Shown;
use crate::toml_reader::TomlError;

/// Largest root mean square of the forces at the root between the instants of a problem [body weights, body weights ×
/// leg length]. Solved walks leave at most 0.003 (docs/measured/OPTIMAL_WALK.md); a body that hops between the
/// instants leaves more.
pub const LARGEST_BETWEEN: f64 = 0.01;

/// Why a figure cannot walk by optimal motion.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OptimalWalkError {
    /// The figure could not be built.
    #[error(transparent)]
    Build(#[from] BuildError),
    /// A built-in file is wrong.
    #[error(transparent)]
    BuiltIn(#[from] TomlError),
    /// The figure has joints that are not hinges or slides.
    #[error(transparent)]
    Joint(#[from] CurvedJointError),
    /// No motion without outside forces was found.
    #[error(
        "found no walk at {speed:.2} m/s with {cadence:.0} steps/min on a leg of {leg_length:.2} m that needs no force \
         from outside: {worst}"
    )]
    NotConverged {
        /// Speed [m/s].
        speed: f64,
        /// Cadence [steps/min].
        cadence: f64,
        /// Leg length [m].
        leg_length: f64,
        /// The largest force at the root.
        worst: Unbalanced,
    },
    /// The motion needs forces from outside between the instants at which it was solved.
    #[error(
        "found no walk at {speed:.2} m/s with {cadence:.0} steps/min on a leg of {leg_length:.2} m that needs no force \
         from outside: between the instants of the solution {:.1} % of body weight remain (rms); expected at most \
         {:.1} %",
        100.0 * share,
        100.0 * LARGEST_BETWEEN
    )]
    Ripple {
        /// Speed [m/s].
        speed: f64,
        /// Cadence [steps/min].
        cadence: f64,
        /// Leg length [m].
        leg_length: f64,
        /// Root mean square of the forces at the root [body weights, body weights × leg length].
        share: f64,
    },
    /// The load does not fit the body.
    #[error(transparent)]
    Load(#[from] ModelError),
    /// A condition outside its range.
    #[error("found {what} of {}; expected {expected}", Shown(*found))]
    Condition {
        /// Meaning of the number.
        what: &'static str,
        /// The number.
        found: f64,
        /// Allowed numbers, and why.
        expected: &'static str,
    },
    /// A strength or a device belongs to a joint that the figure does not have.
    #[error("found the joint `{found}`; expected {expected}")]
    UnknownJoint {
        /// Name that was given.
        found: String,
        /// Names of the joints' coordinates.
        expected: String,
    },
    /// The muscles of a joint are too weak.
    #[error(
        "found no walk at {speed:.2} m/s that the muscles can do: {} needs {:.0} N.m at {:.3} s; expected at most \
         {:.0} N.m, its strength",
        overload.coordinate,
        overload.moment.abs(),
        overload.time_s,
        overload.strength
    )]
    TooWeak {
        /// Speed [m/s].
        speed: f64,
        /// The largest moment above strength.
        overload: Overload,
    },
    /// A movement without its forces.
    #[error("no {movement} was found for a walk at {speed:.2} m/s: {unbalanced}{}", hint(movement))]
    NoMovement {
        /// `stop`, `start` or `movement of steps on the spot`.
        movement: &'static str,
        /// Speed of the walk [m/s].
        speed: f64,
        /// The largest force that nothing supplies.
        unbalanced: Unbalanced,
    },
    /// A movement that does not reach the walk.
    #[error(
        "no {movement} was found for a walk at {speed:.2} m/s: it would have another posture or another speed where it \
         joins the walk{}",
        hint(movement)
    )]
    Misses {
        /// `stop`, `start` or `movement of steps on the spot`.
        movement: &'static str,
        /// Speed of the walk [m/s].
        speed: f64,
    },
    /// A movement that leaves the ground.
    #[error("no {movement} was found for a walk at {speed:.2} m/s: the figure would hop{}", hint(movement))]
    Hops {
        /// `stop`, `start` or `movement of steps on the spot`.
        movement: &'static str,
        /// Speed of the walk [m/s].
        speed: f64,
    },
    /// Machines that do something else in every cycle.
    #[error(
        "the gait `{gait}`: found machines that move joints otherwise from cycle to cycle; expected the same in every \
         cycle, because one cycle is solved and repeated. hint: use the mode `paper`, in scenes `curves`"
    )]
    Machines {
        /// Name of the gait.
        gait: String,
    },
    /// A change of pace without a motion before or after it.
    #[error("found a change of pace without a motion before or after it; expected one on both sides")]
    Order,
    /// The caller asked to stop.
    #[error("the solver was stopped after {steps} steps")]
    Stopped {
        /// Number of steps made.
        steps: usize,
    },
}

/// Name of the movement of steps out of standing.
pub(super) const STEPS_ON_THE_SPOT: &str = "movement of steps on the spot";

/// How a scene does without a movement, if it can.
fn hint(movement: &str) -> &'static str {
    if movement == STEPS_ON_THE_SPOT {
        ". hint: with `recovery_steps = false` a figure of a scene stands by feedback alone and needs no such steps"
    } else {
        ""
    }
}

/// A muscle moment above the strength of its joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Overload {
    /// Name of the coordinate.
    pub coordinate: String,
    /// Moment of the muscles [N.m].
    pub moment: f64,
    /// Their strength [N.m].
    pub strength: f64,
    /// Time [s].
    pub time_s: f64,
}
