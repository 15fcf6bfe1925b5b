//! Torque curves of a walk as a few harmonics ([`TorqueSeries`]), for example as a feedforward for a controller.
//!
//! Coefficients are sums over the rows of the steady cycles, without impacts.

use super::mode::Run;
use super::steady::Steady;
use ambulo_walk::walking::TorqueSeries;

/// Hips, knees and ankles, right and left.
#[must_use]
pub fn torque_series(run: &Run) -> Vec<TorqueSeries> {
    let names = ["hip_flexion", "knee_angle", "ankle_angle"];
    let both = names.iter().flat_map(|name| [format!("{name}_r"), format!("{name}_l")]);
    let Ok(steady) = Steady::of(run) else { return Vec::new() };
    both.map(|coordinate| series(&steady, coordinate)).collect()
}

fn series(steady: &Steady<'_>, coordinate: String) -> TorqueSeries {
    let (effort, grid, cycle_s) = (steady.effort(&coordinate), steady.run.recording.grid(), steady.run.cycle_s);
    let rows = steady.rows();
    let phases: Vec<f64> = rows.clone().map(|row| grid.time(row) / cycle_s).collect();
    let body_kg = steady.run.recording.model.mass();
    TorqueSeries::of(&coordinate, [cycle_s, body_kg], &phases, &effort[rows])
}
