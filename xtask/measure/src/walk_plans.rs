//! Solved walks of the built-in figures: `cargo xtask walk-plans` writes crates/ambulo-walk/data/walks.

use crate::workspace;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::optimal::{NO_ROOT_FORCE, OptimalWalk, SPATIAL_STAGES, WalkPlan};
use std::fs;

const GAITS: [&str; 3] = ["free", "slow", "fast"];

#[expect(clippy::print_stderr, reason = "the command says what it wrote")]
pub(crate) fn run() -> Result<(), String> {
    let mut known: Vec<OptimalWalk> = Vec::new();
    for table in SegmentTable::ALL {
        let build = Build::usual(table);
        let leg_length = build.human().map_err(|e| e.to_string())?.dimensions.leg_length;
        for name in GAITS {
            let gait = Gait::named(name).map_err(|e| e.to_string())?;
            let walk = Walk::new(&gait, leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
            let found = best(&build, &walk, &known)?;
            let path = workspace::root().join(format!("crates/ambulo-walk/data/walks/{}-{name}.toml", table.name()));
            fs::write(&path, WalkPlan::new(found.human.build, &walk, &found.solution).to_toml())
                .map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
            eprintln!(
                "written: {}  root {:.1e}  cost {:.1}",
                path.display(),
                found.solution.progress.last().map_or(f64::NAN, |p| p.root.1),
                cost(&found)
            );
            known.push(found);
        }
    }
    Ok(())
}

/// The walk of lowest cost: from the laws, or from a known walk of any figure and speed.
fn best(build: &Build, walk: &Walk, known: &[OptimalWalk]) -> Result<OptimalWalk, String> {
    let mut best = OptimalWalk::find_with(build, walk, &SPATIAL_STAGES).map_err(|e| e.to_string())?;
    for similar in known {
        let solution = best.problem.solve_near(&similar.problem, similar.solution.unknowns());
        let other = OptimalWalk { solution: solution.map_err(|e| e.to_string())?, ..best.clone() };
        if other.solution.unbalanced(NO_ROOT_FORCE).is_none() && cost(&other) < cost(&best) {
            best = other;
        }
    }
    Ok(best)
}

/// The objective, without forces at the root.
fn cost(of: &OptimalWalk) -> f64 {
    of.problem.problem.costs(of.solution.unknowns()).iter().map(|(_, cost)| cost).sum()
}
