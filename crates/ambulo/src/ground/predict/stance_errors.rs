//! Repeatable errors of the estimate over a stance, learned from force plates and taken off.
//!
//! The estimate of a stance differs from the force plates in part by chance, in part in the same way in every stance: the prior has the
//! strike of other people, the body's segments are not exactly those of the person. What repeats is a curve over the stance for each
//! component, piecewise linear between [`KNOTS`], by least squares:
//!
//!   e(u) = Σ_k B_k(u) c_k      (Σ_s w_s Σ_i B B' + λ 1) c = Σ_s w_s Σ_i B (measured - estimated)
//!
//! with u the elapsed share of the stance as detected from the motion, w_s equal for stances (of a person) and the diagonal λ a share of the
//! mean of that of the left side. [`StanceErrors::default`] has no error at all.
//!
//! Of an error with standard deviation σ between stances of a person, a share ρ of the variance repeats in the next trial of the person
//! ([`REPEATS`]). Then the best linear estimate of the repeatable part after n trials is the mean curve times [`trusted`], and this share of
//! the variance remains: 1 - ρ × trusted.

use crate::model::Side;
use crate::numerics::BandMatrix;

/// Shares of a stance between which curves are straight lines: closest where forces change fastest.
pub const KNOTS: [f64; 15] = [0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.87, 0.93, 1.0];
/// λ as a share of the mean diagonal.
const RIDGE: f64 = 0.1;
/// ρ: share of the variance of the error of a stance that repeats in other trials of the same person and kind. Of the weights 0.5, 0.7 and 1 of one
/// stance, 0.7 gave the smallest errors of the other stances of two people with five trials or stances of a foot.
pub const REPEATS: f64 = 0.67;

/// Weight of the mean error of a number of trials.
#[must_use]
pub fn trusted(trials: usize) -> f64 {
    let n = trials as f64;
    n * REPEATS / (1.0 + (n - 1.0).max(0.0) * REPEATS)
}

/// A curve over the stance, by its values at [`KNOTS`].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StanceCurve(pub [f64; KNOTS.len()]);

/// One sample of an error: elapsed share of the stance, measured minus estimated value, weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorSample {
    /// Elapsed share of the stance as detected from the motion.
    pub phase: f64,
    /// Measured minus estimated value.
    pub error: f64,
    /// Its weight.
    pub weight: f64,
}

impl StanceCurve {
    /// Zero everywhere.
    pub const NONE: StanceCurve = StanceCurve([0.0; KNOTS.len()]);

    /// Value at an elapsed share of the stance.
    #[must_use]
    pub fn at(&self, phase: f64) -> f64 {
        let (k, share) = place(phase);
        self.0[k] + (self.0[k + 1] - self.0[k]) * share
    }

    /// The curve through samples by least squares; zero where there are none.
    #[must_use]
    pub fn through(samples: &[ErrorSample]) -> StanceCurve {
        let mut matrix = BandMatrix::zeros(KNOTS.len(), 1);
        let mut curve = StanceCurve::default();
        for sample in samples.iter().filter(|sample| sample.error.is_finite()) {
            let (k, share) = place(sample.phase);
            let [before, after] = [1.0 - share, share];
            matrix.add(k, k, sample.weight * before * before);
            matrix.add(k + 1, k + 1, sample.weight * after * after);
            matrix.add(k + 1, k, sample.weight * before * after);
            curve.0[k] += sample.weight * before * sample.error;
            curve.0[k + 1] += sample.weight * after * sample.error;
        }
        let trace: f64 = (0..KNOTS.len()).map(|k| matrix.value(k, k)).sum();
        for k in 0..KNOTS.len() {
            matrix.add(k, k, RIDGE * trace / KNOTS.len() as f64);
        }
        match matrix.factor() {
            Some(factor) => {
                factor.solve(&mut curve.0);
                curve
            }
            // Without samples there is nothing to solve.
            None => StanceCurve::default(),
        }
    }
}

/// Index of the knot before a share of the stance, and the share of the way to the next one.
fn place(phase: f64) -> (usize, f64) {
    let phase = phase.clamp(0.0, 1.0);
    let next = KNOTS.partition_point(|knot| *knot <= phase).clamp(1, KNOTS.len() - 1);
    (next - 1, (phase - KNOTS[next - 1]) / (KNOTS[next] - KNOTS[next - 1]))
}

