//! Muscles: the forces that turn the joints, and the loads that the joints carry because of them.
//!
//! | module | duty |
//! |---|---|
//! | [`set`] | muscles, wraps and actuators of a model |
//! | `import`, [`MuscleError`] | muscles from OpenSim documents |
//! | [`path`] | lengths, lengthening speeds and moment arms of muscles in a posture |
//! | [`wrap`] | paths over cylinders and spheres |

/// The body and its mechanics, so that one dependency is enough.
pub use ambulo_body as body;

pub mod set;

mod import;
pub mod path;
pub mod wrap;

pub use import::MuscleError;
