//! The steps of `cargo xtask check`, and the lanes in which they run side by side.

use super::compiler;
use crate::python::interpreter;
use crate::{web, workspace};
use std::env::consts::EXE_SUFFIX;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The profile that everything is built in; it has a folder of its own in `target`.
pub(super) const PROFILE: &str = "ci";
/// The step that compiles the test programs.
pub(super) const TEST_PROGRAMS: &str = "test programs";
/// The step that runs them.
pub(super) const TESTS: &str = "tests";

/// What runs a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Tool {
    /// In the root of the workspace.
    Cargo,
    /// The same, for the target of the browser.
    CargoForWasm,
    /// The same, with the compiler of `cargo clippy`: it finds what the lints have compiled, and compiles nothing anew.
    CargoAfterClippy,
    /// In `viewer/`.
    Npm,
    /// This program.
    Xtask,
    /// The same, for a step that needs Python.
    Python,
    /// The test programs that cargo has compiled.
    TestPrograms,
}

/// One command.
pub(super) struct Step {
    pub(super) name: &'static str,
    pub(super) tool: Tool,
    pub(super) arguments: &'static [&'static str],
    /// Set for this step alone.
    pub(super) variables: &'static [(&'static str, &'static str)],
    /// The step of another lane whose results are needed.
    pub(super) after: Option<&'static str>,
    /// What to do when it fails.
    pub(super) hint: &'static str,
}

/// Steps in order.
pub(super) type Lane = &'static [Step];

/// Most fields of most steps.
const PLAIN: Step = Step { name: "", tool: Tool::Cargo, arguments: &[], variables: &[], after: None, hint: "" };

/// Cargo builds one thing at a time in a folder, so what compiles is one lane. The test programs come first in it:
/// while they run, the other steps of all lanes use the processors that they leave.
pub(super) const LANES: [Lane; 3] = [&COMPILED, &TESTED, &PAGES];

const COMPILED: [Step; 6] = [
    Step { name: "format", arguments: &["fmt", "--all", "--", "--check"], hint: "run `cargo fmt --all`", ..PLAIN },
    Step {
        name: "house",
        tool: Tool::Xtask,
        arguments: &["house"],
        hint: "`cargo xtask house` repeats this step",
        ..PLAIN
    },
    Step {
        name: TEST_PROGRAMS,
        arguments: &[
            "test",
            "--workspace",
            "--locked",
            "--profile",
            PROFILE,
            "--no-run",
            "--message-format=json-render-diagnostics",
        ],
        hint: "mend what the compiler or clippy names, or say why not with #[expect(.., reason = \"..\")]",
        ..PLAIN
    },
    Step {
        name: "lints",
        tool: Tool::CargoForWasm,
        // For the browser's target, so that one pass also shows that the libraries compile where `usize` has 32 bits.
        // The members that are left out, and all test programs, were linted as they were compiled.
        arguments: &[
            "clippy",
            "--workspace",
            "--exclude",
            "ambulo-py",
            "--exclude",
            "xtask",
            "--exclude",
            "xtask-measure",
            "--lib",
            "--bins",
            "--target",
            web::TARGET,
            "--locked",
            "--profile",
            PROFILE,
            "--",
            "-D",
            "warnings",
        ],
        hint: "mend what clippy names, or say why not with #[expect(.., reason = \"..\")]; if it asks for an update of \
            Cargo.lock, run `cargo build` and commit the lock file",
        ..PLAIN
    },
    Step {
        name: "documentation",
        tool: Tool::CargoAfterClippy,
        arguments: &[
            "doc",
            "--workspace",
            "--exclude",
            "ambulo-py",
            "--exclude",
            "xtask",
            "--exclude",
            "xtask-measure",
            "--lib",
            "--no-deps",
            "--target",
            web::TARGET,
            "--locked",
            "--profile",
            PROFILE,
        ],
        variables: &[
            ("RUSTDOCFLAGS", "-D warnings"),
            // The arguments of the lints, as `cargo clippy` hands them to its compiler.
            ("CLIPPY_ARGS", "-D__CLIPPY_HACKERY__warnings__CLIPPY_HACKERY__"),
        ],
        hint: "mend what rustdoc names; `RUSTDOCFLAGS=\"-D warnings\" cargo doc --no-deps` repeats this step",
        ..PLAIN
    },
    Step {
        name: "examples in comments",
        arguments: &["test", "--workspace", "--locked", "--profile", PROFILE, "--doc"],
        hint: "run the failing example alone with `cargo test --package NAME --doc EXAMPLE`",
        ..PLAIN
    },
];

const TESTED: [Step; 1] = [Step {
    name: TESTS,
    tool: Tool::TestPrograms,
    after: Some(TEST_PROGRAMS),
    hint: "run the failing test alone with `cargo test --package NAME TEST`; `cargo test --workspace` runs all",
    ..PLAIN
}];

