//! Tests of the muscles against OpenSim 4.6, closed forms and identities.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

mod muscle_models;
mod shared_data;
mod walks;
mod wrap_models;

mod built_in;
mod contact_loads;
mod curves;
mod emg_against_opensim;
mod emg_comparison;
mod emg_cycles;
mod emg_names;
mod emg_normal_timing;
mod emg_recordings;
mod emg_signals;
mod import;
mod loads;
mod optimization;
mod paths;
mod people;
mod round_trip;
mod scaling;
mod solver;
mod strength;
mod wrap_chain;
mod wrap_closed_forms;
mod wrap_opensim;
