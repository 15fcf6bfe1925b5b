//! The controller: phase, impedance and feedback of the state.

use super::figure::FigureWorld;
use super::foot_placement::{Followed, PlacedFeet};
use super::linear::{Impedance, with_impedances};
use super::pace::{Between, Pace};
use super::plan::{CyclePlan, PlannedStep, Root, STRIKE};
use super::riccati::{Costs, StepMap, foreseen};
use super::settings::{Balance, ControlError, ControlSettings, TrackingCosts};
use super::standing::{Maker, Stage, Standing};
use crate::engine::soles::lowest;
use crate::engine::{Motor, StepSettings};
use crate::kinematics::{Posture, body_motion};
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{CoordinateId, Model, Movement, Side};
use crate::optimal::{Solution, StandingMovements, StrengthCurve};
use crate::walking::TorqueSeries;
use nalgebra::{DMatrix, DVector};
use std::collections::VecDeque;
use std::sync::Arc;

/// Mass times stature of the adult of the settings [kg.m].
const ADULT: f64 = 75.0 * 1.75;
/// Share of the body weight below which a foot swings.
const SWING: f64 = 0.002;
/// A figure whose pelvis is lower than this share of its first height has fallen.
const FALLEN: f64 = 0.7;
/// A joint that was at its limit for the last time longer ago has nothing to do with a fall [s].
const LIMIT_MEMORY_S: f64 = 1.0;
/// Longest time that the phase waits for a strike [s].
const LONGEST_WAIT_S: f64 = 0.3;
/// A foot that was off the ground for a shorter time does not strike [s].
const SHORTEST_SWING_S: f64 = 0.2;
/// Largest feedback of the state at ankle and toes, as the load of the foot times a share of its length: more would turn a foot that does not stand
/// as firmly as planned, and the load on its edge would be lost.
const ANKLE_LEVER: f64 = 0.35;
const TOE_LEVER: f64 = 0.1;
/// Speeds that differ by less are the same [m/s].
const SPEED_ROUNDING: f64 = 1e-6;
/// A strike further from that of the plan does not change the phase; share of the cycle.
const FURTHEST: f64 = 0.25;

/// The figure, as far as heights of its soles depend on it.
#[derive(Debug, Clone)]
struct Body {
    model: Model,
    soles: Vec<ContactSphere>,
    leg_length: f64,
}

impl Body {
    fn of(human: &Human) -> Body {
        Body { model: human.model.clone(), soles: human.soles.clone(), leg_length: human.dimensions.leg_length }
    }

    /// Lowest point of the soles of the right and the left foot [m].
    fn lowest(&self, q: &[f64]) -> [f64; 2] {
        let still = vec![0.0; q.len()];
        let motions = body_motion(&self.model, Posture { q, qd: &still, qdd: &still });
        Side::BOTH.map(|side| lowest(self.soles.iter().filter(|sole| sole.side == side), &motions))
    }
}

/// A fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// Time since the controller began [s].
    pub time_s: f64,
    /// Foot strikes until then.
    pub strikes: usize,
    /// The first joint that needed clearly more than the strength of its muscles in the second before, and when [s].
    pub at_limit: Option<(CoordinateId, f64)>,
}

impl Fall {
    /// A sentence about the fall: time, steps and cause.
    pub(crate) fn told(&self, name: &str, model: &Model) -> String {
        let cause = self.at_limit.map_or("no torque was at its limit".to_owned(), |(id, since_s)| {
            format!(
                "the muscles of `{}` were at their strength from {since_s:.2} s",
                model.coordinates()[id.index()].name
            )
        });
        format!("{name} fell at {:.2} s after {} steps; {cause}", self.time_s, self.strikes)
    }
}