const PAGES: [Step; 4] = [
    Step {
        name: "viewer's packages",
        tool: Tool::Npm,
        arguments: &["ci", "--no-audit", "--no-fund"],
        hint: "`npm ci` in viewer/ needs the package registry; package-lock.json must agree with package.json",
        ..PLAIN
    },
    Step {
        name: "viewer",
        tool: Tool::Npm,
        arguments: &["run", "check"],
        after: Some(TEST_PROGRAMS), // its tests start the command
        hint: "mend what the linter, the compiler or a test names; `npm run build` in viewer/ makes the bundle anew",
        ..PLAIN
    },
    Step {
        name: "Python package",
        tool: Tool::Python,
        arguments: &["python", "--profile", PROFILE],
        after: Some(TEST_PROGRAMS),
        hint: "`cargo xtask python` repeats this step with the module that `cargo test` has compiled",
        ..PLAIN
    },
    Step {
        name: "pages in a browser",
        tool: Tool::Npm,
        arguments: &["run", "e2e"],
        after: Some(TEST_PROGRAMS),
        hint: "`npm run e2e` in viewer/ repeats this step with the `ambulo` that cargo built last",
        ..PLAIN
    },
];

/// Steps of `--full`, after the others and one after the other: they need a quiet machine or take long.
pub(super) const LONG: [Step; 6] = [
    Step {
        name: "fuzz corpus",
        arguments: &[
            "run",
            "--locked",
            "--manifest-path",
            "fuzz/Cargo.toml",
            "--no-default-features",
            "--example",
            "replay",
        ],
        hint: "the last file that is printed is the one that fails",
        ..PLAIN
    },
    Step {
        name: "sweep",
        tool: Tool::Xtask,
        arguments: &["sweep"],
        hint: "each line above is a command that failed and what it printed last",
        ..PLAIN
    },
    Step {
        name: "all numbers of all options",
        arguments: &[
            "test",
            "--locked",
            "--profile",
            PROFILE,
            "--package",
            "ambulo-cli",
            "option_sweep",
            "--",
            "--show-output",
        ],
        variables: &[("AMBULO_SWEEP", "all")],
        hint: "the failing test names the command and its options; the range of a number belongs in the library",
        ..PLAIN
    },
    Step {
        name: "all random scenes",
        arguments: &[
            "test",
            "--workspace",
            "--locked",
            "--profile",
            PROFILE,
            "quarter_of_random_scenes",
            "--",
            "--show-output",
        ],
        variables: &[("AMBULO_SCENES", "all")],
        hint: "the failing test names the seeds of its scenes",
        ..PLAIN
    },
    Step {
        name: "times",
        arguments: &["test", "--workspace", "--locked", "--profile", PROFILE, "in_time", "--", "--show-output"],
        variables: &[("AMBULO_TIMES", "1")],
        hint: "limits of time hold on a machine that does nothing else; run the failing test again",
        ..PLAIN
    },
    Step {
        name: "benchmark",
        tool: Tool::Xtask,
        arguments: &["bench"],
        hint: "`cargo xtask bench` repeats this step",
        ..PLAIN
    },
];

impl Tool {
    /// What a step needs and the machine does not have.
    pub(super) fn lacking(self) -> Option<&'static str> {
        let starts =
            |name: &str| Command::new(name).arg("--version").output().is_ok_and(|output| output.status.success());
        match self {
            Tool::Cargo | Tool::Xtask | Tool::TestPrograms => None,
            Tool::CargoForWasm | Tool::CargoAfterClippy => {
                (!web::has_target()).then_some("the target wasm32-wasip1 (`rustup target add`)")
            }
            Tool::Python => (!has_venv()).then_some("Python 3.11 or later with venv"),
            Tool::Npm => ["npm", "chromium"].into_iter().find(|name| !starts(name)),
        }
    }

    /// Whether its programs use a processor all the time.
    pub(super) fn waits_little(self) -> bool {
        !matches!(self, Tool::Npm | Tool::Python)
    }

    fn command(self) -> Command {
        match self {
            Tool::Cargo | Tool::CargoForWasm | Tool::TestPrograms => workspace::cargo(),
            Tool::CargoAfterClippy => {
                let mut command = workspace::cargo();
                let compiler = compiler::clippy(Path::new(command.get_program()));
                if compiler.is_file() {
                    command.env("RUSTC_WORKSPACE_WRAPPER", compiler);
                }
                command
            }
            Tool::Xtask | Tool::Python => Command::new(std::env::current_exe().unwrap_or_else(|_| "xtask".into())),
            Tool::Npm => {
                let mut command = Command::new("npm");
                command.current_dir(workspace::root().join("viewer")).env("AMBULO", program());
                command
            }
        }
    }
}

impl Step {
    pub(super) fn command(&self) -> Command {
        let mut command = self.tool.command();
        command.args(self.arguments).envs(self.variables.iter().copied());
        if self.arguments.first() == Some(&"test") {
            compiler::stand_in(&mut command);
        }
        command
    }

    /// What is run, in words.
    pub(super) fn words(&self) -> String {
        let tool = match self.tool {
            Tool::Cargo | Tool::CargoAfterClippy | Tool::CargoForWasm => "cargo",
            Tool::Npm => "npm",
            Tool::Xtask | Tool::Python => "cargo xtask",
            Tool::TestPrograms => return "every test program".to_owned(),
        };
        format!("{tool} {}", self.arguments.join(" "))
    }
}

/// Whether there is a Python that makes virtual environments and reads TOML.
fn has_venv() -> bool {
    let mut python = Command::new(interpreter());
    python.args(["-c", "import ensurepip, tomllib, venv"]).output().is_ok_and(|output| output.status.success())
}

/// The `ambulo` command that was compiled with the test programs.
fn program() -> PathBuf {
    workspace::target().join(PROFILE).join(format!("ambulo{EXE_SUFFIX}"))
}
