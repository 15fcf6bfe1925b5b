//! Times inverse dynamics, muscle forces, synthetic walks, predicted ground forces, the stages of an analysis and the
//! `ambulo` command, and measures its memory: `cargo xtask bench`.
//!
//! First, the torques of the reference human are compared with those of another engine, because the time of a wrong
//! result is meaningless. If other engines are installed (see `peers`), they run right after ours, and the ratios are
//! printed: between runs, times of the same program vary by up to 30 %, within a run by a few percent.
//!
//! Times of our own code are CPU time of the thread, as in the peers' programs, so that other work on the machine does
//! not count. The `ambulo` command is measured in wall time. Everything is also written to `target/bench.csv`.

mod fit_methods;
mod gait;
pub(crate) mod human;
pub(crate) mod markers;
mod memory;
mod muscles;
mod prediction;
pub(crate) mod simulation;
pub(crate) mod timing;
mod walk;
pub(crate) mod worlds;

use crate::peers::{self, Outcome, PeerTiming};
use crate::workspace;
use std::fmt::Write as _;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use timing::Timing;

/// Our time over MuJoCo's least calls, at most: one frame at a time, many frames side by side (0.7 us over 3.5 us).
const REQUIRED_OF_MUJOCO: [f64; 2] = [0.43, 0.20];
/// The whole `ambulo forces` command takes at most this long [ms].
const REQUIRED_OF_PROGRAM_MS: f64 = 100.0;
/// Ends of the names of the peers' rows that ours are divided by.
const MUJOCO: &str = "mj_rne and what it needs";
const PINOCCHIO: &str = "rnea";

/// One line of the table.
#[derive(Debug, Clone)]
struct Row {
    quantity: String,
    unit: &'static str,
    timing: Timing,
}

/// Runs everything there is data for. An error means a wrong result or a broken file, never a long time.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run() -> Result<(), String> {
    let (human, walk) = (human::Human::find(), workspace::Walk::find());
    println!("{}", machine());
    // Synthetic walks need no data, nor do forces under them.
    let mut rows = gait::bench()?;
    rows.extend(prediction::bench()?);
    println!();
    match human {
        Some(files) => rows.extend(bench_human(&human::Human::read(&files)?)?),
        None => println!("reference human: skipped: no data"),
    }
    match walk {
        Some(walk) => {
            rows.extend(bench_walk(&walk)?);
            let memory = memory::bench()?;
            print!("\n{}", memory::table(&memory));
            rows.extend(memory);
        }
        None => println!("main job: skipped: no data"),
    }
    rows.extend(muscles::bench()?);
    let path = write_csv(&rows)?;
    println!("\nwritten: {}", path.display());
    Ok(())
}

/// Compares and times the reference human, then the peers.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
fn bench_human(human: &human::Human) -> Result<Vec<Row>, String> {
    let differences = human.check()?;
    println!("largest difference from Pinocchio: {differences}\n");
    let [single, batch] = human.time();
    let row = |what: &str, timing| Row { quantity: format!("inverse dynamics, {what}"), unit: "us/frame", timing };
    let mut rows = vec![row("one frame at a time", single), row("8 frames side by side", batch)];
    print!("{}", table(&rows));
    let scripts = workspace::data().join("reference/peers");
    let peers = peers::measure(&peers::Settings { scripts, ..peers::Settings::default() });
    print!("\n{}", peers::table(&peers));
    let ratios = ratios(&rows, &peers);
    print!("{}", ratios_table(&ratios));
    rows.extend(peers.iter().filter_map(peer_row));
    rows.extend(ratios.into_iter().map(|ratio| ratio.row));
    Ok(rows)
}

/// Times the stages of an analysis, then the command.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
fn bench_walk(walk: &workspace::Walk) -> Result<Vec<Row>, String> {
    let mut rows = walk::stages(walk)?;
    println!("\nmain job, Gait2392 recording");
    print!("{}", table(&rows));
    println!();
    match walk::program(walk) {
        Ok(program) => {
            let met = verdict(program.wall_ms.median, REQUIRED_OF_PROGRAM_MS);
            rows.push(Row { quantity: "ambulo forces, wall time".to_owned(), unit: "ms", timing: program.wall_ms });
            if let Some(peak_mb) = program.peak_mb {
                let timing = Timing::single(peak_mb);
                rows.push(Row { quantity: "ambulo forces, peak memory".to_owned(), unit: "MB", timing });
            }
            let own = rows.iter().position(|r| r.quantity.starts_with("ambulo")).unwrap_or_default();
            print!("{}", table(&rows[own..]));
            println!("required: at most {REQUIRED_OF_PROGRAM_MS} ms: {met}");
        }
        Err(reason) => println!("`ambulo forces` was not timed: {reason}"),
    }
    Ok(rows)
}

/// Our time divided by a peer's, both from this run.
struct Ratio {
    row: Row,
    required: Option<f64>,
}

