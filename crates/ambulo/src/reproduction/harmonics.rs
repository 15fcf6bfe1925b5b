//! Torque curves as a few harmonics, for example as a feedforward for a controller.
//!
//!   τ(t) = mean + Σ_k (cosine_k cos(2π k t/T) + sine_k sin(2π k t/T))          t from the nominal foot strike of the right foot
//!
//! Coefficients are sums over the rows of the steady cycles, without impacts.

use super::mode::Run;
use super::steady::{Steady, mean};
use std::f64::consts::TAU;

/// Number of harmonics.
pub const HARMONICS: usize = 6;

/// The torque of one coordinate over a cycle.
#[derive(Debug, Clone, PartialEq)]
pub struct TorqueSeries {
    /// The coordinate of the model, which also gives the sign.
    pub coordinate: String,
    /// Duration of the cycle [s].
    pub cycle_s: f64,
    /// [N.m].
    pub mean: f64,
    /// First to last harmonic [N.m].
    pub cosine: [f64; HARMONICS],
    /// First to last harmonic [N.m].
    pub sine: [f64; HARMONICS],
    /// Share of the variance that mean and harmonics represent.
    pub r_squared: f64,
}

impl TorqueSeries {
    /// The torque at a share of the cycle [N.m].
    #[must_use]
    pub fn at(&self, phase: f64) -> f64 {
        let wave = |k: usize| {
            let (sin, cos) = (TAU * (k + 1) as f64 * phase).sin_cos();
            self.cosine[k] * cos + self.sine[k] * sin
        };
        self.mean + (0..HARMONICS).map(wave).sum::<f64>()
    }
}

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
