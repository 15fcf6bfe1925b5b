//! What `ambulo batch` costs: `cargo xtask batch-cost [--kills]`.
//!
//! The trials are copies of one recording with its standing trial (`biomechzoo-HC032A` of the data folder: 291 points,
//! of which 52 are markers, two force plates), of which 1.3 s are computed, 131 frames. Processor time and memory are
//! those that Linux counts for the command.
//!
//! | part      | printed                                                                                                       |
//! |-----------|---------------------------------------------------------------------------------------------------------------|
//! | cost      | processor time per trial with one thread; two threads against one; peak memory at 100 and 1,000 trials; bytes per trial in files of its own |
//! | sheet     | core-hours and bytes of 70 h and 288 h of motion: the figures above, multiplied                                |
//! | `--kills` | 10,000 trials in one run that is killed ten times at random times and continued: the bytes are those of a run without interruption |

use crate::sweep::{optimised_program, seeded};
use crate::workspace;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

const RECORDING: &str = "data/biomechzoo-HC032A/HC032A03.c3d";
const STANDING: &str = "data/biomechzoo-HC032A/HC032A01.c3d";
/// Options of `ambulo forces`: 1.3 s of the recording.
const WINDOW: [&str; 5] = ["--", "--from", "1.56", "--to", "2.86"];
const DURATION_S: f64 = 1.3;
const ONE_THREAD: [&str; 2] = ["--jobs", "1"];
const TWO_THREADS: [&str; 2] = ["--jobs", "2"];
/// Hours of motion in the cost sheet.
const HOURS: [f64; 2] = [70.0, 288.0];
/// Trials of the part with kills, and its kills.
const KILLED_TRIALS: usize = 10_000;
const KILLS: usize = 10;
/// The unit of the times in `/proc/self/stat` [s]: `getconf CLK_TCK` is 100 on every Linux machine of today.
const TICK_S: f64 = 0.01;

/// What a run of the command took.
pub(crate) struct Cost {
    pub(crate) processor_s: f64,
    wall_s: f64,
    pub(crate) peak_mb: f64,
}

/// Measures and prints.
#[expect(clippy::print_stdout, reason = "the figures are the command's result")]
pub(crate) fn run(options: &[String]) -> Result<(), String> {
    let with_kills = match options {
        [] => false,
        [only] if only == "--kills" => true,
        _ => return Err(format!("found `{}`; expected no option, or --kills", options.join(" "))),
    };
    let program = optimised_program()?;
    let folder = workspace::target().join("batch-cost");
    let _ = fs::remove_dir_all(&folder);
    let sets = Sets::new(&folder)?;
    let batch = |set: &Path, output: &str, words: &[&str]| run_batch(&program, set, &folder.join(output), words);
    let (small, large) = (sets.of(100)?, sets.of(1000)?);
    let hundred = batch(&small, "hundred", &ONE_THREAD)?;
    let one = batch(&large, "one", &ONE_THREAD)?;
    let two = batch(&large, "two", &TWO_THREADS)?;
    // Copies of a trial in one file are compressed to almost nothing, which other trials are not.
    batch(&small, "apart", &["--jobs", "1", "--part", "1"])?;
    let (per_trial_s, per_trial_bytes) =
        (one.processor_s / 1000.0, size(&files_in(&folder.join("apart"))?) as f64 / 100.0);
    println!("processor time   {:.1} ms per trial of {DURATION_S} s (1,000 trials, one thread)", 1e3 * per_trial_s);
    println!("two threads      {:.2} times as many trials per second as one thread", one.wall_s / two.wall_s);
    println!("peak memory      {:.0} MB with 100 trials, {:.0} MB with 1,000", hundred.peak_mb, one.peak_mb);
    println!(
        "written          {per_trial_bytes:.0} bytes per trial in files of its own; less where several trials share \
         them"
    );
    for hours in HOURS {
        let trials = hours * 3600.0 / DURATION_S;
        println!(
            "{hours:>4} h of motion  {:.1} core-hours, {:.1} GB, if all of it costs as much per second as these trials",
            trials * per_trial_s / 3600.0,
            trials * per_trial_bytes / 1e9
        );
    }
    if files_in(&folder.join("two"))? != files_in(&folder.join("one"))? {
        return Err("two threads wrote other bytes than one".to_owned());
    }
    if with_kills {
        println!("{}", killed(&program, &sets, &folder)?);
    }
    fs::remove_dir_all(&folder).map_err(|e| format!("{}: cannot be removed: {e}", folder.display()))
}

/// Folders with copies of the recording.
struct Sets {
    folder: PathBuf,
    recording: PathBuf,
    standing: PathBuf,
}

impl Sets {
    fn new(folder: &Path) -> Result<Sets, String> {
        fs::create_dir_all(folder).map_err(|e| format!("{}: cannot be created: {e}", folder.display()))?;
        let copy = |from: &str, to: &str| {
            let (from, to) = (workspace::data().join(from), folder.join(to));
            fs::copy(&from, &to).map_err(|e| format!("{}: cannot be copied: {e}", from.display()))?;
            Ok::<_, String>(to)
        };
        let (recording, standing) = (copy(RECORDING, "walk.c3d")?, copy(STANDING, "standing.c3d")?);
        Ok(Sets { folder: folder.to_owned(), recording, standing })
    }

