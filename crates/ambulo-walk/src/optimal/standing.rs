//! Coming to a stand from a walk, walking off, and steps on the spot: movements from or to standing.
//!
//! A stop begins in a walk, at the instant at which the left foot has left the ground. The left foot makes a step, the
//! right foot comes beside it, and the figure stands still. A start begins where a stop ends, in standing. The
//! load moves to the right foot, the left foot makes a short step, the right foot a longer one, and the next step of
//! the left foot belongs to the walk. Steps on the spot begin and end in standing: the left foot is lifted and set
//! down, then the right one. The motion between these postures minimises the cost of muscles, as in other
//! movements. The first guess is a mean of the walk and the posture of standing, in which the loaded foot stays where
//! it was set down.
//!
//! What people do follows from the cost and from bounds, not from a recorded start: the centre of pressure first moves
//! back and towards the foot that will swing (Applied Sciences 10:244, introduction read; PMC5366317, figure 2),
//! because the body must fall forward and over the other foot; after two shorter steps the walk is steady, as that of
//! people is by the third step ("How many steps are needed to reach steady-state walking speed after gait initiation?",
//! abstract read). Bounds say how long the first step is and how high soles are, that the pelvis does not rock back,
//! and that the figure does not hop.
//!
//! Fast walks cannot be stopped in this way: the extrapolated mass centre x + v √(l/g) must not be beyond the toes
//! (Hof, Gazendam, Sinke 2005; unverified).

use super::error::{OptimalWalkError, STEPS_ON_THE_SPOT};
use super::find::OptimalWalk;
use super::instant::{Evaluator, Instant};
use super::layout::Span;
use super::movement::{END, End, Key, MovementProblem, Nearness, posture};
use super::muscles::EffortCosts;
use super::objective::{Bound, Quantity};
use super::plan::WalkPlan;
use super::problem::Problem;
use super::solution::Solution;
use super::solve::NO_ROOT_FORCE;
use crate::dynamics::CurvedJointError;
use crate::gait::Walk;
use crate::model::anthropometry::{Human, SpherePart};
use crate::model::{CoordinateId, Movement, Side};

/// Dimensionless speed V/√(gL) of a walk from which figures stop: 0.7 m/s for a man of 1.75 m.
const STOPPING_SPEED: f64 = 0.235;

/// Posture of standing [deg]: the trunk is upright, knees are not locked, and on level feet the hip joints of a man of
/// 1.75 m are 62 mm ahead of the ankles, the mean of fifteen people (standard deviation 13 mm; Woodhull, Maltrud, Mello
/// 1985, abstract read). Soft heels give way by 0.8 to 1.5 degrees, which leaves 40 to 50 mm.
const STANDING: [(Movement, f64); 3] =
    [(Movement::HipFlexion, -1.6), (Movement::KneeFlexion, 5.0), (Movement::AnkleDorsiflexion, 6.6)];
/// Deviation of joint angles from this posture that costs 1 where a stop ends [rad]: the feet are side by side.
const SIDE_BY_SIDE: f64 = 0.01;
/// Smallest height of a swinging sole, how much higher than in the walk it comes, and the deviation that costs 1 [leg
/// lengths].
const HEIGHTS: [f64; 3] = [0.015, 0.02, 0.005];
/// Share of a stop at whose end the figure rests, and how often an instant of rest counts.
const RESTS: f64 = 0.1;
const REST_COUNTS: f64 = 3.0;
/// Length of the first step of a start, a share of the step of the walk.
const FIRST_STEP_SHARES: [f64; 2] = [0.7, 0.85];
/// How far the pelvis moves back where a start begins, and the deviation that costs 1 [leg lengths].
const BACK: [f64; 2] = [0.02, 0.005];
/// Knot intervals of the splines per second, for legs of 1 m.
const KNOTS_PER_S: f64 = 30.0;
/// Acceleration of the pelvis that costs 1 [g].
const PELVIS: f64 = 0.2;
/// Share of the body weight that the ground carries at least, unless the figure hops; below and above the other shares,
/// [`LOAD_COST`] is paid.
const CARRIED: f64 = 0.05;
const LOADS: [f64; 2] = [0.5, 1.4];
/// Deviation from these shares of the body weight that costs 1.
const LOAD_COST: f64 = 0.05;

