//! Movements that do not repeat: a figure that begins and ends at rest, such as a squat, a jump, or standing up from a
//! chair.
//!
//! Key postures give the first guess: joint angles change smoothly from one to the next, the soles are level, and the
//! lowest sphere touches the ground. Only the first and the last key are part of the problem: there the figure rests.
//! The motion in between follows from requirements and from the cost of muscles.

use super::conditions::WalkConditions;
use super::error::OptimalWalkError;
use super::instant::{Evaluator, Instant};
use super::layout::Span;
use super::muscles::{EffortCosts, MuscleTerms};
use super::near::{NEAR_STAGES, longer};
use super::objective::{Bound, Quantity, Term};
use super::observer::Observer;
use super::problem::Problem;
use super::solution::Solution;
use super::solve::Continuation;
use super::walk::{STAGES, soles_with_width};
use crate::contact::HuntCrossley;
use crate::dynamics::CurvedJointError;
use crate::model::anthropometry::{ContactSphere, Human};
use crate::model::{Coordinate, CoordinateId, CoordinateKind, Model, Movement, Side};
use std::fmt;
use std::ops::Range;

const DEGREE: f64 = std::f64::consts::PI / 180.0;
/// Deviations that cost 1 in the first and the last instant: joint angles [rad]; rates [rad/s, m/s]; accelerations
/// [rad/s², m/s²].
const REST: [f64; 3] = [3.0 * DEGREE, 0.005, 0.02];
/// Deviations that cost 1 where a movement begins or ends in another motion: coordinates [rad, m] and rates [rad/s,
/// m/s].
const JOINED: [f64; 2] = [0.0005, 0.004];
/// Deviations from the first guess that cost 1 while the solver is still guided by it: angles [rad], positions of the
/// pelvis [m].
const GUIDE: [f64; 2] = [10.0 * DEGREE, 0.1];
/// Weight of the first guess in the second round of stages; it is 1 in the first and 0 in the last.
const LESS_GUIDED: f64 = 0.1;
/// Slip velocity of a loaded sphere that costs 1 [m/s].
const SLIP: f64 = 0.02;
/// Force on a sphere at which its slip counts half [body weights].
const LIGHT: f64 = 0.05;
/// Excess over the range of a joint that costs 1 [rad].
const BEYOND: f64 = DEGREE;
/// Name of the terms of the first and the last instants.
pub(super) const END: &str = "end";
/// Instants per knot interval.
const PER_KNOT: usize = 2;

/// A posture at a time: joint angles [deg] by clinical movement, the same on both sides; what is not named is 0.
/// Without [`Movement::PelvicTilt`], the pelvis tilts so that the soles are level.
#[derive(Debug, Clone, PartialEq)]
pub struct Key {
    /// Time [s].
    pub time_s: f64,
    /// Joint angles [deg].
    pub angles_deg: Vec<(Movement, f64)>,
}

impl Key {
    /// A posture at a time.
    #[must_use]
    pub fn new(time_s: f64, angles_deg: &[(Movement, f64)]) -> Key {
        Key { time_s, angles_deg: angles_deg.to_vec() }
    }
}

/// Costs, surfaces and resolution of a movement.
#[derive(Debug, Clone, PartialEq)]
pub struct MovementSettings {
    /// Costs of muscles.
    pub costs: EffortCosts,
    /// Spheres that touch other level surfaces than the ground, such as a chair, each with the height of its surface
    /// [m].
    pub surfaces: Vec<(ContactSphere, f64)>,
    /// Times [s] between which the first guess flies as a thrown body does; elsewhere a foot is on the ground.
    pub flights_s: Vec<[f64; 2]>,
    /// Knot intervals of the splines per second.
    pub knots_per_s: f64,
}

impl Default for MovementSettings {
    fn default() -> MovementSettings {
        MovementSettings {
            costs: EffortCosts::default(),
            surfaces: Vec::new(),
            flights_s: Vec::new(),
            knots_per_s: 40.0,
        }
    }
}

/// A movement of a figure as a problem of optimal motion, with its first guess.
#[derive(Debug, Clone)]
pub struct MovementProblem {
    /// The problem of optimal motion.
    pub problem: Problem,
    /// Unknowns of the first guess.
    pub guess: Vec<f64>,
}

