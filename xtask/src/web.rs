//! The page that computes in the browser, and the documents: `cargo xtask web [--test | --site | --documents |
//! --family]`.
//!
//! Builds the `ambulo` command for WebAssembly with WASI and the page around it into `target/page`, ready for any
//! static host, and prints the size of its files. With `--test`, tests it in Chromium and Firefox
//! (`web/tests/page.test.ts`) and compares its results with those of the command, and walks all links of the documents
//! (`web/tests/documents.test.ts`). With `--site`, adds the API documentation of the crates and the gallery, and walks
//! the links. With `--documents`, makes and walks the documents and the gallery alone, which needs no WebAssembly. With
//! `--family`, solves the walks between which its sliders interpolate (`web/family/walks.json`).

use crate::workspace;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The target of the compiler.
pub(crate) const TARGET: &str = "wasm32-wasip1";
/// Where Firefox is looked for.
const FIREFOX: [&str; 2] = ["/usr/bin/firefox-esr", "/usr/bin/firefox"];
/// As much as the first thread of a program usually has; the linker's default is an eighth of it.
const STACK: &str = "link-arg=-zstack-size=8388608";

pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => build(None, None).map(|_| ()),
        ["--test"] => test(&build(None, None)?),
        ["--site"] => site(),
        ["--documents"] => documents(),
        ["--family"] => solve_family(),
        _ => Err("usage: cargo xtask web [--test | --site | --documents | --family]".to_owned()),
    }
}

/// Builds the whole address and walks its documents.
fn site() -> Result<(), String> {
    let program = drawing_program()?;
    let site = build(Some(&api()?), Some(&program))?;
    walk(&site, &program)
}

/// Makes the documents with the gallery, without the page that computes, and walks them.
fn documents() -> Result<(), String> {
    install_packages()?;
    let program = drawing_program()?;
    let site = workspace::target().join("documents");
    finish(node("documents/site.mjs").arg(site.join("documents")).env("AMBULO", &program))?;
    walk(&site, &program)
}

/// Follows all links of the documents in Chromium, and tests their search.
fn walk(site: &Path, program: &Path) -> Result<(), String> {
    let only = site.join("index.html").exists().then_some("documents");
    finish(node("tests/run.mjs").arg(site).args(only).env("AMBULO", program))
}

/// The command that draws the gallery: the one that the variable AMBULO names, or a new one.
fn drawing_program() -> Result<PathBuf, String> {
    if let Some(program) = std::env::var_os("AMBULO") {
        return std::path::absolute(PathBuf::from(program)).map_err(|e| format!("AMBULO: {e}"));
    }
    finish(workspace::cargo().args(["build", "--locked", "--package", "ambulo-cli"]))?;
    Ok(workspace::debug_program())
}

/// Builds the page and the documents, with the folder of the API documentation and a gallery drawn by a program if
/// there are any; returns its folder.
fn build(api: Option<&Path>, program: Option<&Path>) -> Result<PathBuf, String> {
    if !has_target() {
        return Err(format!("the target {TARGET} is not installed\nhint: `rustup target add {TARGET}` installs it"));
    }
    install_packages()?;
    let mut command = workspace::cargo();
    command.args(["rustc", "--locked", "--package", "ambulo-cli", "--bin", "ambulo", "--profile", "web"]);
    finish(command.args(["--target", TARGET, "--", "-C", STACK]))?;
    // Not `web`: that is the folder in which cargo keeps the build scripts of the profile.
    let site = workspace::target().join("page");
    let wasm = workspace::target().join(TARGET).join("web/ambulo.wasm");
    let mut build = node("build.mjs");
    build.arg(wasm).arg(&site).args(api).env_remove("AMBULO");
    finish(build.envs(program.map(|program| ("AMBULO", program))))?;
    Ok(site)
}

/// Installs the packages of `viewer/`, which the page uses, if they are missing or the list of them has changed since.
fn install_packages() -> Result<(), String> {
    let viewer = workspace::root().join("viewer");
    let changed = |path: &str| fs::metadata(viewer.join(path)).and_then(|file| file.modified()).ok();
    // npm writes the second file when it has installed what the first one lists.
    let [listed, installed] = ["package-lock.json", "node_modules/.package-lock.json"].map(changed);
    if installed.is_some() && installed >= listed {
        return Ok(());
    }
    finish(Command::new("npm").current_dir(&viewer).args(["ci", "--no-audit", "--no-fund"]))
}

/// Whether the compiler has the standard library of the target.
pub(crate) fn has_target() -> bool {
    let output = Command::new("rustc").args(["--print", "target-libdir", "--target", TARGET]).output();
    output.is_ok_and(|output| Path::new(String::from_utf8_lossy(&output.stdout).trim()).is_dir())
}

/// Tests the page in the browsers that are there, of which Chromium must be one; the command that it is compared with
/// is built as for other tests.
#[expect(clippy::print_stdout, reason = "says which browsers are tested")]
fn test(site: &Path) -> Result<(), String> {
    finish(workspace::cargo().args(["build", "--locked", "--package", "ambulo-cli"]))?;
    let in_browser =
        |name| finish(node("tests/run.mjs").arg(site).env("AMBULO", workspace::debug_program()).env("BROWSER", name));
    println!("in Chromium:");
    in_browser("chromium")?;
    if !has_firefox() {
        println!("in Firefox: skipped, it is not installed");
        return Ok(());
    }
    println!("in Firefox:");
    in_browser("firefox")
}

/// Whether the tests find Firefox (`viewer/e2e/page.ts`).
fn has_firefox() -> bool {
    std::env::var_os("FIREFOX").is_some() || FIREFOX.iter().any(|path| Path::new(path).exists())
}

/// Writes the API documentation of the crates for users; returns its folder.
fn api() -> Result<PathBuf, String> {
    let mut command = workspace::cargo();
    command.args(["doc", "--locked", "--no-deps", "--lib"]);
    for package in ["ambulo", "ambulo-formats", "ambulo-results", "ambulo-report"] {
        command.args(["--package", package]);
    }
    // Not the folder of `cargo doc`, which may have the documentation of other crates.
    let folder = workspace::target().join("api");
    finish(command.arg("--target-dir").arg(&folder))?;
    Ok(folder.join("doc"))
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
