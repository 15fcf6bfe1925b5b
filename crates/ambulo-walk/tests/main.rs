//! Tests of walking without a recording that need no other crate than the body's, one module per subject.
//!
//! All are modules of one program, which links faster and takes less space than a program each.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

mod control_activation;
mod control_linear;
mod control_riccati;
mod control_schedule;
mod engine_joint;
mod engine_samples;
mod engine_signal;
mod gait_condition;
mod gait_cyclic_curve;
mod optimal_effort;
mod optimal_instant;
mod optimal_passage;
mod optimal_predict;
mod optimal_problem;
mod optimal_refine;
mod scene_instants;
mod three_steps;
mod tuning;
mod tuning_gain;
mod tuning_outcome;
mod tuning_push;
mod walking_slip;