/// Walks a figure along a plan by torques of its joints.
#[derive(Debug, Clone)]
pub struct WalkController {
    /// Plans and gains by speed, the slowest first.
    paces: Vec<Arc<Pace>>,
    /// The present speed [m/s].
    speed: f64,
    /// Standing, and the ways there and back.
    standing: Option<Arc<Standing>>,
    stage: Stage,
    /// Whether it stands or is about to.
    stands: bool,
    impedances: Vec<Impedance>,
    joints: Vec<usize>,
    places: Vec<usize>,
    /// Hips, knees, ankles and lumbar joint: a figure may fall where their strength ends. Toes reach theirs in every step.
    carrying: Vec<usize>,
    /// Foot of ankles and toes, and the lever of its load by which feedback may turn it [m].
    feet: Vec<Option<(usize, f64)>>,
    /// Balance by foot placement instead of gains.
    placed_feet: Option<PlacedFeet>,
    body: Arc<Body>,
    /// The foot that struck last.
    stance: usize,
    /// Feedback that does not act yet, the oldest first.
    late: VecDeque<Vec<f64>>,
    /// Height of the ground on which the figure stands [m].
    level_m: f64,
    /// Hip height over that of the figure of the plan.
    taller: f64,
    step_s: f64,
    weight_n: f64,
    /// Share of the cycle.
    phase: f64,
    /// Time since each foot left the ground [s]; zero while it bears load.
    swing_s: [f64; 2],
    /// Time that the phase has waited for a foot [s].
    waited_s: f64,
    strikes: usize,
    /// Time since it began [s].
    time_s: f64,
    /// Height of the pelvis at the start [m].
    height_m: Option<f64>,
    /// The first joint that needed more than its strength, since when, and when one did last [s].
    at_limit: Option<(usize, f64, f64)>,
    fall: Option<Fall>,
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
        let (joints, places) = (plan.joints(), plan.places());
        let impedances = impedances(human, &joints, settings);
        let (gains, value) = if settings.balance == Balance::WholeState {
            let maps = FigureWorld::new(human, solution.problem().shoes, step)?.maps(&plan, &impedances)?;
            let (gains, value) = gains(human, &plan, &maps, settings, step.step_s)?;
            (gains, Some(value))
        } else {
            (Vec::new(), None)
        };
        let placed_feet = match settings.balance {
            Balance::FootPlacement(law) => Some(PlacedFeet::new(&human.model, law, size_of(human))?),
            Balance::Nothing | Balance::WholeState => None,
        };
        let body = Body::of(human);
        let soles_m = [0, 1].map(|foot| body.lowest(&plan.steps[plan.strikes[foot]].state[0])[foot]);
        Ok(WalkController {
            placed_feet,
            body: Arc::new(body),
            stance: 0,
            late: late(human, settings, step.step_s),
            level_m: 0.0,
            taller: 1.0,
            speed: solution.speed(),
            paces: vec![Arc::new(Pace { speed: solution.speed(), plan, gains, soles_m, value })],
            standing: None,
            stage: Stage::Walking,
            stands: false,
            impedances,
            carrying: joints.iter().copied().filter(|&c| share_of(human, c).0 >= 1.0).collect(),
            feet: feet(human),
            joints,
            places,
            step_s: step.step_s,
            weight_n: human.model.mass() * human.model.gravity().norm(),
            phase: 0.0,
            swing_s: [0.0; 2],
            waited_s: 0.0,
            strikes: 0,
            time_s: 0.0,
            height_m: None,
            at_limit: None,
            fall: None,
        })
    }

    /// The maps of the time steps of its plan, with its impedances.
    pub(crate) fn maps(
        &self,
        human: &Human,
        solution: &Solution,
        step: StepSettings,
    ) -> Result<Vec<StepMap>, ControlError> {
        FigureWorld::new(human, solution.problem().shoes, step)?.maps(&self.paces[0].plan, &self.impedances)
    }

    /// The controller of the same plan with other settings; `maps` are those of this one.
    pub(crate) fn with_settings(
        &self,
        human: &Human,
        settings: &ControlSettings,
        maps: &[StepMap],
    ) -> Result<WalkController, ControlError> {
        let plan = &self.paces[0].plan;
        let impedances = impedances(human, &self.joints, settings);
        let maps = with_impedances(maps, plan, [&self.impedances, &impedances], self.step_s);
        let (gains, value) = gains(human, plan, &maps.ok_or(ControlError::Riccati)?, settings, self.step_s)?;
        let pace = Pace { gains, value: Some(value), ..Pace::clone(&self.paces[0]) };
        let late = late(human, settings, self.step_s);
        Ok(WalkController { paces: vec![Arc::new(pace)], standing: None, impedances, late, ..self.clone() })
    }

    /// Mean square, over hips, knees, ankles and the lumbar joint, of the difference of their angles from the plan [rad²] and of their torques over
    /// the isometric strength of their muscles.
    pub(crate) fn deviation_and_effort(&self, now: &[[f64; 2]], torques: &[f64]) -> [f64; 2] {
        let planned = self.planned_step();
        let count = self.carrying.len().max(1) as f64;
        let apart = |&c: &usize| now[c][0] - planned.state[0][c];
        let used = |&c: &usize| torques[c] / self.impedances[c].isometric(now[c][0], torques[c]);
        let mean = |of: &dyn Fn(&usize) -> f64| self.carrying.iter().map(|c| of(c).powi(2)).sum::<f64>() / count;
        [mean(&apart), mean(&used)]
    }

    /// One controller of controllers of the same figure at several speeds: between them, plans and gains are mixed linearly. It starts as the
    /// first one, at its speed.
    ///
    /// # Errors
    /// Controllers of figures with other joints; none at all.
    pub fn joined(controllers: &[WalkController]) -> Result<WalkController, ControlError> {
        let count = |controller: &WalkController| controller.impedances.len();
        let wrong = |found: String| Err(ControlError::Joined { found });
        let Some(first) = controllers.first() else { return wrong("none".to_owned()) };
        for other in controllers {
            if count(other) != count(first) {
                return wrong(format!("one of {} coordinates and one of {}", count(first), count(other)));
            }
            if other.impedances != first.impedances {
                return wrong("two with different impedances or strengths".to_owned());
            }
        }
        let mut paces: Vec<Arc<Pace>> = controllers.iter().flat_map(|other| other.paces.iter().cloned()).collect();
        paces.sort_by(|a, b| a.speed.total_cmp(&b.speed));
        Ok(WalkController { paces, ..first.clone() })
    }

    /// The same controller, which can stop, stand and walk off: speed 0 in [`WalkController::set_speed`]. `walk` and `settings` are those of its
    /// slowest speed.
    ///
    /// # Errors
    /// Movements that are not found; those of [`WalkController::with_movements`].
    pub fn with_standing(
        self,
        human: &Human,
        walk: &Solution,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<WalkController, ControlError> {
        let movements = StandingMovements::find(human, walk)?;
        self.with_movements(human, walk, &movements, step, settings)
    }

    /// As [`WalkController::with_standing`], with movements that were found before.
    ///
    /// # Errors
    /// A walk that is not the slowest one, movements of another walk, balance without feedback of the whole state, gains that cannot be computed.
    pub fn with_movements(
        mut self,
        human: &Human,
        walk: &Solution,
        movements: &StandingMovements,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<WalkController, ControlError> {
        let pace = &self.paces[0];
        let value = pace.value.as_ref().filter(|_| (pace.speed - walk.speed()).abs() <= SPEED_ROUNDING);
        let value = value.ok_or(ControlError::Standing { found: walk.speed(), slowest: pace.speed })?;
        if !movements.join(walk) {
            return Err(ControlError::Movements { speed: walk.speed() });
        }
        let [state, input] = costs(human, &pace.plan, &settings.costs, step.step_s);
        let mut maker = Maker {
            human,
            figure: FigureWorld::new(human, walk.problem().shoes, step)?,
            impedances: &self.impedances,
            costs: Costs { state, input },
            delay: delay_steps(settings, step.step_s),
        };
        let standing = maker.standing(movements, &pace.plan, value, |q| self.body.lowest(q))?;
        self.standing = Some(Arc::new(standing));
        Ok(self)
    }

    /// Starts in standing, if it can stand.
    #[must_use]
    pub fn starting_at_rest(mut self) -> WalkController {
        if self.standing.is_some() {
            (self.stage, self.stands) = (Stage::Standing, true);
            self.speed = self.paces[0].speed;
        }
        self
    }

    /// Starts at a phase of the cycle (0 to 1), in which the feet are as planned.
    #[must_use]
    pub fn starting_at(mut self, phase: f64) -> WalkController {
        self.phase = phase.rem_euclid(1.0);
        self
    }

    /// The slowest and the fastest speed that it can walk at [m/s].
    #[must_use]
    pub fn speeds(&self) -> [f64; 2] {
        [&self.paces[0], &self.paces[self.paces.len() - 1]].map(|pace| pace.speed)
    }

    /// Sets the speed [m/s]. It may change in every step. With speed 0, a controller that can stand walks at its slowest speed until the left foot has
    /// left the ground, and then stops; with another speed it walks off as soon as it stands.
    ///
    /// # Errors
    /// A speed outside [`WalkController::speeds`] by more than rounding.
    pub fn set_speed(&mut self, speed: f64) -> Result<(), ControlError> {
        let [slowest, fastest] = self.speeds();
        self.stands = self.standing.is_some() && speed.abs() <= SPEED_ROUNDING;
        let speed = if self.stands { slowest } else { speed };
        if !(slowest - SPEED_ROUNDING..=fastest + SPEED_ROUNDING).contains(&speed) {
            return Err(ControlError::Speed { found: speed, slowest, fastest });
        }
        self.speed = speed.clamp(slowest, fastest);
        Ok(())
    }

    /// The speed of the plan now [m/s].
    #[must_use]
    pub fn speed(&self) -> f64 {
        self.speed
    }

    fn between(&self) -> Between<'_> {
        let above = self.paces.iter().position(|pace| pace.speed >= self.speed).unwrap_or(self.paces.len() - 1);
        let [slow, fast] = [above.saturating_sub(1), above].map(|k| &*self.paces[k]);
        let apart = fast.speed - slow.speed;
        if apart <= 0.0 || self.speed >= fast.speed {
            return Between { paces: [fast, fast], share: 0.0 };
        }
        Between { paces: [slow, fast], share: (self.speed - slow.speed) / apart }
    }

    fn root(&self) -> &Root {
        &self.paces[0].plan.root
    }

    /// The same plan and gains for another figure with the same joints: heights of the plan grow with its legs.
    #[must_use]
    pub fn of_figure(mut self, human: &Human) -> WalkController {
        self.taller *= human.dimensions.leg_length / self.body.leg_length;
        self.weight_n = human.model.mass() * human.model.gravity().norm();
        self.body = Arc::new(Body::of(human));
        self
    }

    /// Coordinates and rates of the plan at the present phase, with the soles at the height of the plan.
    #[must_use]
    pub fn start(&self) -> [Vec<f64>; 2] {
        let [mut q, qd] = self.planned();
        let up = self.root().up;
        q[up] *= self.taller;
        let lowest = self.body.lowest(&q).into_iter().fold(f64::INFINITY, f64::min);
        let planned = match &self.standing {
            Some(standing) if self.stage != Stage::Walking => standing.soles_m[0].min(standing.soles_m[1]),
            _ => self.between().mix(|pace| pace.soles_m[0].min(pace.soles_m[1])),
        };
        q[up] += planned - lowest;
        [q, qd]
    }

    /// Phase of the cycle, 0 to 1; the right foot strikes near 0 and the left one near 0.5.
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.phase
    }

    /// Number of foot strikes so far.
    #[must_use]
    pub fn strikes(&self) -> usize {
        self.strikes
    }

    /// Coordinates and rates of the plan at the present phase.
    #[must_use]
    pub fn planned(&self) -> [Vec<f64>; 2] {
        self.planned_step().state
    }

    fn planned_step(&self) -> PlannedStep {
        let standing = self.standing.as_ref().and_then(|standing| standing.planned(self.stage));
        standing.cloned().unwrap_or_else(|| self.between().planned(self.phase))
    }

    /// Whether it stands: neither walks, nor stops or walks off.
    #[must_use]
    pub fn is_standing(&self) -> bool {
        self.stage == Stage::Standing
    }

    /// The torques of the joints along the plan of the slowest speed, as harmonics of the cycle, without impedance and feedback.
    #[must_use]
    pub fn torque_series(&self) -> Vec<TorqueSeries> {
        let plan = &self.paces[0].plan;
        let (middles, model) = (plan.middles(), &self.body.model);
        let of = |&c: &usize| {
            let about = [plan.steps.len() as f64 * self.step_s, model.mass()];
            TorqueSeries::of(&model.coordinates()[c].name, about, &middles, &plan.torques(c))
        };
        self.joints.iter().map(of).collect()
    }

    /// The largest stiffness by which an angle acts on the torque of its own joint, impedance and feedback together [N.m/rad]: names are those of
    /// the figure's coordinates.
    #[must_use]
    pub fn largest_stiffness(&self, coordinate: CoordinateId) -> f64 {
        let c = coordinate.index();
        let own = self.impedances[c].stiffness;
        let row = self.joints.iter().position(|joint| *joint == c);
        let column = self.places.iter().position(|place| *place == c);
        let (Some(row), Some(column)) = (row, column) else { return own };
        let of_walks = self.paces.iter().flat_map(|pace| &pace.gains);
        let gains = of_walks.chain(self.standing.iter().flat_map(|standing| standing.gains()));
        gains.map(|gain| gain[(row, column)] + own).fold(own, f64::max)
    }

    /// Motors of the coordinates for the next time step; `None` for those of the root, on which nothing acts. `now` has value and rate of each
    /// coordinate, in the order of the figure, `loads_n` the vertical force on the right and the left foot in the last step.
    pub fn act(&mut self, now: &[[f64; 2]], loads_n: [f64; 2]) -> Vec<Option<Motor>> {
        // Coordinates that the plan does not have, such as the abduction of arms, follow those of the plan.
        let now = &now[..self.impedances.len()];
        self.feel(now, loads_n);
        self.look_for_a_fall(now);
        if self.fall.is_some() {
            let limp =
                |(impedance, now): (&Impedance, &[f64; 2])| (impedance.stiffness > 0.0).then(|| impedance.limp(*now));
            return self.impedances.iter().zip(now).map(limp).collect();
        }
        let planned = self.planned_step();
        let feedback = self.delayed(self.feedback(&planned, now, loads_n));
        let motor = |(c, impedance): (usize, &Impedance)| {
            let target = [planned.target[0][c], planned.target[1][c]];
            (impedance.stiffness > 0.0).then(|| impedance.motor(target, planned.torques[c] + feedback[c], now[c]))
        };
        let motors: Vec<Option<Motor>> = self.impedances.iter().enumerate().map(motor).collect();
        self.watch_limits(&motors, now);
        self.advance();
        motors
    }

    /// The feedback that acts now, if `feedback` is the one of the present state.
    fn delayed(&mut self, feedback: Vec<f64>) -> Vec<f64> {
        self.late.push_back(feedback);
        self.late.pop_front().unwrap_or_default()
    }

    /// Torque of each coordinate from the deviation of the state [N.m].
    fn feedback(&self, planned: &PlannedStep, now: &[[f64; 2]], loads_n: [f64; 2]) -> Vec<f64> {
        let mut feedback = vec![0.0; now.len()];
        if let Some(law) = &self.placed_feet {
            let [q, qd]: [Vec<f64>; 2] = [0, 1].map(|k| now.iter().map(|now| now[k]).collect());
            let planned = [&*planned.state[0], &*planned.state[1]];
            let state = Followed { now: [&q, &qd], planned };
            for (hip, torque) in law.torques(&self.body.model, &self.impedances, &state, self.stance) {
                feedback[hip] = torque;
            }
            return feedback;
        }
        let up = self.root().up;
        let higher = self.level_m + (self.taller - 1.0) * planned.state[0][up];
        let places = self.places.iter().map(|&c| now[c][0] - planned.state[0][c] - if c == up { higher } else { 0.0 });
        let rates = (0..now.len()).map(|c| now[c][1] - planned.state[1][c]);
        let apart = DVector::from_iterator(self.places.len() + now.len(), places.chain(rates));
        let of_standing = self.standing.as_ref().and_then(|standing| standing.feedback(self.stage, &apart));
        if let Some(torques) = of_standing.or_else(|| self.between().feedback(self.phase, &apart)) {
            for (joint, torque) in self.joints.iter().zip(torques.iter()) {
                let most = self.feet[*joint].map_or(f64::INFINITY, |(foot, lever_m)| lever_m * loads_n[foot].max(0.0));
                feedback[*joint] = (-torque).clamp(-most, most);
            }
        }
        feedback
    }

    /// The fall, once the pelvis was lower than 0.7 of its first height over the ground. Then joints are only damped.
    #[must_use]
    pub fn fall(&self) -> Option<Fall> {
        self.fall
    }

    fn look_for_a_fall(&mut self, now: &[[f64; 2]]) {
        let height = now[self.root().up][0] - self.level_m;
        // A height that is not a number is none.
        let stands = height >= FALLEN * *self.height_m.get_or_insert(height);
        if self.fall.is_none() && !stands {
            let at_limit = self.at_limit.map(|(c, since_s, _)| (CoordinateId(c), since_s));
            self.fall = Some(Fall { time_s: self.time_s, strikes: self.strikes, at_limit });
        }
    }

    fn watch_limits(&mut self, motors: &[Option<Motor>], now: &[[f64; 2]]) {
        let is_limited = |c: &usize| motors[*c].as_ref().is_some_and(|motor| Impedance::is_overloaded(motor, now[*c]));
        let first = self.carrying.iter().copied().find(is_limited);
        self.at_limit = match (self.at_limit, first) {
            (Some((c, since_s, _)), Some(_)) => Some((c, since_s, self.time_s)),
            (None, Some(c)) => Some((c, self.time_s, self.time_s)),
            (known, None) => known.filter(|(_, _, last_s)| self.time_s - last_s < LIMIT_MEMORY_S),
        };
    }

    /// The phase advances with time, but waits for a foot that has not struck when it should.
    fn advance(&mut self) {
        self.time_s += self.step_s;
        if let Some(standing) = self.standing.as_ref().filter(|_| self.stage != Stage::Walking) {
            self.stage = standing.next(self.stage, self.stands);
            self.phase = StandingMovements::JOINS[usize::from(self.stage == Stage::Walking)];
            return;
        }
        let between = self.between();
        let step = 1.0 / between.mix(|pace| pace.plan.steps.len() as f64);
        let is_late = |foot: usize| {
            let until = (between.strike(foot) - self.phase).rem_euclid(1.0);
            until <= 1.5 * step && self.swing_s[foot] > SHORTEST_SWING_S
        };
        let late = is_late(0) || is_late(1);
        self.waited_s = if late { self.waited_s + self.step_s } else { 0.0 };
        if !late || self.waited_s > LONGEST_WAIT_S {
            let until = (StandingMovements::JOINS[0] - self.phase).rem_euclid(1.0);
            self.phase = (self.phase + step).rem_euclid(1.0);
            if self.stands && until > 0.0 && until <= step {
                self.stage = Stage::Stopping(0);
            }
        }
    }

    /// Sets the phase to that of the plan when a foot strikes, and the level of the ground to that under the foot.
    fn feel(&mut self, now: &[[f64; 2]], loads_n: [f64; 2]) {
        for (foot, load) in loads_n.into_iter().enumerate() {
            if load > STRIKE * self.weight_n {
                if self.swing_s[foot] > SHORTEST_SWING_S {
                    self.strikes += 1;
                    if self.stage == Stage::Walking {
                        self.strike(foot);
                        let q: Vec<f64> = now.iter().map(|now| now[0]).collect();
                        let planned = self.between().mix(|pace| pace.soles_m[foot]);
                        self.level_m = self.body.lowest(&q)[foot] - planned;
                    }
                }
                self.swing_s[foot] = 0.0;
            } else if load < SWING * self.weight_n {
                self.swing_s[foot] += self.step_s;
            }
        }
    }

    fn strike(&mut self, foot: usize) {
        self.stance = foot;
        let planned = self.between().strike(foot);
        let ahead = (planned - self.phase).rem_euclid(1.0);
        if ahead.min(1.0 - ahead) < FURTHEST {
            self.phase = planned;
        }
    }
}