/// Largest difference from the walk where a movement joins it: coordinates [rad, m] and rates [rad/s, m/s].
const APART: [f64; 2] = [0.02, 0.3];

/// Cost of the ends of a built-in movement below which it joins this walk and this posture of standing. Its own walk
/// costs 0.06 and 0.2, a walk whose feet are lifted 5 mm higher 22 and 92.
const SAME_ENDS: f64 = 1.0;

/// How a movement follows the walk. Phases are shares of its cycle, in which the right foot strikes at 0 and the left
/// one at 0.5.
struct Outline {
    /// Phase at which the movement begins, and at which it ends, as long as it lasts in the walk.
    phases: [f64; 2],
    /// The end at which it is the walk: 0 for a stop, 1 for a start; none for steps on the spot.
    walks: Option<usize>,
    /// Phases between which the first guess changes between the walk and standing; of steps on the spot, phases between
    /// which it has a share of the walk.
    changes: [f64; 2],
    /// Phases between which a foot is lifted.
    swings: &'static [(Side, [f64; 2])],
    /// Phases at which the first guess begins to stand on a foot.
    stances: &'static [(Side, f64)],
}

const STOP: Outline = Outline {
    phases: [0.15, 1.4],
    walks: Some(0),
    changes: [0.15, 1.0],
    swings: &[(Side::Left, [0.22, 0.44]), (Side::Right, [0.7, 0.9])],
    stances: &[(Side::Right, 0.15), (Side::Left, 0.5)],
};
const START: Outline = Outline {
    phases: [-1.33, 0.42],
    walks: Some(1),
    changes: [-1.05, -0.25],
    swings: &[(Side::Left, [-0.82, -0.56]), (Side::Right, [-0.32, -0.06]), (Side::Left, [0.18, 0.42])],
    stances: &[(Side::Right, -1.33), (Side::Left, -0.5), (Side::Right, 0.0)],
};
/// Steps on the spot. Phases are those at which the walk lifts the same feet, as far as its first guess needs them.
const STEPS: Outline = Outline {
    phases: [-0.2, 1.25],
    walks: None,
    changes: [-0.1, 1.15],
    swings: &[(Side::Left, [0.16, 0.40]), (Side::Right, [0.62, 0.86])],
    stances: &[(Side::Right, -0.2), (Side::Left, 0.5)],
};
/// Largest share of the walk in the first guess of steps on the spot.
const MOST_WALK: f64 = 0.5;
/// Phases in which the first step of a start has ended and its foot stands.
const FIRST_STEP: [f64; 2] = [-0.48, -0.3];

impl Outline {
    /// The phase at which the movement is the walk.
    const fn joins(&self) -> f64 {
        match self.walks {
            Some(1) => self.phases[1],
            _ => self.phases[0],
        }
    }

    /// Share of standing in the first guess at a phase.
    fn standing(&self, phase: f64) -> f64 {
        let [from, to] = self.changes;
        let share = ((phase - from) / (to - from)).clamp(0.0, 1.0);
        let smooth = share.powi(3) * (10.0 - share * (15.0 - 6.0 * share));
        match self.walks {
            Some(0) => smooth,
            Some(_) => 1.0 - smooth,
            None => 1.0 - 4.0 * MOST_WALK * share * (1.0 - share),
        }
    }

    fn stance(&self, phase: f64) -> Side {
        let begun = self.stances.iter().rev().find(|(_, from)| *from <= phase);
        begun.or(self.stances.first()).map_or(Side::Right, |(side, _)| *side)
    }
}

