//! Wrenches between feet and ground.

mod measured;

pub(crate) use measured::upward;
pub use measured::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, MeasuredGround, feet, measured};
