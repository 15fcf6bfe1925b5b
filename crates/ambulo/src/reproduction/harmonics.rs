//! Torque curves of a walk as a few harmonics ([`TorqueSeries`]), for example as a feedforward for a controller.
//!
//! Coefficients are sums over the rows of the steady cycles, without impacts.

use super::mode::Run;
use super::steady::{Steady, mean};
use crate::simulation::walking::TorqueSeries;
use std::f64::consts::TAU;

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
    let torque = &effort[rows];
    let along = |f: fn(f64) -> f64| {
        std::array::from_fn(|k| {
            let terms = torque.iter().zip(&phases).map(|(tau, phase)| tau * f(TAU * (k + 1) as f64 * phase));
            2.0 * terms.sum::<f64>() / torque.len() as f64
        })
    };
    let mut found = TorqueSeries {
        coordinate,
        cycle_s,
        body_kg: steady.run.recording.model.mass(),
        mean: mean(torque),
        cosine: along(f64::cos),
        sine: along(f64::sin),
        r_squared: 0.0,
    };
    let squares = |of: &dyn Fn(usize) -> f64| (0..torque.len()).map(|k| of(k) * of(k)).sum::<f64>();
    let (left, all) = (squares(&|k| torque[k] - found.at(phases[k])), squares(&|k| torque[k] - found.mean));
    found.r_squared = if all > 0.0 { 1.0 - left / all } else { 1.0 };
    found
}
