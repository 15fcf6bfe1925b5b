//! Recordings and results in the formats of other programs: markers as TRC, C3D and tables, plates as OpenSim's ground
//! reactions, a model's motion as a BVH skeleton, in the skeleton of the recording and as an animated glTF file,
//! results as one long table.

mod folder;
pub(crate) mod glb;
mod laboratory;
mod long_table;
mod markers;
mod plates;
mod rig;
mod skeleton;

pub use folder::{ExchangeError, bvh_of_folder, csv_of_folder, glb_of_folder, glb_of_motion};
pub use laboratory::{laboratory_recording, marker_paths, standing_recording};
pub use markers::{c3d_of_markers, table_of_markers, trc_of_markers};
pub use plates::{GroundReactions, ground_reactions};
pub use rig::rig_of_folder;
pub use skeleton::skeleton_of;
