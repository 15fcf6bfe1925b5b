//! Commands of `cargo xtask` that need the library: benchmarks, validations and fits. Each command is a file of this
//! folder.

#![allow(clippy::disallowed_methods, reason = "measurements are made on one machine")]

mod bench;
mod claim_shares;
mod figures;
mod fit_gait;
mod fit_ground;
mod harmonics;
mod keypoints;
mod normative;
mod normative_bands;
mod optimal_peers;
mod optimal_walk;
mod oracle_c3d;
mod peers;
mod physical_peers;
mod physical_walk;
mod reproduction;
mod simulators;
mod twins;
mod validate;
mod validate_people;
mod walk_bands;
mod walk_plans;
mod workspace;

use std::process::ExitCode;

/// Exit code for a command line that is not understood.
const MISUSED: u8 = 2;

#[expect(clippy::print_stderr, reason = "errors of the automation go to the terminal")]
fn main() -> ExitCode {
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (command, rest) = words.split_first().map_or(("", &[][..]), |(first, rest)| (first.as_str(), rest));
    let done = match (command, rest) {
        ("peers", _) => peers::run(rest),
        ("simulators", _) => simulators::command(rest),
        ("oracle-c3d", _) => oracle_c3d::run(rest),
        ("bench", []) => bench::run(),
        ("bench-markers", _) => bench::markers::run(rest),
        ("bench-simulation", _) => bench::simulation::run(rest),
        ("claim-shares", _) => claim_shares::run(rest),
        ("reproduction", _) => reproduction::run(rest),
        ("figures", []) => figures::run(),
        ("fit-gait", []) => fit_gait::run(),
        ("keypoints", _) => keypoints::run(rest),
        ("normative-bands", []) => normative_bands::run(),
        ("fit-ground", _) => fit_ground::run(rest),
        ("twins", _) => twins::run(rest),
        ("validate", _) => validate::run(rest),
        ("validate-people", _) => validate_people::run(rest),
        ("walk-bands", _) => walk_bands::run(rest),
        ("walk-plans", []) => walk_plans::run(),
        ("optimal-peers", _) => optimal_peers::run(rest),
        ("optimal-walk", _) => optimal_walk::run(rest),
        ("physical-peers", _) => physical_peers::run(rest),
        ("physical-walk", _) => physical_walk::run(rest),
        ("standing", _) => physical_walk::run_standing(rest),
        _ => {
            eprintln!("error: unknown command `{}`\nhint: `cargo xtask help` lists the commands", words.join(" "));
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