/// Errors of all components of a foot's load: measured minus estimated. Sideways is outwards: to the right for the right foot.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StanceErrors {
    /// Force forward, up, outwards [body weights].
    pub force: [StanceCurve; 3],
    /// Centre of pressure along the walking direction and outwards [stature].
    pub center: [StanceCurve; 2],
}

impl StanceErrors {
    /// The mean errors of samples of each component: forces, then centres of pressure.
    #[must_use]
    pub fn through(samples: &[Vec<ErrorSample>; 5]) -> StanceErrors {
        let [forward, up, outwards, along, across] = samples.each_ref().map(|of| StanceCurve::through(of));
        StanceErrors { force: [forward, up, outwards], center: [along, across] }
    }

    /// Forward, up, to the right [body weights] at a share of the stance of a foot.
    pub(super) fn force(&self, side: Side, phase: f64) -> [f64; 3] {
        let [forward, up, outwards] = [0, 1, 2].map(|axis| self.force[axis].at(phase));
        [forward, up, outwards * outwards_sign(side)]
    }

    /// Forward and to the right [stature].
    pub(super) fn center(&self, side: Side, phase: f64) -> [f64; 2] {
        let [forward, outwards] = [0, 1].map(|axis| self.center[axis].at(phase));
        [forward, outwards * outwards_sign(side)]
    }
}

/// 1 for the right foot, -1 for the left one.
#[must_use]
pub fn outwards_sign(side: Side) -> f64 {
    if side == Side::Right { 1.0 } else { -1.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn samples(curve: impl Fn(f64) -> f64) -> Vec<ErrorSample> {
        let sample = |i: u32| {
            let phase = f64::from(i) / 500.0;
            ErrorSample { phase, error: curve(phase), weight: 0.01 }
        };
        (0..=500).map(sample).collect()
    }

    #[test]
    fn a_curve_is_found_up_to_the_ridge_and_none_where_nothing_is_known() {
        let truth = |phase: f64| 0.1 * (phase * std::f64::consts::PI).sin();
        let found = StanceCurve::through(&samples(truth));
        for phase in [0.25, 0.5, 0.75] {
            assert!((found.at(phase) - truth(phase)).abs() < 0.015, "{phase}: {}", found.at(phase));
        }
        assert_eq!(StanceCurve::through(&[]), StanceCurve::default());
        let known_late: Vec<ErrorSample> = samples(|_| 1.0).into_iter().filter(|s| s.phase > 0.5).collect();
        let found = StanceCurve::through(&known_late);
        assert!(found.at(0.2).abs() < 1e-12 && found.at(0.8) > 0.9);
    }

    #[test]
    fn a_curve_is_straight_between_knots_and_constant_beyond() {
        let mut curve = StanceCurve::default();
        curve.0[6] = 1.0;
        assert!((curve.at(0.3) - 1.0).abs() < 1e-12 && (curve.at(0.35) - 0.5).abs() < 1e-12);
        curve.0[14] = 2.0;
        assert!((curve.at(1.7) - 2.0).abs() < 1e-12 && curve.at(-3.0).abs() < 1e-12);
    }

    #[test]
    fn the_left_foot_mirrors_the_right_one() {
        let mut errors = StanceErrors::default();
        errors.force.iter_mut().for_each(|curve| curve.0.fill(0.02));
        errors.center.iter_mut().for_each(|curve| curve.0.fill(0.01));
        let (right, left) = (errors.force(Side::Right, 0.4), errors.force(Side::Left, 0.4));
        assert!((right[2] + left[2]).abs() < 1e-15 && (right[0] - left[0]).abs() < 1e-15);
        assert!((errors.center(Side::Left, 0.4)[1] + 0.01).abs() < 1e-15);
    }

    #[test]
    fn more_trials_are_trusted_more_and_never_wholly() {
        assert!(trusted(0).abs() < 1e-12 && (trusted(1) - REPEATS).abs() < 1e-12);
        assert!(trusted(4) > trusted(1) && trusted(1000) < 1.0);
    }
}