/// Share of the settings that a joint has, and its movement.
fn share_of(human: &Human, coordinate: usize) -> (f64, Option<Movement>) {
    let anatomy = human.model.anatomy();
    let movement = anatomy.meaning(CoordinateId(coordinate)).map(|meaning| meaning.movement);
    let share = match movement {
        Some(Movement::ToeExtension) => 0.2,
        Some(Movement::HipFlexion | Movement::KneeFlexion | Movement::AnkleDorsiflexion | Movement::TrunkLean) => 1.0,
        _ => 0.3,
    };
    (share, movement)
}

/// Foot and lever of each coordinate that turns a foot or its toes.
fn feet(human: &Human) -> Vec<Option<(usize, f64)>> {
    let anatomy = human.model.anatomy();
    let of = |id: CoordinateId| {
        let meaning = anatomy.meaning(id)?;
        let share = match meaning.movement {
            Movement::AnkleDorsiflexion => ANKLE_LEVER,
            Movement::ToeExtension => TOE_LEVER,
            _ => return None,
        };
        Some((usize::from(meaning.side? == Side::Left), share * human.dimensions.foot_length))
    };
    human.model.coordinate_ids().map(of).collect()
}

fn size_of(human: &Human) -> f64 {
    human.model.mass() * human.build.height / ADULT
}

