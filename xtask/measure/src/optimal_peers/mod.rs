//! Optimal motion compared with other solvers on the same problem: `cargo xtask optimal-peers [--env DIR] [--resume]`,
//! `.. --write`.
//!
//! We solve the problem of [`walker`]. Then programs of the peers' scripts read it and our solution:
//! `optimal_casadi.py` checks the solution and solves the same transcription with CasADi and IPOPT, `optimal_moco.py`
//! solves the problem with OpenSim Moco; both start from the same first guess, then from our solution. A run takes half
//! an hour to an hour, so the outcomes are recorded ([`OUTCOMES`]), and `--write` makes the page
//! docs/measured/OPTIMAL_PEERS.md from the record. `--resume` keeps results that an earlier run left in
//! target/peers/optimal for the same problem.

mod page;
mod walker;

use crate::workspace;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use walker::{ACCURACY, Solved, Walker};

/// Outcomes of the last complete run.
const OUTCOMES: &str = "xtask/measure/peers/optimal_outcomes.json";
/// The exported problem, and the peers' results.
const RESULTS: &str = "target/peers/optimal";
/// Our solver runs this often; the median time counts.
const RUNS: usize = 7;
/// Moco's mesh intervals, its limit of CPU time [s], and its tolerances of convergence and constraints.
const MESH: usize = 50;
const LIMIT_S: usize = 1200;
const MOCO_TOLERANCE: f64 = 1e-4;
const STARTS: [&str; 2] = ["cold", "warm"];

struct Settings {
    env: Option<PathBuf>,
    resume: bool,
    write: bool,
}

/// Runs the command.
#[expect(clippy::print_stdout, reason = "the page is the command's result")]
pub(crate) fn run(words: &[String]) -> Result<(), String> {
    let settings = Settings::parse(words)?;
    if !settings.write {
        let outcomes = measure(&settings)?;
        workspace::save(OUTCOMES, &format!("{outcomes:#}\n"))?;
    }
    let page = page::text(&workspace::recorded(OUTCOMES)?)?;
    println!("{page}");
    if settings.write {
        workspace::save("docs/measured/OPTIMAL_PEERS.md", &page)?;
    }
    Ok(())
}

impl Settings {
    fn parse(words: &[String]) -> Result<Settings, String> {
        let mut settings = Settings { env: workspace::peers_env(), resume: false, write: false };
        let mut words = words.iter();
        while let Some(word) = words.next() {
            match word.as_str() {
                "--write" => settings.write = true,
                "--resume" => settings.resume = true,
                "--env" => settings.env = Some(words.next().ok_or("--env needs a folder")?.into()),
                other => return Err(format!("unknown option `{other}`, expected --write, --resume or --env DIR")),
            }
        }
        Ok(settings)
    }

    /// A peer's program in its environment, about to read the problem.
    fn program(&self, package: &str, script: &str) -> Result<Command, String> {
        let mut command = workspace::peer_program(self.env.as_deref(), package, script)?;
        command.arg(file("problem"));
        Ok(command)
    }
}

/// A file of the run.
fn file(name: &str) -> PathBuf {
    workspace::root().join(RESULTS).join(name).with_extension("json")
}

