//! Forces from motion.

mod constraint;
mod forest;
mod inverse;
mod load;

pub use constraint::{BodyTerms, Constraint, Six, relative_rows};
pub use forest::{Forest, ForestError, ForestWorkspace, Link, Solution};
pub use inverse::{Forces, FrameForces, JointReaction, Workspace, inverse, inverse_frame, inverse_frames};
pub use load::{BodyLoad, LoadSeries};
