//! Represents a periodic curve by its first twelve harmonics.
//!
//! Mean curves sampled at 2 % are smooth up to about the twelfth harmonic (literature.md 1.3); above, a second derivative is
//! noise. Values at 0 % and 100 % differ by up to 0.5° in the tables, which average the ends of all cycles; the straight line
//! between both ends is subtracted first, so that the curve does not jump.

use crate::normative::SAMPLES;
use std::f64::consts::TAU;

/// Harmonics kept.
const ORDERS: usize = 12;

/// Mean and harmonics of a curve.
#[derive(Debug, Clone)]
pub(crate) struct Harmonics {
    pub(crate) mean: f64,
    /// Coefficients of cosine and sine, from the first harmonic.
    pub(crate) factors: Vec<[f64; 2]>,
}

impl Harmonics {
    /// Fits the samples at 0 % to 100 %.
    pub(crate) fn of(samples: &[f64]) -> Harmonics {
        let count = SAMPLES - 1;
        let drift = samples[count] - samples[0];
        let level: Vec<f64> = (0..count).map(|i| samples[i] - drift * (i as f64 / count as f64 - 0.5)).collect();
        let factor = |order: usize| {
            let turn = |i: usize| TAU * (order * i) as f64 / count as f64;
            let sum = |f: fn(f64) -> f64| level.iter().enumerate().map(|(i, y)| y * f(turn(i))).sum::<f64>();
            [f64::cos, f64::sin].map(|f| 2.0 / count as f64 * sum(f))
        };
        Harmonics { mean: level.iter().sum::<f64>() / count as f64, factors: (1..=ORDERS).map(factor).collect() }
    }

    /// Value, slope and curvature at a phase [cycles].
    pub(crate) fn at(&self, phase: f64) -> [f64; 3] {
        let mut sum = [self.mean, 0.0, 0.0];
        for (i, [a, b]) in self.factors.iter().enumerate() {
            let turn = TAU * (i + 1) as f64;
            let (sin, cos) = (turn * phase).sin_cos();
            sum[0] += a * cos + b * sin;
            sum[1] += turn * (b * cos - a * sin);
            sum[2] -= turn * turn * (a * cos + b * sin);
        }
        sum
    }
}
