//! Automation of the workspace: `cargo xtask <command>`.
//!
//! This crate has no dependencies, so its commands start at once. Commands that need the library are in the crate
//! `xtask-measure`, which is built with optimisation and started from here.

mod baseline;
mod batch_cost;
mod build_time;
mod check;
mod command_cost;
mod dist;
#[cfg(test)]
mod documents;
mod house;
mod keypoint_cost;
mod measured;
mod mutants;
mod python;
mod same_bytes;
mod stream_cost;
mod sweep;
mod web;
mod workspace;

use std::process::ExitCode;

const HELP: &str = "\
usage: cargo xtask <command>

  check             run what CI runs: format, lints, house, tests, documentation, viewer, in lanes side by side, up to the first failure;
                    prints the time of each step and the slowest tests  [--full: and everything that takes longer]
                    [--shuffle SEED: only the tests, in an order that the seed decides]
  house             print size and shape of the source; fails where it exceeds a limit  [--baseline REV] [--list]
                    [--wrap: break comments and texts over 120 columns first]
  build-time        time a cold release build of the `ambulo` command  [--baseline REV]
  measured          write the generated pages of docs/measured/  [PAGE..] [--check: list pages that are out of date]
  mutants           run mutants of the science and write docs/measured/MUTANTS.md  [MODULE..] [--sample N] [--seed S]
                    [--resume: those not yet run] [--retry: survivors again] [--page: only the page]
  python            make a wheel of the Python package from the module that `cargo test` has compiled, and test it in a bare environment
                    [--profile NAME: the module of another profile] [--with PROGRAM: in an environment of another Python] [--measure: build the wheel for users with maturin and
                    print its size by part and crate, and its times] [--free-threaded: compile the module for free-threaded Python]
  web               build the page that computes in the browser and the documents into target/page
                    [--test: and test them in Chromium, and in Firefox if it is there]
                    [--site: with the API documentation and the gallery, all links walked]
                    [--documents: only documents and gallery, into target/documents, all links walked]
                    [--family: solve the walks between which its sliders interpolate: web/family/walks.json]
  dist              build the archives of a release into target/archives, with checksums and the list of components, and try them
                    [--target TARGET].. [--runner PROGRAM: starts programs of another machine] [--tag TAG: must be the version]
  sweep             run the `ambulo` command on all examples and recordings, and kill it while it writes
  same-bytes        compare every byte that two versions of the `ambulo` command write, on every verb and kind of file  OLD NEW
                    [--only CASE].. [--jobs N] [--keep: keep the folders]
  command-cost      processor time of `ambulo forces` against an earlier revision, and the time until the command starts  [--baseline REV]
  keypoint-cost     measure processor time and memory per frame of `ambulo forces` on keypoints of video, and an hour of them  [PROGRAM]
  batch-cost        measure processor time, memory and bytes per trial of `ambulo batch`, and print what 70 h and 288 h of motion cost
                    [--kills: and compute 10,000 trials with ten kills] [--baseline REV: ratios to another revision]
  stream-cost       measure latency, processor time and memory of `ambulo stream` from end to end, in real time  [--seconds S]
                    [--hours H: and the memory over so many hours of motion, as fast as they are taken] [--baseline REV]
  bench             time inverse dynamics, synthetic walks, the stages of the main job and the `ambulo` command; writes target/bench.csv
                    [--baseline REV: ratios to another revision, measured in the same run]
  bench-markers     time marker fitting and compare it with OpenSim's  [--write: docs/measured/BENCHMARKS_MARKERS.md]
                    [--recordings [NAME]: instead fit the clean recordings frame by frame and all frames together]
                    [--baseline REV]
  bench-simulation  time and check forward simulation, ours and others'  [--write: docs/measured/BENCHMARKS.md] [--without-peers]
                    [--baseline REV]
  peers             time other engines on the same model and motion  [--env DIR] [--scripts DIR]
  simulators        time and check other engines in forward simulation  [--env DIR] [--data DIR] [--golden FILE] ..
  oracle-c3d        compare our C3D reader with ezc3d on every file below a folder  [FOLDER] [--env DIR]
  claim-shares      sample the values that the 1997 paper does not give, and count how often its claims hold
                    [--settings N] [--seed S] [--threads T] [--log FILE: resumed]
                    [--write: crates/ambulo-paper/data/shares.csv]
  reproduction      recompute the 1997 paper and print its claims  [--write: docs/measured/REPRODUCTION.md]
  figures           draw docs/images/ again with the `ambulo` command and a headless Chromium
  fit-gait          fit the laws of joints and ground forces against speed to normative curves; prints their errors
  fit-ground        fit the parameters of the ground-force estimator, leave people and laboratories out
                    [--keep: errors for the gate of the next version] [--write: docs/measured/GROUND_FIT.md]
                    [--evaluations N] [--seed N] [--pull X]
  keypoints         forces from keypoints of video, and from keypoints made from recordings with markers  [--only NAME] [--seed S]
  normative-bands   write the normative bands of page and figures from the tables next to the workspace
  twins             judge recordings, and altered copies of them: faults of laboratories, motions that no person could make, plates
                    that were taken away  [--only NAME] [--fault NAME] [--write: docs/measured/TWINS.md]
  validate          compare predicted ground forces with force plates for all recordings  [--write: docs/measured/VALIDATION.md]
  validate-people   the same by kind of person and laboratory, each predicted without the own laboratory  [--write: docs/measured/PEOPLE.md]
  walk-plans        solve the walks of the built-in figures: crates/ambulo-walk/data/walks
  optimal-peers     solve one problem of optimal motion with our solver, CasADi and Moco, and record the outcomes
                    [--env DIR] [--resume: keep results of peers]  [--write: docs/measured/OPTIMAL_PEERS.md from the record]
  optimal-walk      compare optimal walks in three dimensions with healthy people  [--write: docs/measured/OPTIMAL_WALK.md]
  physical-peers    let the controller of a walk drive the figure in MuJoCo, and record the outcomes  [--env DIR]
                    [--write: docs/measured/PHYSICAL_PEERS.md from the record]
  physical-walk     figures that walk by their own torques: pushes, uneven ground  [--write: docs/measured/PHYSICAL_WALK.md]
  standing          figures that stop, stand, step when they are pushed, and walk off  [--write: docs/measured/STANDING.md]
  walk-bands        compare dynamically consistent walks with normative bands  [--write: docs/measured/WALK_BANDS.md and its picture]
  help              print this text

