//! The controller of a figure that walks by its own torques.
//!
//! In every time step the torque of a joint is
//!
//!   τ = τ*(φ) + k (q*(φ) - q) + d (q̇*(φ) - q̇) - K(φ) (x - x*(φ))          |τ| ≤ τ_max(q, q̇)
//!
//! | code | symbol | unit | meaning | file |
//! |---|---|---|---|---|
//! | `WalkPlan` | τ*, q*, q̇*, x*, K | N.m; rad, m; rad/s, m/s | plan and gains at each phase and speed | `walk_plan` |
//! | `Phase` | φ | 1 | share of the cycle; waits for late feet, jumps to early ones | `phase` |
//! | `Feedback` | k, d, K (x - x*) | N.m/rad, N.m.s/rad, N.m | impedance of joints, feedback of the state | `feedback` |
//! | `Impedance` | τ_max | N.m | strength of the muscles at an angle and a rate | `linear` |
//! | `Recovery` | α, β, f | rad, rad, 1 | steps that are planned again after a strong push | `recovery` |
//! | `FallWatch` | | | whether the figure has fallen, and which joint reached its strength first | `fall` |
//!
//! The state x has all coordinates q but the place forward, and all rates q̇. A figure that has fallen is only damped.
//! Source: docs/PHYSICAL_WALK.md, with what each term is for. Cost: a product of K and x per time step; gains cost
//! seconds, once.
//! Pinned by: tests/physical_walk.rs, tests/scene_walkers.rs.

use super::activation::activated;
use super::fall::{Fall, FallWatch};
use super::feedback::{Feedback, delay_steps, share_of};
use super::figure::FigureWorld;
use super::gains::{PlanGains, costs, gains};
use super::linear::with_impedances;
use super::pace::Pace;
use super::phase::{Phase, Sensed};
use super::plan::CyclePlan;
use super::recovery::Recovery;
use super::riccati::StepMap;
use super::settings::{Balance, ControlError, ControlSettings};
use super::standing::{Maker, Stage};
use super::trials::{Course, Trials};
use super::walk_plan::{Body, SPEED_ROUNDING, WalkPlan};
use crate::engine::{Motor, StepSettings};
use crate::findings::Findings;
use crate::model::CoordinateId;
use crate::model::anthropometry::Human;
use crate::numerics::Order;
use crate::optimal::{Solution, StandingMovements};
use crate::walking::TorqueSeries;
use std::sync::Arc;

/// Walks a figure along a plan by torques of its joints.
#[derive(Debug, Clone)]
pub struct WalkController {
    plan: WalkPlan,
    phase: Phase,
    feedback: Feedback,
    fall: FallWatch,
    /// None where no step is planned again.
    recovery: Option<Recovery>,
}