impl MovementProblem {
    /// The movement of a figure, planar or in three dimensions, from the first to the last key.
    ///
    /// # Errors
    /// Fewer than two keys, or times that do not increase from zero; joints that are not hinges or slides.
    pub fn new(human: &Human, keys: &[Key], settings: &MovementSettings) -> Result<MovementProblem, MovementError> {
        let duration_s = checked(keys)?;
        let MovementSettings { costs, surfaces, flights_s, knots_per_s } = settings;
        let is_spatial = human.model.anatomy().coordinate(Movement::PelvisRight, None).is_some();
        let soles = if is_spatial { soles_with_width(human) } else { human.soles.clone() };
        let problem = Problem {
            model: human.model.clone(),
            soles: soles.iter().chain(surfaces.iter().map(|(sphere, _)| sphere)).cloned().collect(),
            levels_m: soles.iter().map(|_| 0.0).chain(surfaces.iter().map(|(_, level)| *level)).collect(),
            shoes: HuntCrossley::SOFT_SHOES,
            span: Span::Single,
            duration_s,
            travel: None,
            knots: (knots_per_s * duration_s).ceil() as usize,
            instants_per_knot: PER_KNOT,
            length_m: human.dimensions.leg_length,
            terms: Vec::new(),
            observer: Observer::default(),
        };
        let guess = first_guess(&problem, soles.len(), keys, flights_s)?;
        let last = guess.len() - 1;
        let still = vec![0.0; human.model.coordinates().len()];
        let nearness = Nearness::Joints(REST[0]);
        let ends = [0, last].map(|instant| End {
            instants: instant..instant + 1,
            place: &guess[instant],
            rates: &still,
            nearness,
            count: 1.0,
        });
        let mut movement = MovementProblem::of_guess(human, costs, problem, &guess, &ends, |muscles| muscles.joints())?;
        if let Some((height, _)) = human.model.anatomy().coordinate(Movement::PelvisUp, None) {
            movement.problem.settle(&mut movement.guess, height)?;
        }
        Ok(movement)
    }

