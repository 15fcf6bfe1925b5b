//! Where a figure is in its plan: the phase, and the stages of stopping, standing and walking off.
//!
//!   φ ← φ + (1 + f)/n       in every time step, unless a foot is late (at most 0.3 s)
//!   φ ← φ_strike(foot)      when a foot strikes that was off the ground for 0.2 s, if |φ_strike - φ| < 0.25
//!   ℓ ← s - s*              when a foot strikes
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `at.share` | φ | 1 | share of the cycle, 0 to 1 |
//! | `plan.steps.len()` | n | 1 | time steps of a cycle |
//! | `faster` | f | 1 | by how much a recovery step is faster |
//! | `level_m` | ℓ | m | height of the ground on which the figure stands |
//! | `Body::lowest`, `soles_m` | s, s* | m | height of the sole at the strike, now and in the plan |
//!
//! A step out of standing moves the plan sideways, to where the feet are: `aside_m` is the mean distance of the feet
//! that stand from their planned places.
//! A foot strikes above 5 % of the body weight and swings below 0.2 %.
//! Source: phase reset at foot strike as in Aoi, Tsuchiya 2005 (unverified).
//! Pinned by: tests/physical_walk.rs.

use super::plan::STRIKE;
use super::standing::{Moment, Stage};
use super::walk_plan::WalkPlan;
use crate::model::Model;
use crate::optimal::StandingMovements;

/// Share of the body weight below which a foot swings.
const SWING: f64 = 0.002;
/// Longest time that the phase waits for a strike [s].
const LONGEST_WAIT_S: f64 = 0.3;
/// A foot that was off the ground for a shorter time does not strike [s].
const SHORTEST_SWING_S: f64 = 0.2;
/// A strike further from the planned strike than this share of the cycle does not change the phase.
const FURTHEST: f64 = 0.25;

/// State of a figure at the start of a time step.
#[derive(Clone, Copy)]
pub(super) struct Sensed<'a> {
    /// Value and rate of each coordinate.
    pub(super) now: &'a [[f64; 2]],
    /// Vertical force on the right and the left foot in the last time step [N].
    pub(super) loads_n: [f64; 2],
}

/// The phase of a figure, and the state of its feet.
#[derive(Debug, Clone)]
pub(super) struct Phase {
    /// Share of the cycle and stage.
    pub(super) at: Moment,
    /// Whether the figure stands or is about to stand.
    pub(super) stands: bool,
    /// The foot that struck last.
    pub(super) stance: usize,
    pub(super) strikes: usize,
    /// Height of the ground on which the figure stands [m].
    pub(super) level_m: f64,
    /// How far to the right of its plan the figure stands [m].
    pub(super) aside_m: f64,
    /// Time since it began [s].
    pub(super) time_s: f64,
    /// Time since each foot left the ground [s]; zero while it bears load.
    swing_s: [f64; 2],
    /// Time that the phase has waited for a foot [s].
    waited_s: f64,
    pub(super) step_s: f64,
    weight_n: f64,
}

impl Phase {
    /// The start of the cycle of a figure.
    pub(super) fn new(model: &Model, step_s: f64) -> Phase {
        Phase {
            at: Moment { share: 0.0, stage: Stage::Walking, is_mirrored: false },
            stands: false,
            stance: 0,
            strikes: 0,
            level_m: 0.0,
            aside_m: 0.0,
            time_s: 0.0,
            swing_s: [0.0; 2],
            waited_s: 0.0,
            step_s,
            weight_n: weight_n(model),
        }
    }

    /// The same phase of another figure.
    pub(super) fn of_figure(&mut self, model: &Model) {
        self.weight_n = weight_n(model);
    }

