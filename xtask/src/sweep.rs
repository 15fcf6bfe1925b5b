//! The `ambulo` command on every example and every recording, and killed while it writes: `cargo xtask sweep`.
//!
//! | part       | must hold                                                                                            |
//! |------------|------------------------------------------------------------------------------------------------------|
//! | examples   | every scene in `examples/` and in the library can be simulated and every gait walked, every program in `crates/*/examples` ends without error |
//! | recordings | `ambulo info` on every file of the data folder, and `ambulo forces` on every recording with markers or a skeleton, end with an exit code of their own: 0, 1 or 2, never by a panic |
//! | kills      | after a run that was killed at a random time while it replaced other results, a folder has all old or all new results and the user's own files, and the same command then gives the same files as in an empty folder |

use crate::workspace;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Runs that are killed at random times: every fourth at any time, the others while they write files.
const KILLS: u64 = 200;
/// Every how many kills the run is repeated.
const REPEATED: u64 = 10;
/// Folder in the folder of the results that exists while files are written.
const NEW: &str = ".ambulo-new";
/// Files of the user in the folder of the results.
const OWN: [&str; 2] = ["notes.txt", "figures/mine.svg"];
/// The lock that a killed run leaves; the next one removes it.
const LOCK: &str = ".ambulo-lock";
/// Files of recordings that `ambulo forces` takes without a model.
const RECORDINGS: [&str; 3] = ["c3d", "trc", "bvh"];
/// Endings of files that `ambulo info` describes.
const DESCRIBED: [&str; 8] = ["c3d", "trc", "bvh", "mot", "sto", "csv", "osim", "xml"];
/// A file with measured times, which differ between runs.
const TIMED: &str = "timings.json";

/// Runs all parts; the error lists every run that failed.
#[expect(clippy::print_stdout, reason = "counts and failures are the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let scratch = Scratch::new()?;
    let program = optimised_program()?;
    let mut failures = Vec::new();
    let mut files = below(&workspace::root().join("examples"))?;
    files.extend(below(&workspace::root().join("crates/ambulo-paper/data/scenes"))?);
    for file in &files {
        let is_gait = file.parent().is_some_and(|folder| folder.ends_with("gaits"));
        let verb: &[&str] = if is_gait { &["walk", "--gait"] } else { &["simulate"] };
        let mut command = ambulo(&program, verb);
        command.args([text(file), "-o".to_owned(), text(&scratch.0.join("example"))]);
        failures.extend(failure(command, &[0, 1])?);
    }
    let examples = library_examples()?;
    for [package, example] in &examples {
        let mut command = workspace::cargo();
        command.args([
            "run",
            "--quiet",
            "--profile",
            workspace::OPTIMISED,
            "--locked",
            "--package",
            package,
            "--example",
            example,
        ]);
        command.stdout(Stdio::null());
        failures.extend(failure(command, &[0])?);
    }
    println!("examples: {} scenes and gaits, {} programs", files.len(), examples.len());
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

