//! Recorded coordinates of a model, and errors of recordings.

use super::filter::FilterError;
use crate::model::CoordinateId;
use crate::numerics::{Shown, SplineError};

/// Coordinates over time as in the file: SI units, increasing times, gaps as not-a-number.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Name of its source, for messages.
    pub origin: String,
    /// Times [s], strictly increasing.
    pub times: Vec<f64>,
    /// One column per coordinate of the model, in its order; `None` if not recorded [rad or m].
    pub columns: Vec<Option<Vec<f64>>>,
}

/// Why a recording cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MotionError {
    /// The first column is not the time.
    #[error("the first column is `{found}`; expected `time`")]
    NoTime {
        /// Name of the first column.
        found: String,
    },
    /// A time that is not finite.
    #[error("{place}: the time is {found}; expected a finite number of seconds")]
    TimeNotFinite {
        /// Line or row of the file.
        place: String,
        /// The value.
        found: f64,
    },
    /// Times that do not increase.
    #[error(
        "{place}: time {later} s comes after {earlier} s; expected increasing times. hint: sort the rows, or cut the \
         file where the clock was reset"
    )]
    TimeNotRising {
        /// Line or row of the file.
        place: String,
        /// The time before [s].
        earlier: f64,
        /// The time that follows [s].
        later: f64,
    },
    /// Two different rows for one time.
    #[error(
        "{place}: a second row for time {time} s with other numbers in `{column}`; expected one row per time. hint: \
         delete one of the two"
    )]
    TwoRows {
        /// Line or row of the file.
        place: String,
        /// The time [s].
        time: f64,
        /// A column that differs.
        column: String,
    },
    /// No column of a coordinate of the model.
    #[error(
        "no column names a coordinate of the model `{model}`; found {found}; expected some of {known}. hint: is this \
         the motion of another model?"
    )]
    NoCoordinate {
        /// Name of the model.
        model: String,
        /// The first columns.
        found: String,
        /// The model's coordinates.
        known: String,
    },
    /// A required column of a force recording is missing.
    #[error("no column `{column}` for {purpose}; found {found}. hint: check the identifiers of the external loads")]
    NoColumn {
        /// The column.
        column: String,
        /// The quantity that needs it.
        purpose: String,
        /// The columns of the file.
        found: String,
    },
    /// A load on a body that the model does not have.
    #[error("the load `{load}` acts on the body `{body}`, which the model does not have; expected one of {known}")]
    UnknownBody {
        /// Name of the load.
        load: String,
        /// The body that it names.
        body: String,
        /// The model's bodies.
        known: String,
    },
    /// A device without a column of a generalised force of the model.
    #[error("no column of the device names a generalised force of the model; found {found}; expected some of {known}")]
    NoDeviceColumn {
        /// The first columns.
        found: String,
        /// The model's generalised forces.
        known: String,
    },
    /// A gap that is too long to fill, or at an end of the recording.
    #[error(
        "`{column}` has no number from {from_s:.4} s to {to_s:.4} s; expected gaps inside the recording of at most \
         {longest_s} s. hint: choose a range without the gap"
    )]
    Gap {
        /// The column.
        column: String,
        /// First time without a number [s].
        from_s: f64,
        /// Last time without a number [s].
        to_s: f64,
        /// Longest gap that is filled [s].
        longest_s: f64,
    },
    /// Time steps of very different lengths.
    #[error(
        "the time steps of {samples} samples are {shortest_s:.1e} s to {longest_s:.1e} s long; expected similar \
         lengths. hint: check whether the time column was rounded, or merged from two recordings"
    )]
    UnevenClock {
        /// Shortest step [s].
        shortest_s: f64,
        /// Longest step [s].
        longest_s: f64,
        /// Number of samples.
        samples: usize,
    },
    /// A frame rate of the results that is not possible.
    #[error(
        "a frame rate of {} Hz was requested; expected a rate above 0, with at least two frames in the range, and at \
         most {highest_hz} Hz, because of memory", Shown(*found_hz)
    )]
    Rate {
        /// The rate [Hz].
        found_hz: f64,
        /// Highest rate [Hz].
        highest_hz: f64,
    },
    /// A measured force that is not finite.
    #[error(
        "the load `{load}` has a force, point or torque that is not a number at {time_s:.4} s under load; expected \
         numbers. hint: choose a range without this time"
    )]
    ForceNotFinite {
        /// Name of the load.
        load: String,
        /// The time [s].
        time_s: f64,
    },
    /// A range that ends far away from the recording.
    #[error(
        "the range starts or ends at {} s; expected an instant near the recording, which lasts from {first_s} s to \
         {last_s} s, at most {farthest_s} s away", Shown(*found_s)
    )]
    FarRange {
        /// Start or end of the requested range [s].
        found_s: f64,
        /// First recorded time [s].
        first_s: f64,
        /// Last recorded time [s].
        last_s: f64,
        /// Largest allowed distance from the recording [s].
        farthest_s: f64,
    },
    /// Too few frames in the range.
    #[error(
        "the range from {from_s} s to {to_s} s has {found} frames; expected at least {expected}. hint: motion and \
         forces are both known from {first_s:.3} s to {last_s:.3} s"
    )]
    TooShort {
        /// Number of frames in the range.
        found: usize,
        /// Number of frames that are needed.
        expected: usize,
        /// Start of the requested range [s].
        from_s: f64,
        /// End of the requested range [s].
        to_s: f64,
        /// Start of the recording.
        first_s: f64,
        /// End of the recording.
        last_s: f64,
    },
    /// A column that cannot be filtered.
    #[error("`{column}` cannot be filtered")]
    Filter {
        /// The column.
        column: String,
        /// Why.
        source: FilterError,
    },
    /// A column that cannot be fitted by a spline.
    #[error("`{column}` cannot be fitted by a spline")]
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
