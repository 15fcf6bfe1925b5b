//! Compares the acceleration of the mass centre with the one that the measured ground forces cause.
//!
//! Newton's law: the plates measure F(t), and the motion needs N(t) = m (a(t) - g). In each uninterrupted time with
//! complete forces both are integrated, without their means, so that constant errors (mass, offset of a plate) and the
//! different low-pass filters of motion and forces matter little:
//!
//!   V(t) = ∫ (F - F̄) dt      W(t) = ∫ (N - N̄) dt      k = Σ W·V / Σ |V|².
//!
//! The slope k is 1 for motion and forces of one recording. If the clock of both runs faster by a factor c, the
//! accelerations of the motion are c² times as large and the forces are not: k = c², 2.25 for a recording that is 1.5
//! times as fast.
//!
//! | symbol | unit | meaning                                          |
//! |--------|------|--------------------------------------------------|
//! | F, N   | N    | measured and needed total ground force           |
//! | V, W   | N.s  | their changes of momentum, up to a linear trend  |
//!
//! Pinned by: tests/feasibility_motions.rs

use super::frame::{CheckedPart, CheckedValue, FeasibilityLimits, Frame};
use super::spans::Span;
use super::verdict::Check;
use crate::spatial::Vec3;

/// Less change of velocity is not enough for a slope: a person who stands [m/s, rms].
const LEAST_CHANGE_M_S: f64 = 0.03;

/// The forces that the motion needs and that the plates measured, in frames in which all ground forces were measured.
#[derive(Debug, Clone, Default)]
pub(super) struct AccelerationRatio {
    frames: Vec<ComparedFrame>,
}

/// Total ground force of a frame [N].
#[derive(Debug, Clone, Copy)]
struct ComparedFrame {
    number: usize,
    needed: Vec3,
    measured: Vec3,
}

impl AccelerationRatio {
    pub(super) fn add(&mut self, number: usize, frame: &Frame<'_>) {
        let measured: Vec3 = frame.feet.values().flatten().map(|foot| foot.force).sum();
        self.frames.push(ComparedFrame { number, needed: measured + frame.residual.force, measured });
    }

    /// The slope; `None` if the velocity is almost constant.
    fn ratio(&self, step_s: f64, mass_kg: f64) -> Option<f64> {
        let (mut product, mut square) = (0.0, 0.0);
        for run in self.frames.chunk_by(|a, b| a.number + 1 == b.number) {
            let mean = |of: fn(&ComparedFrame) -> Vec3| run.iter().map(of).sum::<Vec3>() / run.len() as f64;
            let [needed_mean, measured_mean] = [mean(|frame| frame.needed), mean(|frame| frame.measured)];
            let (mut needed, mut measured) = (Vec3::zeros(), Vec3::zeros());
            for frame in run {
                needed += frame.needed - needed_mean;
                measured += frame.measured - measured_mean;
                product += needed.dot(&measured);
                square += measured.norm_squared();
            }
        }
        let change_m_s = (square / self.frames.len() as f64).sqrt() * step_s / mass_kg;
        (change_m_s > LEAST_CHANGE_M_S).then(|| product / square)
    }

    /// The ratio with its limit, and the frames that it was found from.
    pub(super) fn span(&self, step_s: f64, limits: &FeasibilityLimits) -> Option<Span> {
        let check = Check::Acceleration;
        let limit = limits.thresholds.acceleration_ratio;
        let value = self.ratio(step_s, limits.mass).filter(|_| limits.thresholds.judges(check))?;
        let [first, last] = [self.frames.first()?, self.frames.last()?].map(|frame| frame.number);
        let worst = CheckedValue { check, of: CheckedPart::Body, value, limit, share: value / limit };
        Some(Span { first, last, worst_at: first, worst })
    }
}
