//! Runs the program in a separate folder, which contains an input for `forces`.
use ambulo_formats::table::Table;
use serde_json::Value;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{LazyLock, Mutex};
use std::time::{Duration, Instant};

/// The built-in input.
pub(crate) const INPUT: [&str; 4] = ["figure.osim", "walk.mot", "walk_grf.mot", "walk_grf.xml"];

/// Leaves out the checks that the built-in walk fails.
const THRESHOLDS: &str = "thresholds.toml";

/// The usual arguments of `forces`.
pub(crate) const FORCES: [&str; 10] = [
    "forces",
    "walk.mot",
    "--model",
    "figure.osim",
    "--grf",
    "walk_grf.mot",
    "--loads",
    "walk_grf.xml",
    "--thresholds",
    THRESHOLDS,
];

/// Options for a run without filters.
pub(crate) const RAW: [&str; 4] = ["--cutoff", "off", "--force-cutoff", "off"];

/// A run that takes longer hangs. The slowest takes less than a minute on a machine that does nothing else.
const HANGS: Duration = Duration::from_secs(1800);

/// A fresh folder, which is kept if the test fails.
pub(crate) struct Workbench {
    pub(crate) folder: PathBuf,
    runs: AtomicUsize,
    kept_on_failure: bool,
}

impl Drop for Workbench {
    fn drop(&mut self) {
        if !(self.kept_on_failure && std::thread::panicking()) {
            // A folder that cannot be removed is no reason to fail.
            let _ = fs::remove_dir_all(&self.folder);
        }
    }
}

/// The outcome of a run.
pub(crate) struct Run {
    pub(crate) code: Option<i32>,
    pub(crate) stdout: String,
    pub(crate) stderr: String,
    /// To be printed; how long a run takes depends on the machine.
    pub(crate) took: Duration,
}

/// A new folder for this process. A number follows the id of the process, because the folder of an earlier one with
/// this id may be left.
fn process_folder() -> &'static Path {
    static FOLDER: LazyLock<PathBuf> = LazyLock::new(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR")).join("program");
        fs::create_dir_all(&all).unwrap();
        remove_left(&all);
        let numbered = |number: usize| all.join(format!("{}-{number}", std::process::id()));
        (0..).map(numbered).find(|folder| fs::create_dir(folder).is_ok()).unwrap()
    });
    &FOLDER
}

/// Removes what processes left that have ended: folders of failed tests and those that several tests shared.
fn remove_left(all: &Path) {
    if !Path::new("/proc/self").exists() {
        return;
    }
    for folder in fs::read_dir(all).unwrap().flatten() {
        let name = folder.file_name().into_string().unwrap_or_default();
        let process = name.split('-').next().unwrap_or_default();
        if !Path::new("/proc").join(process).exists() {
            // Another process may remove it at the same time.
            let _ = fs::remove_dir_all(folder.path());
        }
    }
}

