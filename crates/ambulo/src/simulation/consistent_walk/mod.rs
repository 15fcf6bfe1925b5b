//! Dynamically consistent walks: synthetic walks without residual forces.
//!
//! Average joint curves of many people do not belong to one body, so a walk made of them violates Newton's laws.
//! [`make_consistent_walk`] adds the smallest smooth periodic change to the path of the pelvis, to pelvis and trunk, and to hip,
//! knee, ankle and toes, such that the contact forces of soft shoes on flat ground equal the forces that the motion needs:
//!
//!   find c:   M q̈ + h = Σ Jᵀ f(q, q̇)   in the three coordinates of the root (x, y, pitch), which no muscle drives
//!
//! where f is the law of soft contact ([`crate::contact::HuntCrossley`]) at heel, ball and toes. The motion stays near the joint
//! curves and the ground forces near normative ones of that speed, while joint moments vary as little as possible (minimum torque
//! change; Uno, Kawato, Suzuki 1989, unverified). This is one problem of nonlinear least squares, solved by the method of
//! Levenberg and Marquardt ([`crate::numerics::minimise`]) with shoes that get stiffer from stage to stage. Left and right are equal half a
//! cycle apart, so half a cycle is computed; the splines are periodic.
//!
//! Measured joint moments do not enter the problem.
//!
//! Cost: about 120 iterations, each with 72 inverse dynamics per instant; one second in total.
//! [`make_changing_walk`] joins walks of different paces. Not handled: motion out of the sagittal plane; turning.
//! Pinned by: tests/consistent_walk.rs

mod settings;

mod changing;
mod problem;
mod response;
mod unknowns;
mod walk;

mod adjustment;

pub use adjustment::{Adjustment, Magnitude};
pub use changing::{ChangingWalk, make_changing_walk};
pub use response::PlannedForces;
pub use settings::{ConsistentWalkError, ConsistentWalkSettings, Deviations};
pub use walk::{ConsistentMotion, ConsistentWalk, make_consistent_walk};
