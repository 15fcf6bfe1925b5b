//! Processor time of the `ambulo` command against an earlier revision, and the time until it starts:
//! `cargo xtask command-cost`.
//!
//! Both programs are optimised in full, and run in turn on the same recordings in the same minute, so that the state of
//! the machine counts for both. Time is that in user mode of all threads, of [`RUNS`] runs together. The earlier
//! revision wrote its page in every run.

use crate::build_time::children_cpu_s;
use crate::sweep::optimised_program;
use crate::workspace::{self, Revision};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// The revision that the project's goals are given against.
const BASELINE: &str = "dbe756e";
/// Runs of each program on each recording, after one that is not counted.
const RUNS: usize = 40;
/// Starts of a program that does nothing.
const STARTS: usize = 400;
/// Goals: share of the earlier time without the page and with it, on each recording; start beyond a program that does
/// nothing [ms].
const GAIT2392: (f64, f64) = (0.3, 0.4);
const LABORATORY: (f64, f64) = (0.5, 0.5);
const START_MS: f64 = 1.0;

/// A recording with the words that compute its forces.
struct Case {
    name: &'static str,
    words: Vec<PathBuf>,
    goals: (f64, f64),
}

/// Prints the table.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let revision = match words {
        [] => BASELINE,
        [option, revision] if option == "--baseline" => revision,
        _ => return Err("usage: cargo xtask command-cost [--baseline REV]".to_owned()),
    };
    let ours = optimised_program()?;
    let theirs = baseline_program(revision)?;
    let folder = std::env::temp_dir().join(format!("ambulo-command-cost-{}", std::process::id()));
    let measured = cases()?.iter().try_for_each(|case| compare(case, &ours, &theirs, revision, &folder));
    // A temporary folder that cannot be removed does no harm.
    let _ = fs::remove_dir_all(&folder);
    measured?;
    let (own, nothing) = (start_ms(&ours, &["--version"])?, start_ms(Path::new("/bin/true"), &[])?);
    let beyond = own - nothing;
    println!(
        "start of `ambulo --version`: {own:.2} ms, /bin/true {nothing:.2} ms, beyond it {beyond:.2} ms, asked at most \
         {START_MS}: {}",
        verdict(beyond, START_MS)
    );
    Ok(())
}

fn verdict(value: f64, limit: f64) -> &'static str {
    if value <= limit { "met" } else { "missed" }
}

/// Builds the command of an earlier revision.
fn baseline_program(revision: &str) -> Result<PathBuf, String> {
    let source = Revision::unpack(revision)?;
    let target = workspace::target().join("command-cost");
    let mut build = workspace::cargo();
    build.current_dir(source.folder()).env("CARGO_TARGET_DIR", &target).env_remove("RUSTFLAGS");
    let done = build.args(["build", "--quiet", "--release", "--locked", "--bin", "ambulo"]).status();
    let status = done.map_err(|e| format!("cargo: cannot start: {e}"))?;
    if !status.success() {
        return Err(format!("revision {revision} did not build ({status}), see above"));
    }
    Ok(target.join("release").join(format!("ambulo{}", std::env::consts::EXE_SUFFIX)))
}

fn cases() -> Result<[Case; 2], String> {
    let data = workspace::data().join("data");
    let (gait, laboratory) = (data.join("opensim-gait2392-subject01"), data.join("biomechzoo-HC032A"));
    for folder in [&gait, &laboratory] {
        if !folder.is_dir() {
            return Err(format!("{}: missing; see AMBULO_DATA in `cargo xtask help`", folder.display()));
        }
    }
    let of_gait =
        ["subject01_walk1_ik.mot", "subject01_simbody.osim", "subject01_walk1_grf.mot", "subject01_walk1_grf.xml"];
    let [motion, model, forces, loads] = of_gait.map(|name| gait.join(name));
    let option = PathBuf::from;
    Ok([
        Case {
            name: "Gait2392",
            words: vec![motion, option("--model"), model, option("--grf"), forces, option("--loads"), loads],
            goals: GAIT2392,
        },
        Case {
            name: "HC032A03 with its static",
            words: vec![
                laboratory.join("HC032A03.c3d"),
                option("--static"),
                laboratory.join("HC032A01.c3d"),
                option("--mass"),
                option("60"),
            ],
            goals: LABORATORY,
        },
    ])
}

#[expect(clippy::print_stdout, reason = "rows of the table")]
fn compare(case: &Case, ours: &Path, theirs: &Path, revision: &str, folder: &Path) -> Result<(), String> {
    let forces = |program: &Path, more: &[&str]| {
        let _ = fs::remove_dir_all(folder);
        let mut command = Command::new(program);
        command
            .arg("forces")
            .args(&case.words)
            .arg("-o")
            .arg(folder)
            .args(more)
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        let before = children_cpu_s();
        let done = command.status().map_err(|e| format!("{}: cannot start: {e}", program.display()))?;
        // 1 is a verdict, not an error.
        if !matches!(done.code(), Some(0 | 1)) {
            return Err(format!("{} on {}: {done}", program.display(), case.name));
        }
        let spent = children_cpu_s().zip(before).map(|(after, before)| after[0] - before[0]);
        spent.ok_or_else(|| "this system has no /proc/self/stat".to_owned())
    };
    let without_page = ["--keep", "tables,summary"];
    let mut sums = [0.0; 3];
    for run in 0..=RUNS {
        let times = [forces(theirs, &[])?, forces(ours, &without_page)?, forces(ours, &[])?];
        if run > 0 {
            sums.iter_mut().zip(times).for_each(|(sum, time)| *sum += time);
        }
    }
    let [before, without, with] = sums.map(|sum| 1e3 * sum / RUNS as f64);
    println!("{}: revision {revision} {before:.1} ms of processor time in user mode", case.name);
    for (what, time, goal) in [("without the page", without, case.goals.0), ("with the page", with, case.goals.1)] {
        println!(
            "  {what}: {time:.1} ms, {:.2} of that, asked at most {goal}: {}",
            time / before,
            verdict(time / before, goal)
        );
    }
    Ok(())
}

/// Median of the time from start to end of a program [ms].
fn start_ms(program: &Path, words: &[&str]) -> Result<f64, String> {
    let mut times = Vec::with_capacity(STARTS);
    for _ in 0..STARTS {
        let begin = Instant::now();
        let done = Command::new(program).args(words).stdout(Stdio::null()).status();
        done.map_err(|e| format!("{}: cannot start: {e}", program.display()))?;
        times.push(1e3 * begin.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    Ok(times[STARTS / 2])
}
