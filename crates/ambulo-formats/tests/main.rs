//! Tests of the file formats.
//!
//! All are modules of one program, which links faster and takes less space than a program each.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

mod c3d_bytes;
mod shared_data;

mod arrays_npz;
mod bids_motions;
mod c3d_damage;
mod c3d_recordings;
mod c3d_rotations;
mod c3d_traps;
mod c3d_words;
mod c3d_write;
mod loads;
mod malformed;
mod malformed_skeletons;
mod marker_sets;
mod markers;
mod motions_mvnx;
mod numbers;
mod orientation_tables;
mod osim_muscles;
mod osim_write;
mod other_contents;
#[cfg(feature = "parquet")]
mod parquet_tables;
mod real_files;
mod setups;
mod skeletons;
mod spreadsheets;
mod subjects_b3d;
mod tables;
