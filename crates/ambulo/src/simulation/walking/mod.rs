//! Walking figures: a [`Human`](crate::model::anthropometry::Human) in a world, and what its walk asks of joints, feet and ground.
//!
//! All joints are driven, the turn of the root too (so the trunk is held); its two slides are free, and the ground decides where
//! the figure goes, as in section 4.1 of Faure, Debunne, Cani, Multon 1997. [`Walker`] makes the world, [`Walker::walk`] steps it
//! and keeps what happened as a [`WalkRecording`], from which tables, figures and `analysis` can work.
//!
//! Times: a step of impulses from t to t + h has velocities in the middle of the step, so its forces are those of the posture at
//! t (leapfrog): row n of a recording is the posture at t_n and the forces of the step that begins there. Impulses of impacts
//! ([`ImpactLaw::Sticking`](super::ImpactLaw::Sticking)) are apart from forces.

mod error;
mod excerpt;
mod feet;
mod figure;
mod recording;
mod run;
mod signals;
mod slip;
mod start;

pub use error::WalkingError;
pub use excerpt::{Excerpt, ExcerptRows};
pub use feet::{FootRecord, ToeRecord};
pub use figure::{Ground, Shoes, Walker};
pub use recording::{FootImpact, WalkRecording};
pub use signals::gait_signals;
pub use slip::StanceSlip;
