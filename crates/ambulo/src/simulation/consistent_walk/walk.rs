//! A consistent walk as motion: signals for the simulator, and the walk stepped through time on its soft shoes.

use super::{ConsistentWalk, ConsistentWalkSettings};
use crate::findings::Findings;
use crate::model::Model;
use crate::model::anthropometry::Human;
use crate::simulation::walking::{Ground, Shoes, WalkRecording, Walker, WalkingError};
use crate::simulation::{ImpactLaw, Integrator, Samples, Signal, StepSettings};
use crate::spatial::Vec3;
use std::sync::Arc;

/// Samples of the motion are no farther apart [s].
const STEP_S: f64 = 1e-3;

impl ConsistentWalk {
    /// One signal a coordinate of the model, repeating every cycle; the root's slides have the height and no advance.
    #[must_use]
    pub fn signals(&self, model: &Model) -> Vec<Signal> {
        let count = model.coordinates().len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        let forward = model.coordinate("pelvis_tx").map(|id| id.index());
        let samples = Samples::new(count, [0.0, self.walk().cycle_s()], STEP_S, true, |t, row| {
            self.write(t, &mut q, &mut qd, &mut qdd);
            for (k, entry) in row.iter_mut().enumerate() {
                *entry = if Some(k) == forward { [0.0; 3] } else { [q[k], qd[k], qdd[k]] };
            }
        });
        let samples = Arc::new(samples);
        (0..count).map(|k| Signal::Sampled(Arc::clone(&samples), k)).collect()
    }

    /// The figure on a ground, moving as the walk does at time zero.
    ///
    /// # Errors
    /// A model that is not planar.
    pub fn walker(&self, human: &Human, ground: &Ground) -> Result<Walker, WalkingError> {
        let model = &human.model;
        let count = model.coordinates().len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        self.write(0.0, &mut q, &mut qd, &mut qdd);
        let of = |values: &[f64], name: &str| model.coordinate(name).map_or(0.0, |id| values[id.index()]);
        let [place, velocity] =
            [&q, &qd].map(|values| Vec3::new(of(values, "pelvis_tx"), of(values, "pelvis_ty"), 0.0));
        Ok(Walker::new(human, self.signals(model), ground, velocity.x)?.starting_at(place, velocity))
    }

    /// Walks `cycles` cycles on the soft shoes of the settings, only joints and trunk driven.
    ///
    /// # Errors
    /// A model that is not planar; steps that are no whole number.
    pub fn simulate(
        &self,
        human: &Human,
        settings: &ConsistentWalkSettings,
        step_s: f64,
        cycles: f64,
        findings: &mut Findings,
    ) -> Result<WalkRecording, WalkingError> {
        let ground = Ground {
            friction: settings.shoes.dynamic_friction,
            shoes: Shoes::HuntCrossley(settings.shoes),
            impact: ImpactLaw::Coulomb,
        };
        let step = StepSettings { step_s, integrator: Integrator::Impulse, ..StepSettings::default() };
        self.walker(human, &ground)?.walk(&step, cycles * self.walk().cycle_s(), findings)
    }
}
