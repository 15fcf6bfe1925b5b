//! What a stream refuses.

use crate::ground::predict::PredictError;
use crate::kinematics::TrajectoryError;
use crate::motion::MotionError;

/// Why a stream cannot be made or goes no further.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StreamError {
    /// A rate at which nothing can be streamed.
    #[error("{found_hz} frames a second; expected {lowest_hz} to {highest_hz} Hz")]
    Rate {
        /// The rate [Hz].
        found_hz: f64,
        /// Lowest rate [Hz].
        lowest_hz: f64,
        /// Highest rate [Hz].
        highest_hz: f64,
    },
    /// A delay that is no time or does not fit the window.
    #[error(
        "a delay of {found_s} s; expected 0 to {longest_s} s, half of the window. hint: a longer window allows a longer delay"
    )]
    Delay {
        /// The delay [s].
        found_s: f64,
        /// Longest delay [s].
        longest_s: f64,
    },
    /// A window in which no step can be seen, or that asks for too much memory.
    #[error(
        "a window of {found_s} s; expected {shortest_s} to {longest_s} s: a stride at least, two or more for good results"
    )]
    Window {
        /// The window [s].
        found_s: f64,
        /// Shortest window [s].
        shortest_s: f64,
        /// Longest window [s].
        longest_s: f64,
    },
    /// A frame with another number of coordinates than the model.
    #[error("frame {frame} has {found} coordinates; expected {expected}, one for each of the model `{model}`")]
    Length {
        /// Which frame, from 0.
        frame: usize,
        /// How many it has.
        found: usize,
        /// How many the model has.
        expected: usize,
        /// The model's name.
        model: String,
    },
    /// An infinite coordinate.
    #[error(
        "`{coordinate}` is {found} in frame {frame}; expected a finite number. hint: a coordinate that was not seen is not-a-number"
    )]
    Infinite {
        /// The coordinate.
        coordinate: String,
        /// Which frame, from 0.
        frame: usize,
        /// Its value.
        found: f64,
    },
    /// The frames of the window cannot be smoothed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// Nor made a trajectory.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// Nor told the forces.
    #[error(transparent)]
    Prediction(#[from] PredictError),
}
