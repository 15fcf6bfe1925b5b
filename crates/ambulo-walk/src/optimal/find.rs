//! Finding the walk of a figure: near normative curves, or predicted for some conditions.

use super::conditions::WalkConditions;
use super::error::{LARGEST_BETWEEN, OptimalWalkError};
use super::layout::Span;
use super::muscles::EffortCosts;
use super::observer::Observer;
use super::plan::WalkPlan;
use super::problem::Problem;
use super::solution::Solution;
use super::solve::Continuation;
use super::walk::{SPATIAL_STAGES, WalkCosts, WalkProblem, soles_with_width};
use crate::contact::HuntCrossley;
use crate::gait::Walk;
use crate::model::anthropometry::{Build, Human};
use crate::model::full_body::full_body;

/// Larger forces at the root mean that no walk was found [body weights, body weights × leg length]; those between are
/// reported with the walk.
const LARGEST_ROOT_FORCE: f64 = 1e-3;
/// Instants per knot interval at which the forces at the root between the instants of the problem are judged.
const BETWEEN: usize = 10;
/// Share of its strength by which the muscles of a joint may exceed it: the cost of weakness is steep, but no
/// constraint.
const LARGEST_OVERLOAD: f64 = 0.05;

/// An optimal walk of a figure.
#[derive(Debug, Clone)]
pub struct OptimalWalk {
    /// The figure.
    pub human: Human,
    /// The problem that was solved.
    pub problem: WalkProblem,
    /// Solution of the problem.
    pub solution: Solution,
    /// The conditions that it was predicted for, with the names of coordinates for all joints.
    pub conditions: WalkConditions,
}

impl OptimalWalk {
    /// Finds the walk of a figure in three dimensions on soft shoes: a built-in plan where one is for this walk; else a
    /// solution from the plan with the nearest speed; else a solution from the laws.
    ///
    /// # Errors
    /// A figure that cannot be built; no motion without outside forces.
    pub fn find(build: &Build, walk: &Walk) -> Result<OptimalWalk, OptimalWalkError> {
        OptimalWalk::find_observed(build, walk, &Observer::default())
    }

    /// As [`OptimalWalk::find`], followed by an observer.
    pub(crate) fn find_observed(
        build: &Build,
        walk: &Walk,
        observer: &Observer,
    ) -> Result<OptimalWalk, OptimalWalkError> {
        let (human, problem) = posed(build, walk, observer)?;
        if let Some(plan) = WalkPlan::of(build, walk)? {
            let solution = problem.problem.at(&plan.coefficients)?;
            if solution.unbalanced(LARGEST_ROOT_FORCE).is_none() {
                return Ok(OptimalWalk::level(human, problem, solution));
            }
        }
        if let Some((plan, near)) = WalkPlan::nearest(build.table, walk)? {
            let (_, known) = posed(&plan.build, &near, observer)?;
            let found = OptimalWalk::level(human, problem.clone(), problem.solve_near(&known, &plan.coefficients)?);
            if found.check(walk).is_ok() {
                return Ok(found);
            }
        }
        OptimalWalk::from_laws(build, walk, &SPATIAL_STAGES, observer)
    }

    /// As [`OptimalWalk::find`], with soles that are lifted further than usual, by `lift_m` in the middle of swing.
    ///
    /// # Errors
    /// As [`OptimalWalk::find`]; an observer that stops the solver.
    pub fn find_lifted(
        build: &Build,
        walk: &Walk,
        lift_m: f64,
        observer: &Observer,
    ) -> Result<OptimalWalk, OptimalWalkError> {
        let known = OptimalWalk::find_observed(build, walk, observer)?;
        if lift_m <= 0.0 {
            return Ok(known);
        }
        let Problem { soles, shoes, .. } = &known.problem.problem;
        let costs = WalkCosts { lift: lift_m, ..WalkCosts::default() };
        let problem = WalkProblem::new(&known.human, soles, *shoes, walk, &costs)?.observed_by(observer);
        let solution = problem.solve_near(&known.problem, known.solution.unknowns())?;
        let found = OptimalWalk::level(known.human, problem, solution);
        found.check(walk)?;
        Ok(found)
    }

    /// The figure with the soles of its plan, which are wider than the soles of the planar figure.
    #[must_use]
    pub fn figure(&self) -> Human {
        Human { soles: self.problem.problem.soles.clone(), ..self.human.clone() }
    }

    /// As [`OptimalWalk::find`], from the laws and in given stages.
    ///
    /// # Errors
    /// As [`OptimalWalk::find`].
    pub fn find_with(build: &Build, walk: &Walk, stages: &[Continuation]) -> Result<OptimalWalk, OptimalWalkError> {
        OptimalWalk::from_laws(build, walk, stages, &Observer::default())
    }

