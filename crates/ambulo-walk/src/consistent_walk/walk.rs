//! A dynamically consistent walk: how it is computed, its motion, and the walk simulated with it.

use super::settings::ConsistentWalkSettings;
use crate::contact::HuntCrossley;
use crate::engine::{ImpactLaw, Integrator, Signal, StepSettings};
use crate::findings::Findings;
use crate::gait::Walk;
use crate::gait::machine::repeats;
use crate::model::Model;
use crate::model::anthropometry::Human;
use crate::optimal::{Continuation, FINE_STAGES, OptimalWalkError, STAGES, Sample, Solution, Span, WalkProblem};
use crate::spatial::Vec3;
use crate::walking::{GroundContact, Shoes, WalkRecording, Walker, WalkingError};

/// A dynamically consistent walk: all its external forces are ground forces.
#[derive(Debug, Clone)]
pub struct ConsistentWalk {
    pub(super) walk: Walk,
    /// The problem of optimal motion, with the gait as its first guess.
    pub(super) problem: WalkProblem,
    pub(super) solution: Solution,
}

/// Finds the motion near a gait at constant pace that ground forces explain without residual forces: half a cycle of it
/// if both sides do the same, else a whole cycle.
///
/// # Errors
/// If the figure has joints that are not hinges or slides, the machines of the gait do not repeat what they do, or the
/// built-in laws cannot be read; an observer that stops the solver.
pub fn make_consistent_walk(
    human: &Human,
    walk: &Walk,
    settings: &ConsistentWalkSettings,
) -> Result<ConsistentWalk, OptimalWalkError> {
    if !repeats(walk) {
        return Err(OptimalWalkError::Machines { gait: walk.name().to_owned() });
    }
    let span = if walk.is_symmetric() { Span::MirroredHalfCycle } else { Span::Cycle };
    let problem = WalkProblem::over(span, human, &human.soles, settings.shoes, walk, &settings.costs)?;
    let problem = problem.observed_by(&settings.observer);
    let stages: &[Continuation] = if walk.gait().follows_people() { &STAGES } else { &FINE_STAGES };
    let solution = problem.solve_coarse_first(stages)?;
    Ok(ConsistentWalk { walk: walk.clone(), problem, solution })
}

impl ConsistentWalk {
    /// The gait, before its motion was changed.
    #[must_use]
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// The solution of the problem of optimal motion; check its [`Solution::unbalanced`] forces.
    #[must_use]
    pub fn solution(&self) -> &Solution {
        &self.solution
    }

    /// Writes coordinates, rates and accelerations at one time [s]; each list has one entry per coordinate of the
    /// model.
    pub fn write(&self, time_s: f64, posture: &mut [Vec<f64>; 3]) {
        self.solution.write(time_s, posture);
    }

    /// Motion and forces of the planned motion at some times [s], before any simulation.
    ///
    /// # Errors
    /// Does not fail for a walk that was computed.
    pub fn planned(&self, times_s: &[f64]) -> Result<Vec<Sample>, OptimalWalkError> {
        Ok(self.solution.samples(times_s)?)
    }

    /// One signal per coordinate of the model, repeating every cycle. The root's translations have the height, but no
    /// forward motion.
    #[must_use]
    pub fn signals(&self, model: &Model) -> Vec<Signal> {
        let count = model.coordinates().len();
        let mut posture = [(); 3].map(|()| vec![0.0; count]);
        let forward = model.coordinate("pelvis_tx").map(|id| id.index());
        Signal::periodic(count, self.walk().cycle_s(), |t, row| {
            self.write(t, &mut posture);
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = if Some(k) == forward { [0.0; 3] } else { [0, 1, 2].map(|d| posture[d][k]) };
            }
        })
    }

    /// The figure on a ground, in the posture and with the velocity of the walk at time zero.
    ///
    /// # Errors
    /// If the model is not planar.
    pub fn walker(&self, human: &Human, ground: &GroundContact) -> Result<Walker, WalkingError> {
        let model = &human.model;
        let mut posture = [(); 3].map(|()| vec![0.0; model.coordinates().len()]);
        self.write(0.0, &mut posture);
        let [place, velocity] = root_of(model, &posture);
        let walker = Walker::new(human, self.signals(model), ground, velocity.x)?;
        Ok(walker.starting_at(place, velocity).moving_as(&posture))
    }

    /// Simulates `cycles` cycles on the soft shoes of the settings. Only joints and trunk are driven.
    ///
    /// # Errors
    /// If the model is not planar, or the duration has no whole step.
    pub fn simulate(
        &self,
        human: &Human,
        settings: &ConsistentWalkSettings,
        step_s: f64,
        cycles: f64,
        findings: &mut Findings,
    ) -> Result<WalkRecording, WalkingError> {
        let step = StepSettings { step_s, integrator: Integrator::Impulse, ..StepSettings::default() };
        self.walker(human, &soft_ground(settings.shoes))?.walk(&step, cycles * self.walk().cycle_s(), findings)
    }
}

/// Place [m] and velocity [m/s] of the root in a posture.
pub(super) fn root_of(model: &Model, posture: &[Vec<f64>; 3]) -> [Vec3; 2] {
    let of = |values: &[f64], name: &str| model.coordinate(name).map_or(0.0, |id| values[id.index()]);
    [0, 1].map(|d| Vec3::new(of(&posture[d], "pelvis_tx"), of(&posture[d], "pelvis_ty"), 0.0))
}

/// The ground under soft shoes.
pub(crate) fn soft_ground(shoes: HuntCrossley) -> GroundContact {
    GroundContact { friction: shoes.dynamic_friction, shoes: Shoes::HuntCrossley(shoes), impact: ImpactLaw::Coulomb }
}
