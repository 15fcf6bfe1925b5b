//! The first twelve harmonics of a mean curve.
//!
//! Mean curves sampled at 2 % are smooth up to about the twelfth harmonic (literature.md 1.3); above, a second
//! derivative is noise. Values at 0 % and 100 % differ by up to 0.5° in the tables, which average the ends of all
//! cycles; the straight line between both ends is subtracted first, so that the curve does not jump.

use crate::normative::SAMPLES;
use ambulo::numerics::Harmonics;
use std::f64::consts::TAU;

/// Harmonics kept.
const ORDERS: usize = 12;

/// The harmonics of samples at 0 % to 100 %.
pub(crate) fn harmonics(samples: &[f64]) -> Harmonics {
    let count = SAMPLES - 1;
    let drift = samples[count] - samples[0];
    let phases: Vec<f64> = (0..count).map(|i| i as f64 / count as f64).collect();
    let level: Vec<f64> = phases.iter().zip(samples).map(|(phase, x)| x - drift * (phase - 0.5)).collect();
    Harmonics::of(&phases, &level, ORDERS)
}

/// Value, slope and curvature at a phase [cycles].
pub(crate) fn value_slope_curvature(curve: &Harmonics, phase: f64) -> [f64; 3] {
    let slope = slope(curve);
    [curve.at(phase), slope.at(phase), self::slope(&slope).at(phase)]
}

/// The derivative of a curve, per cycle.
fn slope(curve: &Harmonics) -> Harmonics {
    let times_order =
        |factors: &[f64], sign: f64| (1..).zip(factors).map(|(k, x)| sign * TAU * f64::from(k) * x).collect();
    Harmonics { mean: 0.0, cosine: times_order(&curve.sine, 1.0), sine: times_order(&curve.cosine, -1.0) }
}
