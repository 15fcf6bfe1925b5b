//! Walking figures: a [`Human`](crate::model::anthropometry::Human) walks in a world, and its joint and ground forces
//! are recorded.
//!
//! All joints are driven, and so is the rotation of the root, which holds the trunk. The two translations of the root
//! are free, so the ground decides where the figure goes, as in section 4.1 of Faure, Debunne, Cani, Multon 1997.
//! [`Walker`] makes the world, and [`Walker::walk`] steps it and returns a [`WalkRecording`] for tables, figures and
//! `analysis`.
//!
//! Times: a step of impulses from t to t + h has its velocities in the middle of the step, so its forces belong to the
//! posture at t (leapfrog). Row n of a recording is the posture at t_n and the forces of the step that begins there.
//! Impulses of impacts ([`ImpactLaw::Sticking`](crate::engine::ImpactLaw::Sticking)) are recorded separately from
//! forces.

mod signals;

mod feet;
mod figure;
mod recording;
mod run;
pub(crate) mod slip;
mod torques;

pub use feet::FootRecord;
pub use figure::{GroundContact, Shoes, Walker, WalkingError};
pub(super) use figure::{half_a_step_earlier, sole_material};
pub(crate) use recording::ExcerptRows;
pub(super) use recording::loads;
pub use recording::{FootImpact, WalkRecording};
#[doc(hidden)]
pub use run::{Release, WatchedTargets};
#[doc(hidden)]
pub use signals::GaitTargets;
pub use signals::gait_signals;
pub use slip::StanceSlip;
pub(super) use slip::worst_slip;
pub use torques::{HARMONICS, TorqueSeries};
