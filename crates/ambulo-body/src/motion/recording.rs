//! Recorded coordinates of a model, and errors of recordings.

use super::filter::FilterError;
use crate::model::CoordinateId;
use crate::numerics::{Shown, SplineError, counted};

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
        "no column names a coordinate of the model `{model}`; found {found}; expected some of {known}. hint: {}",
        if *are_forces {
            "these are the columns of measured forces, which belong to the recording of a motion"
        } else {
            "is this the motion of another model?"
        }
    )]
    NoCoordinate {
        /// Name of the model.
        model: String,
        /// The first columns.
        found: String,
        /// The model's coordinates.
        known: String,
        /// Whether the columns are named like forces and centres of pressure.
        are_forces: bool,
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
        "`{column}` has no number {}; expected {}. hint: choose a range without the gap", span(*from_s, *to_s),
        if *longest_s > 0.0 {
            format!("gaps inside the recording of at most {longest_s} s from sample to sample")
        } else {
            "a number at every instant".to_owned()
        }
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
    /// A column without any number.
    #[error("`{column}` has no number in any row; expected a number in every row, or no such column")]
    Empty {
        /// The column.
        column: String,
    },
    /// Rows that all have one time.
    #[error(
        "all {rows} rows have the time {time} s and the same numbers; expected increasing times. hint: export again"
    )]
    OneTime {
        /// Number of rows.
        rows: usize,
        /// Their time [s].
        time: f64,
    },
    /// A long time without any row.
    #[error(
        "there is no row between {from_s:.4} s and {to_s:.4} s; expected steps of at most {longest_s} s. hint: choose \
         a range on one side of the gap, or check the unit of the times"
    )]
    NoRows {
        /// Last time before [s].
        from_s: f64,
        /// First time after [s].
        to_s: f64,
        /// Longest step that is bridged [s].
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
    /// A recording with too few frames.
    #[error(
        "the recording has {found} frame{}; expected at least {expected}, which rates and accelerations need. hint: is \
         it a trial of a standing person, or cut off?", if *found == 1 { "" } else { "s" }
    )]
    TooFewFrames {
        /// Number of frames.
        found: usize,
        /// Number of frames that are needed.
        expected: usize,
    },
    /// A range without a recorded frame.
    #[error(
        "{} is outside of the recorded time, {first_s:.3} s to {last_s:.3} s. hint: choose a range inside the recorded \
         time", outside([*from_s, *to_s], *last_s)
    )]
    Outside {
        /// Start of the requested range [s].
        from_s: f64,
        /// End of the requested range [s].
        to_s: f64,
        /// Start of the recording [s].
        first_s: f64,
        /// End of the recording [s].
        last_s: f64,
    },
    /// Motion and forces with almost no common time.
    #[error(
        "motion and forces have {} in common: the motion lasts from {:.3} s to {:.3} s, the forces from {:.3} s to \
         {:.3} s. hint: give both the same origin of time, or choose the forces of this trial",
        if *found == 0 { "no time".to_owned() } else { format!("only {}", counted(*found, "frame")) },
        motion_s[0], motion_s[1], forces_s[0], forces_s[1]
    )]
    NoCommonTime {
        /// Frames of the motion with forces.
        found: usize,
        /// Start and end of the motion [s].
        motion_s: [f64; 2],
        /// Start and end of the forces [s].
        forces_s: [f64; 2],
    },
    /// Too few frames in the range.
    #[error(
        "the range from {from_s} s to {to_s} s has {found} frame{}; expected at least {expected}, which rates and \
         accelerations need. hint: choose a longer range; motion and forces are both known from {first_s:.3} s to \
         {last_s:.3} s", if *found == 1 { "" } else { "s" }
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

impl MotionError {
    /// A range that is too short; the other reason if all of it is outside of the recording.
    #[must_use]
    pub fn or_outside(self) -> MotionError {
        match self {
            MotionError::TooShort { found: 0, from_s, to_s, first_s, last_s, .. }
                if from_s > last_s || to_s < first_s =>
            {
                MotionError::Outside { from_s, to_s, first_s, last_s }
            }
            other => other,
        }
    }
}

/// The end of a range that is outside of a recording, which sets the other one; or the range, if both are outside.
fn outside([from_s, to_s]: [f64; 2], last_s: f64) -> String {
    if from_s <= to_s {
        format!("the range from {from_s} s to {to_s} s")
    } else if from_s > last_s {
        format!("the start of the range, {from_s} s,")
    } else {
        format!("the end of the range, {to_s} s,")
    }
}

/// A time without numbers for a message.
fn span(from_s: f64, to_s: f64) -> String {
    if to_s > from_s { format!("from {from_s:.4} s to {to_s:.4} s") } else { format!("at {from_s:.4} s") }
}

impl Motion {
    /// The recorded values of a coordinate [rad or m].
    #[must_use]
    pub fn column(&self, id: CoordinateId) -> Option<&[f64]> {
        self.columns.get(id.index())?.as_deref()
    }
}