/// The bytes of a file of the built-in input.
pub(crate) fn demo_input(name: &str) -> Vec<u8> {
    fs::read(Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/recording").join(name)).unwrap()
}

impl Workbench {
    /// A folder with this name, emptied, with the built-in input in it.
    pub(crate) fn new(name: &str) -> Workbench {
        let bench = Workbench::empty(name);
        for file in INPUT.into_iter().chain([THRESHOLDS]) {
            bench.write(file, demo_input(file));
        }
        bench
    }

    /// An empty folder with this name, which no other test may use. Another process, also one of the same tests, has
    /// other folders.
    pub(crate) fn empty(name: &str) -> Workbench {
        static NAMES: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());
        let is_new = NAMES.lock().unwrap().insert(name.to_owned());
        assert!(is_new, "two tests use the folder `{name}`");
        let folder = process_folder().join(name);
        fs::create_dir(&folder).unwrap();
        Workbench { folder, runs: AtomicUsize::new(0), kept_on_failure: true }
    }

    /// Removes the folder after the test, also if the test fails; for large files.
    pub(crate) fn always_removed(mut self) -> Workbench {
        self.kept_on_failure = false;
        self
    }

    pub(crate) fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::write(self.folder.join(name), content).unwrap();
    }

    pub(crate) fn exists(&self, name: &str) -> bool {
        self.folder.join(name).exists()
    }

    pub(crate) fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.folder.join(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    pub(crate) fn text(&self, name: &str) -> String {
        String::from_utf8(self.read(name)).unwrap()
    }

    pub(crate) fn table(&self, name: &str) -> Table {
        Table::read_storage(&self.read(name)).unwrap_or_else(|e| panic!("{name}: {e}")).0
    }

    pub(crate) fn json(&self, name: &str) -> Value {
        serde_json::from_slice(&self.read(name)).unwrap()
    }

    /// Records the present files of a result folder as those of its run, which then may lack files or have broken ones.
    pub(crate) fn record(&self, folder: &str) {
        let mut summary = self.json(&format!("{folder}/summary.json"));
        let recorded: Vec<String> = summary["files"].as_object().unwrap().keys().cloned().collect();
        let found = recorded.into_iter().filter(|name| self.exists(&format!("{folder}/{name}")));
        summary["files"] =
            found.map(|name| (name.clone(), Value::from(self.hash(&format!("{folder}/{name}"))))).collect();
        self.write(&format!("{folder}/summary.json"), serde_json::to_vec_pretty(&summary).unwrap());
    }

    /// SHA-256 of a file.
    pub(crate) fn hash(&self, name: &str) -> String {
        Sha256::digest(self.read(name)).iter().map(|byte| format!("{byte:02x}")).collect()
    }

    /// Names of all files in a folder and below, sorted.
    pub(crate) fn names(&self, folder: &str) -> Vec<String> {
        let mut names = Vec::new();
        for entry in fs::read_dir(self.folder.join(folder)).unwrap() {
            let (path, name) = entry.map(|entry| (entry.path(), entry.file_name().into_string().unwrap())).unwrap();
            match path.is_dir() {
                true => {
                    names.extend(self.names(&format!("{folder}/{name}")).iter().map(|inner| format!("{name}/{inner}")))
                }
                false => names.push(name),
            }
        }
        names.sort();
        names
    }

    /// A command of the program in this folder, not yet started, without output.
    pub(crate) fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ambulo"));
        command.args(args).current_dir(&self.folder).stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
        command
    }

    /// Replaces text in a file, which must contain the old text.
    pub(crate) fn edit(&self, name: &str, old: &str, new: &str) {
        let text = self.text(name);
        assert!(text.contains(old), "`{old}` is not in {name}");
        self.write(name, text.replace(old, new));
    }

    /// Replaces the rows of a storage file below its line of names.
    pub(crate) fn edit_rows(&self, name: &str, edit: impl Fn(Vec<Vec<String>>) -> Vec<Vec<String>>) {
        let text = self.text(name);
        let rows_begin = text.lines().position(|l| l.trim() == "endheader").unwrap() + 2;
        let head: Vec<&str> = text.lines().take(rows_begin).filter(|l| !l.starts_with("nRows")).collect();
        let rows = text.lines().skip(rows_begin).map(|l| l.split_whitespace().map(str::to_owned).collect()).collect();
        let rows: Vec<String> = edit(rows).iter().map(|cells| cells.join("\t")).collect();
        self.write(name, format!("{}\n{}\n", head.join("\n"), rows.join("\n")));
    }

    /// Runs the program in this folder.
    pub(crate) fn run(&self, args: &[&str]) -> Run {
        self.wait(Command::new(env!("CARGO_BIN_EXE_ambulo")).args(args), args)
    }

    /// Runs the program with at most a gigabyte of address space.
    pub(crate) fn run_in_a_gigabyte(&self, args: &[&str]) -> Run {
        self.run_after("ulimit -v 1048576", args)
    }

    /// Runs the program with at most a gigabyte of address space and ten minutes of processor time, which ends a run
    /// that hangs. The longest of these runs, a walk of a person of one metre, takes some seconds.
    pub(crate) fn run_within_limits(&self, args: &[&str]) -> Run {
        self.run_after("ulimit -v 1048576; ulimit -t 600", args)
    }

    /// Runs the program after a command of the shell that limits it.
    fn run_after(&self, limit: &str, args: &[&str]) -> Run {
        if !cfg!(target_os = "linux") {
            return self.run(args);
        }
        let script = format!("{limit}; exec \"$0\" \"$@\"");
        self.wait(Command::new("sh").args(["-c", &script, env!("CARGO_BIN_EXE_ambulo")]).args(args), args)
    }

    /// Runs the program with files of at most so many kilobytes, as on a disk that becomes full.
    pub(crate) fn run_on_a_small_disk(&self, kilobytes: usize, args: &[&str]) -> Run {
        let limit = format!("trap '' XFSZ; ulimit -f {}; exec \"$0\" \"$@\"", 2 * kilobytes);
        self.wait(Command::new("sh").args(["-c", &limit, env!("CARGO_BIN_EXE_ambulo")]).args(args), args)
    }

    fn wait(&self, command: &mut Command, args: &[&str]) -> Run {
        let number = self.runs.fetch_add(1, Ordering::Relaxed);
        let [out, err] = ["stdout", "stderr"].map(|s| self.folder.join(format!("{s}.{number}")));
        command.current_dir(&self.folder).stdin(Stdio::null()).env("RUST_BACKTRACE", "0").env("BROWSER", "none");
        command.stdout(File::create(&out).unwrap()).stderr(File::create(&err).unwrap());
        let start = Instant::now();
        let mut child = command.spawn().unwrap();
        let status = loop {
            if let Some(status) = child.try_wait().unwrap() {
                break status;
            }
            if start.elapsed() > HANGS {
                child.kill().unwrap();
                child.wait().unwrap();
                panic!("`ambulo {}` hangs", args.join(" "));
            }
            std::thread::sleep(Duration::from_millis(2));
        };
        let text = |path: &Path| String::from_utf8_lossy(&fs::read(path).unwrap()).into_owned();
        let run = Run { code: status.code(), stdout: text(&out), stderr: text(&err), took: start.elapsed() };
        let calm = !run.stderr.contains("panicked") && !run.stderr.contains("overflow");
        assert!(run.code.is_some() && calm, "`ambulo {}` ended with {status}: {}", args.join(" "), run.stderr);
        fs::remove_file(out).unwrap();
        fs::remove_file(err).unwrap();
        run
    }

    /// Runs `forces` on the input with further options; results go to `out`.
    pub(crate) fn forces(&self, more: &[&str]) -> Run {
        self.run(&[&FORCES[..], more].concat())
    }
}