fn ratios(ours: &[Row], peers: &[PeerTiming]) -> Vec<Ratio> {
    let mut ratios = Vec::new();
    for (peer, required) in [(MUJOCO, Some(REQUIRED_OF_MUJOCO)), (PINOCCHIO, None)] {
        let found = peers.iter().find(|p| p.name.ends_with(peer));
        let Some((name, theirs)) = found.and_then(|p| Some((p.name.as_str(), p.median_us()?))) else { continue };
        for (i, row) in ours.iter().enumerate() {
            let quantity = format!("{} / {name}", row.quantity.trim_start_matches("inverse dynamics, "));
            let row = Row { quantity, unit: "1", timing: Timing::single(row.timing.median / theirs) };
            ratios.push(Ratio { row, required: required.map(|limits| limits[i]) });
        }
    }
    ratios
}

fn ratios_table(ratios: &[Ratio]) -> String {
    if ratios.is_empty() {
        return "no ratio: peers not installed or not running, see the hints above\n".to_owned();
    }
    let mut text = format!("\n{:<62} {:>7}\n", "ours : theirs", "ratio");
    for Ratio { row, required } in ratios {
        let required = required.map(|limit| format!("  required {limit:.2}: {}", verdict(row.timing.median, limit)));
        let _ = writeln!(text, "{:<62} {:7.3}{}", row.quantity, row.timing.median, required.unwrap_or_default());
    }
    text
}

fn verdict(value: f64, limit: f64) -> &'static str {
    if value <= limit { "met" } else { "missed" }
}

fn peer_row(peer: &PeerTiming) -> Option<Row> {
    match peer.outcome {
        Outcome::Measured { median_us } => {
            Some(Row { quantity: peer.name.clone(), unit: "us/frame", timing: Timing::single(median_us) })
        }
        _ => None,
    }
}

/// Processor and compiler: times without them cannot be compared.
pub(crate) fn machine() -> String {
    let processors = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let model = processors.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let model = model.map_or("unknown processor", |(_, name)| name);
    let rustc = std::env::var_os("RUSTC").unwrap_or_else(|| "rustc".into());
    let version =
        Command::new(rustc).arg("--version").output().map(|o| String::from_utf8_lossy(&o.stdout).into_owned());
    let version = version.unwrap_or_else(|_| "unknown rustc".to_owned());
    let profile = if cfg!(debug_assertions) { ", NOT OPTIMISED: use `cargo xtask bench`" } else { "" };
    format!("{model}, {}{profile}", version.trim())
}

fn table(rows: &[Row]) -> String {
    let mut text = format!("{:<40} {:<9}{:>10}{:>10}{:>10}{:>10}\n", "", "unit", "median", "p10", "p90", "min");
    for Row { quantity, unit, timing } in rows {
        let _ = write!(text, "{quantity:<40} {unit:<9}{:10.3}", timing.median);
        for value in timing.spread.iter().flatten() {
            let _ = write!(text, "{value:10.3}");
        }
        text.push('\n');
    }
    text
}

/// Writes `target/bench.csv`; the spread of what was measured once stays empty.
fn write_csv(rows: &[Row]) -> Result<PathBuf, String> {
    let path = workspace::root().join("target/bench.csv");
    let mut text = "quantity,unit,median,p10,p90,min\n".to_owned();
    for Row { quantity, unit, timing } in rows {
        let spread = timing.spread.map_or_else(|| ",,".to_owned(), |[a, b, c]| format!("{a:.6},{b:.6},{c:.6}"));
        let _ = writeln!(text, "\"{quantity}\",{unit},{:.6},{spread}", timing.median);
    }
    let failed = |e: std::io::Error| format!("{}: cannot write: {e}", path.display());
    fs::create_dir_all(workspace::root().join("target")).map_err(failed)?;
    fs::write(&path, text).map_err(failed)?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::peers::Task;

    fn ours() -> Vec<Row> {
        let row = |what: &str, us| Row {
            quantity: format!("inverse dynamics, {what}"),
            unit: "us/frame",
            timing: Timing::single(us),
        };
        vec![row("one", 1.0), row("many", 1.0)]
    }

    fn peer(name: &str, outcome: Outcome) -> PeerTiming {
        PeerTiming { name: name.to_owned(), task: Task::Inverse, outcome }
    }

    #[test]
    fn ratios_are_judged_by_the_limit_of_their_form() {
        let peers = [peer("MuJoCo 4.0.0 mj_rne and what it needs", Outcome::Measured { median_us: 4.0 })];
        let text = ratios_table(&ratios(&ours(), &peers));
        let verdicts: Vec<&str> = text.lines().filter_map(|line| line.rsplit(' ').next()).collect();
        assert!(verdicts.ends_with(&["met", "missed"]), "{text}");
    }

    #[test]
    fn peers_that_did_not_run_give_no_ratio() {
        let peers = [peer("MuJoCo mj_rne and what it needs", Outcome::NotInstalled { hint: "pip".to_owned() })];
        assert!(ratios_table(&ratios(&ours(), &peers)).starts_with("no ratio"));
        assert!(peer_row(&peers[0]).is_none());
    }
}
