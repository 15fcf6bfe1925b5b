//! Errors of gaits.

use crate::numerics::Shown;
use crate::toml_reader::TomlError;

/// A gait is not possible. The message contains what was found, what was expected, and a hint.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GaitError {
    /// A gait file is not valid.
    #[error(transparent)]
    Toml(#[from] TomlError),
    /// No built-in gait has this name.
    #[error("gait: found `{name}`; expected one of {known}{hint}")]
    UnknownGait {
        /// Name that was found.
        name: String,
        /// Names of the built-in gaits.
        known: String,
        /// A similar name, or another way to give a gait.
        hint: String,
    },
    /// A number is not possible.
    #[error("{what}: found {}; expected {expected}", Shown(*found))]
    Number {
        /// Quantity and unit.
        what: &'static str,
        /// Number that was found.
        found: f64,
        /// Allowed numbers.
        expected: &'static str,
    },
    /// Speed, step length and step frequency contradict each other.
    #[error(
        "speed {speed:.4} m/s: found a step length of {step_length:.4} m and {step_frequency:.4} steps/s, whose \
         product is {:.4} m/s; \
         expected speed = step length × step frequency. hint: leave out one of the three", step_length * step_frequency
    )]
    Contradiction {
        /// Walking speed [m/s].
        speed: f64,
        /// Step length [m].
        step_length: f64,
        /// Step frequency [steps/s].
        step_frequency: f64,
    },
    /// A change names a knot that the curve does not have.
    #[error("change of the {joint}: found no knot `{knot}`; expected one of {known}")]
    UnknownKnot {
        /// Joint.
        joint: &'static str,
        /// Name that was found.
        knot: String,
        /// Names of the knots of the curve.
        known: String,
    },
    /// The curve of a joint is not possible after scaling and changes.
    #[error("{joint}, knot `{knot}`, after the changes and scaling of this gait: {message}")]
    Curve {
        /// Joint.
        joint: &'static str,
        /// Knot with the error.
        knot: String,
        /// Found and expected value.
        message: String,
    },
    /// A change of a whole joint, or a machine that scales its curve, exceeds the range of human joints.
    #[error(
        "{joint}, with its scale and offset: found {found_deg:.0}° in the cycle; expected angles from {:.0}° to \
         {:.0}°. hint: use a scale nearer to 1 or a smaller offset", allowed_deg[0], allowed_deg[1]
    )]
    JointAngle {
        /// Joint.
        joint: &'static str,
        /// The angle [deg].
        found_deg: f64,
        /// Smallest and largest angle [deg].
        allowed_deg: [f64; 2],
    },
    /// A figure that stands at the start and never walks.
    #[error(
        "speed: found 0 m/s at the start and no change to a walking speed after it; expected such a change, or a speed \
         of 0.05 to 5 m/s, because a figure that only stands has no cycle"
    )]
    StandsForever,
    /// A change of pace begins before the previous one has ended.
    #[error(
        "change of pace: found a start at {start_s} s; expected {earliest_s} s or later, after the end of the previous \
         change"
    )]
    OverlappingChange {
        /// Start of the change [s].
        start_s: f64,
        /// End of the previous change [s].
        earliest_s: f64,
    },
}
