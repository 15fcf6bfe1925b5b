//! Recovery steps: after a strong push a figure in three dimensions plans the step under way again, by trial.
//!
//! While the deviation of the state costs more than v, a change c of the step is chosen every 0.15 s: the swinging hip
//! abducts and flexes further, and the phase runs faster. Each candidate is simulated for a time T with the feedback of
//! the plan, in a world of the figure alone on level ground, and the one with the least
//!
//!   J(c) = (x - x*)ᵀ P (x - x*) at T + w_a (α² + β²) + w_f f²          or 10⁶ (2 - t/T) after a fall at t
//!
//! is followed until the foot strikes, or the figure begins to stop. In level walking, and after pushes that feedback alone can take, nothing is
//! tried.
//!
//! | code | symbol | unit | meaning |
//! |---|---|---|---|
//! | `StepChange::adduction` | α | rad | further adduction of the swinging hip |
//! | `StepChange::flexion` | β | rad | further flexion of the swinging hip |
//! | `StepChange::faster` | f | 1 | the phase advances 1 + f times as fast |
//! | `WalkController::cost_to_go` | (x - x*)ᵀ P (x - x*) | 1 | P of the Riccati equation at this phase |
//! | `WORTH_IT` | v | 1 | pushes of 100 N for 0.2 s cost 1 to 4, of 150 N 3 to 15 |
//! | `AHEAD_S` | T | s | one step and a half |
//! | `COSTS` | w_a, w_f | 1/rad², 1 | costs of a change, small beside those of a deviation |
//!
//! Legs are solid in these trials as they are in the walk, so that the foot takes a way past the other leg. Swing legs
//! move to a change at 2.5 rad/s and back to the plan at the same rate once the foot has struck.
//! Source: foot placement after the predicted state as in Yin, Loken, van de Panne 2007 (unverified), but chosen by
//! prediction instead of a linear law. Pinned by: tests/physical_walk.rs.

use super::figure::FigureWorld;
use super::phase::Phase;
use super::plan::PlannedStep;
use super::standing::Stage;
use super::walk_plan::WalkPlan;
use crate::model::{Model, Movement, Side};

/// Cost of a deviation above which a step is planned again.
const WORTH_IT: f64 = 2.0;
/// Time between two plans of a step, and time that a candidate is simulated [s].
const EVERY_S: f64 = 0.15;
const AHEAD_S: f64 = 0.9;
/// Rate at which the swinging hip turns to a change and back [rad/s].
const RATE: f64 = 2.5;
/// Costs of a change: of the square of an angle [1/rad²], and of the square of the faster phase.
const COSTS: [f64; 2] = [0.5, 0.02];
/// Cost of a fall at the end of a trial; an earlier one costs up to twice as much.
const FALL: f64 = 1e6;

/// Candidates, one after the other: adductions, phases, flexions, and differences around the best one.
const ADDUCTIONS: [f64; 6] = [-0.35, -0.2, -0.1, 0.0, 0.1, 0.2];
const FASTER: [f64; 4] = [0.0, 0.5, 1.0, 1.5];
const FLEXIONS: [f64; 4] = [-0.2, -0.1, 0.1, 0.2];
const FINER: [[f64; 2]; 4] = [[-0.05, 0.0], [0.05, 0.0], [0.0, 0.3], [0.0, -0.3]];

/// Change of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct StepChange {
    adduction: f64,
    flexion: f64,
    faster: f64,
}

impl StepChange {
    fn cost(&self) -> f64 {
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

    /// Plans the step under way again, if it is time and the deviation costs enough. `cost_to_go` is that of the state
    /// now, `cost` simulates recovery steps that plan nothing, in the world of the figure, and returns the cost-to-go
    /// at the end or the share of the time at which it fell.
    pub(super) fn plan(
        &mut self,
        time_s: f64,
        cost_to_go: impl Fn() -> f64,
        cost: impl Fn(Recovery, FigureWorld, f64) -> Result<f64, f64>,
    ) {
        if time_s < self.next_s {
            return;
        }
        let Some(world) = self.world.take() else { return };
        if cost_to_go() > WORTH_IT {
            self.next_s = time_s + EVERY_S;
            self.change = self.best(|change| {
                match cost(Recovery { change, ..self.clone() }, FigureWorld::clone(&world), AHEAD_S) {
                    Ok(after) if after.is_finite() => after + change.cost(),
                    Ok(_) => 2.0 * FALL,
                    Err(share) => FALL * (2.0 - share),
                }
            });
        }
        self.world = Some(world);
    }

    /// The change with the least cost: one entry after the other, then finer.
    fn best(&self, cost: impl Fn(StepChange) -> f64) -> StepChange {
        let present = self.change;
        let mut best = (cost(present), present);
        if best.0 <= WORTH_IT {
            return present;
        }
        let mut better = |change: StepChange| {
            let cost = cost(change);
            if cost < best.0 {
                best = (cost, change);
            }
            best.1
        };
        let mut at = present;
        for adduction in ADDUCTIONS {
            at = better(StepChange { adduction, ..present });
        }
        let coarse = at;
        for faster in FASTER {
            at = better(StepChange { faster, ..coarse });
        }
        let coarse = at;
        for flexion in FLEXIONS {
            at = better(StepChange { flexion, ..coarse });
        }
        let StepChange { adduction, flexion, faster } = at;
        for [turn, share] in FINER {
            at = better(StepChange { adduction: adduction + turn, flexion, faster: faster + share });
        }
        at
    }

    /// Changes a planned time step.
    pub(super) fn apply(&mut self, plan: &WalkPlan, phase: &Phase, planned: &mut PlannedStep) {
        let foot = plan.between().next_foot(phase.at.share);
        // A stop, a start and standing have their own plans, in which the phase does not advance.
        if foot != self.foot || phase.at.stage != Stage::Walking {
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