/// A stop, a start and steps on the spot.
#[derive(Debug, Clone)]
pub struct StandingMovements {
    /// Movement from the walk to standing.
    pub stop: Solution,
    /// Movement from the posture in which the stop ends to the walk.
    pub start: Solution,
    /// Movement from this posture to it: the left foot steps on the spot, then the right one. None before
    /// [`StandingMovements::with_steps`], and in the plane.
    pub steps: Option<Solution>,
}

impl StandingMovements {
    /// Shares of the cycle of the walk at which the stop begins and at which the start ends.
    pub const JOINS: [f64; 2] = [STOP.joins(), START.joins()];

    /// A speed at which a figure can stop and walk off [m/s].
    #[must_use]
    pub fn speed(human: &Human) -> f64 {
        STOPPING_SPEED * (human.model.gravity().norm() * human.dimensions.leg_length).sqrt()
    }

    /// The movements of a figure between a walk and standing. The walk must be slow, as at
    /// [`StandingMovements::speed`].
    ///
    /// # Errors
    /// Joints that are not hinges or slides; no movement was found, because the walk is too fast.
    pub fn find(human: &Human, walk: &Solution) -> Result<StandingMovements, OptimalWalkError> {
        let stop = solved(human, walk, "stop", &STOP, None)?;
        let start = solved(human, walk, "start", &START, Some(&at_rest(&stop)))?;
        Ok(StandingMovements { stop, start, steps: None })
    }

    /// The same movements with steps on the spot, unless the figure is in the plane, where no foot can be lifted
    /// without leaning to the side.
    ///
    /// # Errors
    /// No movement was found.
    pub fn with_steps(self, human: &Human, walk: &Solution) -> Result<StandingMovements, OptimalWalkError> {
        if human.model.anatomy().coordinate(Movement::PelvisRight, None).is_none() {
            return Ok(self);
        }
        let steps = solved(human, walk, STEPS_ON_THE_SPOT, &STEPS, Some(&at_rest(&self.stop)))?;
        Ok(StandingMovements { steps: Some(steps), ..self })
    }

    /// Stop, start and steps on the spot of a figure in three dimensions, solved from their first guesses, as the files
    /// of data/walks.
    ///
    /// # Errors
    /// As [`StandingMovements::find`].
    pub fn plans(found: &OptimalWalk, walk: &Walk) -> Result<[WalkPlan; 3], OptimalWalkError> {
        let (human, solution) = (found.figure(), &found.solution);
        let from_guess = |movement, outline, standing: Option<&[f64]>| {
            judged(joining(&human, solution, outline, standing)?.solve_near_guess()?, solution, movement, outline)
        };
        let stop = from_guess("stop", &STOP, None)?;
        let rest = at_rest(&stop);
        let start = from_guess("start", &START, Some(&rest))?;
        let steps = from_guess(STEPS_ON_THE_SPOT, &STEPS, Some(&rest))?;
        Ok([stop, start, steps].map(|made| WalkPlan::new(human.build, walk, &made)))
    }

    /// Whether the stop begins in a walk, and the start ends in it.
    #[must_use]
    pub fn join(&self, walk: &Solution) -> bool {
        let coordinates = |solution: &Solution| solution.problem().model.coordinates().len();
        [(&self.stop, false), (&self.start, true)]
            .into_iter()
            .all(|(movement, is_start)| coordinates(movement) == coordinates(walk) && !misses(movement, walk, is_start))
    }
}

/// The posture in which a stop ends.
fn at_rest(stop: &Solution) -> Vec<f64> {
    stop.instant(stop.problem().duration_s).posture[0].clone()
}

