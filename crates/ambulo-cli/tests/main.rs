//! Tests of the command from outside.
//!
//! All are modules of one program, which links faster and takes less space than a program each.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

#[path = "../../ambulo/tests/shared_data/mod.rs"]
mod shared_data;
#[path = "../../ambulo-report/tests/svg_reader/mod.rs"]
mod svg_reader;
mod workbench;

mod bad_input;
mod batch;
mod conformance;
mod consistent;
mod exchange;
mod failure;
mod figures;
mod folders;
mod hints;
mod keep;
mod marker_input;
mod measured_pages;
mod motion_sets;
mod muscles;
mod one_road;
mod opensim_setup;
mod option_sweep;
mod page_server;
mod pages;
mod panics;
mod pictures;
mod plates;
mod predict;
mod program;
mod replacement;
mod reproduce;
mod request;
mod request_contract;
mod results;
mod run_record;
mod segment_poses;
mod sensors;
mod session;
mod simulate;
mod stream;
mod stream_messages;
mod stream_options;
mod summary_schema;
mod surface;
mod sweep;
mod trial_words;
mod tune;
mod tutorials;
mod validate;
mod verdict;
mod walk;
