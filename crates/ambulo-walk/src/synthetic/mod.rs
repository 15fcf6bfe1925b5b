//! Synthetic walks: from a gait and a body size to motion and ground forces, which are analysed like a recording.
//!
//! There are five modes. [`SyntheticMode::Optimal`] finds the walk of a figure in three dimensions by optimal motion
//! ([`crate::optimal`]); [`SyntheticMode::Predicted`] does so without normative curves as targets, also on slopes, with
//! loads, weak joints and devices. [`SyntheticMode::Corrected`] makes the gait dynamically consistent
//! ([`crate::consistent_walk`]) and simulates it on soft shoes. [`SyntheticMode::Paper`] makes the joints follow the
//! gait exactly, holds the trunk upright and has rigid soles (Faure, Debunne, Cani, Multon 1997).
//! [`SyntheticMode::Physical`] lets a figure in three dimensions walk by its own torques along its optimal walk
//! ([`crate::control`]). The last three skip the cycles before the walk is steady. The kept part begins shortly before
//! a strike of the right foot, so that every cycle is complete.

mod settings;

mod modes;
mod optimal;
mod physical;
mod walk;

pub use crate::consistent_walk::CorrectionReport;
pub use crate::numerics::Progress;
pub use modes::{predict, predict_observed, replay, run_of_states, synthesise, synthesise_observed};
pub use settings::{MOST_CYCLES, RATES_HZ, SyntheticError, SyntheticMode, SyntheticWalkSettings};
pub use walk::{PaceReached, PredictionReport, SyntheticWalk, WalkReport};
