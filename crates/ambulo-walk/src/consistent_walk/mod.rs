//! Dynamically consistent walks: synthetic walks in the sagittal plane without residual forces.
//!
//! Average joint curves of many subjects do not belong to one body, so a walk made of them violates Newton's laws.
//! [`make_consistent_walk`] finds the motion nearest to the gait whose external forces are the contact forces of soft
//! shoes on flat ground. This is a problem of optimal motion ([`crate::optimal`]): here the planar figure walks in it,
//! and the simulator then walks what was found. [`make_changing_walk`] joins walks of different paces by motions with
//! given ends.
//!
//! Not handled: motion out of the sagittal plane; turning.
//! Pinned by: tests/consistent_walk.rs, tests/walk_changes.rs

mod settings;

mod walk;

mod adjustment;

mod changing;

pub use adjustment::{Adjustment, CorrectionReport, Magnitude};
#[doc(hidden)]
pub use changing::ChangingWalk;
pub use changing::make_changing_walk;
pub use settings::ConsistentWalkSettings;
pub(super) use walk::soft_ground;
pub use walk::{ConsistentWalk, make_consistent_walk};
