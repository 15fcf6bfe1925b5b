//! From coordinates to moving bodies.
//!
//! A [`Trajectory`] holds every coordinate with its first two derivatives on a uniform time grid; poses, twists and
//! accelerations of the bodies follow from it frame by frame ([`BodyMotion`]) or block by block inside
//! [`crate::dynamics`].

mod body_motion;
pub mod calibration;
mod clinical_angles;
pub(crate) mod lanes;
pub mod marker_fit;
pub(crate) mod plan;
pub mod retarget;
pub mod scaling;
mod sin_cos;
pub(crate) mod sweep;
mod trajectory;

pub use body_motion::{BodyMotion, Posture, body_motion, each_body_motion};
pub use clinical_angles::{ClinicalAngles, HipAngles, clinical_angles};
pub use trajectory::{Trajectory, TrajectoryError};
