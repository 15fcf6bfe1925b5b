//! Ambulo: motion in, forces out.
//!
//! The science of the project: a body ([`model`]), what was observed of it ([`motion`]), its poses, twists and
//! accelerations ([`kinematics`]), the forces behind them ([`dynamics`], [`ground`]), and what a reader wants to know
//! ([`analysis`]). This crate opens no file, reads no clock, starts no thread and prints nothing.
//!
//! Conventions (docs/CONVENTIONS.md): SI units and radians; world x forward, y up, z right; body quantities at the
//! centre of mass in world axes, angular part before linear; joint moments are those of the parent on the child with
//! the sign of the model's own coordinate.

pub mod findings;
pub mod numerics;
pub mod spatial;
pub mod toml_reader;

pub mod model;
pub mod motion;

pub mod gait;

pub mod kinematics;

pub mod contact;

pub mod dynamics;

pub mod simulation;

pub mod ground;

pub mod analysis;

pub mod study;

pub mod reproduction;

/// The code in README.md is compiled as a test.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
struct Readme;