/// Builds the `ambulo` command with the optimisation of benchmarks and returns its path.
pub(crate) fn optimised_program() -> Result<PathBuf, String> {
    let mut build = workspace::cargo();
    build.args(["build", "--quiet", "--profile", workspace::OPTIMISED, "--locked", "--bin", "ambulo"]);
    let status = build.status().map_err(|e| format!("cargo: cannot start: {e}"))?;
    if !status.success() {
        return Err(format!("the `ambulo` command did not build ({status}), see above"));
    }
    Ok(workspace::target().join(workspace::OPTIMISED).join(format!("ambulo{}", std::env::consts::EXE_SUFFIX)))
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

/// Kills `ambulo demo` at random times while it replaces the results of `ambulo walk`.
#[expect(clippy::print_stdout, reason = "the counts are the command's result")]
fn kills(program: &Path, scratch: &Path) -> Result<Vec<String>, String> {
    let (old, new) = (scratch.join("old"), scratch.join("new"));
    let demo = |folder: &Path| ambulo(program, &["demo", "-o", &text(folder)]);
    let mut failures = Vec::new();
    failures.extend(failure(ambulo(program, &["walk", "--speed", "0.7", "-o", &text(&old)]), &[0, 1])?);
    write_own(&old)?;
    copy(&old, &new)?;
    let start = Instant::now();
    let mut child = started(demo(&new))?;
    wait_for_files(&new, &mut child);
    let computing = start.elapsed();
    child.wait().map_err(|e| format!("ambulo: {e}"))?;
    let writing = start.elapsed() - computing;
    let whole = [contents(&old)?, contents(&new)?];
    let mut counts = [0; 3];
    for (kill, random) in (0..KILLS).zip(seeded()) {
        let folder = scratch.join("killed");
        copy(&old, &folder)?;
        let mut child = started(demo(&folder))?;
        if kill % 4 == 0 {
            sleep(computing.mul_f64(random));
        } else {
            wait_for_files(&folder, &mut child);
            sleep(writing.mul_f64(random));
        }
        // A run that ended before it was killed is as good.
        let _ = child.kill();
        child.wait().map_err(|e| format!("ambulo: {e}"))?;
        let mut view = ambulo(program, &["view", &text(&folder)]);
        view.env("BROWSER", "none");
        failures.extend(failure(view, &[0])?);
        let found = contents(&folder)?;
        let state = whole.iter().position(|files| *files == found).unwrap_or(2);
        counts[state] += 1;
        if state == 2 {
            failures.push(format!("demo, kill {kill}: neither all old nor all new files"));
        }
        if kill % REPEATED == 0 {
            failures.extend(failure(demo(&folder), &[0])?);
            if contents(&folder)? != whole[1] {
                failures.push(format!("demo, kill {kill}, repeated: other files than usual"));
            }
        }
    }
    let [old, new, torn] = counts;
    println!(
        "kills: {KILLS}, of which {old} left all old files, {new} all new files, {torn} a torn or mixed folder or a \
         lost file"
    );
    Ok(failures)
}

fn started(mut command: Command) -> Result<Child, String> {
    command.stderr(Stdio::null()).spawn().map_err(|e| format!("ambulo: cannot start: {e}"))
}

/// Waits until a run begins to write files, or has ended.
fn wait_for_files(folder: &Path, child: &mut Child) {
    while !folder.join(NEW).exists() && matches!(child.try_wait(), Ok(None)) {
        sleep(Duration::from_micros(200));
    }
}

/// Numbers from 0 to 1 that look random and are the same in every run.
pub(crate) fn seeded() -> impl Iterator<Item = f64> {
    let next = |x: &u64| Some(x.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407));
    std::iter::successors(Some(5), next).skip(1).map(|x| (x >> 11) as f64 / (1_u64 << 53) as f64)
}

/// Adds files of the user.
fn write_own(folder: &Path) -> Result<(), String> {
    let written = OWN.iter().map(|name| (folder.join(name), fs::write(folder.join(name), "mine")));
    written.into_iter().try_for_each(|(path, done)| done.map_err(|e| format!("{}: {e}", path.display())))
}

/// Makes a folder a copy of another one.
fn copy(from: &Path, to: &Path) -> Result<(), String> {
    let failed = |e: std::io::Error| format!("{}: cannot be copied: {e}", from.display());
    if to.exists() {
        fs::remove_dir_all(to).map_err(failed)?;
    }
    for path in below(from)? {
        let target = to.join(path.strip_prefix(from).unwrap_or(&path));
        fs::create_dir_all(target.parent().unwrap_or(to)).map_err(failed)?;
        fs::copy(&path, target).map_err(failed)?;
    }
    Ok(())
}

/// Names and bytes of the files of a folder; of the file with measured times only the name.
fn contents(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, String> {
    let mut files = BTreeMap::new();
    for path in below(folder)?.into_iter().filter(|path| !path.ends_with(LOCK)) {
        let bytes = if path.ends_with(TIMED) {
            Vec::new()
        } else {
            fs::read(&path).map_err(|e| format!("{}: {e}", path.display()))?
        };
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