impl WalkController {
    /// The controller of a figure along a walk, for time steps of `settings.step_s`.
    ///
    /// # Errors
    /// A figure that is not planar, a cycle with too few or too many time steps, gains that cannot be computed.
    pub fn new(
        human: &Human,
        solution: &Solution,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<WalkController, ControlError> {
        let mut plan = CyclePlan::new(human, solution, step.step_s)?;
        plan.set_torques(&human.model, solution.cycle_s(), &settings.torques)?;
        let feedback = Feedback::new(human, [plan.joints(), plan.places()], settings, step.step_s)?;
        let mut figure = FigureWorld::new(human, solution.problem().shoes, step)?;
        let (gains, maps) = if settings.balance == Balance::WholeState {
            let maps = activated(figure.maps(&plan, &feedback.impedances)?, feedback.left);
            (gains(human, &plan, &maps, settings, step.step_s)?, feedback.kept(maps))
        } else {
            (PlanGains::default(), Vec::new())
        };
        let recovery = if gains.along.is_empty() { None } else { Recovery::new(&human.model, figure) };
        let PlanGains { gains, at_join: value, along } = gains;
        let body = Body::of(human);
        let carrying = feedback.joints.iter().copied().filter(|&c| share_of(human, c).0 >= 1.0).collect();
        let speed = solution.speed();
        let soles_m = [0, 1].map(|foot| body.lowest(&plan.steps[plan.strikes[foot]].state[0])[foot]);
        Ok(WalkController {
            plan: WalkPlan {
                paces: vec![Arc::new(Pace { speed, plan, gains, maps, soles_m, value, along })],
                standing: None,
                body: Arc::new(body),
                speed,
                height_ratio: 1.0,
            },
            phase: Phase::new(&human.model, step.step_s),
            feedback,
            fall: FallWatch::new(carrying),
            recovery,
        })
    }

    /// The maps of the time steps of its plan, with its impedances.
    pub(crate) fn maps(
        &self,
        human: &Human,
        solution: &Solution,
        step: StepSettings,
    ) -> Result<Vec<StepMap>, ControlError> {
        let mut figure = FigureWorld::new(human, solution.problem().shoes, step)?;
        figure.maps(&self.plan.paces[0].plan, &self.feedback.impedances)
    }

    /// The controller of the same plan with other settings; `maps` belong to this controller.
    pub(crate) fn with_settings(
        &self,
        human: &Human,
        settings: &ControlSettings,
        maps: &[StepMap],
    ) -> Result<WalkController, ControlError> {
        let (pace, step_s) = (&self.plan.paces[0], self.phase.step_s);
        let feedback = self.feedback.with_settings(human, settings, step_s);
        let both = [&*self.feedback.impedances, &feedback.impedances];
        let maps = with_impedances(maps, &pace.plan, both, step_s).ok_or(ControlError::Riccati)?;
        let maps = activated(maps, feedback.left);
        let PlanGains { gains, at_join: value, along } = gains(human, &pace.plan, &maps, settings, step_s)?;
        let pace = Pace { gains, value, along, maps: feedback.kept(maps), ..Pace::clone(pace) };
        let plan = WalkPlan { paces: vec![Arc::new(pace)], standing: None, ..self.plan.clone() };
        Ok(WalkController { plan, feedback, recovery: None, ..self.clone() })
    }

    /// Mean square, over hips, knees, ankles and the lumbar joint, of the difference of their angles from the plan
    /// [rad²] and of their torques over the isometric strength of their muscles.
    pub(crate) fn deviation_and_effort(&self, now: &[[f64; 2]], torques: &[f64]) -> [f64; 2] {
        let (planned, carrying) = (self.plan.step(self.phase.at), &self.fall.carrying);
        let count = carrying.len().max(1) as f64;
        let apart = |&c: &usize| now[c][0] - planned.state[0][c];
        let used = |&c: &usize| torques[c] / self.feedback.impedances[c].isometric(now[c][0], torques[c]);
        let mean = |of: &dyn Fn(&usize) -> f64| carrying.iter().map(|c| of(c).powi(2)).sum::<f64>() / count;
        [mean(&apart), mean(&used)]
    }

    /// One controller of controllers of the same figure at several speeds: between them, plans and gains are mixed
    /// linearly. It starts as the first one, at its speed.
    ///
    /// # Errors
    /// Controllers of figures with other joints; none at all.
    pub fn joined(controllers: &[WalkController]) -> Result<WalkController, ControlError> {
        let count = |controller: &WalkController| controller.feedback.impedances.len();
        let wrong = |found: String| Err(ControlError::Joined { found });
        let Some(first) = controllers.first() else { return wrong("none".to_owned()) };
        for other in controllers {
            if count(other) != count(first) {
                return wrong(format!("one of {} coordinates and one of {}", count(first), count(other)));
            }
            if other.feedback.impedances != first.feedback.impedances {
                return wrong("two with different impedances or strengths".to_owned());
            }
        }
        let mut paces: Vec<Arc<Pace>> = controllers.iter().flat_map(|other| other.plan.paces.iter().cloned()).collect();
        paces.sort_by_number(|pace| pace.speed);
        Ok(WalkController { plan: WalkPlan { paces, ..first.plan.clone() }, ..first.clone() })
    }

    /// The same controller, which can stop, stand and walk off: speed 0 in [`WalkController::set_speed`]. `walk` and
    /// `settings` belong to its slowest speed.
    ///
    /// # Errors
    /// Movements that are not found; errors of [`WalkController::with_movements`].
    pub(crate) fn with_standing(
        self,
        human: &Human,
        walk: &Solution,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<WalkController, ControlError> {
        let mut movements = StandingMovements::find(human, walk)?;
        if self.recovery.is_some() {
            movements = movements.with_steps(human, walk)?;
        }
        self.with_movements(human, walk, &movements, step, settings)
    }

    /// As `WalkController::with_standing`, with movements that were found before. Steps out of standing, if there are
    /// any, are not used by a controller that plans no step again.
    ///
    /// # Errors
    /// A walk that is not the slowest one, movements of another walk, balance without feedback of the whole state,
    /// gains that cannot be computed.
    pub fn with_movements(
        mut self,
        human: &Human,
        walk: &Solution,
        movements: &StandingMovements,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<WalkController, ControlError> {
        let pace = &self.plan.paces[0];
        let value = pace.value.as_ref().filter(|_| (pace.speed - walk.speed()).abs() <= SPEED_ROUNDING);
        let value = value.ok_or(ControlError::Standing { found: walk.speed(), slowest: pace.speed })?;
        if !movements.join(walk) {
            return Err(ControlError::Movements { speed: walk.speed() });
        }
        let mut maker = Maker {
            human,
            figure: FigureWorld::new(human, walk.problem().shoes, step)?,
            impedances: &self.feedback.impedances,
            costs: costs(human, &pace.plan, settings, step.step_s),
            is_late: delay_steps(settings, step.step_s) > 0,
            left: self.feedback.left,
        };
        let steps = movements.steps.as_ref().filter(|_| self.recovery.is_some());
        let standing = maker.standing(movements, steps, &pace.plan, value, |q| self.plan.body.lowest(q))?;
        self.plan.standing = Some(Arc::new(standing));
        Ok(self)
    }

    /// The same controller by feedback alone: after a strong push no step is planned again, and none made out of
    /// standing.
    #[must_use]
    pub fn without_recovery_steps(self) -> WalkController {
        WalkController { recovery: None, ..self }
    }

    /// Starts in standing, if it can stand.
    #[must_use]
    pub(crate) fn starting_at_rest(mut self) -> WalkController {
        if self.plan.standing.is_some() {
            (self.phase.at.stage, self.phase.stands) = (Stage::Standing, true);
            self.plan.speed = self.plan.paces[0].speed;
        }
        self
    }

    /// Starts at a phase of the cycle (0 to 1), in which the feet are as planned.
    #[must_use]
    pub(crate) fn starting_at(mut self, phase: f64) -> WalkController {
        self.phase.at.share = phase.rem_euclid(1.0);
        self
    }

    /// The slowest and the fastest speed that it can walk at [m/s].
    #[must_use]
    pub fn speeds(&self) -> [f64; 2] {
        self.plan.speeds()
    }

    /// Sets the speed [m/s]. It may change in every step. With speed 0, a controller that can stand walks at its
    /// slowest speed until the left foot has left the ground, and then stops; with another speed it walks off as soon
    /// as it stands.
    ///
    /// # Errors
    /// A speed outside [`WalkController::speeds`] by more than rounding.
    pub fn set_speed(&mut self, speed: f64) -> Result<(), ControlError> {
        self.phase.stands = self.plan.standing.is_some() && speed.abs() <= SPEED_ROUNDING;
        self.plan.set_speed(if self.phase.stands { self.speeds()[0] } else { speed })
    }

    /// The speed of the plan now [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.plan.speed
    }

    /// The same plan and gains for another figure with the same joints: heights of the plan grow with its legs.
    #[must_use]
    pub fn of_figure(mut self, human: &Human) -> WalkController {
        self.plan.of_figure(human);
        self.phase.of_figure(&human.model);
        self
    }

    /// The same controller, which tries recovery steps with this figure.
    pub(super) fn predicting_with(mut self, figure: &FigureWorld) -> WalkController {
        if let Some(recovery) = &mut self.recovery {
            recovery.set_world(figure.clone());
        }
        self
    }

    /// Coordinates and rates of the plan at the present phase, with the soles at the height of the plan.
    #[must_use]
    pub fn start(&self) -> [Vec<f64>; 2] {
        self.plan.start(self.phase.at)
    }

    /// Phase of the cycle, 0 to 1; the right foot strikes near 0 and the left one near 0.5.
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.phase.at.share
    }

    /// Number of foot strikes so far.
    #[must_use]
    pub fn strikes(&self) -> usize {
        self.phase.strikes
    }

    /// Coordinates and rates of the plan at the present phase.
    #[must_use]
    pub fn planned(&self) -> [Vec<f64>; 2] {
        self.plan.step(self.phase.at).state
    }

    /// Whether the figure stands: it neither walks, nor stops or walks off.
    #[must_use]
    pub fn is_standing(&self) -> bool {
        self.phase.at.stage == Stage::Standing
    }

    /// The torques of the joints along the plan of the slowest speed, as harmonics of the cycle, without impedance and
    /// feedback.
    #[must_use]
    pub fn torque_series(&self) -> Vec<TorqueSeries> {
        self.plan.torque_series(&self.feedback.joints, self.phase.step_s)
    }

    /// The largest stiffness by which an angle acts on the torque of the same joint, impedance and feedback together
    /// [N.m/rad].
    #[must_use]
    pub fn largest_stiffness(&self, coordinate: CoordinateId) -> f64 {
        self.feedback.largest_stiffness(coordinate.index(), &self.plan)
    }

    /// Motors of the coordinates for the next time step; `None` for the coordinates of the root, on which nothing acts.
    /// `now` has value and rate of each coordinate, in the order of the figure; `loads_n` the vertical force on the
    /// right and the left foot in the last step.
    pub fn act(&mut self, now: &[[f64; 2]], loads_n: [f64; 2]) -> Vec<Option<Motor>> {
        // Coordinates that the plan does not have, such as the abduction of arms, come after the planned ones.
        let now = &now[..self.feedback.impedances.len()];
        let (plan, phase, sensed) = (&self.plan, &mut self.phase, Sensed { now, loads_n });
        phase.feel(plan, sensed);
        self.fall.watch_height(now[plan.root().up][0] - phase.level_m, phase.time_s, phase.strikes);
        if self.fall.fall().is_some() {
            return self.feedback.limp(now);
        }
        self.plan_recovery(sensed);
        let (plan, phase) = (&self.plan, &mut self.phase);
        let mut planned = plan.step(phase.at);
        if let Some(recovery) = &mut self.recovery {
            recovery.apply(plan, phase, &mut planned);
        }
        let motors = self.feedback.motors(plan, phase, &planned, sensed);
        self.fall.watch_limits(&motors, now, phase.time_s);
        phase.advance(plan, self.recovery.as_ref().map_or(0.0, Recovery::faster));
        motors
    }

    /// Plans the step under way again after a strong push, or a step out of standing.
    fn plan_recovery(&mut self, sensed: Sensed<'_>) {
        let Some(mut recovery) = self.recovery.take() else { return };
        if let Some(world) = recovery.due(self.phase.time_s) {
            let trial = |course, ahead_s| {
                let own = self.on_course(course, recovery.clone(), sensed);
                own.trial(FigureWorld::clone(&world), ahead_s, sensed)
            };
            let trials = Trials {
                present: Course { at: self.phase.at, change: recovery.change() },
                steps: self.plan.standing.as_ref().and_then(|standing| standing.stepping()),
                cost_to_go: &|| self.cost_to_go(sensed.now),
                trial: &trial,
            };
            let (chosen, wait_s) = trials.chosen();
            recovery.tried(world, self.phase.time_s + wait_s);
            if let Some(course) = chosen {
                self.take(course, &mut recovery, sensed);
            }
        }
        self.recovery = Some(recovery);
    }

    /// The same controller that takes a course, with the recovery steps of a trial.
    fn on_course(&self, course: Course, mut recovery: Recovery, sensed: Sensed<'_>) -> WalkController {
        let mut own = self.clone();
        own.take(course, &mut recovery, sensed);
        own.recovery = Some(recovery);
        own
    }

    fn take(&mut self, Course { at, change }: Course, recovery: &mut Recovery, sensed: Sensed<'_>) {
        if at != self.phase.at {
            self.phase.go_to(at, &self.plan, sensed);
            recovery.set_foot(self.plan.next_foot(at));
        }
        recovery.set_change(change);
    }

    /// Simulates the figure with this controller for a time [s], in a world of its own whose level ground is where
    /// it stands: the cost-to-go at the end, or the share of the time at which it fell.
    fn trial(mut self, mut world: FigureWorld, ahead_s: f64, sensed: Sensed<'_>) -> Result<f64, f64> {
        let own = &mut self;
        let [mut q, qd]: [Vec<f64>; 2] = [0, 1].map(|k| sensed.now.iter().map(|now| now[k]).collect());
        q[own.plan.root().up] -= own.phase.level_m;
        own.phase.level_m = 0.0;
        world.place(&q, &qd);
        let (mut loads_n, mut findings) = (sensed.loads_n, Findings::default());
        let steps = (ahead_s / world.settings.step_s) as usize;
        for step in 0..steps {
            for (c, motor) in own.act(&world.read(), loads_n).into_iter().enumerate() {
                motor.into_iter().for_each(|motor| world.drive(c, motor));
            }
            if own.fall().is_some() || world.step(&mut findings).is_err() {
                return Err(step as f64 / steps as f64);
            }
            loads_n = world.loads();
        }
        Ok(own.cost_to_go(&world.read()))
    }

    /// Cost of a deviation from the plan until it has passed, xᵀ P x with P of the Riccati equation; not a number where
    /// no step is planned again.
    fn cost_to_go(&self, now: &[[f64; 2]]) -> f64 {
        let (plan, phase) = (&self.plan, &self.phase);
        let apart = self.feedback.deviation(plan, phase, &plan.step(phase.at), now);
        plan.cost_to_go(phase.at, &apart).unwrap_or(f64::NAN)
    }

    /// The fall, once the pelvis was lower than 0.7 of its first height over the ground. Then joints are only damped.
    #[must_use]
    pub fn fall(&self) -> Option<Fall> {
        self.fall.fall()
    }
}