    /// A folder with this many trials and the standing trial. The copies are links, which take no room on the disk.
    fn of(&self, trials: usize) -> Result<PathBuf, String> {
        let set = self.folder.join(format!("set-{trials}"));
        let cannot = |e: std::io::Error| format!("{}: cannot be filled: {e}", set.display());
        fs::create_dir_all(&set).map_err(cannot)?;
        fs::hard_link(&self.standing, set.join("standing.c3d")).map_err(cannot)?;
        for trial in 0..trials {
            fs::hard_link(&self.recording, set.join(format!("walk-{trial:05}.c3d"))).map_err(cannot)?;
        }
        Ok(set)
    }
}

fn batch(program: &Path, set: &Path, output: &Path, words: &[&str]) -> Command {
    let mut command = Command::new(program);
    command.arg("batch").arg(set).arg("-o").arg(output).args(["--quiet", "--resume"]).args(words).args(WINDOW);
    command.stdout(Stdio::null());
    command
}

/// Runs a batch to its end.
fn run_batch(program: &Path, set: &Path, output: &Path, words: &[&str]) -> Result<Cost, String> {
    run_to_end(batch(program, set, output, words))
}

/// Runs a command to its end and returns what it took.
pub(crate) fn run_to_end(mut command: Command) -> Result<Cost, String> {
    let (begun, before_s) = (Instant::now(), children_s()?);
    let mut child = command.spawn().map_err(|e| format!("ambulo: cannot start: {e}"))?;
    let mut peak_mb = 0.0;
    let status = loop {
        let status = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        let peak =
            status.lines().find_map(|line| line.strip_prefix("VmHWM:")?.trim().strip_suffix("kB")?.trim().parse().ok());
        peak_mb = peak.map_or(peak_mb, |kb: f64| kb / 1024.0);
        match child.try_wait().map_err(|e| format!("ambulo: {e}"))? {
            Some(status) => break status,
            None => sleep(Duration::from_millis(20)),
        }
    };
    if !status.success() {
        return Err(format!("`ambulo` ended with {status}"));
    }
    Ok(Cost { processor_s: children_s()? - before_s, wall_s: begun.elapsed().as_secs_f64(), peak_mb })
}

/// Processor time of all children that have ended [s]: fields 16 and 17 of `/proc/self/stat` (`man proc_pid_stat`).
fn children_s() -> Result<f64, String> {
    let text = fs::read_to_string("/proc/self/stat")
        .map_err(|e| format!("/proc/self/stat: cannot be read: {e}; this command needs Linux"))?;
    // The second field is a name in brackets, which may have blanks.
    let rest = text.rsplit_once(')').map_or("", |(_, rest)| rest);
    let ticks: f64 = rest.split_whitespace().skip(13).take(2).filter_map(|field| field.parse::<f64>().ok()).sum();
    Ok(ticks * TICK_S)
}

/// Ten kills at random times, then a run to the end; the bytes are compared with those of an unbroken run.
fn killed(program: &Path, sets: &Sets, folder: &Path) -> Result<String, String> {
    let set = sets.of(KILLED_TRIALS)?;
    let whole = run_batch(program, &set, &folder.join("whole"), &TWO_THREADS)?;
    let mut interrupted = 0;
    for random in seeded().take(KILLS) {
        let mut child = batch(program, &set, &folder.join("killed"), &TWO_THREADS)
            .spawn()
            .map_err(|e| format!("ambulo: cannot start: {e}"))?;
        // Long enough to read the set and to close a part, too short for all trials in ten runs.
        sleep(Duration::from_secs_f64(whole.wall_s * (0.05 + 0.1 * random)));
        interrupted += usize::from(child.try_wait().is_ok_and(|ended| ended.is_none()));
        let _ = child.kill();
        let _ = child.wait();
    }
    run_batch(program, &set, &folder.join("killed"), &TWO_THREADS)?;
    if files_in(&folder.join("killed"))? != files_in(&folder.join("whole"))? {
        return Err("a batch that was killed and continued has other bytes than one without interruption".to_owned());
    }
    Ok(format!(
        "kills            {KILLED_TRIALS} trials, {interrupted} of {KILLS} runs killed before their end: the same \
         bytes as without interruption"
    ))
}

/// The files of a batch by name.
pub(crate) fn files_in(folder: &Path) -> Result<BTreeMap<PathBuf, Vec<u8>>, String> {
    let mut files = BTreeMap::new();
    for table in ["trials", "frames", "cycles", "events"] {
        let cannot = |e: std::io::Error| format!("{}: cannot be read: {e}", folder.join(table).display());
        for entry in fs::read_dir(folder.join(table)).map_err(cannot)? {
            let name = Path::new(table).join(entry.map_err(cannot)?.file_name());
            files.insert(name.clone(), fs::read(folder.join(&name)).map_err(cannot)?);
        }
    }
    Ok(files)
}

fn size(files: &BTreeMap<PathBuf, Vec<u8>>) -> usize {
    files.values().map(Vec::len).sum()
}
