//! Rapier in single precision, its usual form.

use rapier3d as rapier;

mod human;
mod program;
mod scene;

/// Name of the settings and of the crate in the lock file.
const PRECISION: [&str; 2] = ["f32", "rapier3d"];

fn main() -> std::process::ExitCode {
    program::run()
}
