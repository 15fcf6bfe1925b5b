//! Decides whether a person could make a motion: checks of strength, joint range, power, friction, centre of pressure,
//! sliding, flight, residual force and moment, a ground that pulls, and accelerations that the measured forces do not
//! cause.
//!
//! [`check`] judges a whole recording or synthetic walk and returns a [`Verdict`]; [`check_frame`] checks one frame
//! without allocating. An infeasible motion is a result, not an error. A motion is called feasible only if nearly all
//! of it was judged. Defaults, their sources and the file format of [`Thresholds`]: docs/JUDGEMENT.md.

mod acceleration_ratio;
mod floor_heights;
mod frame;
mod frame_reader;
mod ground_speed;
mod judgement;
mod likeness;
mod motion_and_forces;
mod person;
pub(crate) mod spans;
mod thresholds;
mod verdict;

#[doc(hidden)]
pub use frame::{CheckedPart, CheckedValue, FeasibilityLimits, FootFrame, Frame};
pub use frame::{check_frame, least_load_n};
pub use judgement::check;
pub(crate) use judgement::inner_frames;
pub use likeness::likeness;
#[doc(hidden)]
pub use motion_and_forces::{MotionAndForces, PredictedForces};
pub use person::Person;
pub use thresholds::Thresholds;
pub use verdict::{
    Check, Closest, FitOfForces, LARGE_RESIDUAL_BW, Likeness, LikenessMeasure, NotJudged, Reason, Verdict, VerdictState,
};

pub(super) use ground_speed::over_ground;
