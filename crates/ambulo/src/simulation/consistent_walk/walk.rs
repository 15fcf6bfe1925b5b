//! A dynamically consistent walk: how it is computed, its motion, and the walk simulated with it.

use super::problem::{Problem, Stage};
use super::response::{self, PlannedForces};
use super::settings::{ConsistentWalkError, ConsistentWalkSettings};
use super::unknowns::{self, Layout};
use crate::contact::HuntCrossley;
use crate::findings::Findings;
use crate::gait::Walk;
use crate::gait::machine::WalkMachine;
use crate::model::Model;
use crate::model::anthropometry::Human;
use crate::numerics::{Progress, minimise};
use crate::simulation::walking::{GroundContact, Shoes, WalkRecording, Walker, WalkingError};
use crate::simulation::{ImpactLaw, Integrator, Signal, StepSettings};
use crate::spatial::Vec3;

/// A dynamically consistent walk: all its external forces are ground forces.
#[derive(Debug, Clone)]
pub struct ConsistentWalk {
    pub(super) walk: Walk,
    pub(super) layout: Layout,
    pub(super) coefficients: Vec<f64>,
    /// Progress of the solver, one entry per stage.
    pub progress: Vec<Progress>,
}

/// From stage to stage, shoes get stiffer, friction steeper and dynamics stricter.
const STAGES: [Stage; 9] = [
    Stage { stiffness: 0.25, creep: 50.0, root: 25.0, iterations: 30 },
    Stage { stiffness: 0.5, creep: 25.0, root: 10.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 16.0, root: 5.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 10.0, root: 3.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 6.0, root: 2.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 4.0, root: 1.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 2.5, root: 1.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 1.6, root: 1.0, iterations: 30 },
    Stage { stiffness: 1.0, creep: 1.0, root: 1.0, iterations: 80 },
];

/// Changes a walk at constant speed until ground forces explain it without residual forces.
///
/// # Errors
/// If the figure lacks a coordinate, or the built-in ground force laws cannot be read.
pub fn make_consistent_walk(
    human: &Human,
    walk: &Walk,
    settings: &ConsistentWalkSettings,
) -> Result<ConsistentWalk, ConsistentWalkError> {
    let layout = Layout::new(&human.model, settings.splines);
    let mut problem = Problem::new(human, walk, settings, &layout)?;
    let mut coefficients = problem.first_guess();
    let mut progress = Vec::new();
    for stage in STAGES {
        problem.enter(stage);
        progress.push(minimise(&mut problem, &mut coefficients, stage.iterations));
    }
    Ok(ConsistentWalk { walk: walk.clone(), layout, coefficients, progress })
}

impl ConsistentWalk {
    /// The walk before the change.
    #[must_use]
    pub fn walk(&self) -> &Walk {
        &self.walk
    }

    /// Number of adjusted parameters.
    #[must_use]
    pub fn parameters(&self) -> usize {
        self.coefficients.len()
    }

    /// The motion of the walk, for several instants.
    #[must_use]
    pub fn motion(&self) -> ConsistentMotion<'_> {
        ConsistentMotion { of: self, machine: WalkMachine::new(&self.walk) }
    }

    /// Writes coordinates, rates and accelerations at one time [s]; see [`ConsistentMotion::write`].
    pub fn write(&self, time_s: f64, q: &mut [f64], qd: &mut [f64], qdd: &mut [f64]) {
        self.motion().write(time_s, q, qd, qdd);
    }

    /// Forces of the planned motion at a time [s], before any simulation.
    ///
    /// # Errors
    /// If the figure lacks a coordinate.
    pub fn planned(
        &self,
        human: &Human,
        shoes: &HuntCrossley,
        time_s: f64,
    ) -> Result<PlannedForces, ConsistentWalkError> {
        let count = human.model.coordinates().len();
        let mut posture = [vec![0.0; count], vec![0.0; count], vec![0.0; count]];
        let [q, qd, qdd] = &mut posture;
        self.write(time_s, q, qd, qdd);
        response::planned(human, shoes, &posture)
    }

    /// One signal per coordinate of the model, repeating every cycle. The root's translations have the height, but no forward
    /// motion.
    #[must_use]
    pub fn signals(&self, model: &Model) -> Vec<Signal> {
        let count = model.coordinates().len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        let forward = model.coordinate("pelvis_tx").map(|id| id.index());
        let mut motion = self.motion();
        Signal::periodic(count, self.walk().cycle_s(), |t, row| {
            motion.write(t, &mut q, &mut qd, &mut qdd);
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = if Some(k) == forward { [0.0; 3] } else { [q[k], qd[k], qdd[k]] };
            }
        })
    }

    /// Place [m] and velocity [m/s] of the root at a time [s].
    pub(super) fn root_at(&self, model: &Model, time_s: f64) -> [Vec3; 2] {
        let count = model.coordinates().len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        self.write(time_s, &mut q, &mut qd, &mut qdd);
        let of = |values: &[f64], name: &str| model.coordinate(name).map_or(0.0, |id| values[id.index()]);
        [&q, &qd].map(|values| Vec3::new(of(values, "pelvis_tx"), of(values, "pelvis_ty"), 0.0))
    }

    /// The figure on a ground, in the posture and with the velocity of the walk at time zero.
    ///
    /// # Errors
    /// If the model is not planar.
    pub fn walker(&self, human: &Human, ground: &GroundContact) -> Result<Walker, WalkingError> {
        let model = &human.model;
        let [place, velocity] = self.root_at(model, 0.0);
        Ok(Walker::new(human, self.signals(model), ground, velocity.x)?.starting_at(place, velocity))
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
        self.walker(human, &soft_ground(settings))?.walk(&step, cycles * self.walk().cycle_s(), findings)
    }
}

/// The ground under the soft shoes of the settings.
pub(super) fn soft_ground(settings: &ConsistentWalkSettings) -> GroundContact {
    GroundContact {
        friction: settings.shoes.dynamic_friction,
        shoes: Shoes::HuntCrossley(settings.shoes),
        impact: ImpactLaw::Coulomb,
    }
}

/// The motion of a consistent walk: what the state machine of the gait gives, and the change of it.
#[derive(Debug)]
pub struct ConsistentMotion<'a> {
    of: &'a ConsistentWalk,
    machine: WalkMachine,
}

impl ConsistentMotion<'_> {
    /// Writes coordinates, rates and accelerations at a time [s]; each slice has one entry per coordinate of the model.
    pub fn write(&mut self, time_s: f64, q: &mut [f64], qd: &mut [f64], qdd: &mut [f64]) {
        let ConsistentWalk { walk, layout, coefficients, .. } = self.of;
        unknowns::reference(&mut self.machine, walk.speed(), layout, time_s, q, qd, qdd);
        layout.add(coefficients, time_s / walk.cycle_s(), walk.cycle_s(), q, qd, qdd);
    }
}
