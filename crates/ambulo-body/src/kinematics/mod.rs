//! Kinematics: from markers to joint coordinates, and from coordinates to the motion of all bodies.
//!
//! A [`Trajectory`] contains every coordinate with its first two derivatives on a uniform time grid. The poses, twists
//! and accelerations of the bodies are computed from it frame by frame ([`BodyMotion`]), or in blocks of frames inside
//! [`crate::dynamics`].

pub(crate) mod plan;
mod trajectory;

mod body_motion;
mod clinical_angles;
mod flight_gravity;
pub(crate) mod lanes;
mod posture_sweep;
pub(crate) mod skeleton_body;
pub(crate) mod sweep;

pub mod calibration;
pub mod keypoints;
pub mod marker_fit;
pub mod marker_proposal;
pub mod pose_fit;
pub mod retarget;
pub mod rig;
pub mod scaling;
pub mod sensor_fit;

pub use body_motion::{BodyMotion, body_motion, each_body_motion};
#[doc(hidden)]
pub use calibration::angles_zxy;
pub use clinical_angles::{ClinicalAngles, clinical_angles};
pub use flight_gravity::FlightGravity;
#[doc(hidden)]
pub use flight_gravity::WRONG_CLOCK;
pub use posture_sweep::{JointMotion, PostureSweep};
pub use trajectory::{Posture, Trajectory, TrajectoryError};
