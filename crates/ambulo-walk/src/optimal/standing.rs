//! Coming to a stand from a walk, and walking off: two movements that join a walk and standing.
//!
//! A stop begins in a walk, when the left foot has left the ground, and ends at rest on both feet; a start ends in the
//! walk before the left foot strikes. In between, the cost of muscles is minimised, as in other movements. The first
//! guess mixes the walk, which slows down or speeds up, with the posture of standing, and keeps the right foot where it
//! is. Without bounds of the load on the ground, some starts hop, which is a local minimum.
//!
//! The right foot alone is on the ground while the body slows down, so fast walks cannot be stopped in this way: the
//! extrapolated mass centre x + v √(l/g) must not be beyond the toes (Hof, Gazendam, Sinke 2005; unverified).

use super::error::OptimalWalkError;
use super::instant::{Evaluator, Instant};
use super::layout::Span;
use super::movement::{End, Key, MovementProblem, posture};
use super::muscles::EffortCosts;
use super::objective::{Bound, Quantity};
use super::problem::Problem;
use super::solution::Solution;
use super::solve::NO_ROOT_FORCE;
use crate::dynamics::CurvedJointError;
use crate::model::anthropometry::Human;
use crate::model::{Movement, Side};

/// Dimensionless speed V/√(gL) of a walk from which figures stop: 0.7 m/s for a man of 1.75 m.
const STOPPING_SPEED: f64 = 0.235;

/// Posture of standing [deg]: knees are not locked.
const STANDING: [(Movement, f64); 3] =
    [(Movement::HipFlexion, 3.0), (Movement::KneeFlexion, 5.0), (Movement::AnkleDorsiflexion, 2.0)];
/// Height of the swinging foot and the deviation that costs 1 [leg lengths].
const CLEARANCE: [f64; 2] = [0.03, 0.005];
/// Knot intervals of the splines per second, for legs of 1 m.
const KNOTS_PER_S: f64 = 40.0;
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

/// How a movement and its first guess follow the walk.
struct Outline {
    /// Duration as a share of the cycle of the walk.
    duration: f64,
    /// Share of the cycle at which it leaves or joins the walk.
    joins: f64,
    /// Shares of the movement between which the left foot is lifted.
    swing: [f64; 2],
    /// Share of the movement at which the first guess begins to move.
    rests: f64,
}

const STOP: Outline = Outline { duration: 0.65, joins: 0.15, swing: [0.2, 0.5], rests: 0.0 };
const START: Outline = Outline { duration: 0.9, joins: 0.42, swing: [0.68, 0.9], rests: 0.3 };

/// A stop and a start.
#[derive(Debug, Clone)]
pub struct StandingMovements {
    /// Movement from the walk to standing.
    pub stop: Solution,
    /// Movement from the posture in which the stop ends to the walk.
    pub start: Solution,
}

impl StandingMovements {
    /// Shares of the cycle of the walk at which the stop begins and at which the start ends.
    pub const JOINS: [f64; 2] = [STOP.joins, START.joins];

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
        let checked = |movement: &'static str, solution: Solution| {
            let speed = walk.speed();
            match solution.unbalanced(NO_ROOT_FORCE) {
                Some(unbalanced) => Err(OptimalWalkError::NoMovement { movement, speed, unbalanced }),
                None if hops(&solution) => Err(OptimalWalkError::Hops { movement, speed }),
                None if misses(&solution, walk, movement == "start") => {
                    Err(OptimalWalkError::Misses { movement, speed })
                }
                None => Ok(solution),
            }
        };
        let stop = checked("stop", joining(human, walk, None)?.solve()?)?;
        let empty = || vec![0.0; human.model.coordinates().len()];
        let mut standing = [empty(), empty(), empty()];
        stop.write(stop.problem().duration_s, &mut standing);
        let start = checked("start", joining(human, walk, Some(&standing[0]))?.solve()?)?;
        Ok(StandingMovements { stop, start })
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

