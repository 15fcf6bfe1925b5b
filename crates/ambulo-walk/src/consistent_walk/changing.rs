//! A consistent walk whose pace changes on the way.
//!
//! The walk is made consistent at every constant pace. Each change is one motion from the state of the walk before to
//! the state of the walk after (`Passage`), or from or to rest, so the whole walk is C² and needs no force from
//! outside.
//! Pinned by: tests/walk_changes.rs

use super::settings::ConsistentWalkSettings;
use super::walk::{ConsistentWalk, make_consistent_walk, root_of, soft_ground};
use crate::engine::{Integrator, Signal, StepSettings};
use crate::findings::Findings;
use crate::gait::{PaceRamp, Walk};
use crate::model::Model;
use crate::model::anthropometry::Human;
use crate::optimal::{FINE_STAGES, OptimalWalkError, Passage, PassageEnd, STAGES, Solution, WalkProblem};
use crate::walking::{WalkRecording, Walker, WalkingError};

/// Steps of the new pace after a change in which the walk settles.
const SETTLING_STEPS: f64 = 1.0;

/// A walk whose pace changes.
#[derive(Debug, Clone)]
pub struct ChangingWalk {
    walk: Walk,
    /// Consistent walks at the different paces, in the order in which they come.
    paces: Vec<ConsistentWalk>,
    /// The standing figure, if it stands at some time.
    standing: Option<(WalkProblem, Solution)>,
    /// The changes in order of time.
    changes: Vec<Change>,
}

/// One change of pace.
#[derive(Debug, Clone)]
struct Change {
    start_s: f64,
    duration_s: f64,
    /// Indices of the paces before and after it; `None` where the figure stands.
    paces: [Option<usize>; 2],
    solution: Solution,
}

/// Makes a walk with changes of pace consistent.
///
/// # Errors
/// If the figure has joints that are not hinges or slides, or the built-in laws cannot be read; an observer that stops
/// the solver.
pub fn make_changing_walk(
    human: &Human,
    walk: &Walk,
    settings: &ConsistentWalkSettings,
) -> Result<ChangingWalk, OptimalWalkError> {
    let mut made = ChangingWalk { walk: walk.clone(), paces: Vec::new(), standing: None, changes: Vec::new() };
    let ramps = walk.pace_ramps();
    if ramps.is_empty() && walk.clock(0.0).stands() {
        made.stand(human, settings, 0.0)?;
    } else if ramps.is_empty() {
        made.paces.push(make_consistent_walk(human, walk, settings)?);
    }
    for (number, ramp) in ramps.iter().enumerate() {
        let next_s = ramps.get(number + 1).map_or(f64::INFINITY, |next| next.start_s);
        let change = made.change(human, settings, number, (ramp, next_s))?;
        made.changes.push(change);
    }
    Ok(made)
}

impl ChangingWalk {
    /// Consistent walks at the different paces, in the order in which they come.
    #[must_use]
    pub fn paces(&self) -> &[ConsistentWalk] {
        &self.paces
    }

    /// The motions of the changes, in order of time; check their [`Solution::unbalanced`] forces.
    pub fn changes(&self) -> impl Iterator<Item = &Solution> {
        self.changes.iter().map(|change| &change.solution)
    }

    /// The number of the walk at a pace, which is made if it is new.
    fn pace(
        &mut self,
        human: &Human,
        pace: &Walk,
        settings: &ConsistentWalkSettings,
    ) -> Result<usize, OptimalWalkError> {
        if let Some(known) = self.paces.iter().position(|known| known.walk() == pace) {
            return Ok(known);
        }
        self.paces.push(make_consistent_walk(human, pace, settings)?);
        Ok(self.paces.len() - 1)
    }

    /// Solves one change. It ends some steps after its ramp, at the latest at the start of the next one.
    fn change(
        &mut self,
        human: &Human,
        settings: &ConsistentWalkSettings,
        number: usize,
        (ramp, next_s): (&PaceRamp, f64),
    ) -> Result<Change, OptimalWalkError> {
        let walk = self.walk.clone();
        let end_s = ramp.start_s + ramp.duration_s;
        let settling_s = 0.5 * SETTLING_STEPS * ramp.paces[1].cycle_s();
        let duration_s = (end_s + settling_s).min(next_s) - ramp.start_s;
        let mut paces = [None; 2];
        for ((pace, steady), time_s) in paces.iter_mut().zip(&ramp.paces).zip([ramp.start_s, end_s]) {
            if !walk.clock(time_s).stands() {
                *pace = Some(self.pace(human, steady, settings)?);
            } else {
                self.stand(human, settings, time_s)?;
            }
        }
        let [Some(before), Some(after)] = paces.map(|pace| self.end(pace)) else {
            return Err(OptimalWalkError::Order);
        };
        let passage = Passage { change: number, start_s: ramp.start_s, duration_s, ends: [before, after] };
        let problem = WalkProblem::passage(human, &human.soles, settings.shoes, &walk, &settings.changes, &passage)?;
        let problem = problem.observed_by(&settings.observer);
        let solution = problem.solve_coarse_first(&FINE_STAGES)?;
        Ok(Change { start_s: ramp.start_s, duration_s, paces, solution })
    }

