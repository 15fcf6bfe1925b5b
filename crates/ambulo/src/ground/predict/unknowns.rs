//! The unknown curves: deviation of each component of each stance from its prior.
//!
//!   f(t) = μ(t) + s(t) Σ_k z_k B((t - t_k) / h) / β       z_k independent, mean 0, standard deviation 1
//!
//! with μ and s of [`super::expected`], B the cubic B-spline, h the shortest time in which the curve may deviate, and
//! β² = Σ B² on average, so that f has the standard deviation s. The z are numbered in order of time of their knots, so
//! that the equations form a band.

use super::expected::Component;
use super::fitted_parameters::FittedParameters;
use super::stances::{BodyScale, Stance};
use crate::numerics::Order;

/// β: root of the mean over one interval of Σ B², 151/315.
pub const UNIT: f64 = 0.692_358_7;

/// One component of one stance: cubic B-splines on uniform knots from strike to off.
#[derive(Debug, Clone)]
pub struct Curve {
    /// Time of the first knot [s].
    pub start_s: f64,
    /// Time between knots [s].
    pub spacing_s: f64,
    /// Indices of its unknowns in the whole system.
    pub numbers: Vec<usize>,
}

/// The four splines that are not zero at a time: index of the first one, and their values divided by β.
pub(super) type ActiveSplines = (usize, [f64; 4]);

impl Curve {
    /// The splines with influence at a time inside the stance.
    pub fn active(&self, time: f64) -> ActiveSplines {
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
    /// Lowest and highest index of the unknowns with influence between two times.
    pub(super) fn range(&self, from_s: f64, to_s: f64) -> [usize; 2] {
        [self.numbers[self.active(from_s).0], self.numbers[self.active(to_s).0 + 3]]
    }
}

/// Curves of all components of all stances.
#[derive(Debug, Clone)]
pub(super) struct Unknowns {
    /// One entry per stance, in the order of [`Component::ALL`].
    pub(super) curves: Vec<[Curve; 6]>,
    pub(super) count: usize,
}

impl Unknowns {
    pub(super) fn new(stances: &[Stance], body_scale: &BodyScale, parameters: &FittedParameters) -> Unknowns {
        let curve = |stance: &Stance, component: Component| {
            let detail = match component {
                Component::Force(axis) => parameters.detail[axis],
                Component::Moment(_) => parameters.detail[2],
            };
            let duration = stance.duration_s();
            let intervals = (duration / (detail * body_scale.leg_time_s)).round().max(3.0) as usize;
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
        knots.sort_by_number(|knot| knot.0);
        for (number, (_, s, c, k)) in knots.iter().enumerate() {
            curves[*s][*c].numbers[*k] = number;
        }
        Unknowns { curves, count: knots.len() }
    }

    /// Largest difference of indices between overlapping splines of one curve.
    pub(super) fn widest(&self) -> usize {
        let together = self.curves.iter().flatten().flat_map(|curve| curve.numbers.windows(4));
        together.map(|four| four[3] - four[0]).max().unwrap_or(0)
    }
}
