//! Inverse dynamics (forces from motion) and constrained dynamics (motion from forces).
//!
//! [`inverse()`] computes the joint forces of a recorded motion. [`solve_graph`] computes the motion and the constraint
//! forces of jointed bodies with closed loops, contacts and friction, as each step of the simulator needs them.
//! [`residual_reduction`] changes a recorded motion so that it agrees with measured ground forces.
//!
//! Constraints have several solvers: [`Method::Newton`] tries `proximal`, then `nonsmooth_newton`, then `relaxed`;
//! [`Method::ConjugateGradient`] is the solver of the 1997 paper. docs/METHODS.md compares them.

mod inverse;
mod inverse_derivatives;
mod joint_moments;
mod joint_powers;
mod roots;

pub(crate) mod block;
mod elimination;
mod elimination_order;

mod constraint;
mod departure;
mod lumped;
mod problem;

mod active_set;
mod conjugate_gradient;
mod curvature;
mod delassus;
mod friction_state;
mod mixing;
mod nonsmooth_newton;
mod proximal;
mod relaxed;
mod solve;
mod within_law;

pub mod residual_reduction;

pub use block::{BodyTerms, Six};
pub use constraint::{ActsOn, Constraint, ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law};
#[doc(hidden)]
pub use constraint::{relative_slide, relative_turn};
#[doc(hidden)]
pub use elimination::{EliminationWorkspace, Offsets};
#[doc(hidden)]
pub use elimination_order::Elimination;
#[doc(hidden)]
pub use elimination_order::parents_first;
pub use elimination_order::{Link, LinkError, LinkTerms};
#[doc(hidden)]
pub use inverse::each_root_reaction;
pub use inverse::{
    BodyLoad, Forces, FrameForces, JointReaction, LoadSeries, ReactionReader, Workspace, inverse, inverse_frame,
    inverse_frames, inverse_with_residual, project_wrenches,
};
#[doc(hidden)]
pub use inverse_derivatives::InverseDerivatives;
pub use inverse_derivatives::{CurvedJointError, inverse_derivatives};
#[doc(hidden)]
pub use inverse_derivatives::{DerivativeKernel, Spatial};
pub use joint_moments::JointMoments;
pub use joint_powers::JointPowers;
pub use problem::{Method, SolverSettings};
#[doc(hidden)]
pub use roots::Roots;
#[doc(hidden)]
pub use solve::project_displacements;
pub use solve::{GraphWorkspace, solve_graph, undetermined_rows};
