//! The `ambulo` command on every example and every recording, and killed while it writes: `cargo xtask sweep`.
//!
//! | part       | must hold                                                                                            |
//! |------------|------------------------------------------------------------------------------------------------------|
//! | examples   | every scene in `examples/` can be simulated, every program in `crates/*/examples` ends without error |
//! | recordings | `ambulo info` on every file of the data folder, and `ambulo forces` on every recording with markers or a skeleton, end with an exit code of their own: 0, 1 or 2, never by a panic |
//! | kills      | after a run that was killed at any time, the same command gives the same files as in an empty folder |

use crate::workspace;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::Instant;

/// Runs that are killed, spread evenly over the time of a whole run.
const KILLS: u32 = 20;
/// Files of recordings that `ambulo forces` takes without a model.
const RECORDINGS: [&str; 3] = ["c3d", "trc", "bvh"];
/// Endings of files that `ambulo info` describes.
const DESCRIBED: [&str; 8] = ["c3d", "trc", "bvh", "mot", "sto", "csv", "osim", "xml"];
/// Files with measured times, which differ between runs.
const TIMED: [&str; 2] = ["summary.json", "report.html"];

/// Runs all parts; the error lists every run that failed.
#[expect(clippy::print_stdout, reason = "counts and failures are the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let scratch = Scratch::new()?;
    let program = release_program()?;
    let mut failures = Vec::new();
    let scenes = below(&workspace::root().join("examples"))?;
    for scene in &scenes {
        let command = ambulo(&program, &["simulate", &text(scene), "-o", &text(&scratch.0.join("scene"))]);
        failures.extend(failure(command, &[0, 1])?);
    }
    let examples = library_examples()?;
    for [package, example] in &examples {
        let mut command = workspace::cargo();
        command.args(["run", "--quiet", "--release", "--locked", "--package", package, "--example", example]);
        command.stdout(Stdio::null());
        failures.extend(failure(command, &[0])?);
    }
    println!("examples: {} scenes, {} programs", scenes.len(), examples.len());
    let data = workspace::data().join("data");
    let files = if data.is_dir() { below(&data)? } else { Vec::new() };
    let with = |endings: &[&str]| -> Vec<&PathBuf> { files.iter().filter(|file| ends_in(file, endings)).collect() };
    for file in with(&DESCRIBED) {
        failures.extend(failure(ambulo(&program, &["info", &text(file)]), &[0, 1, 2])?);
    }
    for file in with(&RECORDINGS) {
        let command = ambulo(&program, &["forces", &text(file), "-o", &text(&scratch.0.join("forces"))]);
        failures.extend(failure(command, &[0, 1, 2])?);
    }
    println!("recordings: {} described, {} computed", with(&DESCRIBED).len(), with(&RECORDINGS).len());
    failures.extend(kills(&program, &scratch.0)?);
    println!("kills: {KILLS} runs killed and repeated");
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// A temporary folder, removed when dropped.
struct Scratch(PathBuf);

impl Scratch {
    fn new() -> Result<Scratch, String> {
        let folder = std::env::temp_dir().join(format!("ambulo-sweep-{}", std::process::id()));
        fs::create_dir_all(&folder).map_err(|e| format!("{}: cannot create: {e}", folder.display()))?;
        Ok(Scratch(folder))
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // A temporary folder that cannot be removed does no harm.
        let _ = fs::remove_dir_all(&self.0);
    }
}

/// Builds the `ambulo` command in release and returns its path.
fn release_program() -> Result<PathBuf, String> {
    let mut build = workspace::cargo();
    build.args(["build", "--quiet", "--release", "--locked", "--bin", "ambulo"]);
    let status = build.status().map_err(|e| format!("cargo: cannot start: {e}"))?;
    if !status.success() {
        return Err(format!("the `ambulo` command did not build ({status}), see above"));
    }
    Ok(workspace::target().join("release").join(format!("ambulo{}", std::env::consts::EXE_SUFFIX)))
}

/// Package and name of each program in `crates/*/examples`.
fn library_examples() -> Result<Vec<[String; 2]>, String> {
    let crates = workspace::root().join("crates");
    let sources = below(&crates)?.into_iter().filter(|file| ends_in(file, &["rs"]));
    let named = sources.filter_map(|file| {
        let inside = text(file.strip_prefix(&crates).ok()?);
        let (package, example) = inside.strip_suffix(".rs")?.split_once("/examples/")?;
        (!package.contains('/')).then(|| [package.to_owned(), example.trim_end_matches("/main").to_owned()])
    });
    Ok(named.collect())
}

fn ambulo(program: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.args(words).stdout(Stdio::null());
    command
}

/// Runs a command to its end; a message if its exit code is none of these.
fn failure(mut command: Command, codes: &[i32]) -> Result<Option<String>, String> {
    let output = command.stderr(Stdio::piped()).output().map_err(|e| format!("ambulo: cannot start: {e}"))?;
    if output.status.code().is_some_and(|code| codes.contains(&code)) {
        return Ok(None);
    }
    let said = String::from_utf8_lossy(&output.stderr);
    let last = said.lines().rev().take(3).collect::<Vec<_>>().into_iter().rev().collect::<Vec<_>>().join("\n    ");
    Ok(Some(format!("{command:?}: {}\n    {last}", output.status)))
}

/// Kills `ambulo demo` at several times and repeats it into the same folder.
fn kills(program: &Path, scratch: &Path) -> Result<Vec<String>, String> {
    let whole = scratch.join("whole");
    let demo = |folder: &Path| ambulo(program, &["demo", "-o", &text(folder)]);
    let start = Instant::now();
    let mut failures: Vec<String> = failure(demo(&whole), &[0])?.into_iter().collect();
    let duration = start.elapsed();
    let expected = contents(&whole)?;
    for kill in 0..KILLS {
        let folder = scratch.join(format!("killed-{kill}"));
        let mut child =
            demo(&folder).stderr(Stdio::null()).spawn().map_err(|e| format!("ambulo: cannot start: {e}"))?;
        sleep(duration * kill / KILLS);
        // A run that ended before it was killed is as good.
        let _ = child.kill();
        child.wait().map_err(|e| format!("ambulo: {e}"))?;
        failures.extend(failure(demo(&folder), &[0])?);
        if contents(&folder)? != expected {
            failures.push(format!(
                "demo, killed at {kill}/{KILLS} of its time and repeated: other files than in an empty folder"
            ));
        }
    }
    Ok(failures)
}

/// Names and bytes of the files of a folder; of files with measured times only the names.
fn contents(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, String> {
    let mut files = BTreeMap::new();
    for path in below(folder)? {
        let is_timed = path.file_name().is_some_and(|name| TIMED.iter().any(|timed| name == *timed));
        let bytes =
            if is_timed { Vec::new() } else { fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))? };
        files.insert(path.strip_prefix(folder).unwrap_or(&path).to_owned(), bytes);
    }
    Ok(files)
}

/// All files below a folder, sorted.
fn below(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let mut files = Vec::new();
    let listing = fs::read_dir(folder).map_err(|e| format!("{}: cannot read: {e}", folder.display()))?;
    for path in listing.flatten().map(|entry| entry.path()) {
        if path.is_dir() { files.extend(below(&path)?) } else { files.push(path) }
    }
    files.sort();
    Ok(files)
}

fn ends_in(file: &Path, endings: &[&str]) -> bool {
    let ending = file.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_lowercase();
    endings.contains(&ending.as_str())
}

fn text(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}
