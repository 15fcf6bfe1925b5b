//! Optimal motion: the motion of a body on the ground that is best by a given measure, with forces from its own joints alone.
//!
//! A [`Problem`] has a body on soft shoes, a span of time and an objective. Its unknowns are splines of all coordinates, those of the root included;
//! inverse dynamics under the contact forces of each posture gives the forces, so that neither forces nor velocities are unknown. The
//! forces at the root, which nothing supplies, must vanish at all instants.
//!
//! ```text
//! WalkProblem ──> Problem ──> Transcription ──> NormalEquations ──> steps ──> Solution
//! laws of people   terms       instants          band with border    solve     samples, forward simulation
//! ```
//!
//! Cost: per step one inverse dynamics with derivatives for each instant, and one factorisation of a band with a border.
//! Not handled: obstacles, slopes, durations that are unknown.
//! Pinned by: tests/optimal.rs

mod layout;

mod instant;

mod objective;

mod forward;
mod normal;
mod problem;
mod solution;
mod solve;

mod walk;

pub use forward::Drift;
pub use layout::Span;
pub use objective::{Bound, Quantity, Term};
pub use problem::Problem;
pub use solution::{Progress, Sample, SoleContact, Solution};
pub use solve::Continuation;
pub use walk::{STAGES, WalkCosts, WalkProblem, soles_with_width};
