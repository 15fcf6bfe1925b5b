//! The plan of a controller: q*, q̇* and τ* at any phase and speed, and in standing.
//!
//! Between two speeds v₁ < v < v₂ with plans, and with the share w = (v - v₁) / (v₂ - v₁),
//!
//!   q*(φ) = (1 - w) q*₁(φ) + w q*₂(φ)          and so for q̇*, τ*, K and heights of soles
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `PlannedStep::state` | q*, q̇* | rad, m; rad/s, m/s | coordinates and rates at the start of a time step |
//! | `PlannedStep::target` | q*, q̇* | the same | in its middle: the targets of the impedance |
//! | `PlannedStep::torques` | τ* | N.m | torques in its middle |
//! | `Pace::gains` | K | N.m per unit of state | one row per joint, one column per entry of the state |
//! | `speed` | v | m/s | present speed |
//! | `height_ratio` | | 1 | hip height, relative to the figure of the plan |
//!
//! Pinned by: tests/physical_walk.rs.

use super::pace::{Between, Pace};
use super::plan::{PlannedStep, Root};
use super::settings::ControlError;
use super::standing::{Moment, Stage, Standing};
use crate::engine::soles::lowest;
use crate::kinematics::{Posture, body_motion};
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{Model, Side};
use crate::optimal::StandingMovements;
use crate::walking::TorqueSeries;
use nalgebra::{DMatrix, DVector};
use std::sync::Arc;

/// Speeds that differ by less are the same [m/s].
pub(super) const SPEED_ROUNDING: f64 = 1e-6;

/// Share of steps on the spot after which the first foot has struck.
pub(super) const FIRST_DOWN: f64 = 0.5;

/// The figure, as far as heights of its soles depend on it.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) model: Model,
    soles: Vec<ContactSphere>,
    leg_length: f64,
}

impl Body {
    pub(super) fn of(human: &Human) -> Body {
        Body { model: human.model.clone(), soles: human.soles.clone(), leg_length: human.dimensions.leg_length }
    }

    /// Lowest point of the soles of the right and the left foot [m].
    pub(super) fn lowest(&self, q: &[f64]) -> [f64; 2] {
        let still = vec![0.0; q.len()];
        let motions = body_motion(&self.model, Posture { q, qd: &still, qdd: &still });
        Side::BOTH.map(|side| lowest(self.soles.iter().filter(|sole| sole.side == side), &motions))
    }

    /// Place to the right of the right and the left foot [m].
    pub(super) fn aside(&self, q: &[f64]) -> [f64; 2] {
        let still = vec![0.0; q.len()];
        let motions = body_motion(&self.model, Posture { q, qd: &still, qdd: &still });
        Side::BOTH.map(|side| {
            let of_foot = self.soles.iter().filter(|sole| sole.side == side);
            let places = of_foot.map(|sole| motions[sole.body.index()].pose.place(sole.center).z);
            let (sum, count) = places.fold((0.0, 0.0), |(sum, count), z| (sum + z, count + 1.0));
            sum / count
        })
    }
}

/// Plans and gains of a figure at several speeds and in standing.
#[derive(Debug, Clone)]
pub(super) struct WalkPlan {
    /// Plans and gains by speed, the slowest first.
    pub(super) paces: Vec<Arc<Pace>>,
    /// Standing, and the ways there and back.
    pub(super) standing: Option<Arc<Standing>>,
    pub(super) body: Arc<Body>,
    /// The present speed [m/s].
    pub(super) speed: f64,
    /// Hip height, relative to the figure of the plan [1].
    pub(super) height_ratio: f64,
}

impl WalkPlan {
    /// The slowest and the fastest speed [m/s].
    pub(super) fn speeds(&self) -> [f64; 2] {
        [&self.paces[0], &self.paces[self.paces.len() - 1]].map(|pace| pace.speed)
    }

    /// Sets the speed [m/s] to one within [`WalkPlan::speeds`].
    pub(super) fn set_speed(&mut self, speed: f64) -> Result<(), ControlError> {
        let [slowest, fastest] = self.speeds();
        if !(slowest - SPEED_ROUNDING..=fastest + SPEED_ROUNDING).contains(&speed) {
            return Err(ControlError::Speed { found: speed, slowest, fastest });
        }
        self.speed = speed.clamp(slowest, fastest);
        Ok(())
    }

