//! The unknown curves: how far each component of each stance departs from what is expected of it.
//!
//!   f(t) = μ(t) + s(t) Σ_k z_k B((t - t_k) / h) / β       z_k of unit deviation, independent
//!
//! with μ and s of [`super::expected`], B the cubic B-spline, h the least time in which the curve may deviate, and β² = Σ B² on average,
//! so that f has the deviation s. All z are numbered by the time of their knot, so that what is far apart in time is far apart in number
//! and the equations form a band.

use super::expected::Component;
use super::stances::{Measure, Stance};
use super::weights::Weights;

/// β: root of the mean over one interval of Σ B², 151/315.
const UNIT: f64 = 0.692_358_7;

/// One component of one stance: cubic B-splines on uniform knots from strike to off.
#[derive(Debug, Clone)]
pub(super) struct Curve {
    start_s: f64,
    spacing_s: f64,
    /// Numbers of its unknowns in the whole system.
    pub(super) numbers: Vec<usize>,
}

/// Four splines that are not zero at an instant: the first one's index, and their values divided by β.
pub(super) type Active = (usize, [f64; 4]);

impl Curve {
    /// What counts at an instant inside the stance.
    pub(super) fn active(&self, time: f64) -> Active {
        let intervals = self.numbers.len() - 3;
        let place = ((time - self.start_s) / self.spacing_s).clamp(0.0, intervals as f64);
        let first = (place as usize).min(intervals - 1);
        let u = place - first as f64;
        let v = 1.0 - u;
        let values = [
            v * v * v / 6.0,
            (4.0 - 6.0 * u * u + 3.0 * u * u * u) / 6.0,
            (4.0 - 6.0 * v * v + 3.0 * v * v * v) / 6.0,
            u * u * u / 6.0,
        ];
        (first, values.map(|b| b / UNIT))
    }
}

impl Curve {
    /// Lowest and highest number that act between two instants.
    pub(super) fn range(&self, from_s: f64, to_s: f64) -> [usize; 2] {
        [self.numbers[self.active(from_s).0], self.numbers[self.active(to_s).0 + 3]]
    }
}

/// Curves of all components of all stances.
#[derive(Debug, Clone)]
pub(super) struct Unknowns {
    /// One entry a stance, in the order of [`Component::ALL`].
    pub(super) curves: Vec<[Curve; 6]>,
    pub(super) count: usize,
}

impl Unknowns {
    pub(super) fn new(stances: &[Stance], measure: &Measure, weights: &Weights) -> Unknowns {
        let curve = |stance: &Stance, component: Component| {
            let detail = match component {
                Component::Force(axis) => weights.detail[axis],
                Component::Moment(_) => weights.detail[2],
            };
            let duration = stance.duration_s();
            let intervals = (duration / (detail * measure.leg_time_s)).round().max(3.0) as usize;
            Curve { start_s: stance.start_s, spacing_s: duration / intervals as f64, numbers: vec![0; intervals + 3] }
        };
        let mut curves: Vec<[Curve; 6]> =
            stances.iter().map(|stance| Component::ALL.map(|component| curve(stance, component))).collect();
        let mut knots: Vec<(f64, usize, usize, usize)> = Vec::new();
        for (s, of_stance) in curves.iter().enumerate() {
            for (c, curve) in of_stance.iter().enumerate() {
                let time = |k: usize| curve.start_s + curve.spacing_s * (k as f64 - 1.0);
                knots.extend((0..curve.numbers.len()).map(|k| (time(k), s, c, k)));
            }
        }
        knots.sort_by(|a, b| a.0.total_cmp(&b.0));
        for (number, (_, s, c, k)) in knots.iter().enumerate() {
            curves[*s][*c].numbers[*k] = number;
        }
        Unknowns { curves, count: knots.len() }
    }

    /// Most numbers between splines of one curve that act together.
    pub(super) fn widest(&self) -> usize {
        let together = self.curves.iter().flatten().flat_map(|curve| curve.numbers.windows(4));
        together.map(|four| four[3] - four[0]).max().unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splines_sum_to_one_and_have_unit_deviation_on_average() {
        let curve = Curve { start_s: 1.0, spacing_s: 0.1, numbers: (0..9).collect() };
        let mut square = 0.0;
        for i in 0..1000 {
            let (first, values) = curve.active(1.0 + 0.6 * (f64::from(i) + 0.5) / 1000.0);
            assert!(first + 4 <= curve.numbers.len());
            assert!((values.iter().sum::<f64>() * UNIT - 1.0).abs() < 1e-12);
            square += values.iter().map(|b| b * b).sum::<f64>() / 1000.0;
        }
        assert!((square - 1.0).abs() < 1e-3, "{square}");
    }

    #[test]
    fn outside_of_the_stance_the_nearest_splines_are_given() {
        let curve = Curve { start_s: 0.0, spacing_s: 0.1, numbers: (0..6).collect() };
        assert_eq!(curve.active(-1.0).0, 0);
        assert_eq!(curve.active(9.0).0, 2);
    }
}
