//! What can be wrong with a gait.

use super::request::Gait;
use crate::toml_reader::TomlError;

/// Why a gait cannot be walked: what was found, what was allowed, what to do.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum GaitError {
    /// A gait file is wrong.
    #[error(transparent)]
    Toml(#[from] TomlError),
    /// No built-in gait has this name.
    #[error("gait: found `{name}`; expected one of {}{hint}", Gait::NAMES.join(", "))]
    UnknownGait {
        /// What was asked for.
        name: String,
        /// The name that was probably meant.
        hint: String,
    },
    /// A number that no gait can have.
    #[error("{what}: found {found}; expected {expected}")]
    Number {
        /// Quantity and unit.
        what: &'static str,
        /// What was asked for.
        found: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// Speed, step length and frequency that contradict each other.
    #[error(
        "speed {speed:.4} m/s: found a step length of {step_length:.4} m and {step_frequency:.4} steps/s, which make {:.4} m/s; \
         expected speed = step length × frequency. hint: leave one of the three out", step_length * step_frequency
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
        /// What was named.
        knot: String,
        /// What there is.
        known: String,
    },
    /// The curve that step length, height and changes make of a joint.
    #[error("{joint}, knot `{knot}`, as changed and scaled for this gait: {message}")]
    Curve {
        /// Joint.
        joint: &'static str,
        /// The knot at fault.
        knot: String,
        /// What was found and what was expected.
        message: String,
    },
    /// A change of speed that begins before the one before it has ended.
    #[error(
        "change of speed: found a start at {start_s} s; expected {earliest_s} s or later, when the change before it has ended"
    )]
    OverlappingChange {
        /// Its start [s].
        start_s: f64,
        /// End of the change before it [s].
        earliest_s: f64,
    },
}

impl GaitError {
    pub(super) fn unknown(name: &str) -> GaitError {
        let near = crate::toml_reader::nearest(name, Gait::NAMES.into_iter());
        let hint = match near {
            Some(near) => format!(". hint: is `{near}` meant?"),
            None => String::from(", or a TOML file (docs/GAITS.md)"),
        };
        GaitError::UnknownGait { name: name.to_owned(), hint }
    }
}
