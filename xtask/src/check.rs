//! What CI runs, in order, up to the first failure: `cargo xtask check`.
//!
//! The steps are plain cargo commands in the dev profile, so each can be run alone while something is mended.

use crate::workspace;
use std::time::Instant;

/// One cargo command.
struct Step {
    name: &'static str,
    arguments: &'static [&'static str],
    /// Set for this step alone.
    variable: Option<(&'static str, &'static str)>,
    /// What to do when it fails.
    hint: &'static str,
}

const STEPS: [Step; 4] = [
    Step {
        name: "format",
        arguments: &["fmt", "--all", "--", "--check"],
        variable: None,
        hint: "run `cargo fmt --all`",
    },
    Step {
        name: "lints",
        arguments: &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
        variable: None,
        hint: "mend what clippy names, or say why not with #[expect(.., reason = \"..\")]; if it asks for an update of Cargo.lock, run `cargo build` and commit the lock file",
    },
    Step {
        name: "tests",
        // What a test measured or skipped is worth seeing when it passes, too.
        arguments: &["test", "--workspace", "--locked", "--", "--show-output"],
        variable: None,
        hint: "run the failing test alone with `cargo test --package NAME TEST`",
    },
    Step {
        name: "documentation",
        arguments: &["doc", "--workspace", "--no-deps", "--locked"],
        variable: Some(("RUSTDOCFLAGS", "-D warnings")),
        hint: "mend what rustdoc names; `RUSTDOCFLAGS=\"-D warnings\" cargo doc --no-deps` repeats this step",
    },
];

/// Runs the steps. The error names the step that failed and what to do.
#[expect(clippy::print_stdout, reason = "the steps and their times are the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let start = Instant::now();
    for (i, step) in STEPS.iter().enumerate() {
        println!("[{}/{}] {}: cargo {}", i + 1, STEPS.len(), step.name, step.arguments.join(" "));
        let step_start = Instant::now();
        run_step(step)?;
        println!("[{}/{}] {}: {:.1} s", i + 1, STEPS.len(), step.name, step_start.elapsed().as_secs_f64());
    }
    println!("all {} steps passed in {:.1} s", STEPS.len(), start.elapsed().as_secs_f64());
    Ok(())
}

fn run_step(step: &Step) -> Result<(), String> {
    let mut command = workspace::cargo();
    command.args(step.arguments).envs(step.variable);
    let status = command.status().map_err(|e| format!("{}: cargo cannot start: {e}", step.name))?;
    if status.success() {
        return Ok(());
    }
    Err(format!("the step `{}` failed ({status})\nhint: {}", step.name, step.hint))
}
