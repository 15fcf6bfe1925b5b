//! Mean and standard deviation over cycles.
//!
//!   x̄(t) = Σ x_k(t) / n        s(t)² = Σ (x_k(t) - x̄(t))² / (n - 1)
//!
//! with x_k(t) the curve of cycle k at t per cent of the cycle, and n cycles.

use super::{CycleForces, SessionCycle, depends_on_forces};
use crate::model::Side;
use crate::numerics::rms;

/// Mean and standard deviation of curves of the same length.
#[derive(Debug, Clone, PartialEq)]
pub struct CurveStatistics {
    /// Mean at each sample.
    pub mean: Vec<f64>,
    /// Standard deviation at each sample; `None` for a single curve.
    pub sd: Option<Vec<f64>>,
    /// Number of curves.
    pub count: usize,
}

impl CurveStatistics {
    /// Statistics of at least one curve; `None` without any, or of curves of different lengths.
    #[must_use]
    pub fn of(curves: &[&[f64]]) -> Option<CurveStatistics> {
        let length = curves.first()?.len();
        if curves.iter().any(|curve| curve.len() != length) {
            return None;
        }
        let count = curves.len();
        let mean: Vec<f64> =
            (0..length).map(|i| curves.iter().map(|curve| curve[i]).sum::<f64>() / count as f64).collect();
        let deviation = |i: usize| {
            let squares: f64 = curves.iter().map(|curve| (curve[i] - mean[i]).powi(2)).sum();
            (squares / (count - 1) as f64).sqrt()
        };
        let sd = (count > 1).then(|| (0..length).map(deviation).collect());
        Some(CurveStatistics { mean, sd, count })
    }

    /// Standard deviation over the whole cycle: the root mean square over the standard deviations of the samples.
    #[must_use]
    pub fn spread(&self) -> Option<f64> {
        self.sd.as_deref().map(rms)
    }
}

/// A quantity over the cycles of one side.
#[derive(Debug, Clone, PartialEq)]
pub struct PooledCurve {
    /// Mean and standard deviation.
    pub statistics: CurveStatistics,
    /// The source of the forces of these cycles; `None` for angles.
    pub forces: Option<CycleForces>,
}

/// Mean and standard deviation of a quantity over the cycles of a side that are not excluded. A quantity that depends
/// on forces uses cycles with measured forces, or, without such cycles, cycles with predicted forces. `None` without
/// cycles.
#[must_use]
pub fn pooled(cycles: &[SessionCycle], quantity: &str, side: Side) -> Option<PooledCurve> {
    let of_side = || {
        let own = cycles.iter().filter(|cycle| cycle.side == side && cycle.excluded.is_none());
        own.filter_map(|cycle| Some((cycle.forces, cycle.curves.get(quantity)?.as_slice())))
    };
    if !depends_on_forces(quantity) {
        let all: Vec<&[f64]> = of_side().map(|(_, curve)| curve).collect();
        return Some(PooledCurve { statistics: CurveStatistics::of(&all)?, forces: None });
    }
    let of_source = |source: CycleForces| {
        let own: Vec<&[f64]> = of_side().filter(|(forces, _)| *forces == source).map(|(_, curve)| curve).collect();
        Some(PooledCurve { statistics: CurveStatistics::of(&own)?, forces: Some(source) })
    };
    of_source(CycleForces::Measured).or_else(|| of_source(CycleForces::Predicted))
}

/// Root mean square difference of the mean curves of both sides, in the unit of the quantity; `None` unless both sides
/// have cycles with forces from the same source.
#[must_use]
pub fn side_difference(right: Option<&PooledCurve>, left: Option<&PooledCurve>) -> Option<f64> {
    let (right, left) = right.zip(left).filter(|(right, left)| right.forces == left.forces)?;
    Some(rms_difference(&right.statistics.mean, &left.statistics.mean))
}

/// Root mean square difference.
pub(super) fn rms_difference(a: &[f64], b: &[f64]) -> f64 {
    rms(&a.iter().zip(b).map(|(a, b)| a - b).collect::<Vec<_>>())
}