    fn from_laws(
        build: &Build,
        walk: &Walk,
        stages: &[Continuation],
        observer: &Observer,
    ) -> Result<OptimalWalk, OptimalWalkError> {
        let (human, problem) = posed(build, walk, observer)?;
        let solution = problem.solve(stages)?;
        let found = OptimalWalk::level(human, problem, solution);
        found.check(walk)?;
        Ok(found)
    }

    fn level(human: Human, problem: WalkProblem, solution: Solution) -> OptimalWalk {
        OptimalWalk { human, problem, solution, conditions: WalkConditions::default() }
    }

    /// Predicts the walk of a figure under some conditions, without normative curves as targets, at the speed and the
    /// cadence of a walk. If the conditions differ between the sides, so does the walk.
    ///
    /// # Errors
    /// As [`OptimalWalk::find`]; conditions that do not fit the figure; muscles that are too weak.
    pub fn predict(build: &Build, walk: &Walk, conditions: &WalkConditions) -> Result<OptimalWalk, OptimalWalkError> {
        OptimalWalk::predict_observed(build, walk, conditions, &Observer::default())
    }

    /// As [`OptimalWalk::predict`], followed by an observer.
    pub(crate) fn predict_observed(
        build: &Build,
        walk: &Walk,
        conditions: &WalkConditions,
        observer: &Observer,
    ) -> Result<OptimalWalk, OptimalWalkError> {
        let followed = OptimalWalk::find_observed(build, walk, observer)?;
        let conditions = conditions.checked(&followed.human.model)?;
        let human = conditions.figure(&followed.human)?;
        let (start, unknowns) = if conditions.is_symmetric() && !conditions.asymmetric {
            (followed.problem.clone(), followed.solution.unknowns().to_vec())
        } else {
            let shoes = followed.problem.problem.shoes;
            let soles = &followed.problem.problem.soles;
            let costs = WalkCosts::default();
            let whole = WalkProblem::over(Span::Cycle, &followed.human, soles, shoes, walk, &costs)?;
            let whole = whole.observed_by(observer);
            let unknowns = whole.problem.fitted(&followed.without_travel(&whole.problem));
            (whole, unknowns)
        };
        let found = start.predict(&human, walk, &EffortCosts::default(), &conditions, &unknowns)?;
        let found = OptimalWalk { human, problem: found.problem, solution: found.solution, conditions };
        found.check_prediction(walk)?;
        Ok(found)
    }

    /// Coordinates at the instants of a problem, without forward motion.
    fn without_travel(&self, problem: &Problem) -> Vec<Vec<f64>> {
        let count = problem.model.coordinates().len();
        let mut posture = [(); 3].map(|()| vec![0.0; count]);
        let at = |share: f64| {
            self.solution.write(share * problem.duration_s, &mut posture);
            if let Some((id, distance)) = problem.travel {
                posture[0][id.index()] -= share * distance;
            }
            posture[0].clone()
        };
        problem.shares().into_iter().map(at).collect()
    }

    /// Checks that muscles can do the motion, and that it needs no force from outside.
    pub(super) fn check_prediction(&self, walk: &Walk) -> Result<(), OptimalWalkError> {
        // Muscles that are too weak leave forces at the root too; the muscles are the cause.
        if let Some(overload) = self.solution.overload(LARGEST_OVERLOAD) {
            return Err(OptimalWalkError::TooWeak { speed: walk.speed(), overload });
        }
        self.check(walk)
    }

    /// Checks that the motion needs no force from outside.
    fn check(&self, walk: &Walk) -> Result<(), OptimalWalkError> {
        let solution = &self.solution;
        let (speed, cadence) = (walk.speed(), 120.0 / walk.cycle_s());
        let leg_length = self.human.dimensions.leg_length;
        if let Some(worst) = solution.unbalanced(LARGEST_ROOT_FORCE) {
            return Err(OptimalWalkError::NotConverged { speed, cadence, leg_length, worst });
        }
        let (share, _) = solution.root_forces(BETWEEN)?;
        if share > LARGEST_BETWEEN {
            return Err(OptimalWalkError::Ripple { speed, cadence, leg_length, share });
        }
        Ok(())
    }
}

/// A figure in three dimensions on soft shoes, and the problem of its walk.
fn posed(build: &Build, walk: &Walk, observer: &Observer) -> Result<(Human, WalkProblem), OptimalWalkError> {
    let human = full_body(build)?;
    let soles = soles_with_width(&human);
    let problem = WalkProblem::new(&human, &soles, HuntCrossley::SOFT_SHOES, walk, &WalkCosts::default())?;
    Ok((human, problem.observed_by(observer)))
}
