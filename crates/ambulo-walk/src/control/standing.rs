//! Standing, stopping and walking off: their plans and gains, and the progress of a figure in them.
//!
//! The gains of a stop follow from the Riccati equation backwards from standing, and the gains of a start backwards
//! from the walk that it joins. Standing is a plan of one time step that repeats. Feet that stand cannot be moved by
//! torques, so that a deviation of their place would cost for ever: standing looks ahead for some seconds only.

use super::activation::activated;
use super::figure::FigureWorld;
use super::linear::Impedance;
use super::pace::KEPT_EVERY;
use super::plan::{CyclePlan, PlannedStep};
use super::riccati::{Costs, StepMap};
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
    /// Steps on the spot.
    Stepping(usize),
}

/// A place in the plan.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Moment {
    /// Share of the cycle φ, 0 to 1.
    pub(super) share: f64,
    pub(super) stage: Stage,
    /// Whether a stop and the start after it are the mirror images of the plan: the right foot steps first.
    pub(super) is_mirrored: bool,
}

impl Moment {
    /// The share of the cycle at which a movement joins the walk, or its mirror image half a cycle later.
    pub(super) fn joins(self, share: f64) -> f64 {
        if self.is_mirrored { (share + 0.5).rem_euclid(1.0) } else { share }
    }
}

/// Plans and gains of a movement.
#[derive(Debug, Clone)]
struct Movement {
    steps: Vec<PlannedStep>,
    /// One row per joint, one column per entry of the state.
    gains: Vec<DMatrix<f64>>,
    /// Empty where feedback acts at once.
    maps: Vec<StepMap>,
    /// Matrix P of every tenth time step.
    along: Vec<DMatrix<f64>>,
}

/// Standing, and how a figure comes there and walks off.
#[derive(Debug, Clone)]
pub(super) struct Standing {
    stop: Movement,
    /// One time step.
    stand: Movement,
    start: Movement,
    /// Steps on the spot; none where the figure does not step to keep its balance.
    steps: Option<Movement>,
    /// Height of the sole of the right and the left foot [m].
    pub(super) soles_m: [f64; 2],
    /// The mirror images of these movements, if the walk is its own mirror image.
    image: Option<Image>,
}

/// Where entries come from in a mirror image, and their signs.
#[derive(Debug, Clone)]
struct Image {
    coordinates: Vec<(usize, f64)>,
    /// Entries of the state.
    state: Vec<(usize, f64)>,
    joints: Vec<(usize, f64)>,
}

impl Image {
    /// `has_torques`: the torques of the joints are a part of the state.
    fn of(walk: &CyclePlan, has_torques: bool) -> Option<Image> {
        let coordinates = walk.mirror.clone()?;
        let among = |some: &[usize]| -> Option<Vec<(usize, f64)>> {
            let place = |c: &usize| {
                let (other, sign) = coordinates[*c];
                Some((some.iter().position(|own| *own == other)?, sign))
            };
            some.iter().map(place).collect()
        };
        let (places, joints) = (among(&walk.places())?, among(&walk.joints())?);
        let rates = coordinates.iter().map(|(c, sign)| (places.len() + c, *sign));
        let first = places.len() + coordinates.len();
        let torques = joints.iter().filter(|_| has_torques).map(|(k, sign)| (first + k, *sign));
        let state = places.iter().copied().chain(rates).chain(torques).collect();
        Some(Image { state, joints, coordinates })
    }

    fn step(&self, step: &PlannedStep) -> PlannedStep {
        let image = |values: &Vec<f64>| self.coordinates.iter().map(|(c, sign)| sign * values[*c]).collect();
        let both = |state: &[Vec<f64>; 2]| state.each_ref().map(image);
        PlannedStep { state: both(&step.state), target: both(&step.target), torques: image(&step.torques) }
    }
}

fn imaged(values: &DVector<f64>, entries: &[(usize, f64)]) -> DVector<f64> {
    DVector::from_iterator(entries.len(), entries.iter().map(|(k, sign)| sign * values[*k]))
}

impl Standing {
    fn at(&self, stage: Stage) -> Option<(&Movement, usize)> {
        match stage {
            Stage::Walking => None,
            Stage::Stopping(step) => Some((&self.stop, step)),
            Stage::Standing => Some((&self.stand, 0)),
            Stage::Starting(step) => Some((&self.start, step)),
            Stage::Stepping(step) => Some((self.steps.as_ref()?, step)),
        }
    }

    /// The plan in a stage; none while it walks.
    pub(super) fn planned(&self, at: Moment) -> Option<PlannedStep> {
        let (movement, step) = self.at(at.stage)?;
        let step = movement.steps.get(step)?;
        Some(self.image(at).map_or_else(|| step.clone(), |image| image.step(step)))
    }

    /// K times a deviation of the state; none while it walks.
    pub(super) fn feedback(&self, at: Moment, apart: &DVector<f64>) -> Option<DVector<f64>> {
        let (movement, step) = self.at(at.stage)?;
        let gain = movement.gains.get(step)?;
        Some(match self.image(at) {
            Some(image) => imaged(&(gain * imaged(apart, &image.state)), &image.joints),
            None => gain * apart,
        })
    }