    /// The movement with coordinates of a first guess at all instants, and with the costs of muscles that `add` adds.
    /// `problem` has no terms.
    pub(super) fn of_guess(
        human: &Human,
        costs: &EffortCosts,
        mut problem: Problem,
        guess: &[Vec<f64>],
        ends: &[End<'_>],
        add: impl FnOnce(&mut MuscleTerms<'_>),
    ) -> Result<MovementProblem, CurvedJointError> {
        let guess = problem.fitted(guess);
        let conditions = WalkConditions::default();
        let mut muscles = MuscleTerms::new(human, costs, &conditions, &problem, problem.duration_s);
        add(&mut muscles);
        let mut terms = muscles.terms;
        terms.extend(ends.iter().flat_map(|end| end.terms(&problem)));
        terms.extend(ranges(&problem));
        terms.extend(slips(&problem));
        problem.terms = terms;
        Ok(MovementProblem { problem, guess })
    }

    /// Requires a quantity to have a value, or a bound, from one time to another [s]; `deviation` costs 1 for an
    /// instant. Times between two instants are moved to the nearest ones.
    pub fn require(&mut self, [from_s, to_s]: [f64; 2], quantity: Quantity, bound: Bound, value: f64, deviation: f64) {
        let last = (self.problem.instants() - 1) as f64;
        let place = |time_s: f64| (time_s / self.problem.duration_s * last).round().clamp(0.0, last) as usize;
        let (first, end) = (place(from_s), place(to_s));
        let targets = (0..=last as usize).map(|k| (first..=end).contains(&k).then_some(value)).collect();
        self.problem.terms.push(Term { name: "requirement".to_owned(), quantity, targets, deviation, bound });
    }

    /// The coordinate of a movement with the sign that it increases with, of the right side for legs.
    #[must_use]
    pub fn coordinate(&self, movement: Movement) -> Option<(CoordinateId, f64)> {
        let anatomy = self.problem.model.anatomy();
        anatomy.coordinate(movement, None).or_else(|| anatomy.coordinate(movement, Some(Side::Right)))
    }

    /// Solves the problem: first near the first guess, then without it. Check [`Solution::unbalanced`] for forces that
    /// nothing supplies and [`Solution::overload`] for muscles that are too weak.
    ///
    /// # Errors
    /// If the figure has joints that are not hinges or slides, or the observer stops the solver.
    pub fn solve(&self) -> Result<Solution, OptimalWalkError> {
        let near = self.guided(1.0)?.solve(&self.guess, &STAGES)?;
        self.unguided(&self.guided(LESS_GUIDED)?.solve(near.unknowns(), &longer(&NEAR_STAGES))?)
    }

    /// As [`MovementProblem::solve`], in less time, where the first guess is near the solution.
    pub(super) fn solve_near_guess(&self) -> Result<Solution, OptimalWalkError> {
        self.unguided(&self.guided(1.0)?.solve(&self.guess, &STAGES)?)
    }

    /// Solves the problem without the first guess, from a solution near it.
    fn unguided(&self, guided: &Solution) -> Result<Solution, OptimalWalkError> {
        let stages = longer(&NEAR_STAGES);
        let on = Continuation::on(&stages);
        // Where the last stage alone is stuck, those before it lead out.
        self.problem.balanced(self.problem.solve(guided.unknowns(), &stages)?, &[&on, &stages, &on], &[])
    }

    /// The problem with a cost of deviations from the first guess.
    fn guided(&self, weight: f64) -> Result<Problem, CurvedJointError> {
        let mut problem = self.problem.clone();
        let guess = problem.at(&self.guess)?;
        for id in problem.model.coordinate_ids() {
            let quantity = Quantity::Position(vec![(id, 1.0)]);
            let targets = guess.values(&quantity).map(Some).collect();
            let turns = problem.model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
            let deviation = GUIDE[usize::from(!turns)] / weight.sqrt();
            problem.terms.push(Term {
                name: "first guess".to_owned(),
                quantity,
                targets,
                deviation,
                bound: Bound::Near,
            });
        }
        Ok(problem)
    }
}

/// A movement that cannot be described.
#[derive(Debug, Clone, PartialEq)]
pub enum MovementError {
    /// Keys without a beginning and an end.
    Keys {
        /// Number of keys found.
        count: usize,
    },
    /// The first key that does not follow the one before, or does not begin at 0.
    Time {
        /// Number of the key, from 1.
        key: usize,
        /// Time of the key [s].
        time_s: f64,
        /// The time must be later than this; the time of the first key must equal it [s].
        after_s: f64,
    },
    /// A joint with other motions than hinges and slides.
    Joint(CurvedJointError),
}

impl fmt::Display for MovementError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            MovementError::Keys { count } => {
                write!(f, "a movement with {count} key postures; expected at least 2, its beginning and its end")
            }
            MovementError::Time { key: 1, time_s, .. } => write!(f, "key posture 1 is at {time_s} s; expected 0 s"),
            MovementError::Time { key, time_s, after_s } => {
                write!(f, "key posture {key} is at {time_s} s; expected later than {after_s} s")
            }
            MovementError::Joint(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for MovementError {}

impl From<CurvedJointError> for MovementError {
    fn from(error: CurvedJointError) -> MovementError {
        MovementError::Joint(error)
    }
}

/// The duration of a movement [s].
fn checked(keys: &[Key]) -> Result<f64, MovementError> {
    let (Some(first), Some(last), true) = (keys.first(), keys.last(), keys.len() > 1) else {
        return Err(MovementError::Keys { count: keys.len() });
    };
    if first.time_s.is_nan() || first.time_s.abs() > 0.0 {
        return Err(MovementError::Time { key: 1, time_s: first.time_s, after_s: 0.0 });
    }
    for (k, pair) in keys.windows(2).enumerate() {
        if !(pair[1].time_s > pair[0].time_s && pair[1].time_s.is_finite()) {
            return Err(MovementError::Time { key: k + 2, time_s: pair[1].time_s, after_s: pair[0].time_s });
        }
    }
    Ok(last.time_s)
}

/// Coordinates at all instants of a problem, whose first `soles` spheres belong to the feet.
fn first_guess(
    problem: &Problem,
    soles: usize,
    keys: &[Key],
    flights_s: &[[f64; 2]],
) -> Result<Vec<Vec<f64>>, CurvedJointError> {
    let model = &problem.model;
    let times: Vec<f64> = problem.shares().iter().map(|share| share * problem.duration_s).collect();
    // The last posture, standing, determines the position of the feet.
    let mut postures: Vec<Vec<f64>> = times.iter().map(|_| vec![0.0; model.coordinates().len()]).collect();
    let key_times: Vec<f64> = keys.iter().map(|key| key.time_s).collect();
    let key_postures: Vec<Vec<f64>> = keys.iter().map(|key| posture(model, key)).collect();
    for c in 0..model.coordinates().len() {
        let values: Vec<f64> = key_postures.iter().map(|posture| posture[c]).collect();
        for (posture, value) in postures.iter_mut().zip(between(&key_times, &values, &times)) {
            posture[c] = value;
        }
    }
    postures.push(posture(model, &Key::new(0.0, &[])));
    let still = vec![0.0; model.coordinates().len()];
    let at_rest = |q| Instant { posture: [q, still.clone(), still.clone()], ..Instant::default() };
    let mut instants: Vec<Instant> = postures.into_iter().map(at_rest).collect();
    let mut evaluator = Evaluator::new(model, &problem.soles, &problem.levels_m)?;
    evaluator.evaluate_forces(&problem.shoes, &mut instants);
    let middle = |at: &Instant| at.contacts[..soles].iter().map(|c| c.place.x).sum::<f64>() / soles as f64;
    let lowest = |at: &Instant| at.contacts[..soles].iter().map(|c| c.values.height).fold(f64::INFINITY, f64::min);
    let moved =
        [Movement::PelvisForward, Movement::PelvisUp].map(|movement| model.anatomy().coordinate(movement, None));
    let start = instants.last().map_or(0.0, middle);
    let lift = |time_s: f64| {
        let fall = |[from, to]: &[f64; 2]| 0.5 * model.gravity().norm() * (time_s - from) * (to - time_s);
        flights_s.iter().map(fall).fold(0.0, f64::max)
    };
    let placed = |(at, time_s): (&Instant, &f64)| {
        let mut posture = at.posture[0].clone();
        for (coordinate, error) in moved.iter().zip([middle(at) - start, lowest(at) - lift(*time_s)]) {
            if let Some((id, sign)) = coordinate {
                posture[id.index()] -= sign * error;
            }
        }
        posture
    };
    Ok(instants.iter().zip(&times).map(placed).collect())
}

/// Values at `times` of a curve through `values` at `knots`: cubic between two knots, without overshoot, at rest at
/// both ends (slopes are the harmonic means of Fritsch and Butland 1984; unverified).
fn between(knots: &[f64], values: &[f64], times: &[f64]) -> Vec<f64> {
    let last = knots.len() - 1;
    let secant = |k: usize| (values[k + 1] - values[k]) / (knots[k + 1] - knots[k]);
    let slope = |k: usize| {
        if k == 0 || k == last || secant(k - 1) * secant(k) <= 0.0 {
            return 0.0;
        }
        2.0 * secant(k - 1) * secant(k) / (secant(k - 1) + secant(k))
    };
    let at = |time_s: &f64| {
        let k = knots.iter().rposition(|knot| knot <= time_s).unwrap_or(0).min(last - 1);
        let length = knots[k + 1] - knots[k];
        let s = ((time_s - knots[k]) / length).clamp(0.0, 1.0);
        let rest = 1.0 - s;
        values[k] * rest * rest * (1.0 + 2.0 * s)
            + values[k + 1] * s * s * (3.0 - 2.0 * s)
            + length * s * rest * (slope(k) * rest - slope(k + 1) * s)
    };
    times.iter().map(at).collect()
}

/// Coordinates of a key.
pub(super) fn posture(model: &Model, key: &Key) -> Vec<f64> {
    let angle = |wanted: Movement| key.angles_deg.iter().find(|(movement, _)| *movement == wanted).map(|(_, deg)| *deg);
    let level = [(Movement::HipFlexion, 1.0), (Movement::KneeFlexion, -1.0), (Movement::AnkleDorsiflexion, 1.0)];
    let tilt: f64 = level.iter().map(|(movement, sign)| sign * angle(*movement).unwrap_or(0.0)).sum();
    let value = |id: CoordinateId| {
        let coordinate = &model.coordinates()[id.index()];
        let Some(meaning) = model.anatomy().meaning(id) else { return coordinate.default_value };
        match (angle(meaning.movement), meaning.movement) {
            (Some(deg), _) => meaning.sign * deg * DEGREE,
            (None, Movement::PelvicTilt) => meaning.sign * tilt * DEGREE,
            _ => coordinate.default_value,
        }
    };
    model.coordinate_ids().map(value).collect()
}

/// The state at the first or the last instants.
pub(super) struct End<'a> {
    pub(super) instants: Range<usize>,
    /// Coordinates [rad, m] and rates [rad/s, m/s].
    pub(super) place: &'a [f64],
    pub(super) rates: &'a [f64],
    pub(super) nearness: Nearness,
    /// How often it counts.
    pub(super) count: f64,
}

/// How near a movement comes to a given state at an end.
#[derive(Debug, Clone, Copy)]
pub(super) enum Nearness {
    /// Coordinates of joints, with the deviation that costs 1 [rad].
    Joints(f64),
    /// All coordinates but the place forward.
    All,
}

impl End<'_> {
    fn terms(&self, problem: &Problem) -> Vec<Term> {
        let root: Vec<CoordinateId> = problem.root().into_iter().map(|(id, _)| id).collect();
        let forward = problem.model.anatomy().coordinate(Movement::PelvisForward, None).map(|(id, _)| id);
        let at = |value: f64| -> Vec<Option<f64>> {
            (0..problem.instants()).map(|k| self.instants.contains(&k).then_some(value)).collect()
        };
        let is_rest = self.rates.iter().all(|rate| rate.abs() <= 0.0);
        let mut terms = Vec::new();
        for id in problem.model.coordinate_ids() {
            let mut add = |quantity, value, deviation| {
                let (name, targets, deviation) = (END.to_owned(), at(value), deviation / self.count.sqrt());
                terms.push(Term { name, quantity, targets, deviation, bound: Bound::Near });
            };
            let place = self.place[id.index()];
            let deviation = match id {
                id if Some(id) == forward && !(is_rest && matches!(self.nearness, Nearness::All)) => {
                    Some(0.05 * problem.length_m)
                }
                id => match self.nearness {
                    Nearness::All => Some(JOINED[0]),
                    Nearness::Joints(_) if root.contains(&id) => None,
                    Nearness::Joints(deviation) => Some(deviation),
                },
            };
            if let Some(deviation) = deviation {
                add(Quantity::Position(vec![(id, 1.0)]), place, deviation);
            }
            let deviation = if is_rest { REST[1] } else { JOINED[1] };
            add(Quantity::Rate(vec![(id, 1.0)]), self.rates[id.index()], deviation);
            if is_rest {
                add(Quantity::Acceleration(vec![(id, 1.0)]), 0.0, REST[2]);
            }
        }
        terms
    }
}

/// Joints stay in their ranges.
fn ranges(problem: &Problem) -> Vec<Term> {
    let coordinates = problem.model.coordinates();
    let mut terms = Vec::new();
    for id in problem.model.coordinate_ids() {
        let Coordinate { kind: CoordinateKind::Rotation, range: Some([least, greatest]), .. } =
            &coordinates[id.index()]
        else {
            continue;
        };
        for (limit, bound) in [(*least, Bound::AtLeast), (*greatest, Bound::AtMost)] {
            let (quantity, targets) = (Quantity::Position(vec![(id, 1.0)]), vec![Some(limit); problem.instants()]);
            terms.push(Term { name: "range".to_owned(), quantity, targets, deviation: BEYOND, bound });
        }
    }
    terms
}

/// Loaded spheres do not slip.
fn slips(problem: &Problem) -> Vec<Term> {
    let light_n = LIGHT * problem.weight_n();
    let slip = |sphere: usize, axis: usize| Term {
        name: "slip".to_owned(),
        quantity: Quantity::Slip { sphere, axis, light_n },
        targets: vec![Some(0.0); problem.instants()],
        deviation: SLIP,
        bound: Bound::Near,
    };
    (0..problem.soles.len()).flat_map(|sphere| [slip(sphere, 0), slip(sphere, 1)]).collect()
}
