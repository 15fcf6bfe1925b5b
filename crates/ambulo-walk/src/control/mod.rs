//! Figures that walk by their own torques: feedback keeps them near a planned walk, and nothing but their joints and
//! the ground moves them.
//!
//! The plan is a dynamically consistent walk ([`crate::consistent_walk`]): postures q*, rates q̇* and joint torques τ*
//! over a cycle. At every time step the torque of a joint is
//!
//!   τ = τ*(φ) + k (q*(φ) - q) + d (q̇*(φ) - q̇) - K(φ) (x - x*(φ))          within the strength of its muscles
//!
//! with the phase φ of the cycle, the impedance k, d of the joint, and the state x of the whole figure: all coordinates
//! but the place along the ground, and all rates. Without K the figure falls within seconds. K comes from the walk
//! itself: the derivatives of one time step of the simulator by state and torques, along the plan, are the matrices of
//! a linear periodic system, and K minimises
//!
//!   Σ_steps (x - x*)ᵀ Q (x - x*) + Δτᵀ R Δτ
//!
//! which is the periodic Riccati equation (module `riccati`). The phase advances with time and is set to the phase of
//! the plan when a foot strikes, early or late. An early or late strike is not part of the linear system: with K alone
//! (without k and d) the figure falls when it is pushed backwards.
//!
//! The figure is planar, or has three dimensions ([`crate::optimal::OptimalWalk`]). In the plane its legs pass each
//! other side by side; in three dimensions they are solid, and after a strong push the step under way is planned again
//! (module `recovery`).
//! Several plans make one controller whose speed can be changed on the way ([`WalkController::joined`]); it can stop,
//! stand and walk off (`WalkController::with_standing`).
//!
//! Sources: the discrete periodic Riccati equation as in Bittanti, Colaneri, De Nicolao 1991 (unverified; derived
//! here); phase reset at foot strike as in Aoi, Tsuchiya 2005 (unverified). docs/PHYSICAL_WALK.md has results and
//! limits. Not handled: turning; activation of muscles.

pub(crate) mod activation;
mod controller;
mod fall;
mod feedback;
pub(crate) mod figure;
mod foot_placement;
mod gains;
pub(crate) mod linear;
mod pace;
mod phase;
mod physical;
pub(crate) mod plan;
mod recovery;
pub(crate) mod riccati;
mod schedule;
mod settings;
mod standing;
mod trials;
mod walk_plan;
mod walk_recorder;

pub use controller::WalkController;
pub use fall::Fall;
pub use physical::PhysicalWalk;
pub(crate) use schedule::ScheduledController;
#[doc(hidden)]
pub use schedule::SpeedSchedule;
#[doc(hidden)]
pub use settings::ControlError;
pub use settings::{Balance, ControlSettings, FootPlacement, TorqueCurves, TrackingCosts};
pub use walk_recorder::FigureWalk;
pub(crate) use walk_recorder::{FigureRecorder, Live, LiveTargets};
