//! Predicted walks that choose their cadence: at a given speed, the cadence of the least cost.
//!
//! The duration of a problem is fixed. So the walk is solved at several cadences, each time starting from the solution
//! at the cadence beside it. When the middle one of three neighbouring cadences is the cheapest, a parabola goes
//! through their costs, and its lowest point is the cadence that is chosen. The solver stops about one percent above a
//! minimum, and costs of neighbouring cadences differ by a few percent only. Therefore each solution gets some more
//! steps of the solver, and cadences are [`STEP`] apart.

use super::conditions::WalkConditions;
use super::error::OptimalWalkError;
use super::find::OptimalWalk;
use super::muscles::EffortCosts;
use super::observer::Observer;
use super::solve::Continuation;
use super::walk::{WalkCosts, WalkProblem};
use crate::findings::Findings;
use crate::gait::{Gait, Walk};
use crate::model::anthropometry::Build;
use crate::model::full_body::full_body;

/// Distance of the cadences that are compared, as a share of that of the walk.
const STEP: f64 = 0.07;
/// Cadences beyond the first one on either side.
const FARTHEST: i32 = 2;
/// Stages near a known walk before these; the finer ones would be solved twice.
const COARSE: usize = 3;
/// More steps of the solver near a solution.
const POLISH: [Continuation; 2] = [
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0002, updates: 2, steps: 30, gain: 1e-4 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.00003, updates: 6, steps: 30, gain: 1e-4 },
];

/// A walk at one of the cadences.
struct Tried {
    /// Number of steps from the cadence of the walk.
    place: i32,
    found: OptimalWalk,
    walk: Walk,
    cost: f64,
}

impl Tried {
    fn new(place: i32, mut found: OptimalWalk, walk: Walk) -> Result<Tried, OptimalWalkError> {
        found.solution = found.problem.problem.solve(found.solution.unknowns(), &POLISH)?;
        found.check_prediction(&walk)?;
        let cost = found.solution.progress.last().map_or(f64::INFINITY, |last| last.cost);
        Ok(Tried { place, found, walk, cost })
    }

    /// The walk at another cadence; `None` if there is none.
    fn at(&self, build: &Build, gait: &Gait, place: i32) -> Result<Option<Tried>, OptimalWalkError> {
        let walk = Walk::new(gait, self.walk.leg_length(), &mut Findings::default());
        let Ok(walk) = walk else { return Ok(None) };
        match self.found.near(build, &walk).and_then(|found| Tried::new(place, found, walk)) {
            Err(stopped @ OptimalWalkError::Stopped { .. }) => Err(stopped),
            tried => Ok(tried.ok()),
        }
    }
}

impl OptimalWalk {
    /// As [`OptimalWalk::predict`], at the cadence of the least cost within a fifth of that of `walk`, and the walk
    /// with this cadence. The speed stays.
    ///
    /// # Errors
    /// As [`OptimalWalk::predict`]; an observer that stops the solver. Other cadences at which no walk is found are not
    /// chosen.
    pub fn predict_freely(
        build: &Build,
        walk: &Walk,
        conditions: &WalkConditions,
        observer: &Observer,
    ) -> Result<(OptimalWalk, Walk), OptimalWalkError> {
        let gait = |steps: f64| {
            let steps_s = 2.0 * (1.0 + STEP * steps) / walk.cycle_s();
            let pace = walk.gait().pace.with(Some(walk.speed()), None, Some(steps_s));
            Gait { pace, ..walk.gait().clone() }
        };
        let found = OptimalWalk::predict_observed(build, walk, conditions, observer)?;
        let mut tried = vec![Tried::new(0, found, walk.clone())?];
        let mut best = 0;
        loop {
            let place = tried[best].place;
            for beside in [place - 1, place + 1] {
                if beside.abs() <= FARTHEST && tried.iter().all(|known| known.place != beside) {
                    tried.extend(tried[best].at(build, &gait(f64::from(beside)), beside)?);
                }
            }
            let least = (0..tried.len()).min_by(|&a, &b| tried[a].cost.total_cmp(&tried[b].cost)).unwrap_or(best);
            if least == best {
                break;
            }
            best = least;
        }
        let place = tried[best].place;
        let cost = |beside: i32| tried.iter().find(|known| known.place == beside).map(|known| known.cost);
        let at_vertex = match (cost(place - 1), cost(place + 1)) {
            (Some(slower), Some(faster)) => {
                let steps = f64::from(place) + vertex(slower, tried[best].cost, faster);
                tried[best].at(build, &gait(steps), place)?
            }
            _ => None,
        };
        let chosen = at_vertex.unwrap_or_else(|| tried.swap_remove(best));
        Ok((chosen.found, chosen.walk))
    }

    /// The same prediction of another walk, from this one, before [`POLISH`].
    fn near(&self, build: &Build, walk: &Walk) -> Result<OptimalWalk, OptimalWalkError> {
        let known = &self.problem.problem;
        let level = full_body(build)?;
        let base = WalkProblem::over(known.span, &level, &known.soles, known.shoes, walk, &WalkCosts::default())?;
        let base = base.observed_by(&known.observer);
        let problem = base.of_muscles(&self.human, walk, &EffortCosts::default(), &self.conditions, 0.0);
        let known = self.solution.unknowns();
        let solution = match problem.approach(&self.problem, known, &problem.near_stages()[..COARSE])? {
            Some(solution) => solution,
            None => problem.solve_near(&self.problem, known)?,
        };
        Ok(OptimalWalk { human: self.human.clone(), problem, solution, conditions: self.conditions.clone() })
    }
}

/// Place of the vertex of the parabola through values at -1, 0 and 1, of which the middle one is the least.
fn vertex(before: f64, least: f64, after: f64) -> f64 {
    let curvature = before - 2.0 * least + after;
    if curvature > 0.0 { (0.5 * (before - after) / curvature).clamp(-0.5, 0.5) } else { 0.0 }
}
