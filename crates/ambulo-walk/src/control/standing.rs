//! Standing, stopping and walking off: their plans and gains, and the progress of a figure in them.
//!
//! The gains of a stop follow from the Riccati equation backwards from standing, and the gains of a start backwards
//! from the walk that it joins. Standing is a plan of one time step that repeats. Feet that stand cannot be moved by
//! torques, so that a deviation of their place would cost for ever: standing looks ahead for some seconds only.

use super::figure::FigureWorld;
use super::linear::Impedance;
use super::plan::{CyclePlan, PlannedStep};
use super::riccati::{Costs, foreseen};
use super::settings::ControlError;
use crate::model::anthropometry::Human;
use crate::optimal::{Solution, StandingMovements};
use nalgebra::{DMatrix, DVector};

/// Time for which standing looks ahead [s].
const AHEAD_S: f64 = 3.0;

/// Whether a figure walks, stops, stands or walks off; in a movement, with the number of its time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stage {
    Walking,
    Stopping(usize),
    Standing,
    Starting(usize),
}

/// Plans and gains of a movement.
#[derive(Debug, Clone)]
struct Movement {
    steps: Vec<PlannedStep>,
    /// One row per joint, one column per entry of the state.
    gains: Vec<DMatrix<f64>>,
}

/// Standing, and how a figure comes there and walks off.
#[derive(Debug, Clone)]
pub(super) struct Standing {
    stop: Movement,
    /// One time step.
    stand: Movement,
    start: Movement,
    /// Height of the sole of the right and the left foot [m].
    pub(super) soles_m: [f64; 2],
}

impl Standing {
    fn at(&self, stage: Stage) -> Option<(&Movement, usize)> {
        match stage {
            Stage::Walking => None,
            Stage::Stopping(step) => Some((&self.stop, step)),
            Stage::Standing => Some((&self.stand, 0)),
            Stage::Starting(step) => Some((&self.start, step)),
        }
    }

    /// The plan in a stage; none while it walks.
    pub(super) fn planned(&self, stage: Stage) -> Option<&PlannedStep> {
        self.at(stage).and_then(|(movement, step)| movement.steps.get(step))
    }

    /// K times a deviation of the state; none while it walks.
    pub(super) fn feedback(&self, stage: Stage, apart: &DVector<f64>) -> Option<DVector<f64>> {
        let gain = self.at(stage).and_then(|(movement, step)| movement.gains.get(step))?;
        Some(gain * apart)
    }

    /// Gains of all stages.
    pub(super) fn gains(&self) -> impl Iterator<Item = &DMatrix<f64>> {
        [&self.stop, &self.stand, &self.start].into_iter().flat_map(|movement| &movement.gains)
    }

    /// The stage after a time step.
    pub(super) fn next(&self, stage: Stage, stands: bool) -> Stage {
        match stage {
            Stage::Stopping(step) if step + 1 < self.stop.steps.len() => Stage::Stopping(step + 1),
            Stage::Stopping(_) => Stage::Standing,
            Stage::Standing if !stands => Stage::Starting(0),
            Stage::Starting(step) if step + 1 < self.start.steps.len() => Stage::Starting(step + 1),
            Stage::Starting(_) => Stage::Walking,
            Stage::Standing | Stage::Walking => stage,
        }
    }
}

/// Makes plans and gains.
pub(super) struct Maker<'a> {
    pub(super) human: &'a Human,
    pub(super) figure: FigureWorld,
    pub(super) impedances: &'a [Impedance],
    pub(super) costs: Costs,
    /// Time steps after which feedback acts.
    pub(super) delay: usize,
}

impl Maker<'_> {
    /// Standing of a figure whose start joins a walk with the matrix P of the Riccati equation, `delay` steps later;
    /// `lowest` are heights of soles.
    pub(super) fn standing(
        &mut self,
        movements: &StandingMovements,
        walk: &CyclePlan,
        value: &DMatrix<f64>,
        lowest: impl Fn(&[f64]) -> [f64; 2],
    ) -> Result<Standing, ControlError> {
        let stands = standing_step(&movements.stop)?;
        let soles_m = lowest(&stands.state[0]);
        let maps = self.figure.maps(&walk.with_steps(vec![stands.clone()]), self.impedances)?;
        let times = (AHEAD_S / self.figure.settings.step_s) as usize;
        let (gain, of_standing) = self.costs.repeated(&maps[0], times).ok_or(ControlError::Riccati)?;
        let stand = Movement { gains: foreseen(&maps, &[gain], self.delay), steps: vec![stands.clone()] };
        let stop = self.movement(&movements.stop, walk, vec![stands; self.delay], of_standing)?;
        let joined = walk.step_at(StandingMovements::JOINS[1]);
        let after = (joined..joined + self.delay).map(|k| walk.steps[k % walk.steps.len()].clone()).collect();
        let start = self.movement(&movements.start, walk, after, value.clone())?;
        Ok(Standing { stop, stand, start, soles_m })
    }

    /// A movement followed by the steps `after`, with the matrix P of the Riccati equation after these.
    fn movement(
        &mut self,
        solution: &Solution,
        walk: &CyclePlan,
        after: Vec<PlannedStep>,
        mut value: DMatrix<f64>,
    ) -> Result<Movement, ControlError> {
        let mut steps = CyclePlan::new(self.human, solution, self.figure.settings.step_s)?.steps;
        let count = steps.len();
        steps.extend(after);
        let plan = walk.with_steps(steps);
        let maps = self.figure.maps(&plan, self.impedances)?;
        let gains = self.costs.gains(&maps, &mut value).ok_or(ControlError::Riccati)?;
        let mut gains = foreseen(&maps, &gains, self.delay);
        gains.truncate(count);
        let mut steps = plan.steps;
        steps.truncate(count);
        Ok(Movement { steps, gains })
    }
}

/// The end of a stop as a time step that repeats.
fn standing_step(stop: &Solution) -> Result<PlannedStep, ControlError> {
    let samples = stop.samples(&[stop.problem().duration_s])?;
    let [q, qd, _] = samples.iter().map(|sample| sample.posture.clone()).next().unwrap_or_default();
    let torques = samples.into_iter().map(|sample| sample.forces).next().unwrap_or_default();
    let state = [q, vec![0.0; qd.len()]];
    Ok(PlannedStep { target: state.clone(), state, torques })
}