/// A movement; with the posture of standing, one from it. It is the built-in one, or is solved from its first guess:
/// solved from the built-in one, the movements of other figures take half the time, but a woman then kept her balance
/// after 12 of 16 pushes of 150 N, not 15.
fn solved(
    human: &Human,
    walk: &Solution,
    movement: &'static str,
    outline: &Outline,
    standing: Option<&[f64]>,
) -> Result<Solution, OptimalWalkError> {
    let movement_problem = joining(human, walk, outline, standing)?;
    let problem = &movement_problem.problem;
    if let Some(plan) = WalkPlan::of_movement(movement, human, walk)?
        && plan.coefficients.len() == movement_problem.guess.len()
        && cost_of_ends(problem, &plan.coefficients) < SAME_ENDS
        && let Ok(solution) = judged(problem.at(&plan.coefficients)?, walk, movement, outline)
    {
        return Ok(solution);
    }
    judged(movement_problem.solve_near_guess()?, walk, movement, outline)
}

/// The part of the cost for distances from where the movement should begin and end.
fn cost_of_ends(problem: &Problem, unknowns: &[f64]) -> f64 {
    problem.costs(unknowns).iter().filter(|(name, _)| name == END).map(|(_, cost)| cost).sum()
}

/// A solution, unless it is no movement between the walk and standing.
fn judged(
    solution: Solution,
    walk: &Solution,
    movement: &'static str,
    outline: &Outline,
) -> Result<Solution, OptimalWalkError> {
    let speed = walk.speed();
    match solution.unbalanced(NO_ROOT_FORCE) {
        Some(unbalanced) => Err(OptimalWalkError::NoMovement { movement, speed, unbalanced }),
        None if hops(&solution) => Err(OptimalWalkError::Hops { movement, speed }),
        None if outline.walks.is_some_and(|end| misses(&solution, walk, end == 1)) => {
            Err(OptimalWalkError::Misses { movement, speed })
        }
        None => Ok(solution),
    }
}

/// Whether a movement differs from the walk at the instant of their join.
fn misses(solution: &Solution, walk: &Solution, is_start: bool) -> bool {
    let (outline, at_s) = if is_start { (START, solution.problem().duration_s) } else { (STOP, 0.0) };
    let [own, joined] = [solution.instant(at_s), walk.instant(outline.joins() * walk.cycle_s())];
    let forward = solution.problem().model.anatomy().coordinate(Movement::PelvisForward, None);
    let differ = |part: usize| {
        let pairs = own.posture[part].iter().zip(&joined.posture[part]).enumerate();
        let counted = pairs.filter(|(c, _)| part > 0 || forward.is_none_or(|(id, _)| id.index() != *c));
        counted.map(|(_, (a, b))| (a - b).abs()).fold(0.0, f64::max) > APART[part]
    };
    differ(0) || differ(1)
}

fn hops(solution: &Solution) -> bool {
    let spheres: Vec<usize> = (0..solution.problem().soles.len()).collect();
    let least = solution.ground_force(&spheres).map(|[_, up, _]| up).fold(f64::INFINITY, f64::min);
    least < CARRIED * solution.problem().weight_n()
}

