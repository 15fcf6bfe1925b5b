//! Time of a cold release build of the `ambulo` command: `cargo xtask build-time [--baseline REV]`.
//!
//! Builds into an empty temporary folder, dependencies included, with their sources downloaded before. CPU time is that
//! of cargo and all its compilers, so it can be compared on a machine that does other work as well; wall time cannot.

use crate::workspace::{self, Revision};
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Unit of the times in `/proc` [1/s]; Linux has used this value on every common machine for twenty years.
const TICKS_PER_SECOND: f64 = 100.0;

/// Duration of a build.
#[derive(Debug, Clone, Copy)]
struct Cost {
    wall_s: f64,
    /// None where the system has no `/proc`.
    cpu_s: Option<f64>,
}

/// Builds the tree, and a revision before it, and prints times and ratio.
#[expect(clippy::print_stdout, reason = "the table is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let baseline = match words {
        [] => None,
        [option, revision] if option == "--baseline" => Some(revision),
        _ => return Err("usage: cargo xtask build-time [--baseline REV]".to_owned()),
    };
    println!("{:<24} {:>9} {:>9}", "cold release build", "wall [s]", "CPU [s]");
    let before = match baseline {
        Some(name) => Some(show(name, build(Revision::unpack(name)?.folder())?)),
        None => None,
    };
    let now = show("this tree", build(&workspace::root())?);
    if let Some(before) = before {
        let cpu = now.cpu_s.zip(before.cpu_s).map(|(now, before)| now / before);
        println!("{:<24} {:>9.2} {:>9}", "ratio", now.wall_s / before.wall_s, decimals(cpu, 2));
    }
    Ok(())
}

#[expect(clippy::print_stdout, reason = "a row of the table")]
fn show(name: &str, cost: Cost) -> Cost {
    println!("{name:<24} {:>9.1} {:>9}", cost.wall_s, decimals(cost.cpu_s, 1));
    cost
}

fn decimals(value: Option<f64>, decimals: usize) -> String {
    value.map_or_else(|| "-".to_owned(), |value| format!("{value:.decimals$}"))
}

/// Builds the command of the workspace in `folder` into an empty folder.
fn build(folder: &Path) -> Result<Cost, String> {
    let target = std::env::temp_dir().join(format!("ambulo-build-{}", std::process::id()));
    let cargo = |arguments: &[&str]| {
        let mut command = workspace::cargo();
        command.current_dir(folder).args(arguments).env("CARGO_TARGET_DIR", &target).env_remove("RUSTFLAGS");
        finish(command)
    };
    cargo(&["fetch", "--quiet", "--locked"])?;
    let (start, cpu_before) = (Instant::now(), children_cpu_s());
    let built = cargo(&["build", "--quiet", "--release", "--locked", "--bin", "ambulo"]);
    let spent = |after: [f64; 2], before: [f64; 2]| after[0] + after[1] - before[0] - before[1];
    let cpu_s = children_cpu_s().zip(cpu_before).map(|(after, before)| spent(after, before));
    let cost = Cost { wall_s: start.elapsed().as_secs_f64(), cpu_s };
    fs::remove_dir_all(&target).map_err(|e| format!("{}: cannot remove: {e}", target.display()))?;
    built.map(|()| cost)
}

fn finish(mut command: Command) -> Result<(), String> {
    let status = command.status().map_err(|e| format!("cargo: cannot start: {e}"))?;
    if status.success() { Ok(()) } else { Err(format!("cargo failed ({status}), see above")) }
}

/// CPU time of all children that have ended, and of theirs, in user mode and in the system [s].
pub(crate) fn children_cpu_s() -> Option<[f64; 2]> {
    let ticks = children_ticks(&fs::read_to_string("/proc/self/stat").ok()?)?;
    Some(ticks.map(|ticks| ticks / TICKS_PER_SECOND))
}

/// User and system time of the children from a line of `/proc/self/stat`; the second field, a name, may contain blanks.
fn children_ticks(stat: &str) -> Option<[f64; 2]> {
    const USER: usize = 13;
    let after_name: Vec<&str> = stat.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks = |field: usize| after_name.get(field)?.parse::<f64>().ok();
    Some([ticks(USER)?, ticks(USER + 1)?])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_children_s_time_is_read_behind_the_name() {
        let stat = "77 (a (b) c) S 1 2 3 4 5 6 7 8 9 10 11 12 130 40 17 18";
        assert_eq!(children_ticks(stat), Some([130.0, 40.0]));
        assert_eq!(children_ticks("77 (short) S 1"), None);
    }
}
