//! Recordings in the formats of other programs: markers as TRC, C3D and tables, plates as OpenSim's ground reactions, a model's motion
//! as a BVH skeleton.

mod markers;
mod plates;
mod skeleton;

pub use markers::{c3d_of_markers, table_of_markers, trc_of_markers};
pub use plates::{GroundReactions, ground_reactions};
pub use skeleton::skeleton_of;