    /// Solves how the figure stands at a time [s], once.
    fn stand(&mut self, human: &Human, settings: &ConsistentWalkSettings, time_s: f64) -> Result<(), OptimalWalkError> {
        if self.standing.is_none() {
            let ConsistentWalkSettings { shoes, costs, observer, .. } = settings;
            let problem = WalkProblem::standing(human, &human.soles, *shoes, &self.walk, costs, time_s)?;
            let problem = problem.observed_by(observer);
            let solution = problem.solve(&STAGES)?;
            self.standing = Some((problem, solution));
        }
        Ok(())
    }

    /// The motion at a pace, or of standing.
    fn end(&self, pace: Option<usize>) -> Option<PassageEnd<'_>> {
        match pace {
            Some(pace) => {
                let ConsistentWalk { walk, problem, solution } = &self.paces[pace];
                Some(PassageEnd { problem, solution, cycle_s: walk.cycle_s() })
            }
            None => {
                let (problem, solution) = self.standing.as_ref()?;
                Some(PassageEnd { problem, solution, cycle_s: problem.problem.duration_s })
            }
        }
    }

    /// Writes coordinates, rates and accelerations at a time [s]. The forward position restarts in every part of the
    /// walk.
    pub fn write(&self, time_s: f64, posture: &mut [Vec<f64>; 3]) {
        let begun = self.changes.partition_point(|change| change.start_s <= time_s).checked_sub(1);
        let (change, since_s) = match (begun, self.changes.first()) {
            (Some(begun), _) => (&self.changes[begun], time_s - self.changes[begun].start_s),
            (None, Some(first)) => (first, 0.0),
            (None, None) => {
                return match (self.paces.first(), &self.standing) {
                    (Some(pace), _) => pace.write(time_s, posture),
                    (None, Some((_, standing))) => standing.write(time_s, posture),
                    (None, None) => {}
                };
            }
        };
        let pace = if begun.is_none() { change.paces[0] } else { change.paces[1] };
        if begun.is_some() && since_s < change.duration_s {
            change.solution.write(since_s, posture);
        } else if let Some(PassageEnd { solution, cycle_s, .. }) = self.end(pace) {
            solution.write(self.walk.clock(time_s).phase.value * cycle_s, posture);
        }
    }

    /// The motion from `start_s`: one signal per coordinate of the model. The root's translations are zero, because
    /// forces move them.
    ///
    /// # Panics
    /// If the duration is not above zero.
    #[must_use]
    pub fn signals(&self, human: &Human, start_s: f64, duration_s: f64) -> Vec<Signal> {
        let model = &human.model;
        let count = model.coordinates().len();
        let mut posture = [(); 3].map(|()| vec![0.0; count]);
        let root = ["pelvis_tx", "pelvis_ty"].map(|name| model.coordinate(name).map(|id| id.index()));
        Signal::over(count, duration_s, |since_s, row| {
            self.write(start_s + since_s, &mut posture);
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = if root.contains(&Some(k)) { [0.0; 3] } else { [0, 1, 2].map(|d| posture[d][k]) };
            }
        })
    }

    /// Coordinates, rates and accelerations at a time [s].
    #[must_use]
    pub fn posture(&self, model: &Model, time_s: f64) -> [Vec<f64>; 3] {
        let mut posture = [(); 3].map(|()| vec![0.0; model.coordinates().len()]);
        self.write(time_s, &mut posture);
        posture
    }

    /// Simulates `duration_s` on the soft shoes of the settings, from the posture and with the velocity of the walk at
    /// time zero. Only joints and trunk are driven.
    ///
    /// # Errors
    /// If the model is not planar, or the duration has no whole step.
    pub fn simulate(
        &self,
        human: &Human,
        settings: &ConsistentWalkSettings,
        step_s: f64,
        duration_s: f64,
        findings: &mut Findings,
    ) -> Result<WalkRecording, WalkingError> {
        let step = StepSettings { step_s, integrator: Integrator::Impulse, ..StepSettings::default() };
        let signals = self.signals(human, 0.0, duration_s + step_s);
        let posture = self.posture(&human.model, 0.0);
        let [place, velocity] = root_of(&human.model, &posture);
        let walker = Walker::new(human, signals, &soft_ground(settings.shoes), self.walk.speed())?;
        walker.starting_at(place, velocity).moving_as(&posture).walk(&step, duration_s, findings)
    }
}