/// The problem of a stop; with the posture of standing, of a movement from it.
fn joining(
    human: &Human,
    walk: &Solution,
    outline: &Outline,
    standing: Option<&[f64]>,
) -> Result<MovementProblem, CurvedJointError> {
    let (like, cycle_s) = (walk.problem(), walk.cycle_s());
    let [begins, ends] = outline.phases;
    let duration_s = (ends - begins) * cycle_s;
    let knots_per_s = KNOTS_PER_S / like.length_m.sqrt();
    let problem = Problem {
        span: Span::Single,
        duration_s,
        travel: None,
        knots: (knots_per_s * duration_s).ceil() as usize,
        instants_per_knot: 2,
        terms: Vec::new(),
        ..like.clone()
    };
    let rest = standing.map_or_else(|| posture(&like.model, &Key::new(0.0, &STANDING)), <[f64]>::to_vec);
    let guess = first_guess(&problem, walk, outline, &rest)?;
    let costs = EffortCosts { pelvis: PELVIS, ..EffortCosts::default() };
    let last = problem.instants() - 1;
    let [in_walk, at_rest] = if outline.walks == Some(0) { [0, last] } else { [last, 0] };
    let still = vec![0.0; like.model.coordinates().len()];
    let forward = like.model.anatomy().coordinate(Movement::PelvisForward, None);
    let [walked, rates] = if outline.walks.is_some() {
        // The walk determines the height of the pelvis, but not the distance travelled.
        let [mut walked, rates, _] = walk.instant(outline.joins() * cycle_s).posture;
        if let Some((forward, _)) = forward {
            walked[forward.index()] = guess[in_walk][forward.index()];
        }
        [walked, rates]
    } else {
        [guess[at_rest].clone(), still.clone()]
    };
    let nearness = if standing.is_some() { Nearness::All } else { Nearness::Joints(SIDE_BY_SIDE) };
    let rested = ((RESTS * last as f64) as usize).max(1);
    let resting = if standing.is_some() { at_rest..at_rest + 1 } else { at_rest + 1 - rested..at_rest + 1 };
    let ends = [
        End { instants: in_walk..in_walk + 1, place: &walked, rates: &rates, nearness: Nearness::All, count: 1.0 },
        End { count: REST_COUNTS, instants: resting, place: &guess[at_rest], rates: &still, nearness },
    ];
    let heels = heels(&problem, &guess[at_rest])?;
    let at_rest_m = forward.map(|(forward, sign)| (forward, sign, sign * guess[at_rest][forward.index()]));
    let mut movement = MovementProblem::of_guess(human, &costs, problem, &guess, &ends, |muscles| {
        muscles.joints();
        muscles.trunk();
        muscles.moment_rates();
    })?;
    require(&mut movement, walk, outline, at_rest_m, &heels);
    Ok(movement)
}

/// Requires what people do: feet that swing clear of the ground and not higher than needed, a pelvis that does not rock
/// back, and a load on the ground near the body's weight.
fn require(
    movement: &mut MovementProblem,
    walk: &Solution,
    outline: &Outline,
    at_rest_m: Option<(CoordinateId, f64, f64)>,
    heels: &[(usize, Side, f64)],
) {
    let (like, cycle_s, duration_s) = (walk.problem(), walk.cycle_s(), movement.problem.duration_s);
    let all = [0.0, duration_s];
    let [least, most, deviation] = HEIGHTS.map(|share| share * like.length_m);
    let highest =
        (0..like.soles.len()).map(Quantity::Height).flat_map(|height| walk.values(&height).collect::<Vec<_>>());
    let highest = highest.fold(0.0, f64::max) + most;
    for (sphere, sole) in like.soles.iter().enumerate() {
        for (_, span) in outline.swings.iter().filter(|(side, _)| *side == sole.side) {
            let span = span.map(|phase| (phase - outline.phases[0]) * cycle_s);
            movement.require(span, Quantity::Height(sphere), Bound::AtLeast, least, deviation);
        }
        movement.require(all, Quantity::Height(sphere), Bound::AtMost, highest, deviation);
    }
    if let Some((forward, sign, place)) = at_rest_m.filter(|_| outline.walks == Some(1)) {
        let [back, deviation] = BACK.map(|share| share * like.length_m);
        movement.require(all, Quantity::Position(vec![(forward, sign)]), Bound::AtLeast, place - back, deviation);
    }
    for (sphere, _, place) in heels.iter().filter(|(_, side, _)| outline.walks == Some(1) && *side == Side::Left) {
        let span = FIRST_STEP.map(|phase| (phase - outline.phases[0]) * cycle_s);
        let step_m = 0.5 * walk.speed() * cycle_s;
        for (bound, share) in [Bound::AtLeast, Bound::AtMost].into_iter().zip(FIRST_STEP_SHARES) {
            movement.require(span, Quantity::Place(*sphere, 0), bound, place + share * step_m, deviation);
        }
    }
    let spheres: Vec<usize> = (0..like.soles.len()).collect();
    for (bound, share) in [Bound::AtLeast, Bound::AtMost].into_iter().zip(LOADS) {
        let load = Quantity::GroundForce(spheres.clone(), 1);
        movement.require(all, load, bound, share * like.weight_n(), LOAD_COST * like.weight_n());
    }
}

