//! Solved walks of the built-in figures: `cargo xtask walk-plans` writes crates/ambulo-walk/data/walks.

use crate::workspace;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Speed, Walk};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::optimal::{NO_ROOT_FORCE, OptimalWalk, SPATIAL_STAGES, StandingMovements, WalkPlan};
use std::fs;

const GAITS: [&str; 3] = ["free", "slow", "fast"];

pub(crate) fn run() -> Result<(), String> {
    walks()?;
    movements()
}

#[expect(clippy::print_stderr, reason = "the command says what it wrote")]
fn write(name: &str, plan: &WalkPlan) -> Result<(), String> {
    let path = workspace::root().join(format!("crates/ambulo-walk/data/walks/{name}.toml"));
    fs::write(&path, plan.to_toml()).map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
    eprintln!("written: {}", path.display());
    Ok(())
}

/// Movements between a walk and standing.
fn movements() -> Result<(), String> {
    let table = SegmentTable::DeLevaMale;
    let build = Build::usual(table);
    let human = build.human().map_err(|e| e.to_string())?;
    let mut gait = Gait::named("free").map_err(|e| e.to_string())?;
    gait.pace.speed = Some(Speed::MetersPerSecond(StandingMovements::speed(&human)));
    let walk = Walk::new(&gait, human.dimensions.leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
    let found = OptimalWalk::find(&build, &walk).map_err(|e| e.to_string())?;
    let plans = StandingMovements::plans(&found, &walk).map_err(|e| e.to_string())?;
    ["stop", "start", "steps"]
        .iter()
        .zip(&plans)
        .try_for_each(|(movement, plan)| write(&format!("{}-{movement}", table.name()), plan))
}

#[expect(clippy::print_stderr, reason = "the command says what it found")]
fn walks() -> Result<(), String> {
    let mut known: Vec<OptimalWalk> = Vec::new();
    for table in SegmentTable::ALL {
        let build = Build::usual(table);
        let leg_length = build.human().map_err(|e| e.to_string())?.dimensions.leg_length;
        for name in GAITS {
            let gait = Gait::named(name).map_err(|e| e.to_string())?;
            let walk = Walk::new(&gait, leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
            let found = best(&build, &walk, &known)?;
            write(&format!("{}-{name}", table.name()), &WalkPlan::new(found.human.build, &walk, &found.solution))?;
            eprintln!(
                "root {:.1e}  cost {:.1}",
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
