//! Automation of the workspace: `cargo xtask <command>`. Each command is a file of this folder.

mod bench;
mod check;
mod figures;
mod fit_gait;
mod fit_ground;
mod harmonics;
mod normative;
mod normative_bands;
mod npz;
mod oracle_c3d;
mod peers;
mod simulators;
mod table;
mod validate;
mod walk_bands;
mod workspace;

use std::process::ExitCode;

const HELP: &str = "\
usage: cargo xtask <command>

  check             what CI runs: format, lints, tests, documentation, the viewer, its pages in a browser; stops at the first failure
  bench             time inverse dynamics, synthetic walks, the stages of the main job and the `ambulo` command; writes target/bench.csv
  bench-markers     time marker fitting and compare it, ours and OpenSim's  [--write: docs/BENCHMARKS_MARKERS.md]
  bench-simulation  time and check forward simulation, ours and others'  [--write: docs/BENCHMARKS.md] [--without-peers]
  peers             time other engines on the same model and motion  [--env DIR] [--scripts DIR]
  simulators        time and check other engines in forward simulation  [--env DIR] [--data DIR] [--golden FILE] ..
  oracle-c3d        compare our C3D reader with ezc3d on every file below a folder  [FOLDER] [--env DIR]
  figures           draw docs/images/ anew with the `ambulo` command and a headless Chromium
  fit-gait          fit the laws of joints and ground forces against speed anew from normative curves; prints their errors
  fit-ground        fit the numbers of the ground-force estimator anew, each subject left out in turn  [--write: docs/GROUND_FIT.md]
                    [--evaluations N] [--seed N] [--pull X]
  normative-bands   write the normative bands of page and figures anew, from the tables beside the workspace
  validate          judge predicted ground forces against plates of all recordings  [--write: docs/VALIDATION.md]
  walk-bands        judge corrected walks against normative bands  [--write: docs/WALK_BANDS.md and its picture]
  help              this text

environment:
  AMBULO_DATA       folder that holds `data` and `reference`; without it ../shared beside this workspace
  AMBULO_PEERS_ENV  folder of the other engines' virtual environments; see `cargo xtask peers`
";

/// The command line could not be understood.
const MISUSED: u8 = 2;

#[expect(clippy::print_stdout, clippy::print_stderr, reason = "the shell of the automation: help and errors")]
fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (command, rest) = words.split_first().map_or(("help", &[][..]), |(first, rest)| (first.as_str(), rest));
    let done = match (command, rest) {
        ("peers", _) => peers::run(rest),
        ("simulators", _) => simulators::command(rest),
        ("oracle-c3d", _) => oracle_c3d::run(rest),
        ("check", []) => check::run(),
        ("bench", []) => bench::run(),
        ("bench-markers", _) => bench::markers::run(rest),
        ("bench-simulation", _) => bench::simulation::run(rest),
        ("figures", []) => figures::run(),
        ("fit-gait", []) => fit_gait::run(),
        ("normative-bands", []) => normative_bands::run(),
        ("fit-ground", _) => fit_ground::run(rest),
        ("validate", _) => validate::run(rest),
        ("walk-bands", _) => walk_bands::run(rest),
        ("help" | "--help" | "-h", []) => {
            print!("{HELP}");
            Ok(())
        }
        _ => {
            eprint!("error: unknown command `{}`\n\n{HELP}", words.join(" "));
            return ExitCode::from(MISUSED);
        }
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            eprintln!("error: {message}");
            ExitCode::FAILURE
        }
    }
}
