//! The controller: phase, impedance and feedback of the state.

use super::linear::{FigureWorld, Impedance};
use super::plan::{CyclePlan, STRIKE};
use super::riccati::periodic_gains;
use super::settings::{ControlError, ControlSettings, TrackingCosts};
use crate::kinematics::{Posture, body_motion};
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{CoordinateId, Model, Movement, Side};
use crate::optimal::strength_of;
use crate::simulation::consistent_walk::ConsistentWalk;
use crate::simulation::{Motor, StepSettings};
use nalgebra::{DMatrix, DVector};
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
        Side::BOTH.map(|side| {
            let of_side = self.soles.iter().filter(|sole| sole.side == side);
            let height = |sole: &ContactSphere| motions[sole.body.index()].pose.place(sole.center).y - sole.radius;
            of_side.map(height).fold(f64::INFINITY, f64::min)
        })
    }
}

/// A fall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fall {
    /// Time since the controller began [s].
    pub time_s: f64,
    /// Foot strikes until then.
    pub strikes: usize,
    /// The first joint torque that reached the strength of its muscles in the second before, and when [s].
    pub at_limit: Option<(CoordinateId, f64)>,
}

/// Walks a figure along a plan by torques of its joints.
#[derive(Debug, Clone)]
pub struct WalkController {
    plan: Arc<CyclePlan>,
    /// Gains of each time step: one row per joint, one column per entry of the state. Empty without feedback.
    gains: Arc<Vec<DMatrix<f64>>>,
    impedances: Vec<Impedance>,
    joints: Vec<usize>,
    places: Vec<usize>,
    /// Hips, knees, ankles and lumbar joint: a figure may fall where their strength ends. Toes reach theirs in every step.
    carrying: Vec<usize>,
    /// Foot of ankles and toes, and the lever of its load by which feedback may turn it [m].
    feet: Vec<Option<(usize, f64)>>,
    body: Arc<Body>,
    /// Height of the sole of the right and the left foot when it strikes, in the plan [m].
    soles_m: [f64; 2],
    /// Height of the ground on which the figure stands [m].
    level_m: f64,
    /// Hip height over that of the figure of the plan.
    taller: f64,
    step_s: f64,
    weight_n: f64,
    /// Number of the time step of the plan.
    phase: usize,
    /// Time since each foot left the ground [s]; zero while it bears load.
    swing_s: [f64; 2],
    /// Time that the phase has waited for a foot [s].
    waited_s: f64,
    strikes: usize,
    /// Time since it began [s].
    time_s: f64,
    /// Height of the pelvis at the start [m].
    height_m: Option<f64>,
    /// The first joint at its limit, since when, and when one was last [s].
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
        walk: &ConsistentWalk,
        step: StepSettings,
        settings: &ControlSettings,
    ) -> Result<WalkController, ControlError> {
        let mut plan = CyclePlan::new(human, walk, step.step_s)?;
        if let Some(count) = settings.harmonics {
            plan.keep_harmonics(count);
        }
        let (joints, places) = (plan.joints(), plan.places());
        let impedances = impedances(human, &joints, settings);
        let gains = if settings.feedback {
            let maps = FigureWorld::new(human, walk, step)?.maps(&plan, &impedances)?;
            let [of_state, of_input] = costs(human, &plan, &settings.costs, step.step_s);
            periodic_gains(&maps, &of_state, &of_input).ok_or(ControlError::Riccati)?
        } else {
            Vec::new()
        };
        let body = Body::of(human);
        let soles_m = [0, 1].map(|foot| body.lowest(&plan.steps[plan.strikes[foot]].state[0])[foot]);
        Ok(WalkController {
            body: Arc::new(body),
            soles_m,
            level_m: 0.0,
            taller: 1.0,
            plan: Arc::new(plan),
            gains: Arc::new(gains),
            impedances,
            carrying: joints.iter().copied().filter(|&c| share_of(human, c).0 >= 1.0).collect(),
            feet: feet(human),
            joints,
            places,
            step_s: step.step_s,
            weight_n: human.model.mass() * human.model.gravity().norm(),
            phase: 0,
            swing_s: [0.0; 2],
            waited_s: 0.0,
            strikes: 0,
            time_s: 0.0,
            height_m: None,
            at_limit: None,
            fall: None,
        })
    }

    /// Starts at a phase of the cycle (0 to 1), in which the feet are as planned.
    #[must_use]
    pub fn starting_at(mut self, phase: f64) -> WalkController {
        self.phase = (phase.rem_euclid(1.0) * self.steps() as f64) as usize % self.steps();
        self
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
        let [mut q, qd] = self.planned().clone();
        let up = self.plan.root[1];
        q[up] *= self.taller;
        let lowest = self.body.lowest(&q).into_iter().fold(f64::INFINITY, f64::min);
        let [right, left] = self.soles_m;
        q[up] += right.min(left) - lowest;
        [q, qd]
    }

    /// Phase of the cycle, 0 to 1; the right foot strikes at 0 and the left one at 0.5.
    #[must_use]
    pub fn phase(&self) -> f64 {
        self.phase as f64 / self.steps() as f64
    }

    /// Number of foot strikes so far.
    #[must_use]
    pub fn strikes(&self) -> usize {
        self.strikes
    }

    /// Coordinates and rates of the plan at the present phase.
    #[must_use]
    pub fn planned(&self) -> &[Vec<f64>; 2] {
        &self.plan.steps[self.phase].state
    }

    fn steps(&self) -> usize {
        self.plan.steps.len()
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
        self.gains.iter().map(|gain| gain[(row, column)] + own).fold(own, f64::max)
    }

    /// Motors of the coordinates for the next time step; `None` for those of the root, on which nothing acts. `now` has value and rate of each
    /// coordinate, in the order of the figure, `loads_n` the vertical force on the right and the left foot in the last step.
    pub fn act(&mut self, now: &[[f64; 2]], loads_n: [f64; 2]) -> Vec<Option<Motor>> {
        // Coordinates that the plan does not have, such as the abduction of arms, follow those of the plan.
        let now = &now[..self.impedances.len()];
        self.feel(now, loads_n);
        self.look_for_a_fall(now);
        if self.fall.is_some() {
            let limp = |impedance: &Impedance| (impedance.stiffness > 0.0).then(|| impedance.limp());
            return self.impedances.iter().map(limp).collect();
        }
        let planned = &self.plan.steps[self.phase];
        let mut feedback = vec![0.0; now.len()];
        if let Some(gain) = self.gains.get(self.phase) {
            let up = self.plan.root[1];
            let higher = self.level_m + (self.taller - 1.0) * planned.state[0][up];
            let places =
                self.places.iter().map(|&c| now[c][0] - planned.state[0][c] - if c == up { higher } else { 0.0 });
            let rates = (0..now.len()).map(|c| now[c][1] - planned.state[1][c]);
            let apart = DVector::from_iterator(self.places.len() + now.len(), places.chain(rates));
            for (joint, torque) in self.joints.iter().zip((gain * apart).iter()) {
                let most = self.feet[*joint].map_or(f64::INFINITY, |(foot, lever_m)| lever_m * loads_n[foot].max(0.0));
                feedback[*joint] = (-torque).clamp(-most, most);
            }
        }
        let motor = |(c, impedance): (usize, &Impedance)| {
            let target = [planned.target[0][c], planned.target[1][c]];
            (impedance.stiffness > 0.0).then(|| impedance.motor(target, planned.torques[c] + feedback[c], now[c]))
        };
        let motors: Vec<Option<Motor>> = self.impedances.iter().enumerate().map(motor).collect();
        self.watch_limits(&motors, now);
        self.advance();
        motors
    }

    /// The fall, once the pelvis was lower than 0.7 of its first height over the ground. Then joints are only damped.
    #[must_use]
    pub fn fall(&self) -> Option<Fall> {
        self.fall
    }

    fn look_for_a_fall(&mut self, now: &[[f64; 2]]) {
        let height = now[self.plan.root[1]][0] - self.level_m;
        let first = *self.height_m.get_or_insert(height);
        // Also if it is not a number.
        if self.fall.is_none() && !(height >= FALLEN * first) {
            let at_limit = self.at_limit.map(|(c, since_s, _)| (CoordinateId(c), since_s));
            self.fall = Some(Fall { time_s: self.time_s, strikes: self.strikes, at_limit });
        }
    }

    fn watch_limits(&mut self, motors: &[Option<Motor>], now: &[[f64; 2]]) {
        let is_limited = |c: &usize| motors[*c].as_ref().is_some_and(|motor| Impedance::is_at_limit(motor, now[*c]));
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
        let next = (self.phase + 1) % self.steps();
        let late = (0..2).any(|foot| self.plan.strikes[foot] == next && self.swing_s[foot] > SHORTEST_SWING_S);
        self.waited_s = if late { self.waited_s + self.step_s } else { 0.0 };
        if !late || self.waited_s > LONGEST_WAIT_S {
            self.phase = next;
        }
    }

    /// Sets the phase to that of the plan when a foot strikes, and the level of the ground to that under the foot.
    fn feel(&mut self, now: &[[f64; 2]], loads_n: [f64; 2]) {
        for (foot, load) in loads_n.into_iter().enumerate() {
            if load > STRIKE * self.weight_n {
                if self.swing_s[foot] > SHORTEST_SWING_S {
                    self.strikes += 1;
                    self.strike(foot);
                    let q: Vec<f64> = now.iter().map(|now| now[0]).collect();
                    self.level_m = self.body.lowest(&q)[foot] - self.soles_m[foot];
                }
                self.swing_s[foot] = 0.0;
            } else if load < SWING * self.weight_n {
                self.swing_s[foot] += self.step_s;
            }
        }
    }

    fn strike(&mut self, foot: usize) {
        let steps = self.steps();
        let planned = self.plan.strikes[foot];
        let early = (planned + steps - self.phase) % steps;
        let apart = early.min(steps - early);
        if (apart as f64) < FURTHEST * steps as f64 {
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
    let weight_height = human.model.mass() * human.model.gravity().norm() * human.build.height;
    let of = |c: usize| {
        if !joints.contains(&c) {
            return Impedance { stiffness: 0.0, damping: 0.0, strength: [0.0; 2] };
        }
        let (share, movement) = share_of(human, c);
        let stiffness = settings.stiffness * share * size_of(human);
        let [with, against] = strength_of(movement).map(|strength| strength * weight_height);
        let sign = human.model.anatomy().meaning(CoordinateId(c)).map_or(1.0, |meaning| meaning.sign);
        let strength = if sign < 0.0 { [against, with] } else { [with, against] };
        Impedance { stiffness, damping: stiffness * settings.damping_s, strength }
    };
    (0..human.model.coordinates().len()).map(of).collect()
}

/// The diagonal matrices Q and R of a time step.
fn costs(human: &Human, plan: &CyclePlan, costs: &TrackingCosts, step_s: f64) -> [DMatrix<f64>; 2] {
    let [forward, up, turn] = plan.root;
    let place = |c: usize| match c {
        c if c == up => costs.height,
        c if c == turn => costs.pelvis,
        _ => costs.angle,
    };
    let rate = |c: usize| match c {
        c if c == forward => costs.velocity[0],
        c if c == up => costs.velocity[1],
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
