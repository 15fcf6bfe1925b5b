//! Solved walks of the built-in figures: `cargo xtask walk-plans` writes crates/ambulo/data/walks.

use crate::workspace;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo::optimal::{OptimalWalk, SPATIAL_STAGES, WalkPlan};
use std::fs;

const GAITS: [&str; 3] = ["slow", "free", "fast"];

#[expect(clippy::print_stderr, reason = "the command says what it wrote")]
pub(crate) fn run() -> Result<(), String> {
    for table in SegmentTable::ALL {
        let build = Build::usual(table);
        let leg_length = build.human().map_err(|e| e.to_string())?.dimensions.leg_length;
        for name in GAITS {
            let gait = Gait::named(name).map_err(|e| e.to_string())?;
            let walk = Walk::new(&gait, leg_length, &mut Findings::default()).map_err(|e| e.to_string())?;
            let found = OptimalWalk::find_with(&build, &walk, &SPATIAL_STAGES, None).map_err(|e| e.to_string())?;
            let path = workspace::root().join(format!("crates/ambulo/data/walks/{}-{name}.toml", table.name()));
            fs::write(&path, WalkPlan::new(found.human.build, &walk, &found.solution).to_toml())
                .map_err(|e| format!("{}: cannot write: {e}", path.display()))?;
            eprintln!(
                "written: {}  root {:.1e}",
                path.display(),
                found.solution.progress.last().map_or(f64::NAN, |p| p.root.1)
            );
        }
    }
    Ok(())
}
