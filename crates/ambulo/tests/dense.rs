//! Tests whose own code takes most of their time, in a program that is optimised like the library.
#![allow(clippy::disallowed_methods, reason = "expected values of tests may have the bits of the platform")]
#![allow(clippy::unwrap_used, reason = "a test fails by panicking, in its helpers too")]

mod common;

mod architecture;
mod elimination;
mod independent;
