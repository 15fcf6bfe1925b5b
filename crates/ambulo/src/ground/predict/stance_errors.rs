//! Repeatable errors of the estimate over a stance, learned from force plates and subtracted.
//!
//! The estimate of a stance differs from the force plates in part by chance, in part in the same way in every stance:
//! the prior has the strike of other subjects, the body's segments differ slightly from the person's. What repeats is a
//! curve over the stance for each component, with a cubic without slope at its ends between [`KNOTS`], so that forces
//! have no kinks, by least squares:
//!
//!   e(u) = Σ_k B_k(u) c_k      (Σ_s w_s Σ_i B B' + λ 1) c = Σ_s w_s Σ_i B (measured - estimated)
//!
//! with u the elapsed share of the stance as detected from the motion, w_s equal for stances (of a person) and the
//! diagonal λ a share of the mean diagonal of the left side. [`StanceErrors::default`] has no error at all.
//!
//! Of an error with standard deviation σ between stances of a person, a share ρ of the variance repeats in the next
//! trial of the person ([`REPEATS`]). Then the best linear estimate of the repeatable part after n trials is the mean
//! curve times [`trusted`], and this share of the variance remains: 1 - ρ × trusted.

use super::stance_traits::{TRAITS, Traits};
use crate::model::Side;
use crate::numerics::BandMatrix;

/// Shares of a stance between which curves go from one value to the next: closest where forces change fastest.
pub const KNOTS: [f64; 15] = [0.0, 0.03, 0.06, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.87, 0.93, 1.0];
/// Entry of the diagonal of a value that is held at zero, as a share of its trace.
const HELD: f64 = 1e9;
/// λ as a share of the mean diagonal.
const RIDGE: f64 = 0.1;
/// As above, for the curve of a usual stance and for its changes with descent, haste and leg length: of the force
/// forward, up and outwards. Chosen among 0.03 to 10 and [`UNUSED`] by the mean errors of groups of people whose
/// laboratory was left out (docs/GROUND_FORCES.md; the gate of docs/measured/GROUND_FIT.md has each group).
const RIDGES: [[f64; 1 + TRAITS]; 3] =
    [[2.0, UNUSED, UNUSED, UNUSED], [1.0, 0.1, 0.1, UNUSED], [0.1, UNUSED, UNUSED, 0.3]];
/// The ridge of a change that does not help people of other laboratories.
const UNUSED: f64 = 1e9;
/// ρ: share of the variance of the error of a stance that repeats in other trials of the same person and kind. Of the
/// weights 0.5, 0.7 and 1 of one stance, 0.7 gave the smallest errors of the other stances of two subjects with five
/// trials or stances of a foot.
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

/// The values of a curve at foot strike and foot off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Determined by the samples.
    Free,
    /// Zero: a force begins and ends there.
    Zero,
}

/// One sample of an error: measured minus estimated value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorSample {
    /// Elapsed share of the stance as detected from the motion.
    pub phase: f64,
    /// Measured minus estimated value.
    pub error: f64,
    /// Weight of the sample.
    pub weight: f64,
    /// Traits of its stance (`stance_traits`).
    pub traits: Traits,
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
    pub fn through(samples: &[ErrorSample], ends: Ends) -> StanceCurve {
        let [curve] = curves_through(samples, |_| [1.0], [RIDGE], ends);
        curve
    }

    /// The mean curve of a usual stance of the force forward (0), up (1) or outwards (2), and its change for each unit
    /// of each trait, by least squares; zero at both ends.
    #[must_use]
    pub fn through_by_traits(samples: &[ErrorSample], axis: usize) -> [StanceCurve; 1 + TRAITS] {
        let factors = |sample: &ErrorSample| {
            let [descent, haste, leg] = sample.traits;
            [1.0, descent, haste, leg]
        };
        curves_through(samples, factors, RIDGES[axis], Ends::Zero)
    }
}

