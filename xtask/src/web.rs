//! The page that computes in the browser: `cargo xtask web [--test | --family]`.
//!
//! Builds the `ambulo` command for WebAssembly with WASI and the page around it into `target/page`, ready for any static host, and prints the size
//! of its files. With `--test`, tests it in Chromium (`web/tests/page.test.ts`) and compares its results with those of the command. With `--family`,
//! solves the walks between which its sliders interpolate (`web/family/walks.json`).

use crate::workspace;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The target of the compiler.
pub(crate) const TARGET: &str = "wasm32-wasip1";
/// As much as the first thread of a program usually has; the linker's default is an eighth of it.
const STACK: &str = "link-arg=-zstack-size=8388608";

pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => build().map(|_| ()),
        ["--test"] => test(&build()?),
        ["--family"] => solve_family(),
        _ => Err("usage: cargo xtask web [--test | --family]".to_owned()),
    }
}

/// Builds the page; returns its folder.
fn build() -> Result<PathBuf, String> {
    if !has_target() {
        return Err(format!("the target {TARGET} is not installed\nhint: `rustup target add {TARGET}` installs it"));
    }
    install_packages()?;
    let mut command = workspace::cargo();
    command.args(["rustc", "--locked", "--package", "ambulo-cli", "--bin", "ambulo", "--profile", "web"]);
    finish(command.args(["--target", TARGET, "--", "-C", STACK]))?;
    // Not `web`: that is the folder in which cargo keeps the build scripts of the profile.
    let site = workspace::target().join("page");
    let program = workspace::target().join(TARGET).join("web/ambulo.wasm");
    finish(node("build.mjs").arg(program).arg(&site))?;
    Ok(site)
}

/// Installs the packages of `viewer/`, which the page uses.
fn install_packages() -> Result<(), String> {
    let viewer = workspace::root().join("viewer");
    if viewer.join("node_modules").is_dir() {
        return Ok(());
    }
    finish(Command::new("npm").current_dir(&viewer).args(["ci", "--no-audit", "--no-fund"]))
}

/// Whether the compiler has the standard library of the target.
pub(crate) fn has_target() -> bool {
    let output = Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
}

/// Tests the page; the command that it is compared with is built as for other tests.
fn test(site: &Path) -> Result<(), String> {
    finish(workspace::cargo().args(["build", "--locked", "--package", "ambulo-cli"]))?;
    finish(node("tests/run.mjs").arg(site).env("AMBULO", workspace::debug_program()))
}

/// Solves the walks between which the page interpolates.
fn solve_family() -> Result<(), String> {
    install_packages()?;
    finish(workspace::cargo().args(["build", "--locked", "--release", "--package", "ambulo-cli"]))?;
    finish(node("family/run.mjs").env("AMBULO", workspace::target().join("release/ambulo")))
}

/// Node with a script of `web/`.
fn node(script: &str) -> Command {
    let path: PathBuf = workspace::root().join("web").join(script);
    let mut command = Command::new("node");
    command.arg(path);
    command
}

fn finish(command: &mut Command) -> Result<(), String> {
    let program = command.get_program().to_string_lossy().into_owned();
    let status = command.status().map_err(|e| format!("{program}: cannot start: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("{program} failed ({status}), see above")) }
}
