//! Ground reaction forces: measured, or predicted from the motion; and when each foot is on the ground.

pub mod foot_motion;
pub mod footfalls;
mod lever_rule;
mod load_sides;
mod measured;
pub mod phases;
pub mod plates;
pub mod predict;
pub(crate) mod refit;
pub mod stances;
pub mod stream;

pub(crate) use lever_rule::LeverRule;
pub(crate) use load_sides::{FootPaths, LoadedSpan};
pub use measured::{BodyForces, CENTER_OF_PRESSURE_LOAD_N, GroundForces, feet, measured};
pub(crate) use measured::{TotalLoad, center_of_pressure};
