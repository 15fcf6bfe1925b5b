//! Why a stream cannot be started or continued.

use crate::ground::predict::PredictError;
use crate::kinematics::TrajectoryError;
use crate::motion::MotionError;

/// Why a stream cannot be started or continued.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StreamError {
    /// A frame rate out of range.
    #[error("a frame rate of {found_hz} Hz; expected {lowest_hz} to {highest_hz} Hz")]
    Rate {
        /// The rate [Hz].
        found_hz: f64,
        /// Lowest rate [Hz].
        lowest_hz: f64,
        /// Highest rate [Hz].
        highest_hz: f64,
    },
    /// A delay out of range.
    #[error(
        "a delay of {found_s} s; expected 0 to {longest_s} s, half of the window. hint: a longer window allows a \
         longer delay"
    )]
    Delay {
        /// The delay [s].
        found_s: f64,
        /// Longest delay [s].
        longest_s: f64,
    },
    /// A window that is shorter than a stride or needs too much memory.
    #[error(
        "a window of {found_s} s; expected {shortest_s} to {longest_s} s: at least one stride, two or more for good \
         results"
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
    #[error("frame {frame} has {found} coordinates; expected {expected}, those of the model `{model}`")]
    Length {
        /// Number of the frame, from 0.
        frame: usize,
        /// Number of coordinates found.
        found: usize,
        /// Number of coordinates of the model.
        expected: usize,
        /// The model's name.
        model: String,
    },
    /// An infinite coordinate.
    #[error(
        "`{coordinate}` is {found} in frame {frame}; expected a finite number. hint: a missing coordinate is passed as \
         not-a-number"
    )]
    Infinite {
        /// The coordinate.
        coordinate: String,
        /// Number of the frame, from 0.
        frame: usize,
        /// Value found.
        found: f64,
    },
    /// Smoothing failed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// The trajectory is not possible.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The prediction failed.
    #[error(transparent)]
    Prediction(#[from] PredictError),
}
