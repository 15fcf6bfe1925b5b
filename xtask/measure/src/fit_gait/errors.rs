//! How far laws are from the mean curves.

use crate::harmonics::{harmonics, value_slope_curvature};
use crate::normative::{Curves, SPEEDS};
use ambulo::gait::{CyclicCurve, Jet, SpeedRange};

/// Error of one curve at one speed.
#[derive(Debug, Clone, Copy)]
pub(crate) struct CurveError {
    /// Of the angle against the table [deg]: root mean square, and the largest.
    pub(crate) rms_deg: f64,
    pub(crate) largest_deg: f64,
    /// Of the second derivative against that of the first twelve harmonics, relative to its own root mean square.
    pub(crate) acceleration: f64,
}

/// A curve against the table at the speed with number i.
pub(crate) fn of(curve: &CyclicCurve, range: &SpeedRange, curves: &Curves, i: usize) -> CurveError {
    let speed = range.held(Jet::constant(SPEEDS[i]));
    let samples = &curves[i][..curves[i].len() - 1];
    let reference = harmonics(&curves[i]);
    let (mut square, mut largest, mut missed, mut total) = (0.0, 0.0_f64, 0.0, 0.0);
    for (k, sample) in samples.iter().enumerate() {
        let phase = k as f64 / samples.len() as f64;
        let found = curve.at(Jet::new(phase, 1.0, 0.0), speed);
        let error = found.value.to_degrees() - sample;
        square += error * error;
        largest = largest.max(error.abs());
    }
    for k in 0..FINE {
        let phase = k as f64 / FINE as f64;
        let [_, _, expected] = value_slope_curvature(&reference, phase);
        missed += (curve.at(Jet::new(phase, 1.0, 0.0), speed).acceleration.to_degrees() - expected).powi(2);
        total += expected * expected;
    }
    CurveError {
        rms_deg: (square / samples.len() as f64).sqrt(),
        largest_deg: largest,
        acceleration: f64::sqrt(missed / total),
    }
}

/// Samples of a cycle on which accelerations are compared.
const FINE: usize = 400;
