//! A consistent walk whose pace changes on the way.
//!
//! The walk is made consistent at the pace before and at the pace after each change. During a change the correction goes from the one to the
//! other as the angles of the gait do, and to nothing where the figure stands:
//!
//! ```text
//! q = q_machine(t) + w [(1 - R) c₀(φ) + R c₁(φ)]
//! ```
//!
//! with the phase φ, the share of walking w and the progress R of the change ([`Walk::change_progress`]). It is C² like its parts. Within a change the motion is not consistent by itself:
//! the simulation finds the forces, and the trunk is held by the torque that is missing.
//! Pinned by: tests/walk_changes.rs

use super::settings::{ConsistentWalkError, ConsistentWalkSettings};
use super::unknowns::reference;
use super::walk::{ConsistentWalk, make_consistent_walk, soft_ground};
use crate::findings::Findings;
use crate::gait::machine::WalkMachine;
use crate::gait::{Jet, Walk};
use crate::model::Model;
use crate::model::anthropometry::Human;
use crate::simulation::walking::{WalkRecording, Walker, WalkingError};
use crate::simulation::{Integrator, Signal, StepSettings};
use crate::spatial::Vec3;

/// A walk whose pace changes, with corrections for the paces before and after each change.
#[derive(Debug, Clone)]
pub struct ChangingWalk {
    walk: Walk,
    /// Consistent walks at the different paces, in the order in which they come.
    paces: Vec<ConsistentWalk>,
    /// Indices of the paces before and after each change.
    changes: Vec<[usize; 2]>,
}

/// Makes a walk with changes of pace consistent at each of its paces.
///
/// # Errors
/// If the figure lacks a coordinate, or the built-in ground force laws cannot be read.
pub fn make_changing_walk(
    human: &Human,
    walk: &Walk,
    settings: &ConsistentWalkSettings,
) -> Result<ChangingWalk, ConsistentWalkError> {
    let (mut paces, mut changes): (Vec<ConsistentWalk>, Vec<[usize; 2]>) = (Vec::new(), Vec::new());
    for ramp in walk.pace_ramps() {
        let mut numbers = [0, 1];
        for (number, pace) in numbers.iter_mut().zip(&ramp.paces) {
            *number = match paces.iter().position(|known| known.walk() == pace) {
                Some(known) => known,
                None => {
                    paces.push(make_consistent_walk(human, pace, settings)?);
                    paces.len() - 1
                }
            };
        }
        changes.push(numbers);
    }
    if changes.is_empty() {
        paces.push(make_consistent_walk(human, walk, settings)?);
    }
    Ok(ChangingWalk { walk: walk.clone(), paces, changes })
}

impl ChangingWalk {
    /// Consistent walks at the different paces, in the order in which they come.
    #[must_use]
    pub fn paces(&self) -> &[ConsistentWalk] {
        &self.paces
    }

    /// Shares of the corrections of two paces at a time [s].
    fn shares(&self, time_s: f64) -> [(usize, Jet); 2] {
        let Some((change, share)) = self.walk.change_progress(time_s) else {
            let first = self.changes.first().map_or(0, |paces| paces[0]);
            return [(first, Jet::constant(1.0)), (first, Jet::ZERO)];
        };
        let [before, after] = self.changes[change];
        [(before, -share + 1.0), (after, share)]
    }

    /// The motion from `start_s`: one signal per coordinate of the model. The root's translations are zero, because forces move them.
    ///
    /// # Panics
    /// If the duration is not above zero.
    #[must_use]
    pub fn signals(&self, human: &Human, start_s: f64, duration_s: f64) -> Vec<Signal> {
        let model = &human.model;
        let count = model.coordinates().len();
        let (mut q, mut qd, mut qdd) = (vec![0.0; count], vec![0.0; count], vec![0.0; count]);
        let root = ["pelvis_tx", "pelvis_ty"].map(|name| model.coordinate(name).map(|id| id.index()));
        let mut machine = WalkMachine::new(&self.walk);
        Signal::over(count, duration_s, |since_s, row| {
            let t = start_s + since_s;
            reference(&mut machine, 0.0, &self.paces[0].layout, t, &mut q, &mut qd, &mut qdd);
            let clock = self.walk.clock(t);
            let mut jets: Vec<Jet> = (0..count).map(|k| Jet::new(q[k], qd[k], qdd[k])).collect();
            for (pace, share) in self.shares(t) {
                let ConsistentWalk { layout, coefficients, .. } = &self.paces[pace];
                for (coordinate, change) in layout.changes(coefficients, clock.phase) {
                    jets[coordinate] += change * share * clock.walking;
                }
            }
            for (k, (entry, jet)) in row.iter_mut().zip(&jets).enumerate() {
                *entry = if root.contains(&Some(k)) { [0.0; 3] } else { [jet.value, jet.rate, jet.acceleration] };
            }
        })
    }

    /// Place [m] and velocity [m/s] of the root at a time before the first change; `None` if the figure stands.
    #[must_use]
    pub fn start(&self, model: &Model, time_s: f64) -> Option<[Vec3; 2]> {
        let walks = !self.walk.clock(time_s).stands();
        walks.then(|| self.paces[self.shares(time_s)[0].0].root_at(model, time_s))
    }

    /// Simulates `duration_s` on the soft shoes of the settings. Only joints and trunk are driven. A figure that walks at time zero starts
    /// in the posture and with the velocity of its consistent walk.
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
        let walker = Walker::new(human, signals, &soft_ground(settings), self.walk.speed())?;
        let walker = match self.start(&human.model, 0.0) {
            Some([place, velocity]) => walker.starting_at(place, velocity),
            None => walker,
        };
        walker.walk(&step, duration_s, findings)
    }
}
