//! Walking without a recording: gaits, optimal motion, and figures in a simulated world.
//!
//! The crate `ambulo` contains these modules; most programs depend on it alone.
//!
//! | module | duty |
//! |---|---|
//! | [`gait`] | joint curves against phase and speed, steps, state machines |
//! | [`optimal`] | motions that obey mechanics and cost little |
//! | [`engine`] | worlds of rigid bodies, stepped through time |
//! | [`walking`], [`consistent_walk`] | figures that walk in a world, and walks without outside forces |
//! | [`control`], [`tuning`] | figures that walk by their own torques, and the search for their gains |
//! | [`scene`] | worlds from files |
//! | [`synthetic`] | from a gait and a body size to motion and ground forces |

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")
)]

#[doc(no_inline)]
pub use ambulo_body::{contact, dynamics, findings, kinematics, model, motion, numerics, spatial, toml_reader};

pub mod gait;

pub mod optimal;

pub mod engine;

pub mod consistent_walk;
pub mod walking;

pub mod control;

pub mod scene;

pub mod synthetic;
pub mod tuning;