impl Run {
    /// Asserts exit code 0 and returns the run.
    #[track_caller]
    pub(crate) fn done(self) -> Run {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        self
    }

    /// Asserts exit code 0 and, unless nothing was printed, the verdict that the motion is infeasible; returns the run.
    #[track_caller]
    pub(crate) fn infeasible(self) -> Run {
        assert_eq!(self.code, Some(0), "{}", self.stderr);
        assert!(self.stdout.is_empty() || self.stdout.contains("infeasible"), "{}", self.stdout);
        self
    }

    /// Asserts an error (exit code 2) with these words and nothing on standard output.
    #[track_caller]
    pub(crate) fn refused(&self, words: &[&str]) {
        assert_eq!(self.code, Some(2), "{}{}", self.stdout, self.stderr);
        assert!(self.stderr.starts_with("error: "), "{}", self.stderr);
        assert!(self.stdout.is_empty(), "{}", self.stdout);
        self.reports(words);
    }

    /// Asserts a warning with these words, whatever the verdict.
    #[track_caller]
    pub(crate) fn warned(&self, words: &[&str]) {
        assert!(matches!(self.code, Some(0 | 1)), "{}", self.stderr);
        assert!(self.stderr.contains("warning: "), "{}", self.stderr);
        self.reports(words);
    }

    #[track_caller]
    pub(crate) fn reports(&self, words: &[&str]) {
        for word in words {
            assert!(self.stderr.contains(word), "`{word}` is missing in: {}", self.stderr);
        }
    }
}
