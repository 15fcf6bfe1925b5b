//! Laws of a joint's knots: found on each mean curve, fitted against speed.
//!
//! First, the time of each knot is located on every curve, and a quadratic of dimensionless speed is fitted to it.
//! Angle, slope and curvature are then read from the curves at the times of that law, not at the located times, and
//! fitted as well. An error of the time law therefore has little effect, because the knot is still on the curve.

use super::polynomial;
use super::recipe::{Mark, Recipe, Wanted};
use crate::harmonics::{harmonics, value_slope_curvature};
use crate::normative::{Curves, SPEEDS};
use ambulo::numerics::Harmonics;

/// Steps of a search over a whole cycle.
const STEPS_PER_PERCENT: usize = 20;

/// A knot's laws: coefficients of dimensionless speed.
pub(crate) struct KnotLaws {
    pub(crate) name: &'static str,
    pub(crate) begins: &'static str,
    pub(crate) height_share: f64,
    /// Percent of the cycle.
    pub(crate) at: Vec<f64>,
    /// Degrees, degrees a cycle, degrees a cycle².
    pub(crate) ends: [Vec<f64>; 3],
}

/// A joint's knots as laws of a degree, from the speeds with these numbers.
pub(crate) fn laws(recipe: &Recipe, curves: &Curves, used: &[usize], degree: usize) -> Vec<KnotLaws> {
    let speeds: Vec<f64> = used.iter().map(|i| SPEEDS[*i]).collect();
    let waves: Vec<Harmonics> = used.iter().map(|i| harmonics(&curves[*i])).collect();
    let mut times: Vec<Vec<f64>> = vec![Vec::new(); recipe.knots.len()];
    for (k, wanted) in recipe.knots.iter().enumerate() {
        if !matches!(wanted.mark, Mark::Between(..)) {
            let found: Vec<f64> = waves.iter().map(|curve| search(curve, wanted.mark)).collect();
            times[k] = polynomial::fit(&speeds, &found, degree);
        }
    }
    for (k, wanted) in recipe.knots.iter().enumerate() {
        if let Mark::Between(a, b, share) = wanted.mark {
            times[k] = times[a].iter().zip(&times[b]).map(|(a, b)| a + share * (b - a)).collect();
        }
    }
    recipe.knots.iter().zip(times).map(|(wanted, at)| on_curves(wanted, at, &speeds, &waves, degree)).collect()
}

fn on_curves(wanted: &Wanted, at: Vec<f64>, speeds: &[f64], curves: &[Harmonics], degree: usize) -> KnotLaws {
    let read: Vec<[f64; 3]> = speeds
        .iter()
        .zip(curves)
        .map(|(speed, curve)| value_slope_curvature(curve, polynomial::at(&at, *speed) / 100.0))
        .collect();
    let ends = [0, 1, 2].map(|i| {
        let column: Vec<f64> = read.iter().map(|ends| ends[i]).collect();
        polynomial::fit(speeds, &column, degree)
    });
    let Wanted { name, begins, height_share, .. } = *wanted;
    KnotLaws { name, begins, height_share, at, ends }
}

/// Percent of the cycle at which a mark is.
fn search(curve: &Harmonics, mark: Mark) -> f64 {
    let best = |low: f64, high: f64, rated: fn([f64; 3]) -> f64| {
        let count = ((high - low) * STEPS_PER_PERCENT as f64) as usize;
        let percents = (0..=count).map(|i| low + i as f64 / STEPS_PER_PERCENT as f64);
        let rating = |percent: f64| rated(value_slope_curvature(curve, percent / 100.0));
        percents.max_by(|a, b| rating(*a).total_cmp(&rating(*b))).unwrap_or(low)
    };
    match mark {
        Mark::Highest(low, high) => best(low, high, |[angle, ..]| angle),
        Mark::Lowest(low, high) => best(low, high, |[angle, ..]| -angle),
        Mark::Rising(low, high) => best(low, high, |[_, slope, _]| slope),
        Mark::Falling(low, high) => best(low, high, |[_, slope, _]| -slope),
        // Between is resolved from its neighbours.
        Mark::Contact | Mark::Between(..) => 0.0,
    }
}
