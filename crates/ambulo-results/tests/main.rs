//! Tests of the results and their files.
//!
//! All are modules of one program, which links faster and takes less space than a program each.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

#[path = "../../ambulo/tests/free_bodies/mod.rs"]
mod free_bodies;

mod cycle_table;
mod files;
mod ground_files;
mod json_place;
mod keep;
mod scene_tables;
mod state_table;
mod stream_columns;
mod units;
