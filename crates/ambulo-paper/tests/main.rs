//! Tests of the paper's claims, one module per subject.

#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]
#![allow(clippy::print_stdout, reason = "what a test measured or skipped is shown with --show-output")]

mod claims;
mod criteria;
mod ground_force;
mod interaction;
mod settings;
mod shares;
mod synthetic_walk;
