//! Forces from motion.

mod inverse;
mod load;

pub use inverse::{Forces, FrameForces, JointReaction, Workspace, inverse, inverse_frame, inverse_frames};
pub use load::{BodyLoad, LoadSeries};
