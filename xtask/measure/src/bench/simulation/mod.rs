//! Forward simulation, timed and checked, ours and others': `cargo xtask bench-simulation [--write] [--without-peers]`.
//!
//! | part       | what                                                                                    |
//! |------------|-----------------------------------------------------------------------------------------|
//! | `scaling`  | chains and random trees of 10 to 10,000 bodies, with and without position projection    |
//! | `ladder`   | ladders of 10 to 1,000 closed loops; one of 1,000 rungs with ever more of them closed   |
//! | `stance`   | the human on 12 spheres: time, forces, what its contacts leave of the laws of contact   |
//! | `accuracy` | energy of a chain without damping, joints of a flailing one                             |
//! | `peers`    | what `cargo xtask simulators` runs, right after ours                                    |
//!
//! The output is the page docs/measured/BENCHMARKS.md; with `--write` it is written there with its pictures. A time
//! above its limit is reported; a wrong result fails the command.

mod accuracy;
mod figure;
mod ladder;
mod markdown;
mod page;
mod requirements;
mod run;
mod scaling;
mod stance;

use super::worlds;
use crate::simulators::{self, PeerTiming};
use crate::workspace;
use ambulo::dynamics::SolverSettings;
use std::fs;

/// Folder of the page, relative to the workspace root.
const DOCS: &str = "docs/measured";
/// The human of the scene, in the peers' data folder.
const HUMAN: &str = "human_contact.xml";

/// Everything measured in one run.
struct Results {
    machine: String,
    scaling: scaling::Scaling,
    ladders: ladder::Ladders,
    /// None without the human's file.
    stance: Option<stance::Standing>,
    accuracy: accuracy::Accuracy,
    peers: Vec<PeerTiming>,
}

/// A way to solve loops and contacts, by name.
struct NamedSolver {
    name: &'static str,
    solver: SolverSettings,
}

/// All methods; the first is the default.
fn methods() -> Vec<NamedSolver> {
    vec![NamedSolver { name: "augmented Lagrangian", solver: SolverSettings::default() }]
}

/// Runs the verb. An error means a wrong answer or a broken file, never a long time.
#[expect(clippy::print_stdout, clippy::print_stderr, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let (mut write, mut with_peers) = (false, true);
    for word in words {
        match word.as_str() {
            "--write" => write = true,
            "--without-peers" => with_peers = false,
            _ => return Err(format!("unknown option `{word}`, expected --write or --without-peers")),
        }
    }
    let results = measure(with_peers)?;
    let requirements = requirements::all(&results);
    let page = page::text(&results, &requirements);
    println!("{page}");
    if write {
        let folder = workspace::root().join(DOCS);
        let save = |name: &str, text: &str| {
            let path = folder.join(name);
            fs::write(&path, text).map_err(|e| format!("{}: cannot write: {e}", path.display()))
        };
        save("../images/simulation_scaling.svg", &figure::scaling(&results)?)?;
        save("../images/simulation_ladder.svg", &figure::ladder(&results)?)?;
        save("BENCHMARKS.md", &page)?;
        eprintln!("written: {}", folder.join("BENCHMARKS.md").display());
    }
    let wrong = requirements.iter().filter(|a| a.wrong()).count();
    if wrong == 0 { Ok(()) } else { Err(format!("{wrong} results are less accurate than required, see the table")) }
}

#[expect(clippy::print_stderr, reason = "minutes pass before the page is complete")]
fn measure(with_peers: bool) -> Result<Results, String> {
    eprintln!("chains and trees");
    let scaling = scaling::measure()?;
    eprintln!("ladders");
    let ladders = ladder::measure(&methods())?;
    eprintln!("human");
    let settings = simulators::Settings::default();
    let stance = match fs::read_to_string(settings.data.join(HUMAN)) {
        Ok(xml) => Some(stance::measure(&worlds::human(&xml)?)?),
        Err(_) => None,
    };
    eprintln!("accuracy");
    let accuracy = accuracy::measure()?;
    let peers = if with_peers { simulators::run(&settings) } else { Vec::new() };
    Ok(Results { machine: super::machine(), scaling, ladders, stance, accuracy, peers })
}
