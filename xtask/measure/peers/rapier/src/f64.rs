//! Rapier in double precision.

use rapier3d_f64 as rapier;

mod human;
mod program;
mod scene;

/// Name of the settings and of the crate in the lock file.
const PRECISION: [&str; 2] = ["f64", "rapier3d-f64"];

fn main() -> std::process::ExitCode {
    program::run()
}