environment:
  AMBULO_DATA       folder with `data` and `reference`; default: ../shared next to this workspace
  AMBULO_PEERS_ENV  folder of the other engines' virtual environments; see `cargo xtask peers`
";

/// Commands of this crate; the documents are compared with this list.
#[cfg(test)]
const OWN: [&str; 14] = [
    "check",
    "house",
    "build-time",
    "measured",
    "mutants",
    "python",
    "web",
    "dist",
    "sweep",
    "same-bytes",
    "command-cost",
    "batch-cost",
    "keypoint-cost",
    "stream-cost",
];

/// Commands of the crate `xtask-measure`.
const MEASUREMENTS: [&str; 23] = [
    "bench",
    "bench-markers",
    "bench-simulation",
    "peers",
    "simulators",
    "oracle-c3d",
    "claim-shares",
    "reproduction",
    "figures",
    "fit-gait",
    "fit-ground",
    "keypoints",
    "normative-bands",
    "twins",
    "validate",
    "validate-people",
    "optimal-peers",
    "optimal-walk",
    "physical-peers",
    "physical-walk",
    "standing",
    "walk-plans",
    "walk-bands",
];

/// Exit code for a command line that is not understood.
const MISUSED: u8 = 2;

#[expect(clippy::print_stdout, clippy::print_stderr, reason = "help and errors of the automation go to the terminal")]
fn main() -> ExitCode {
    if let Some(code) = check::in_place_of_compiler() {
        return code;
    }
    let words: Vec<String> = std::env::args().skip(1).collect();
    let (command, rest) = words.split_first().map_or(("help", &[][..]), |(first, rest)| (first.as_str(), rest));
    let done = match (command, rest) {
        _ if baseline::is_asked(&words) => baseline::run(&words),
        ("check", _) => check::run(rest),
        ("build-time", _) => build_time::run(rest),
        ("measured", _) => measured::run(rest),
        ("mutants", _) => mutants::run(rest),
        ("python", _) => python::run(rest),
        ("web", _) => web::run(rest),
        ("dist", _) => dist::run(rest),
        ("sweep", []) => sweep::run(),
        ("same-bytes", _) => same_bytes::run(rest),
        ("command-cost", _) => command_cost::run(rest),
        ("batch-cost", _) => batch_cost::run(rest),
        ("keypoint-cost", _) => keypoint_cost::run(rest),
        ("stream-cost", _) => stream_cost::run(rest),
        ("house", _) => house::run(rest),
        (command, _) if MEASUREMENTS.contains(&command) => measure(&words),
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

/// Builds `xtask-measure` with optimisation and runs one of its commands. A page that it writes gets its first line.
fn measure(words: &[String]) -> Result<(), String> {
    let mut command = workspace::cargo();
    command.args(["run", "--quiet", "--profile", workspace::OPTIMISED, "--locked", "--package", "xtask-measure", "--"]);
    command.args(words);
    let status = command.status().map_err(|e| format!("cargo: cannot start: {e}"))?;
    // A page is written even if what it reports misses a requirement.
    if words.iter().any(|word| word == "--write") {
        measured::stamp(&words[0])?;
    }
    if status.success() { Ok(()) } else { Err(format!("`{}` failed ({status}), see above", words.join(" "))) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn help_lists_every_command() {
        let listed = |name: &&str| HELP.contains(&format!("\n  {name} "));
        assert_eq!(OWN.iter().chain(&MEASUREMENTS).find(|name| !listed(name)), None);
    }
}