    /// When a foot strikes, sets the phase to the planned phase, and the level of the ground to the level under the
    /// foot.
    pub(super) fn feel(&mut self, plan: &WalkPlan, sensed: Sensed<'_>) {
        for (foot, load) in sensed.loads_n.into_iter().enumerate() {
            if load > STRIKE * self.weight_n {
                if self.swings(foot) && matches!(self.at.stage, Stage::Stepping(_)) {
                    self.step_aside(plan, sensed);
                }
                if self.swing_s[foot] > SHORTEST_SWING_S {
                    self.strikes += 1;
                    if self.at.stage == Stage::Walking {
                        self.strike(foot, plan);
                        let q: Vec<f64> = sensed.now.iter().map(|now| now[0]).collect();
                        let planned = plan.between().mix(|pace| pace.soles_m[foot]);
                        self.level_m = plan.body.lowest(&q)[foot] - planned;
                    }
                }
                self.swing_s[foot] = 0.0;
            } else if load < SWING * self.weight_n {
                self.swing_s[foot] += self.step_s;
            }
        }
    }

    /// Goes to another moment of the plan. A figure that stands or steps out of standing does so where it is.
    pub(super) fn go_to(&mut self, at: Moment, plan: &WalkPlan, sensed: Sensed<'_>) {
        self.at = at;
        self.step_aside(plan, sensed);
    }

    /// The figure has put its feet elsewhere: its plan goes on there.
    fn step_aside(&mut self, plan: &WalkPlan, sensed: Sensed<'_>) {
        let q: Vec<f64> = sensed.now.iter().map(|now| now[0]).collect();
        let [now, planned] = [&q, &plan.step(self.at).state[0]].map(|q| plan.body.aside(q));
        let stands = |foot: &usize| !self.swings(*foot) || sensed.loads_n[*foot] > 0.0;
        let moved: Vec<f64> = [0, 1].into_iter().filter(stands).map(|foot| now[foot] - planned[foot]).collect();
        if !moved.is_empty() {
            self.aside_m = moved.iter().sum::<f64>() / moved.len() as f64;
        }
    }

    /// Whether a foot is off the ground.
    pub(super) fn swings(&self, foot: usize) -> bool {
        self.swing_s[foot] > 0.0
    }

    fn strike(&mut self, foot: usize, plan: &WalkPlan) {
        self.stance = foot;
        let planned = plan.between().strike(foot);
        let ahead = (planned - self.at.share).rem_euclid(1.0);
        if ahead.min(1.0 - ahead) < FURTHEST {
            self.at.share = planned;
        }
    }

    /// The phase advances with time, faster by a share in a recovery step, but waits for a foot that has not struck
    /// when it should.
    pub(super) fn advance(&mut self, plan: &WalkPlan, faster: f64) {
        self.time_s += self.step_s;
        if let Some(standing) = plan.standing.as_ref().filter(|_| self.at.stage != Stage::Walking) {
            // A faster step leaves out time steps.
            let passed = |time_s: f64| ((1.0 + faster.max(0.0)) * (time_s / self.step_s).round() + 1e-9).floor();
            let count = passed(self.time_s) - passed(self.time_s - self.step_s);
            for _ in 0..count as usize {
                self.at.stage = standing.next(self.at.stage, self.stands);
            }
            self.at.share = self.at.joins(StandingMovements::JOINS[usize::from(self.at.stage == Stage::Walking)]);
            return;
        }
        let between = plan.between();
        let step = (1.0 + faster) / between.mix(|pace| pace.plan.steps.len() as f64);
        let is_late = |foot: usize| {
            let until = (between.strike(foot) - self.at.share).rem_euclid(1.0);
            until <= 1.5 * step && self.swing_s[foot] > SHORTEST_SWING_S
        };
        let late = is_late(0) || is_late(1);
        self.waited_s = if late { self.waited_s + self.step_s } else { 0.0 };
        if !late || self.waited_s > LONGEST_WAIT_S {
            let before = self.at.share;
            self.at.share = (before + step).rem_euclid(1.0);
            for is_mirrored in plan.standing.iter().flat_map(|standing| standing.images()) {
                let joins = Moment { is_mirrored, ..self.at }.joins(StandingMovements::JOINS[0]);
                let until = (joins - before).rem_euclid(1.0);
                if self.stands && until > 0.0 && until <= step {
                    (self.at.stage, self.at.is_mirrored) = (Stage::Stopping(0), is_mirrored);
                }
            }
        }
    }
}

fn weight_n(model: &Model) -> f64 {
    model.mass() * model.gravity().norm()
}