    /// The plans on both sides of the present speed.
    pub(super) fn between(&self) -> Between<'_> {
        let above = self.paces.iter().position(|pace| pace.speed >= self.speed).unwrap_or(self.paces.len() - 1);
        let [slow, fast] = [above.saturating_sub(1), above].map(|k| &*self.paces[k]);
        let apart = fast.speed - slow.speed;
        if apart <= 0.0 || self.speed >= fast.speed {
            return Between { paces: [fast, fast], share: 0.0 };
        }
        Between { paces: [slow, fast], share: (self.speed - slow.speed) / apart }
    }

    pub(super) fn root(&self) -> &Root {
        &self.paces[0].plan.root
    }

    /// The planned time step.
    pub(super) fn step(&self, at: Moment) -> PlannedStep {
        let standing = self.standing.as_ref().and_then(|standing| standing.planned(at));
        standing.unwrap_or_else(|| self.between().planned(at.share))
    }

    /// K(φ) (x - x*) [N.m], one torque per joint, for the deviation x - x* of the state; none without gains.
    pub(super) fn feedback(&self, at: Moment, deviation: &DVector<f64>) -> Option<DVector<f64>> {
        let of_standing = self.standing.as_ref().and_then(|standing| standing.feedback(at, deviation));
        of_standing.or_else(|| self.between().feedback(at.share, deviation))
    }

    /// xᵀ P x of a deviation of the state; none where P is not kept.
    pub(super) fn cost_to_go(&self, at: Moment, deviation: &DVector<f64>) -> Option<f64> {
        let of_standing = self.standing.as_ref().and_then(|standing| standing.cost_to_go(at, deviation));
        of_standing.or_else(|| self.between().cost_to_go(at.share, deviation))
    }

    /// The foot that strikes next: 0 right, 1 left.
    pub(super) fn next_foot(&self, at: Moment) -> usize {
        let stepping = self.standing.as_ref().and_then(|standing| standing.stepping());
        match (at.stage, stepping) {
            (Stage::Stepping(step), Some(count)) => {
                let is_first = (step as f64) < FIRST_DOWN * count as f64;
                usize::from(is_first != at.is_mirrored)
            }
            _ => self.between().next_foot(at.share),
        }
    }

    /// The deviation of the state after a time step with feedback torques of the joints [N.m]; none without maps.
    pub(super) fn after(&self, at: Moment, deviation: &DVector<f64>, inputs: &DVector<f64>) -> Option<DVector<f64>> {
        let of_standing = self.standing.as_ref().and_then(|standing| standing.after(at, deviation, inputs));
        of_standing.or_else(|| self.between().after(at.share, deviation, inputs))
    }

    /// The moment of the plan a time step later.
    pub(super) fn later(&self, at: Moment) -> Moment {
        let stage = match &self.standing {
            Some(standing) if at.stage != Stage::Walking => standing.next(at.stage, true),
            _ => Stage::Walking,
        };
        let share = match (at.stage, stage) {
            (Stage::Walking, _) => at.share + 1.0 / self.between().mix(|pace| pace.plan.steps.len() as f64),
            (_, Stage::Walking) => at.joins(StandingMovements::JOINS[1]),
            _ => at.share,
        };
        Moment { share: share.rem_euclid(1.0), stage, ..at }
    }

    /// Gains of all time steps of all plans.
    pub(super) fn gains(&self) -> impl Iterator<Item = &DMatrix<f64>> {
        let of_walks = self.paces.iter().flat_map(|pace| &pace.gains);
        of_walks.chain(self.standing.iter().flat_map(|standing| standing.gains()))
    }

    /// Coordinates and rates, with the soles at the height of the plan.
    pub(super) fn start(&self, at: Moment) -> [Vec<f64>; 2] {
        let [mut q, qd] = self.step(at).state;
        let up = self.root().up;
        q[up] *= self.height_ratio;
        let lowest = self.body.lowest(&q).into_iter().fold(f64::INFINITY, f64::min);
        let planned = match &self.standing {
            Some(standing) if at.stage != Stage::Walking => standing.soles_m[0].min(standing.soles_m[1]),
            _ => self.between().mix(|pace| pace.soles_m[0].min(pace.soles_m[1])),
        };
        q[up] += planned - lowest;
        [q, qd]
    }

    /// The same plan for another figure with the same joints: heights grow with its legs.
    pub(super) fn of_figure(&mut self, human: &Human) {
        self.height_ratio *= human.dimensions.leg_length / self.body.leg_length;
        self.body = Arc::new(Body::of(human));
    }

    /// The torques of joints along the plan of the slowest speed, as harmonics of the cycle.
    pub(super) fn torque_series(&self, joints: &[usize], step_s: f64) -> Vec<TorqueSeries> {
        let plan = &self.paces[0].plan;
        let (middles, model) = (plan.middles(), &self.body.model);
        let of = |&c: &usize| {
            let about = [plan.steps.len() as f64 * step_s, model.mass()];
            TorqueSeries::of(&model.coordinates()[c].name, about, &middles, &plan.torques(c))
        };
        joints.iter().map(of).collect()
    }
}
