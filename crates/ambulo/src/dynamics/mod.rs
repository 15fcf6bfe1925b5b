//! Forces from motion, and motion from forces.

mod best;
mod block;
mod carried;
mod conjugate_gradient;
mod constraint;
mod curvature;
mod departure;
mod elimination;
mod inverse;
mod line_search;
mod load;
mod mixing;
mod proximal;
mod relaxed;
pub mod residual_reduction;
mod roots;
mod solve;

pub use constraint::{
    Acting, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law, Six,
    relative_rows,
};
pub use elimination::{Elimination, EliminationWorkspace, Link, LinkError, LinkTerms, Offsets};
pub use inverse::{
    Forces, FrameForces, JointReaction, Workspace, inverse, inverse_frame, inverse_frames, project_wrenches,
};
pub use load::{BodyLoad, LoadSeries};
pub(crate) use roots::Roots;
pub use solve::{GraphWorkspace, Method, SolverSettings, solve_graph, undetermined_rows};
pub(crate) use solve::{project_displacements, project_placed};
