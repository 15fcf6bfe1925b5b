//! A recording of coordinates, as observed.

use super::filter::FilterError;
use crate::model::CoordinateId;
use crate::numerics::SplineError;

/// Coordinates over time as a file holds them: SI units, rising times, gaps as not-a-number.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Where it came from, for people.
    pub origin: String,
    /// Instants [s], strictly rising.
    pub times: Vec<f64>,
    /// One column a coordinate of the model, in its order; `None` where the recording has none [rad or m].
    pub columns: Vec<Option<Vec<f64>>>,
}

/// Why a recording cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The first column is not the time.
    #[error("the first column is `{found}`; expected `time`")]
    NoTime {
        /// What the first column is called.
        found: String,
    },
    /// An instant that is no number.
    #[error("{place}: the time is {found}; expected a finite number of seconds")]
    TimeNotFinite {
        /// Line of the file, or row.
        place: String,
        /// The value.
        found: f64,
    },
    /// Time that runs backwards or stands still.
    #[error(
        "{place}: time {later} s comes after {earlier} s; expected rising times. hint: sort the rows, or cut the file where the clock was reset"
    )]
    TimeNotRising {
        /// Line of the file, or row.
        place: String,
        /// The instant before.
        earlier: f64,
        /// The instant that follows it.
        later: f64,
    },
    /// Two different rows for one instant.
    #[error(
        "{place}: a second row for time {time} s with other numbers in `{column}`; expected one row an instant. hint: delete one of the two"
    )]
    TwoRows {
        /// Line of the file, or row.
        place: String,
        /// The instant.
        time: f64,
        /// A column that differs.
        column: String,
    },
    /// No column that the model knows.
    #[error(
        "no column names a coordinate of the model `{model}`; found {found}; expected some of {known}. hint: is this the motion of another model?"
    )]
    NoCoordinate {
        /// Name of the model.
        model: String,
        /// The first columns.
        found: String,
        /// The model's coordinates.
        known: String,
    },
    /// A column that a force recording must have.
    #[error("no column `{column}` for {purpose}; found {found}. hint: check the identifiers of the external loads")]
    NoColumn {
        /// The column.
        column: String,
        /// What it was wanted for.
        purpose: String,
        /// The columns that are there.
        found: String,
    },
    /// A load on a body that the model does not have.
    #[error("the load `{load}` acts on the body `{body}`; expected one of {known}")]
    UnknownBody {
        /// Name of the load.
        load: String,
        /// The body that it names.
        body: String,
        /// The model's bodies.
        known: String,
    },
    /// A device that helps no coordinate of the model.
    #[error("no column of the device names a generalised force of the model; found {found}; expected some of {known}")]
    NoDeviceColumn {
        /// The first columns.
        found: String,
        /// The model's generalised forces.
        known: String,
    },
    /// A gap that is too long to fill, or that touches the end.
    #[error(
        "`{column}` has no number from {from_s:.4} s to {to_s:.4} s; expected gaps inside the recording of at most {longest_s} s. hint: choose a range without the gap"
    )]
    Gap {
        /// The column.
        column: String,
        /// First instant without a number.
        from_s: f64,
        /// Last instant without a number.
        to_s: f64,
        /// Longest gap that is filled.
        longest_s: f64,
    },
    /// A clock whose steps are of very different lengths.
    #[error(
        "the clock of {samples} samples steps by {shortest_s:.1e} s to {longest_s:.1e} s; expected steps of about one length. hint: was the time column rounded or merged from two recordings?"
    )]
    UnevenClock {
        /// Shortest step [s].
        shortest_s: f64,
        /// Longest step [s].
        longest_s: f64,
        /// Number of samples.
        samples: usize,
    },
    /// A rate at which no result can be given.
    #[error(
        "{found_hz} frames a second were asked for; expected a rate above 0 and at most {highest_hz} Hz that has two frames in the range"
    )]
    Rate {
        /// The rate [Hz].
        found_hz: f64,
        /// Highest rate [Hz].
        highest_hz: f64,
    },
    /// A measured force that is no number.
    #[error(
        "the load `{load}` has a force, point or torque that is not a number at {time_s:.4} s while it carries force; expected numbers. hint: choose a range without this instant"
    )]
    ForceNotFinite {
        /// Name of the load.
        load: String,
        /// The instant [s].
        time_s: f64,
    },
    /// Nothing is left to compute.
    #[error(
        "the range from {from_s} s to {to_s} s has {found} frames; expected at least {expected}. hint: motion and forces were both recorded from {first_s} s to {last_s} s"
    )]
    TooShort {
        /// How many frames there are.
        found: usize,
        /// How many are needed.
        expected: usize,
        /// Start of the range asked for.
        from_s: f64,
        /// End of the range asked for.
        to_s: f64,
        /// Start of the recording.
        first_s: f64,
        /// End of the recording.
        last_s: f64,
    },
    /// The filter refused.
    #[error("`{column}` cannot be filtered")]
    Filter {
        /// The column.
        column: String,
        /// Why.
        source: FilterError,
    },
    /// The spline refused.
    #[error("`{column}` cannot be followed by a spline")]
    Spline {
        /// The column.
        column: String,
        /// Why.
        source: SplineError,
    },
}

impl Motion {
    /// The recorded values of a coordinate [rad or m].
    #[must_use]
    pub fn column(&self, id: CoordinateId) -> Option<&[f64]> {
        self.columns.get(id.index())?.as_deref()
    }
}
