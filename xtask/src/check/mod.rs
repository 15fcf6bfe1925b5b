//! What CI runs, in order, up to the first failure: `cargo xtask check`; with `--full` everything that takes longer, too.
//!
//! The steps are plain commands of cargo (in the dev profile), of this program and, in `viewer/`, of npm, so you can repeat a failed step alone. A step whose program or target is not installed is skipped with a message; where `CI` is set, that is a failure.

use crate::python::interpreter;
use crate::{web, workspace};
use std::process::Command;
use std::time::Instant;

/// What runs a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Tool {
    /// In the root of the workspace.
    Cargo,
    /// The same, for the target of the browser.
    CargoForWasm,
    /// In `viewer/`.
    Npm,
    /// This program.
    Xtask,
    /// The same, for a step that needs Python.
    Python,
}

/// One command.
struct Step {
    name: &'static str,
    tool: Tool,
    arguments: &'static [&'static str],
    /// Set for this step alone.
    variable: Option<(&'static str, &'static str)>,
    /// What to do when it fails.
    hint: &'static str,
}

const STEPS: [Step; 12] = [
    Step {
        name: "format",
        tool: Tool::Cargo,
        arguments: &["fmt", "--all", "--", "--check"],
        variable: None,
        hint: "run `cargo fmt --all`",
    },
    Step {
        name: "lints",
        tool: Tool::Cargo,
        arguments: &["clippy", "--workspace", "--all-targets", "--locked", "--", "-D", "warnings"],
        variable: None,
        hint: "mend what clippy names, or say why not with #[expect(.., reason = \"..\")]; if it asks for an update of Cargo.lock, run `cargo build` and commit the lock file",
    },
    Step {
        name: "house",
        tool: Tool::Xtask,
        arguments: &["house"],
        variable: None,
        hint: "`cargo xtask house` repeats this step",
    },
    Step {
        name: "test programs",
        tool: Tool::Cargo,
        arguments: &["test", "--workspace", "--locked", "--no-run"],
        variable: None,
        hint: "mend what the compiler names",
    },
    Step {
        name: "tests",
        tool: Tool::Cargo,
        // The output of tests that pass is printed as well: it has the values that they measured and the recordings that were missing.
        arguments: &["test", "--workspace", "--locked", "--all-targets", "--", "--show-output"],
        variable: None,
        hint: "run the failing test alone with `cargo test --package NAME TEST`; `cargo test --workspace` runs all",
    },
    Step {
        name: "examples in comments",
        tool: Tool::Cargo,
        arguments: &["test", "--workspace", "--locked", "--doc"],
        variable: None,
        hint: "run the failing example alone with `cargo test --package NAME --doc EXAMPLE`",
    },
    Step {
        name: "Python package",
        tool: Tool::Python,
        arguments: &["python"],
        variable: None,
        hint: "`cargo xtask python` repeats this step with the module that the tests' step has compiled",
    },
    Step {
        name: "documentation",
        tool: Tool::Cargo,
        arguments: &["doc", "--workspace", "--no-deps", "--locked"],
        variable: Some(("RUSTDOCFLAGS", "-D warnings")),
        hint: "mend what rustdoc names; `RUSTDOCFLAGS=\"-D warnings\" cargo doc --no-deps` repeats this step",
    },
    Step {
        name: "32-bit target",
        tool: Tool::CargoForWasm,
        arguments: &["check", "--package", "ambulo-cli", "--bin", "ambulo", "--target", web::TARGET, "--locked"],
        variable: None,
        hint: "the command has to compile where `usize` has 32 bits, for the page in the browser (`cargo xtask web`)",
    },
    Step {
        name: "viewer's packages",
        tool: Tool::Npm,
        arguments: &["ci", "--no-audit", "--no-fund"],
        variable: None,
        hint: "`npm ci` in viewer/ needs the package registry; package-lock.json must agree with package.json",
    },
    Step {
        name: "viewer",
        tool: Tool::Npm,
        arguments: &["run", "check"],
        variable: None,
        hint: "mend what the linter, the compiler or a test names; `npm run build` in viewer/ makes the bundle anew",
    },
    Step {
        name: "pages in a browser",
        tool: Tool::Npm,
        arguments: &["run", "e2e"],
        variable: None,
        hint: "`npm run e2e` in viewer/ repeats this step with the `ambulo` that cargo built last",
    },
];

