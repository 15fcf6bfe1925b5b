//! The body and its mechanics: models, recorded motion, kinematics, contact and dynamics.
//!
//! The crate `ambulo` contains these modules under the same names; most programs depend on it alone.
//!
//! | module | duty |
//! |---|---|
//! | [`findings`] | warnings and notes about unusual input |
//! | [`numerics`], [`spatial`] | splines, equations and random numbers; poses, twists, wrenches and inertias |
//! | [`toml_reader`] | TOML files, with errors that have line and key |
//! | [`model`] | bodies, joints, coordinates, markers and anatomy |
//! | [`motion`] | recordings of markers, coordinates, skeletons, force plates and sensors |
//! | [`kinematics`] | from markers to coordinates, and from coordinates to the motion of all bodies |
//! | [`contact`] | contact points, friction, rigid and compliant laws |
//! | [`dynamics`] | inverse dynamics, and bodies under constraints |

#![cfg_attr(
    test,
    allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")
)]

/// Readers and writers of files, so that one dependency is enough.
pub use ambulo_formats as formats;

pub mod findings;
pub mod numerics;
pub mod spatial;
pub mod toml_reader;

pub mod model;
pub mod motion;

pub mod kinematics;

pub mod contact;

pub mod dynamics;
