//! The dominant muscle group by net joint moment, and whether it shortens or lengthens.
//!
//! Only net moments are known: if both groups act at once (co-contraction), each has a larger moment, and the moments
//! of ligaments and joint stops are included.

use super::mode::Run;
use super::steady::{STEADY_CYCLES, Steady};
use ambulo_body::numerics::mean;

/// Parts of the gait cycle: name, begin and end [share of the cycle] (Perry's phases; unverified page).
pub const PHASES: [(&str, f64, f64); 7] = [
    ("loading response", 0.0, 0.12),
    ("mid stance", 0.12, 0.31),
    ("terminal stance", 0.31, 0.50),
    ("pre-swing", 0.50, 0.62),
    ("initial swing", 0.62, 0.75),
    ("mid swing", 0.75, 0.87),
    ("terminal swing", 0.87, 1.0),
];
/// Joint, coordinate, and the groups with positive and negative moment.
pub(super) const GROUPS: [(&str, &str, [&str; 2]); 3] = [
    ("hip", "hip_flexion_r", ["flexors", "extensors"]),
    ("knee", "knee_angle_r", ["extensors", "flexors"]),
    ("ankle", "ankle_angle_r", ["dorsiflexors", "plantarflexors"]),
];
/// A mean power below this counts as isometric [W/kg].
const NEITHER_W_KG: f64 = 0.02;

/// One joint in one part of the cycle; right leg, mean over the steady cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MuscleRow {
    /// The joint.
    pub joint: &'static str,
    /// The part of the cycle.
    pub phase: &'static str,
    /// The dominant muscle group.
    pub group: &'static str,
    /// `concentric` (it shortens and generates energy), `eccentric` (it lengthens and absorbs energy), or `isometric`.
    pub action: &'static str,
    /// Share of the part of the cycle in which this group dominates.
    pub share: f64,
    /// Mean moment, with the sign of the model's coordinate [N.m/kg].
    pub moment_nm_kg: f64,
    /// Mean power [W/kg].
    pub power_w_kg: f64,
    /// Work over the part of the cycle, without impacts [J/kg].
    pub work_j_kg: f64,
}

/// All joints in all parts of the cycle.
#[must_use]
pub fn muscle_table(run: &Run) -> Vec<MuscleRow> {
    let Ok(steady) = Steady::of(run) else { return Vec::new() };
    let grid = run.recording.grid();
    let mass = run.recording.model.mass();
    let mut rows = Vec::new();
    for (joint, coordinate, groups) in GROUPS {
        let Some(id) = run.recording.coordinate(coordinate) else { continue };
        let (moments, rates) = (&run.recording.efforts[id.index()], run.recording.trajectory.rates(id));
        for (phase, from, to) in PHASES {
            let inside = |row: &usize| {
                let at = (grid.time(*row) / run.cycle_s + 1e-9).fract();
                (from..to).contains(&at)
            };
            let within: Vec<usize> = steady.rows().filter(inside).collect();
            let moment: Vec<f64> = within.iter().map(|row| moments[*row] / mass).collect();
            let power: Vec<f64> = within.iter().map(|row| moments[*row] * rates[*row] / mass).collect();
            let (moment_nm_kg, power_w_kg) = (mean(&moment), mean(&power));
            let positive = moment_nm_kg >= 0.0;
            let with = moment.iter().filter(|m| (**m >= 0.0) == positive).count();
            rows.push(MuscleRow {
                joint,
                phase,
                group: groups[usize::from(!positive)],
                action: action(power_w_kg),
                share: with as f64 / moment.len().max(1) as f64,
                moment_nm_kg,
                power_w_kg,
                work_j_kg: power.iter().sum::<f64>() * grid.step_s / STEADY_CYCLES as f64,
            });
        }
    }
    rows
}

fn action(power_w_kg: f64) -> &'static str {
    if power_w_kg > NEITHER_W_KG {
        "concentric"
    } else if power_w_kg < -NEITHER_W_KG {
        "eccentric"
    } else {
        "isometric"
    }
}