/// Curves whose sum, each times its factor for a sample, goes through samples by least squares; `ridges` are the λ of
/// the curves as shares of the mean diagonal of the first one.
fn curves_through<const N: usize>(
    samples: &[ErrorSample],
    factors: impl Fn(&ErrorSample) -> [f64; N],
    ridges: [f64; N],
    ends: Ends,
) -> [StanceCurve; N] {
    // The unknowns of a knot stand side by side.
    let mut matrix = BandMatrix::zeros(N * KNOTS.len(), 2 * N - 1);
    let mut right = vec![0.0; N * KNOTS.len()];
    for sample in samples.iter().filter(|sample| sample.error.is_finite()) {
        let (k, share) = place(sample.phase);
        let factors = factors(sample);
        let row: Vec<f64> = [1.0 - share, share].iter().flat_map(|hat| factors.map(|factor| hat * factor)).collect();
        for (i, a) in row.iter().enumerate() {
            right[N * k + i] += sample.weight * a * sample.error;
            for (j, b) in row[..=i].iter().enumerate() {
                matrix.add(N * k + i, N * k + j, sample.weight * a * b);
            }
        }
    }
    let trace: f64 = (0..KNOTS.len()).map(|k| matrix.value(N * k, N * k)).sum();
    for i in 0..right.len() {
        let is_held = ends == Ends::Zero && [0, KNOTS.len() - 1].contains(&(i / N));
        matrix.add(i, i, trace * if is_held { HELD } else { ridges[i % N] / KNOTS.len() as f64 });
    }
    match matrix.factor() {
        Some(factor) => {
            factor.solve(&mut right);
            std::array::from_fn(|curve| StanceCurve(std::array::from_fn(|k| right[N * k + curve])))
        }
        // Without samples there is nothing to solve.
        None => [StanceCurve::NONE; N],
    }
}

/// Index of the knot before a share of the stance, and the share of the way to the next one, smooth at both.
fn place(phase: f64) -> (usize, f64) {
    let phase = phase.clamp(0.0, 1.0);
    let next = KNOTS.partition_point(|knot| *knot <= phase).clamp(1, KNOTS.len() - 1);
    let share = (phase - KNOTS[next - 1]) / (KNOTS[next] - KNOTS[next - 1]);
    (next - 1, share * share * (3.0 - 2.0 * share))
}

/// Errors of all components of a foot's load: measured minus estimated. Sideways is outwards: to the right for the
/// right foot.
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
        let [forward, up, outwards] = [0, 1, 2].map(|k| StanceCurve::through(&samples[k], Ends::Zero));
        let [along, across] = [3, 4].map(|k| StanceCurve::through(&samples[k], Ends::Free));
        StanceErrors { force: [forward, up, outwards], center: [along, across] }
    }

    /// Forward, up, to the right [body weights] at a share of the stance of a foot.
    #[doc(hidden)] // for tests
    pub fn force(&self, side: Side, phase: f64) -> [f64; 3] {
        let [forward, up, outwards] = [0, 1, 2].map(|axis| self.force[axis].at(phase));
        [forward, up, outwards * outwards_sign(side)]
    }

    /// Forward and to the right [stature].
    #[doc(hidden)] // for tests
    pub fn center(&self, side: Side, phase: f64) -> [f64; 2] {
        let [forward, outwards] = [0, 1].map(|axis| self.center[axis].at(phase));
        [forward, outwards * outwards_sign(side)]
    }
}

/// Mean errors of the estimate in walking, which depend on traits of the stance.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ErrorsByTraits {
    /// Mean errors in a usual stance.
    pub usual: StanceErrors,
    /// Change of the force forward, up and outwards for each unit of each trait (`stance_traits`) [body weights].
    pub changes: [[StanceCurve; TRAITS]; 3],
}

impl ErrorsByTraits {
    /// Forward, up, to the right [body weights] at a share of the stance of a foot.
    pub(super) fn force(&self, side: Side, phase: f64, traits: &Traits) -> [f64; 3] {
        let usual = self.usual.force(side, phase);
        let more = self
            .changes
            .each_ref()
            .map(|curves| -> f64 { curves.iter().zip(traits).map(|(curve, size)| size * curve.at(phase)).sum() });
        [usual[0] + more[0], usual[1] + more[1], usual[2] + outwards_sign(side) * more[2]]
    }
}

/// 1 for the right foot, -1 for the left one.
#[must_use]
pub(crate) fn outwards_sign(side: Side) -> f64 {
    if side == Side::Right { 1.0 } else { -1.0 }
}