    /// xᵀ P x of a deviation; none while it walks.
    pub(super) fn cost_to_go(&self, at: Moment, apart: &DVector<f64>) -> Option<f64> {
        let (movement, step) = self.at(at.stage)?;
        let value = movement.along.get(step / KEPT_EVERY)?;
        let apart = self.image(at).map_or_else(|| apart.clone(), |image| imaged(apart, &image.state));
        Some(apart.dot(&(value * &apart)))
    }

    /// Time steps of steps on the spot.
    pub(super) fn stepping(&self) -> Option<usize> {
        self.steps.as_ref().map(|steps| steps.steps.len())
    }

    /// The deviation of the state after a time step; none while it walks.
    pub(super) fn after(&self, at: Moment, apart: &DVector<f64>, inputs: &DVector<f64>) -> Option<DVector<f64>> {
        let (movement, step) = self.at(at.stage)?;
        let map = movement.maps.get(step)?;
        Some(match self.image(at) {
            Some(image) => {
                imaged(&map.after(&imaged(apart, &image.state), &imaged(inputs, &image.joints)), &image.state)
            }
            None => map.after(apart, inputs),
        })
    }

    fn image(&self, at: Moment) -> Option<&Image> {
        self.image.as_ref().filter(|_| at.is_mirrored)
    }

    /// Whether movements are the mirror images of the plan, for all that there are.
    pub(super) fn images(&self) -> impl Iterator<Item = bool> {
        [false].into_iter().chain(self.image.iter().map(|_| true))
    }

    /// Gains of all stages.
    pub(super) fn gains(&self) -> impl Iterator<Item = &DMatrix<f64>> {
        [&self.stop, &self.stand, &self.start].into_iter().chain(&self.steps).flat_map(|movement| &movement.gains)
    }

    /// The stage after a time step.
    pub(super) fn next(&self, stage: Stage, stands: bool) -> Stage {
        match stage {
            Stage::Stopping(step) if step + 1 < self.stop.steps.len() => Stage::Stopping(step + 1),
            Stage::Stopping(_) => Stage::Standing,
            Stage::Standing if !stands => Stage::Starting(0),
            Stage::Starting(step) if step + 1 < self.start.steps.len() => Stage::Starting(step + 1),
            Stage::Starting(_) => Stage::Walking,
            Stage::Stepping(step) if Some(step + 1) < self.stepping() => Stage::Stepping(step + 1),
            Stage::Stepping(_) => Stage::Standing,
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
    /// Whether feedback acts later, so that it must foresee the state.
    pub(super) is_late: bool,
    /// Share of a torque of feedback that is left after a time step; none where it acts at once.
    pub(super) left: Option<f64>,
}

impl Maker<'_> {
    /// Standing of a figure whose start joins a walk with the matrix P of the Riccati equation, with steps on the spot
    /// for one that steps to keep its balance; `lowest` are heights of soles.
    pub(super) fn standing(
        &mut self,
        movements: &StandingMovements,
        steps: Option<&Solution>,
        walk: &CyclePlan,
        value: &DMatrix<f64>,
        lowest: impl Fn(&[f64]) -> [f64; 2],
    ) -> Result<Standing, ControlError> {
        let stands = standing_step(&movements.stop)?;
        let soles_m = lowest(&stands.state[0]);
        let maps = self.maps(&walk.with_steps(vec![stands.clone()]))?;
        let times = (AHEAD_S / self.figure.settings.step_s) as usize;
        let (gain, of_standing) = self.costs.repeated(&maps[0], times).ok_or(ControlError::Riccati)?;
        let along = vec![of_standing.clone()];
        let stand = Movement { gains: vec![gain], steps: vec![stands], maps: self.kept(maps), along };
        let steps = steps.map(|steps| self.movement(steps, walk, of_standing.clone())).transpose()?;
        let stop = self.movement(&movements.stop, walk, of_standing)?;
        let start = self.movement(&movements.start, walk, value.clone())?;
        Ok(Standing { stop, stand, start, steps, soles_m, image: Image::of(walk, self.left.is_some()) })
    }

    /// A movement with the matrix P of the Riccati equation after it.
    fn movement(
        &mut self,
        solution: &Solution,
        walk: &CyclePlan,
        mut value: DMatrix<f64>,
    ) -> Result<Movement, ControlError> {
        let plan = walk.with_steps(CyclePlan::new(self.human, solution, self.figure.settings.step_s)?.steps);
        let maps = self.maps(&plan)?;
        let mut along = Vec::new();
        let keep = |number: usize, value: &DMatrix<f64>| {
            if number.is_multiple_of(KEPT_EVERY) {
                along.push(value.clone());
            }
        };
        let gains = self.costs.gains_with(&maps, &mut value, keep).ok_or(ControlError::Riccati)?;
        along.reverse();
        Ok(Movement { steps: plan.steps, gains, maps: self.kept(maps), along })
    }

    fn maps(&mut self, plan: &CyclePlan) -> Result<Vec<StepMap>, ControlError> {
        Ok(activated(self.figure.maps(plan, self.impedances)?, self.left))
    }

    fn kept(&self, maps: Vec<StepMap>) -> Vec<StepMap> {
        if self.is_late { maps } else { Vec::new() }
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