fn impedances(human: &Human, joints: &[usize], settings: &ControlSettings) -> Vec<Impedance> {
    let of = |c: usize| {
        let (share, movement) = share_of(human, c);
        let is_driven = if joints.contains(&c) { 1.0 } else { 0.0 };
        let stiffness = is_driven * settings.stiffness * share * size_of(human);
        let strength = StrengthCurve::of_movement(movement, human.model.mass(), human.build.height);
        let sign = human.model.anatomy().meaning(CoordinateId(c)).map_or(1.0, |meaning| meaning.sign);
        let strength = if sign < 0.0 { strength.reversed() } else { strength };
        Impedance { stiffness, damping: stiffness * settings.damping_s, strength }
    };
    (0..human.model.coordinates().len()).map(of).collect()
}

/// Steps after which feedback acts.
fn delay_steps(settings: &ControlSettings, step_s: f64) -> usize {
    (settings.delay_s / step_s).round() as usize
}

/// The feedback that acts before the first one arrives: none.
fn late(human: &Human, settings: &ControlSettings, step_s: f64) -> VecDeque<Vec<f64>> {
    VecDeque::from(vec![vec![0.0; human.model.coordinates().len()]; delay_steps(settings, step_s)])
}

/// Gains of all steps of a plan with these maps, and the matrix P of [`Pace::value`].
fn gains(
    human: &Human,
    plan: &CyclePlan,
    maps: &[StepMap],
    settings: &ControlSettings,
    step_s: f64,
) -> Result<(Vec<DMatrix<f64>>, DMatrix<f64>), ControlError> {
    let [state, input] = costs(human, plan, &settings.costs, step_s);
    let (costs, delay) = (Costs { state, input }, delay_steps(settings, step_s));
    let (gains, mut value) = costs.periodic(maps).ok_or(ControlError::Riccati)?;
    let joined = (plan.step_at(StandingMovements::JOINS[1]) + delay) % maps.len();
    costs.gains(&maps[joined..], &mut value).ok_or(ControlError::Riccati)?;
    Ok((foreseen(maps, &gains, delay), value))
}

/// The diagonal matrices Q and R of a time step.
fn costs(human: &Human, plan: &CyclePlan, costs: &TrackingCosts, step_s: f64) -> [DMatrix<f64>; 2] {
    let Root { forward, up, sideways, turns } = &plan.root;
    let place = |c: usize| match c {
        c if c == *up => costs.height,
        c if Some(c) == *sideways => costs.sideways,
        c if turns.contains(&c) => costs.pelvis,
        _ => costs.angle,
    };
    let rate = |c: usize| match c {
        c if c == *forward || Some(c) == *sideways => costs.velocity[0],
        c if c == *up => costs.velocity[1],
        _ => costs.rate,
    };
    let torque = |c: &usize| costs.torque * share_of(human, *c).0 * size_of(human);
    let of_state = plan.places().into_iter().map(place).chain((0..human.model.coordinates().len()).map(rate));
    let of_input = plan.joints();
    let diagonal = |deviations: Vec<f64>| {
        let squares = deviations.iter().map(|deviation| step_s / (deviation * deviation));
        DMatrix::from_diagonal(&DVector::from_iterator(deviations.len(), squares))
    };
    [diagonal(of_state.collect()), diagonal(of_input.iter().map(torque).collect())]
}
