//! What CI runs, up to the first failure: `cargo xtask check`; with `--full` everything that takes longer, too; with
//! `--shuffle SEED` only the tests, in another order.
//!
//! The steps are plain commands of cargo (in the profile `ci`), of this program and, in `viewer/`, of npm, so you can
//! repeat a failed step alone. They run in lanes, side by side ([`steps`]). A step whose program or target is not
//! installed is skipped with a message; where `CI` is set, that is a failure.

mod children;
mod compiler;
mod lanes;
mod programs;
mod shuffled;
mod steps;

use crate::workspace;
use lanes::{Lanes, Row, seconds};
use std::fs;
use std::time::Instant;
use steps::{LANES, LONG, Step, TEST_PROGRAMS, TESTS};

/// Tests in the list at the end.
const SLOWEST: usize = 10;

pub(crate) use compiler::in_place_of_compiler;

/// Runs the steps. The error names the step that failed and what to do.
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    match words[..] {
        [] => check(false),
        ["--full"] => check(true),
        ["--shuffle", seed] => shuffle(seed),
        _ => Err("usage: cargo xtask check [--full | --shuffle SEED]".to_owned()),
    }
}

#[expect(clippy::print_stdout, reason = "the steps and their times are the command's result")]
fn check(full: bool) -> Result<(), String> {
    let start = Instant::now();
    let long: &[Step] = if full { &LONG } else { &[] };
    if std::env::var_os("CI").is_some() {
        all_present(LANES.iter().copied().flatten().chain(long))?;
    }
    let lanes = Lanes::new();
    lanes.run(&LANES)?;
    lanes.run(&[long])?;
    let rows = &lanes.progress().rows;
    print!("{}", table(rows));
    print!("{}", slowest());
    println!("all steps passed or were skipped in {:.1} s", start.elapsed().as_secs_f64());
    Ok(())
}

/// Compiles the test programs and runs their tests in an order that the seed decides.
fn shuffle(seed: &str) -> Result<(), String> {
    let seed = seed.parse().map_err(|_| format!("found the seed `{seed}`; expected a whole number, 0 or more"))?;
    let compile: Vec<&Step> = LANES.iter().copied().flatten().filter(|step| step.name == TEST_PROGRAMS).collect();
    Lanes::new().run(&compile.into_iter().map(std::slice::from_ref).collect::<Vec<_>>())?;
    shuffled::run(seed)
}

/// Times of the steps.
fn table(rows: &[Row]) -> String {
    let line = |name: &str, wall: &str, cpu: &str| format!("{name:<26} {wall:>9} {cpu:>9}\n");
    let of = |row: &Row| line(row.name, &seconds(Some(row.wall_s)), &seconds(row.cpu_s));
    let sum = rows.iter().map(|row| row.cpu_s).sum::<Option<f64>>();
    format!(
        "\n{}{}{}",
        line("step", "wall [s]", "CPU [s]"),
        rows.iter().map(of).collect::<String>(),
        line("sum", "", &seconds(sum))
    )
}

/// The slowest tests and their times, which are longer where other steps ran at the same time.
fn slowest() -> String {
    let output = fs::read(lanes::log_of(TESTS)).unwrap_or_default();
    let rows = programs::slowest(&String::from_utf8_lossy(&output), SLOWEST);
    let rows: String = rows.iter().map(|(seconds, test)| format!("{seconds:>8.1} {test}\n")).collect();
    format!("\n wall [s] the {SLOWEST} slowest tests\n{rows}\n")
}

/// An error if CI would skip a step or the tests that need recordings.
fn all_present<'a>(steps: impl Iterator<Item = &'a Step>) -> Result<(), String> {
    if let Some(lacking) = steps.filter_map(|step| step.tool.lacking()).next() {
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
