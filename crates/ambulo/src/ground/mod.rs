//! Wrenches between feet and ground.

pub mod foot_motion;
pub mod footfalls;
mod measured;
pub mod phases;
pub mod plates;
pub mod predict;
pub mod stream;

pub use measured::upward;
pub use measured::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, GroundForces, feet, measured};