/// Whether a movement differs from the walk at the instant of their join.
fn misses(solution: &Solution, walk: &Solution, is_start: bool) -> bool {
    let (outline, at_s) = if is_start { (START, solution.problem().duration_s) } else { (STOP, 0.0) };
    let [own, joined] = [solution.instant(at_s), walk.instant(outline.joins * walk.cycle_s())];
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

/// The problem of a stop; with the posture of standing, of a start from it.
fn joining(human: &Human, walk: &Solution, standing: Option<&[f64]>) -> Result<MovementProblem, CurvedJointError> {
    let is_start = standing.is_some();
    let outline = if is_start { START } else { STOP };
    let (like, cycle_s) = (walk.problem(), walk.cycle_s());
    let (duration_s, join_s) = (outline.duration * cycle_s, outline.joins * cycle_s);
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
    let mixed = |share: &f64| {
        // 0 in the walk, 1 in standing.
        let away = if is_start { ((1.0 - share) / (1.0 - outline.rests)).min(1.0) } else { *share };
        let slowed = duration_s * (away - 0.5 * away * away);
        let walked = walk.instant(if is_start { join_s - slowed } else { join_s + slowed }).posture;
        let w = away.powi(3) * (10.0 - away * (15.0 - 6.0 * away));
        walked[0].iter().zip(&rest).map(|(walked, rest)| (1.0 - w) * walked + w * rest).collect::<Vec<f64>>()
    };
    let postures: Vec<Vec<f64>> = problem.shares().iter().map(mixed).collect();
    let guess = on_right_foot(&problem, postures)?;
    let costs = EffortCosts { pelvis: PELVIS, ..EffortCosts::default() };
    let last = problem.instants() - 1;
    let [in_walk, at_rest] = if is_start { [last, 0] } else { [0, last] };
    // The walk determines the height of the pelvis, but not the distance travelled.
    let [mut walked, rates, _] = walk.instant(join_s).posture;
    if let Some((forward, _)) = like.model.anatomy().coordinate(Movement::PelvisForward, None) {
        walked[forward.index()] = guess[in_walk][forward.index()];
    }
    let still = vec![0.0; rates.len()];
    let ends = [
        End { instant: in_walk, place: &walked, rates: &rates, is_exact: true },
        End { instant: at_rest, place: &guess[at_rest], rates: &still, is_exact: is_start },
    ];
    let mut movement = MovementProblem::of_guess(human, &costs, problem, &guess, &ends, |muscles| {
        muscles.joints();
        muscles.trunk();
        muscles.moment_rates();
    })?;
    let [height, lower] = CLEARANCE.map(|share| share * like.length_m);
    for sphere in (0..like.soles.len()).filter(|sphere| like.soles[*sphere].side == Side::Left) {
        let span = outline.swing.map(|share| share * duration_s);
        movement.require(span, Quantity::Height(sphere), Bound::AtLeast, height, lower);
    }
    let spheres: Vec<usize> = (0..like.soles.len()).collect();
    for (bound, share) in [Bound::AtLeast, Bound::AtMost].into_iter().zip(LOADS) {
        let load = Quantity::GroundForce(spheres.clone(), 1);
        movement.require([0.0, duration_s], load, bound, share * like.weight_n(), LOAD_COST * like.weight_n());
    }
    Ok(movement)
}

/// Moves the pelvis in all postures so that the right foot stays where it is in the first one, with the lowest sole as
/// high as there.
fn on_right_foot(problem: &Problem, postures: Vec<Vec<f64>>) -> Result<Vec<Vec<f64>>, CurvedJointError> {
    let anatomy = problem.model.anatomy();
    let still = vec![0.0; problem.model.coordinates().len()];
    let at_rest = |q| Instant { posture: [q, still.clone(), still.clone()], ..Instant::default() };
    let mut instants: Vec<Instant> = postures.into_iter().map(at_rest).collect();
    Evaluator::new(&problem.model, &problem.soles, &problem.levels_m)?.evaluate_forces(&problem.shoes, &mut instants);
    let of_foot = |at: &Instant| {
        let right = problem.soles.iter().zip(&at.contacts).filter(|(sole, _)| sole.side == Side::Right);
        let count = right.clone().count().max(1) as f64;
        let middle = right.fold([0.0; 2], |[x, z], (_, contact)| [x + contact.place.x, z + contact.place.z]);
        let lowest = at.contacts.iter().map(|contact| contact.values.height).fold(f64::INFINITY, f64::min);
        [middle[0] / count, lowest, middle[1] / count]
    };
    let first = instants.first().map_or([0.0; 3], of_foot);
    let moved = [Movement::PelvisForward, Movement::PelvisUp, Movement::PelvisRight];
    let placed = |at: &Instant| {
        let mut posture = at.posture[0].clone();
        for ((movement, first), now) in moved.iter().zip(first).zip(of_foot(at)) {
            if let Some((id, sign)) = anatomy.coordinate(*movement, None) {
                posture[id.index()] += sign * (first - now);
            }
        }
        posture
    };
    Ok(instants.iter().map(placed).collect())
}
