//! Optimal motion: computes the motion of a body on the ground that minimises an objective, without residual forces.
//!
//! A [`Problem`] has a body on soft shoes, a span of time and an objective. Its unknowns are splines of all
//! coordinates, including the root's. Each posture determines its contact forces, and inverse dynamics computes
//! the joint forces from both, so neither forces nor velocities are unknown. The residual forces at the root must be
//! zero at all instants.
//!
//! ```text
//! WalkProblem ──> Problem ──> Transcription ──> NormalEquations ──> steps ──> Solution
//! targets         terms       instants          band with border    solve     samples, forward simulation
//! ```
//!
//! Cost: one inverse dynamics with derivatives per step and instant, and one factorisation of a band with a border per
//! step. Not handled: obstacles, durations as unknowns (predictions compare several); slopes are inclined gravity.
//! Pinned by: tests/optimal.rs, tests/optimal_prediction.rs, tests/optimal_movements.rs, tests/optimal_observer.rs

pub(crate) mod layout;

pub(crate) mod instant;

pub(crate) mod objective;

mod forward;
mod normal;
mod observer;
pub(crate) mod problem;
pub(crate) mod refine;
mod solution;
mod solve;

mod conditions;
pub(crate) mod effort;
mod error;
mod find;
mod free_cadence;
mod movement;
mod muscles;
mod near;
mod plan;
pub(crate) mod predict;
mod standing;
mod strength;
mod track;
mod unassisted;
pub(crate) mod walk;

pub use conditions::{Device, Load, LoadPlace, WalkConditions};
pub use effort::Effort;
pub use error::{LARGEST_BETWEEN, OptimalWalkError, Overload};
pub use find::OptimalWalk;
pub use forward::Drift;
pub use layout::Span;
pub(crate) use layout::mirror;
#[doc(hidden)]
pub use movement::MovementError;
pub use movement::{Key, MovementProblem, MovementSettings};
pub use muscles::{EffortCosts, WORK_PRICES};
pub use near::NEAR_STAGES;
pub use objective::{Bound, Quantity, Term};
pub use observer::Observer;
pub use plan::WalkPlan;
pub(crate) use predict::moment_at;
pub use predict::{DeviceEffort, Prediction, metabolic_power};
pub use problem::Problem;
pub use solution::{Progress, Sample, SoleContact, Solution, Unbalanced};
pub use solve::{Continuation, NO_ROOT_FORCE};
pub use standing::StandingMovements;
pub use strength::{ECCENTRIC, Hill, StrengthCurve};
pub use track::{FootGuide, TRACK_STAGES, TrackError, TrackProblem, TrackSettings, TrackedFoot, TrackedMotion};
pub use unassisted::Unassisted;
pub use walk::{FINE_STAGES, SPATIAL_STAGES, STAGES, WalkCosts, WalkProblem, soles_with_width};
pub(crate) use walk::{Passage, PassageEnd};