/// Number, side and place forward [m] of the spheres under the heels in a posture.
fn heels(problem: &Problem, posture: &[f64]) -> Result<Vec<(usize, Side, f64)>, CurvedJointError> {
    let still = vec![0.0; posture.len()];
    let mut at = [Instant { posture: [posture.to_vec(), still.clone(), still], ..Instant::default() }];
    Evaluator::new(&problem.model, &problem.soles, &problem.levels_m)?.evaluate_forces(&problem.shoes, &mut at);
    let of_heels = problem.soles.iter().enumerate().filter(|(_, sole)| sole.part == SpherePart::Heel);
    Ok(of_heels.map(|(k, sole)| (k, sole.side, at[0].contacts[k].values.place_x)).collect())
}

/// Coordinates at all instants: the walk mixed with standing, with the stance foot where it came to stand and the
/// lowest sole as high as in the first one.
fn first_guess(
    problem: &Problem,
    walk: &Solution,
    outline: &Outline,
    rest: &[f64],
) -> Result<Vec<Vec<f64>>, CurvedJointError> {
    let [begins, ends] = outline.phases;
    let phases: Vec<f64> = problem.shares().iter().map(|share| begins + share * (ends - begins)).collect();
    let mixed = |phase: &f64| {
        let standing = outline.standing(*phase);
        let walked = walk.instant(phase * walk.cycle_s()).posture;
        let mix = |(walked, rest): (&f64, &f64)| (1.0 - standing) * walked + standing * rest;
        walked[0].iter().zip(rest).map(mix).collect::<Vec<f64>>()
    };
    let anatomy = problem.model.anatomy();
    let still = vec![0.0; problem.model.coordinates().len()];
    let at_rest = |q| Instant { posture: [q, still.clone(), still.clone()], ..Instant::default() };
    let mut instants: Vec<Instant> = phases.iter().map(mixed).map(at_rest).collect();
    Evaluator::new(&problem.model, &problem.soles, &problem.levels_m)?.evaluate_forces(&problem.shoes, &mut instants);
    let of_foot = |at: &Instant, side: Side| {
        let of_side = problem.soles.iter().zip(&at.contacts).filter(|(sole, _)| sole.side == side);
        let count = of_side.clone().count().max(1) as f64;
        let middle = of_side.fold([0.0; 2], |[x, z], (_, contact)| [x + contact.place.x, z + contact.place.z]);
        let lowest = at.contacts.iter().map(|contact| contact.values.height).fold(f64::INFINITY, f64::min);
        [middle[0] / count, lowest, middle[1] / count]
    };
    let mut side = outline.stance(begins);
    let mut stands = instants.first().map_or([0.0; 3], |first| of_foot(first, side));
    let mut moved = [0.0; 3];
    let movements = [Movement::PelvisForward, Movement::PelvisUp, Movement::PelvisRight];
    let mut guess = Vec::new();
    for (at, &phase) in instants.iter().zip(&phases) {
        if outline.stance(phase) != side {
            side = outline.stance(phase);
            let [x, _, z] = of_foot(at, side);
            stands = [x + moved[0], stands[1], z + moved[2]];
        }
        let now = of_foot(at, side);
        moved = [0, 1, 2].map(|axis| stands[axis] - now[axis]);
        let mut posture = at.posture[0].clone();
        for (movement, moved) in movements.iter().zip(moved) {
            if let Some((id, sign)) = anatomy.coordinate(*movement, None) {
                posture[id.index()] += sign * moved;
            }
        }
        guess.push(posture);
    }
    Ok(guess)
}