/// Solves the problem with all solvers.
fn measure(settings: &Settings) -> Result<Value, String> {
    let walker = Walker::new()?;
    let mut runs = (0..RUNS).map(|_| walker.solve()).collect::<Result<Vec<Solved>, String>>()?;
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    let ours = &runs[RUNS / 2];
    let exported = walker.json(ours)?.to_string();
    if fs::read_to_string(file("problem")).is_ok_and(|known| known != exported) || !settings.resume {
        for name in ["casadi", "moco-cold", "moco-warm"] {
            // It need not exist.
            let _ = fs::remove_file(file(name));
        }
    }
    workspace::save(&format!("{RESULTS}/problem.json"), &exported)?;
    let casadi = result("casadi", || {
        let mut command = settings.program("casadi", "optimal_casadi.py")?;
        command.arg(file("casadi")).arg(ACCURACY.to_string());
        Ok(command)
    })?;
    let [cold, warm] = STARTS.map(|start| {
        let name = format!("moco-{start}");
        result(&name, || {
            let mut command = settings.program("opensim", "optimal_moco.py")?;
            command.arg(file(&name)).arg(start);
            command.args([MESH.to_string(), LIMIT_S.to_string(), MOCO_TOLERANCE.to_string()]);
            Ok(command)
        })
    });
    Ok(json!({
        "machine": crate::bench::machine(),
        "commit": workspace::commit(),
        "walker": walker.described(),
        "ours": ours_json(ours)?,
        "casadi": casadi,
        "moco": { "cold": cold?, "warm": warm?, "mesh": MESH, "limit_s": LIMIT_S },
    }))
}

fn ours_json(ours: &Solved) -> Result<Value, String> {
    let last = ours.solution.progress.last().ok_or("no progress")?;
    let between = ours.solution.root_forces(10).map_err(|e| e.to_string())?;
    Ok(json!({
        "seconds": ours.seconds, "objective": ours.objective, "steps": ours.steps, "newton_steps": last.steps,
        "root": last.root.1, "root_between": { "rms": between.0, "largest": between.1 },
    }))
}

/// The result of a peer: that of an earlier run if it is still there; otherwise its program runs now.
fn result(name: &str, command: impl FnOnce() -> Result<Command, String>) -> Result<Value, String> {
    let path = file(name);
    let mut ended = String::new();
    if !path.is_file() {
        let log = path.with_extension("log");
        let out = fs::File::create(&log).map_err(|e| format!("{}: cannot write: {e}", log.display()))?;
        let status = command()?.stdout(out).status().map_err(|e| format!("{name}: cannot start: {e}"))?;
        ended = format!("{status}, see {}", shown(&log));
    }
    match fs::read_to_string(&path) {
        Ok(text) => serde_json::from_str(&text).map_err(|e| format!("{}: {e}", path.display())),
        // Ended by the limit of its time, or refused.
        Err(_) => Ok(json!({ "failed": ended })),
    }
}

fn shown(path: &Path) -> String {
    path.strip_prefix(workspace::root()).unwrap_or(path).display().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_page_is_that_of_the_recorded_outcomes() {
        let page = fs::read_to_string(workspace::root().join("docs/measured/OPTIMAL_PEERS.md")).unwrap();
        let (_, written) = page.split_once("\n\n").unwrap();
        let rendered = page::text(&workspace::recorded(OUTCOMES).unwrap()).unwrap();
        assert!(written == rendered, "hint: run `cargo xtask measured OPTIMAL_PEERS`");
    }

    #[test]
    fn options_are_read() {
        let parse = |words: &[&str]| Settings::parse(&words.iter().map(|&w| w.to_owned()).collect::<Vec<_>>());
        let settings = parse(&["--env", "there", "--resume"]).unwrap();
        assert_eq!((settings.env, settings.resume, settings.write), (Some("there".into()), true, false));
        assert!(parse(&["--quick"]).is_err() && parse(&["--env"]).is_err());
        let nowhere = Settings { env: Some("/nowhere".into()), resume: false, write: false };
        assert!(nowhere.program("casadi", "x.py").unwrap_err().contains("README"));
    }

    #[test]
    fn our_solution_has_no_force_at_the_root_and_is_the_exported_one() {
        let walker = Walker::new().unwrap();
        let solved = walker.solve().unwrap();
        let last = solved.solution.progress.last().unwrap();
        assert!(last.root.1 <= ACCURACY, "{last:?}");
        let exported = walker.json(&solved).unwrap();
        assert_eq!(exported["solution"].as_array().unwrap().len(), solved.solution.unknowns().len());
        assert!((exported["objective"].as_f64().unwrap() - solved.objective).abs() < 1e-12);
    }
}
