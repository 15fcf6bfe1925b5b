//! Recovery steps: how the step under way, or a step out of standing, is changed after a strong push.
//!
//! The swinging hip abducts and flexes further, and the step takes less time. The change is chosen by trial in the
//! simulator ([`super::trials`]) and kept until the foot strikes, or the figure begins to stop.
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `StepChange::adduction` | α | rad | further adduction of the swinging hip |
//! | `StepChange::flexion` | β | rad | further flexion of the swinging hip |
//! | `StepChange::faster` | f | 1 | the phase advances 1 + f times as fast |
//! | `COSTS` | w_a, w_f | 1/rad², 1 | costs of a change, small beside those of a deviation |
//!
//! Swing legs move to a change at 2.5 rad/s and back to the plan at the same rate once the foot has struck.
//! Pinned by: tests/physical_walk.rs.

use super::figure::FigureWorld;
use super::phase::Phase;
use super::plan::PlannedStep;
use super::standing::Stage;
use super::walk_plan::WalkPlan;
use crate::model::{Model, Movement, Side};

/// Rate at which the swinging hip turns to a change and back [rad/s].
const RATE: f64 = 2.5;
/// Costs of a change: of the square of an angle [1/rad²], and of the square of the faster phase.
const COSTS: [f64; 2] = [0.5, 0.02];

/// Change of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct StepChange {
    pub(super) adduction: f64,
    pub(super) flexion: f64,
    pub(super) faster: f64,
}

impl StepChange {
    pub(super) fn cost(&self) -> f64 {
        COSTS[0] * (self.adduction.powi(2) + self.flexion.powi(2)) + COSTS[1] * self.faster.powi(2)
    }
}

/// A coordinate of a hip, its sign, and by how much its plan is changed now [rad].
#[derive(Debug, Clone, Copy)]
struct ChangedHip {
    coordinate: usize,
    sign: f64,
    by: f64,
}

/// The recovery steps of a figure.
#[derive(Debug, Clone)]
pub(super) struct Recovery {
    /// Adduction and flexion of the right and the left hip.
    hips: [[ChangedHip; 2]; 2],
    /// The change of the step under way, and its foot.
    change: StepChange,
    foot: usize,
    /// Time of the next plan [s].
    next_s: f64,
    /// The figure alone on level ground; none in a trial, which plans nothing.
    world: Option<Box<FigureWorld>>,
}

impl Recovery {
    /// The recovery steps of a figure; none if it cannot place its feet sideways.
    pub(super) fn new(model: &Model, world: FigureWorld) -> Option<Recovery> {
        let hip = |movement, side| {
            let (id, sign) = model.anatomy().coordinate(movement, Some(side))?;
            Some(ChangedHip { coordinate: id.index(), sign, by: 0.0 })
        };
        let both = |side| Some([hip(Movement::HipAdduction, side)?, hip(Movement::HipFlexion, side)?]);
        let hips = [both(Side::Right)?, both(Side::Left)?];
        Some(Recovery { hips, change: StepChange::default(), foot: 0, next_s: 0.0, world: Some(Box::new(world)) })
    }

    /// The same recovery steps of another figure.
    pub(super) fn set_world(&mut self, world: FigureWorld) {
        self.world = Some(Box::new(world));
    }

    /// Share by which the phase is faster.
    pub(super) fn faster(&self) -> f64 {
        self.change.faster
    }

    /// Takes the world of the figure for trials, if it is time for some; [`Recovery::tried`] gives it back.
    pub(super) fn due(&mut self, time_s: f64) -> Option<Box<FigureWorld>> {
        self.world.take_if(|_| time_s >= self.next_s)
    }

    /// Trials have been made; others follow after a time [s].
    pub(super) fn tried(&mut self, world: Box<FigureWorld>, next_s: f64) {
        (self.world, self.next_s) = (Some(world), next_s);
    }

    /// The change of the step under way.
    pub(super) fn change(&self) -> StepChange {
        self.change
    }

    /// Changes the step under way.
    pub(super) fn set_change(&mut self, change: StepChange) {
        self.change = change;
    }

    /// Another foot steps than before.
    pub(super) fn set_foot(&mut self, foot: usize) {
        self.foot = foot;
    }

    /// Changes a planned time step.
    pub(super) fn apply(&mut self, plan: &WalkPlan, phase: &Phase, planned: &mut PlannedStep) {
        let foot = plan.next_foot(phase.at);
        // A stop and a start are followed as they were planned.
        if foot != self.foot || !matches!(phase.at.stage, Stage::Walking | Stage::Stepping(_)) {
            (self.foot, self.change) = (foot, StepChange::default());
        }
        let most = RATE * phase.step_s;
        for (side, hips) in self.hips.iter_mut().enumerate() {
            let swings = side == foot && phase.swings(side);
            for (hip, wanted) in hips.iter_mut().zip([self.change.adduction, self.change.flexion]) {
                let turn = (if swings { wanted } else { 0.0 } - hip.by).clamp(-most, most);
                hip.by += turn;
                for part in [&mut planned.state, &mut planned.target] {
                    part[0][hip.coordinate] += hip.sign * hip.by;
                    part[1][hip.coordinate] += hip.sign * turn / phase.step_s;
                }
            }
        }
    }
}
