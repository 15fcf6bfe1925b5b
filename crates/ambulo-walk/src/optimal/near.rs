//! A walk from the solution of a similar one: another speed, or a figure of another size with the same joints or some
//! of them.
//!
//! The start differs from the new first guess as the known solution differs from its own guess; translations grow with
//! leg length. So the result of the solver for the walk is kept, and the change of the targets is added.
//! Feet of this start slip by some mm/s and their soles are too deep or too high by fractions of a millimetre, which
//! costs much with the final friction and slack; the first stages have less of both.

use super::error::OptimalWalkError;
use super::solution::Solution;
use super::solve::Continuation;
use super::walk::{WalkProblem, moves_sideways};
use crate::dynamics::CurvedJointError;
use crate::model::{CoordinateId, CoordinateKind, Movement};

/// Stages of a solution that starts near a known one.
pub const NEAR_STAGES: [Continuation; 5] = [
    Continuation { stiffness: 1.0, creep: 5.0, slip: 1.0, slack: 0.005, updates: 0, steps: 10, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 2.0, slip: 1.0, slack: 0.002, updates: 0, steps: 10, gain: 3e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.001, updates: 0, steps: 10, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.0002, updates: 1, steps: 10, gain: 1e-3 },
    Continuation { stiffness: 1.0, creep: 1.0, slip: 1.0, slack: 0.00003, updates: 6, steps: 10, gain: 1e-3 },
];

/// Factors of the deviation of slip in these stages, for a walk in three dimensions.
const NEAR_SLIP: [f64; 5] = [4.0, 4.0, 3.0, 1.7, 1.0];
/// Steps of the solver before an update, and factor of the gain below which a stage ends, where the objective changes
/// more than near a known walk.
const LONGER: (usize, f64) = (3, 0.3);

/// Stages with more steps.
pub(super) fn longer(stages: &[Continuation]) -> Vec<Continuation> {
    let longer =
        |stage: &Continuation| Continuation { steps: LONGER.0 * stage.steps, gain: LONGER.1 * stage.gain, ..*stage };
    stages.iter().map(longer).collect()
}

impl WalkProblem {
    /// Solves the problem from the solution of a similar walk, in fewer steps than from the first guess: another speed
    /// (steps of up to 0.2 m/s were tried) or cadence, another mass and height, fewer joints. `unknowns` solve `known`
    /// ([`Solution::unknowns`]): knot after knot, one number per coordinate [rad or m], without forward motion. If
    /// `known` lacks coordinates of this walk, or if span or knots are not the same, it starts from the first guess.
    ///
    /// Check [`Solution::progress`] or [`Solution::unbalanced`], as after [`WalkProblem::solve`].
    ///
    /// # Errors
    /// As [`WalkProblem::solve`].
    pub fn solve_near(&self, known: &WalkProblem, unknowns: &[f64]) -> Result<Solution, OptimalWalkError> {
        let stages = self.near_stages();
        let Some(found) = self.approach(known, unknowns, &stages)? else { return self.solve(self.stages()) };
        self.problem.balanced(found, &[&Continuation::on(&stages)], &self.kept)
    }

    /// [`NEAR_STAGES`] for this walk.
    pub(super) fn near_stages(&self) -> [Continuation; 5] {
        let mut stages = NEAR_STAGES;
        if moves_sideways(&self.problem.model) {
            for (stage, slip) in stages.iter_mut().zip(NEAR_SLIP) {
                stage.slip = slip;
            }
        }
        stages
    }

    /// Some stages of the solution near a known one; `None` where that is no start, see [`WalkProblem::solve_near`].
    pub(super) fn approach(
        &self,
        known: &WalkProblem,
        unknowns: &[f64],
        stages: &[Continuation],
    ) -> Result<Option<Solution>, OptimalWalkError> {
        let start = self.start_near(known, unknowns)?;
        start.map(|start| self.problem.solve_keeping(&start, stages, &self.kept)).transpose()
    }

    /// The start of this problem near a solution of a similar one; `None` if its splines do not determine all
    /// coordinates.
    fn start_near(&self, known: &WalkProblem, unknowns: &[f64]) -> Result<Option<Vec<f64>>, CurvedJointError> {
        let (own, other) = (&self.problem, &known.problem);
        let coordinates = own.model.coordinates();
        let places: Option<Vec<usize>> =
            coordinates.iter().map(|c| other.model.coordinate(&c.name).map(CoordinateId::index)).collect();
        let Some(places) = places else { return Ok(None) };
        if own.span != other.span || own.knots != other.knots || unknowns.len() != known.guess.len() {
            return Ok(None);
        }
        let larger = own.length_m / other.length_m;
        let mut start = self.guess.clone();
        let width = other.model.coordinates().len();
        let knots = unknowns.chunks(width).zip(known.guess.chunks(width));
        for (start, (solved, guessed)) in start.chunks_mut(coordinates.len()).zip(knots) {
            for ((x, &place), coordinate) in start.iter_mut().zip(&places).zip(coordinates) {
                let scale = if coordinate.kind == CoordinateKind::Translation { larger } else { 1.0 };
                *x += scale * (solved[place] - guessed[place]);
            }
        }
        if let Some((height, _)) = own.model.anatomy().coordinate(Movement::PelvisUp, None) {
            own.settle(&mut start, height)?;
        }
        Ok(Some(start))
    }
}
