//! Why a motion cannot be made consistent.

use crate::kinematics::TrajectoryError;
use crate::model::ModelError;

/// Why a motion cannot be made consistent.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ConsistencyError {
    /// Nothing pushes the body.
    #[error(
        "no load was given; expected the ground's force on each foot. hint: measure it, or predict it from the motion"
    )]
    NoLoads,
    /// A load that has not one entry a frame.
    #[error("the load on `{body}` has {found} entries; expected {expected}, one a frame")]
    LoadFrames {
        /// The body.
        body: String,
        /// Entries.
        found: usize,
        /// Frames.
        expected: usize,
    },
    /// A load that is no number inside the window.
    #[error(
        "the load on `{body}` is not a finite number at {time_s:.3} s. hint: choose a window in which forces are known"
    )]
    LoadNotFinite {
        /// The body.
        body: String,
        /// When [s].
        time_s: f64,
    },
    /// A window with too few frames.
    #[error(
        "the window {from_s:.3} to {to_s:.3} s holds {found} frames of the motion; expected at least {expected}. hint: widen the window in which loads are complete"
    )]
    TooShort {
        /// Begin of the window [s].
        from_s: f64,
        /// Its end [s].
        to_s: f64,
        /// Frames.
        found: usize,
        /// Frames wanted.
        expected: usize,
    },
    /// A window that would take too much memory.
    #[error(
        "{found_mb:.0} MB would be needed for {frames} frames; allowed are {most_mb:.0} MB. hint: choose a shorter window"
    )]
    TooLong {
        /// Frames.
        frames: usize,
        /// Memory [MB].
        found_mb: f64,
        /// The most [MB].
        most_mb: f64,
    },
    /// A model that is held by the ground.
    #[error("no joint to ground slides freely; expected a body that only its feet carry")]
    HeldRoot,
    /// A setting that makes no sense.
    #[error("the setting {name} is {found}; expected a finite number above zero")]
    Setting {
        /// Its name.
        name: &'static str,
        /// Its value.
        found: f64,
    },
    /// Numbers that overflowed.
    #[error("the equations have no solution: a number overflowed in iteration {iteration}")]
    Singular {
        /// The iteration, from one.
        iteration: usize,
    },
    /// A body that cannot be changed.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The motion that came out.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
}
