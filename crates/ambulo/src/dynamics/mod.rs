//! Forces from motion, and motion from forces.

mod block;
mod constraint;
mod elimination;
mod inverse;
mod load;
mod proximal;

pub use constraint::{
    Acting, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, Convergence, GraphSolution, Law, Six, relative_rows,
};
pub use elimination::{Elimination, EliminationWorkspace, Link, LinkError, LinkTerms, Offsets};
pub use inverse::{
    Forces, FrameForces, JointReaction, Workspace, inverse, inverse_frame, inverse_frames, project_wrenches,
};
pub use load::{BodyLoad, LoadSeries};
pub use proximal::{GraphWorkspace, SolverSettings, solve_graph};
pub(crate) use proximal::project_displacements;
