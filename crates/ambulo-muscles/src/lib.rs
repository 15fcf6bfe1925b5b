//! Muscles: the forces that turn the joints, and the loads that the joints carry because of them.
//!
//! | module | duty |
//! |---|---|
//! | [`built_in`] | the muscles of the built-in body of a person |
//! | [`set`] | muscles, wraps and actuators of a model |
//! | `import`, `export`, `scaled` | muscles from OpenSim documents and back; scaled with the body |
//! | [`path`] | lengths, lengthening speeds and moment arms of muscles in a posture |
//! | [`wrap`] | paths of muscles over cylinders and spheres |
//! | [`curves`], [`strength`] | what force a muscle can exert at a length and a speed |
//! | [`optimization`] | controls of least effort for given generalised forces |
//! | [`settings`], [`solver`], [`trial`] | muscle forces of a posture and of a motion |
//! | [`contact_loads`] | what hip, knee and ankle carry, and both condyles of a knee |
//! | [`emg`] | electromyograms: channels by name, envelopes, on/off, comparison with activations |

pub mod built_in;
pub mod set;

mod export;
mod import;
pub mod path;
mod scaled;
#[doc(hidden)]
pub mod wrap;

#[doc(hidden)]
pub mod curves;
pub mod strength;

#[doc(hidden)]
pub mod optimization;

pub mod settings;
pub mod solver;
pub mod trial;

pub mod contact_loads;

pub mod emg;

pub use import::MuscleError;
