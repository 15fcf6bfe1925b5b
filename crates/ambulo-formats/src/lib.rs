//! Readers and writers of the files of movement science. Bytes in, records out, and back.
//!
//! This crate has no physics and opens no file: every reader takes bytes and returns a record with the content of the
//! file, in the file's own names; every writer returns bytes. Units are converted to SI (metres, seconds) where
//! the format states its unit; angles stay as the file has them, with a flag.
//!
//! | module | format | read | write |
//! |---|---|---|---|
//! | [`table`] | OpenSim `.mot` / `.sto` (versions 1-3), numeric CSV | yes | yes |
//! | [`trc`] | marker trajectories `.trc` | yes | yes |
//! | [`c3d`] | recordings `.c3d`: points, analog channels, force plates, events, all parameters | yes | yes |
//! | [`b3d`] | subjects of AddBiomechanics `.b3d`: markers, coordinates, ground forces | yes | yes |
//! | [`bids_motion`] | motions of BIDS data sets: `_motion.tsv` with `_channels.tsv` | yes | no |
//! | [`bvh`] | skeletons in motion `.bvh` | yes | yes |
//! | [`external_loads`] | OpenSim `ExternalLoads` XML | yes | yes |
//! | [`mvnx`] | motions of Xsens MVN `.mvnx`, versions 3 and 4 | yes | no |
//! | [`npz`] | archives of NumPy arrays `.npz` | yes | yes |
//! | [`osim`] | OpenSim model `.osim`, document versions 20303-40600; `MarkerSet` XML | yes | yes; no |
//! | `parquet` (with the feature of this name) | columns of Apache Parquet `.parquet` | yes | yes |
//! | [`setup`] | OpenSim set-ups of scaling, inverse kinematics and inverse dynamics | yes | no |

pub mod b3d;
pub mod bids_motion;
pub mod bvh;
pub mod c3d;
mod content;
pub mod error;
pub mod external_loads;
pub mod mvnx;
pub mod npz;
pub mod number;
pub mod osim;
#[cfg(feature = "parquet")]
pub mod parquet;
mod plain_text;
pub mod setup;
pub mod table;
pub mod trc;
mod xml;

pub use content::content;
pub use error::{Error, Remark};

/// For the tests of this crate.
#[doc(hidden)]
pub mod internals {
    use crate::c3d::Processor;

    /// A 16-bit word of a C3D file.
    #[must_use]
    pub fn word(processor: Processor, bytes: [u8; 2]) -> u16 {
        processor.u16(bytes)
    }

    /// A real number of a C3D file.
    #[must_use]
    pub fn real(processor: Processor, bytes: [u8; 4]) -> f32 {
        processor.f32(bytes)
    }

    /// A real number as a C3D file has it.
    #[must_use]
    pub fn real_bytes(processor: Processor, value: f32) -> Option<[u8; 4]> {
        processor.f32_bytes(value)
    }
}