/// Steps of `--full`, after the others.
const LONG_STEPS: [Step; 4] = [
    Step {
        name: "fuzz corpus",
        tool: Tool::Cargo,
        arguments: &[
            "run",
            "--locked",
            "--manifest-path",
            "fuzz/Cargo.toml",
            "--no-default-features",
            "--example",
            "replay",
        ],
        variable: None,
        hint: "the last file that is printed is the one that fails",
    },
    Step {
        name: "sweep",
        tool: Tool::Xtask,
        arguments: &["sweep"],
        variable: None,
        hint: "each line above is a command that failed and what it printed last",
    },
    Step {
        name: "all numbers of all options",
        tool: Tool::Cargo,
        arguments: &["test", "--locked", "--package", "ambulo-cli", "option_sweep", "--", "--show-output"],
        variable: Some(("AMBULO_SWEEP", "all")),
        hint: "the failing test names the command and its options; the range of a number belongs in the library",
    },
    Step {
        name: "benchmark",
        tool: Tool::Xtask,
        arguments: &["bench"],
        variable: None,
        hint: "`cargo xtask bench` repeats this step",
    },
];

/// Runs the steps. The error names the step that failed and what to do.
#[expect(clippy::print_stdout, reason = "the steps and their times are the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let long: &[Step] = match words {
        [] => &[],
        [option] if option == "--full" => &LONG_STEPS,
        _ => return Err("usage: cargo xtask check [--full]".to_owned()),
    };
    let steps: Vec<&Step> = STEPS.iter().chain(long).collect();
    let start = Instant::now();
    let lacking: Vec<Option<&str>> = steps.iter().map(|step| step.tool.lacking()).collect();
    if std::env::var_os("CI").is_some() {
        all_present(&lacking)?;
    }
    for (i, (step, lacking)) in steps.iter().zip(lacking).enumerate() {
        let head = format!("[{}/{}] {}", i + 1, steps.len(), step.name);
        if let Some(lacking) = lacking {
            println!("{head}: skipped: {lacking} is not installed");
            continue;
        }
        println!("{head}: {} {}", step.tool.word(), step.arguments.join(" "));
        let step_start = Instant::now();
        run_step(step)?;
        println!("{head}: {:.1} s", step_start.elapsed().as_secs_f64());
    }
    println!("all {} steps passed or skipped in {:.1} s", steps.len(), start.elapsed().as_secs_f64());
    Ok(())
}

/// An error if CI would skip a step or the tests that need recordings.
fn all_present(lacking: &[Option<&str>]) -> Result<(), String> {
    if let Some(lacking) = lacking.iter().flatten().next() {
        return Err(format!("{lacking} is not installed\nhint: .ci/run installs what the steps need"));
    }
    let data = workspace::data().join("data");
    if data.is_dir() {
        return Ok(());
    }
    let data = data.display();
    Err(format!(
        "{data}: no recordings, and in CI no test may be skipped\nhint: set AMBULO_DATA to the folder with `data`"
    ))
}

/// Whether there is a Python that makes virtual environments and reads TOML.
fn has_venv() -> bool {
    let mut python = Command::new(interpreter());
    python.args(["-c", "import ensurepip, tomllib, venv"]).output().is_ok_and(|output| output.status.success())
}

impl Tool {
    /// What a step needs and the machine does not have.
    fn lacking(self) -> Option<&'static str> {
        let starts =
            |name: &str| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success());
        match self {
            Tool::Cargo | Tool::Xtask => None,
            Tool::CargoForWasm => (!web::has_target()).then_some("the target wasm32-wasip1 (`rustup target add`)"),
            Tool::Python => (!has_venv()).then_some("Python 3.11 or later with venv"),
            Tool::Npm => ["npm", "chromium"].into_iter().find(|name| !starts(name)),
        }
    }

    fn word(self) -> &'static str {
        match self {
            Tool::Cargo | Tool::CargoForWasm => "cargo",
            Tool::Npm => "npm",
            Tool::Xtask | Tool::Python => "cargo xtask",
        }
    }

    fn command(self) -> Command {
        match self {
            Tool::Cargo | Tool::CargoForWasm => workspace::cargo(),
            Tool::Xtask | Tool::Python => Command::new(std::env::current_exe().unwrap_or_else(|_| "xtask".into())),
            Tool::Npm => {
                let mut command = Command::new("npm");
                command.current_dir(workspace::root().join("viewer")).env("AMBULO", workspace::debug_program());
                command
            }
        }
    }
}

fn run_step(step: &Step) -> Result<(), String> {
    let cannot = |e: std::io::Error| format!("{}: {} cannot start: {e}", step.name, step.tool.word());
    let status = step.tool.command().args(step.arguments).envs(step.variable).status().map_err(cannot)?;
    if status.success() {
        return Ok(());
    }
    Err(format!("the step `{}` failed ({status})\nhint: {}", step.name, step.hint))
}
