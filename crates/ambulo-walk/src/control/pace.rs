//! Plans at several speeds, and interpolation between two of them.

use super::plan::{CyclePlan, PlannedStep};
use super::riccati::StepMap;
use nalgebra::{DMatrix, DVector};

/// Time steps between two matrices P that are kept along the plan.
pub(super) const KEPT_EVERY: usize = 10;

/// A plan at one speed, and its gains.
#[derive(Debug, Clone)]
pub(super) struct Pace {
    /// [m/s].
    pub(super) speed: f64,
    pub(super) plan: CyclePlan,
    /// Gains of each time step: one row per joint, one column per entry of the state. Empty without feedback.
    pub(super) gains: Vec<DMatrix<f64>>,
    /// Maps of each time step, by which late feedback foresees the state; empty where feedback acts at once.
    pub(super) maps: Vec<StepMap>,
    /// Height of the sole of the right and the left foot when it strikes [m].
    pub(super) soles_m: [f64; 2],
    /// Matrix P of the Riccati equation where a start from standing joins the walk; none without gains.
    pub(super) value: Option<DMatrix<f64>>,
    /// Matrix P of every tenth time step; empty where no step is planned again.
    pub(super) along: Vec<DMatrix<f64>>,
}

/// Two paces and the share of the second one, between which the present speed lies.
pub(super) struct Between<'a> {
    pub(super) paces: [&'a Pace; 2],
    pub(super) share: f64,
}

impl Between<'_> {
    pub(super) fn mix(&self, of: impl Fn(&Pace) -> f64) -> f64 {
        (1.0 - self.share) * of(self.paces[0]) + self.share * of(self.paces[1])
    }

    /// Share of the cycle at which a foot strikes; the strikes of both paces may lie on either side of the end of the
    /// cycle.
    pub(super) fn strike(&self, foot: usize) -> f64 {
        let [first, second] = self.paces.map(|pace| pace.plan.strike(foot));
        let apart = second - first;
        (first + self.share * (apart - apart.round())).rem_euclid(1.0)
    }

    pub(super) fn planned(&self, phase: f64) -> PlannedStep {
        let [first, second] = self.paces.map(|pace| &pace.plan.steps[pace.plan.step_at(phase)]);
        if self.share > 0.0 { first.blended(second, self.share) } else { first.clone() }
    }

    /// K times a deviation of the state.
    pub(super) fn feedback(&self, phase: f64, apart: &DVector<f64>) -> Option<DVector<f64>> {
        let of = |pace: &Pace| pace.gains.get(pace.plan.step_at(phase)).map(|gain| gain * apart);
        let first = of(self.paces[0])?;
        if self.share > 0.0 { Some(first * (1.0 - self.share) + of(self.paces[1])? * self.share) } else { Some(first) }
    }

    /// xᵀ P x of a deviation of the state; none where P is not kept.
    pub(super) fn cost_to_go(&self, phase: f64, apart: &DVector<f64>) -> Option<f64> {
        let of = |pace: &Pace| {
            let value = pace.along.get(pace.plan.step_at(phase) / KEPT_EVERY)?;
            Some(apart.dot(&(value * apart)))
        };
        let first = of(self.paces[0])?;
        if self.share > 0.0 { Some(first * (1.0 - self.share) + of(self.paces[1])? * self.share) } else { Some(first) }
    }

    /// The foot that strikes next: 0 right, 1 left.
    pub(super) fn next_foot(&self, phase: f64) -> usize {
        let [right, left] = [0, 1].map(|foot| (self.strike(foot) - phase).rem_euclid(1.0));
        usize::from(left < right)
    }

    /// The deviation of the state after a time step; none without maps.
    pub(super) fn after(&self, phase: f64, apart: &DVector<f64>, inputs: &DVector<f64>) -> Option<DVector<f64>> {
        let of = |pace: &Pace| pace.maps.get(pace.plan.step_at(phase)).map(|map| map.after(apart, inputs));
        let first = of(self.paces[0])?;
        if self.share > 0.0 { Some(first * (1.0 - self.share) + of(self.paces[1])? * self.share) } else { Some(first) }
    }
}
