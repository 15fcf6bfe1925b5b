//! Mechanical energy of a world.

use super::state::WorldState;
use super::world::{JointCoordinate, World};
use crate::findings::{Code, Findings};
use crate::spatial::Wrench;

/// Energies at one instant [J].
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Energy {
    /// ½ m v² + ½ ωᵀ I ω of all bodies, and ½ r q̇² of rotors.
    pub kinetic: f64,
    /// -m g · x; zero at the origin of the world.
    pub gravity: f64,
    /// ½ k (q - rest)² of springs on coordinates.
    pub springs: f64,
}

impl Energy {
    /// Total mechanical energy [J].
    #[must_use]
    pub fn total(&self) -> f64 {
        self.kinetic + self.gravity + self.springs
    }
}

/// Rise of the energy, as a share of the kinetic energy that the start allows, that is no error of time stepping: the
/// first-order step of an oscillation of 100 rad/s exchanges 5 % at 1 ms.
const RISE: f64 = 0.1;
/// Smallest rise that counts, as the whole weight lifted by this height [m].
const LIFTED_M: f64 = 1e-3;

/// Watches that the energy of a scene does not rise above its initial energy.
#[derive(Debug, Clone, Copy)]
pub(crate) struct EnergyWatch {
    /// Energies and time at which it began [J, s].
    start: f64,
    kinetic: f64,
    start_s: f64,
    least: f64,
}

impl EnergyWatch {
    /// `None` if something drives the world, so that its energy may rise.
    pub(crate) fn new(world: &World, state: &WorldState) -> Option<EnergyWatch> {
        let energy = energy(world, state);
        let least = LIFTED_M * world.mass() * world.gravity.norm();
        is_passive(world).then_some(EnergyWatch {
            start: energy.total(),
            kinetic: energy.kinetic,
            start_s: state.time_s,
            least,
        })
    }

    /// Returns whether the energy has risen, and reports it.
    pub(crate) fn rises(&mut self, world: &World, state: &WorldState, findings: &mut Findings) -> bool {
        let now = energy(world, state);
        let rise = now.total() - self.start;
        // Energy of a fall is counted in full; energy that came from nowhere must not widen its own limit.
        let fallen = (self.start - now.gravity - now.springs).max(0.0);
        let rises = rise > (RISE * fallen.max(self.kinetic)).max(self.least);
        if rises {
            let start = if self.start_s > 0.0 { format!("{:.3} s", self.start_s) } else { "the start".to_owned() };
            let message = format!(
                "without a drive, the energy rose by {rise:.4} J above its {:.4} J at {start}, at {:.3} s",
                self.start, state.time_s
            );
            findings.report(Code::EnergyRose, message);
        }
        rises
    }
}

/// Whether nothing does work on the bodies but gravity, springs and dissipation.
fn is_passive(world: &World) -> bool {
    let acts = |c: &JointCoordinate| c.drive.is_some() || c.motor.is_some() || c.effort != 0.0;
    world.figures.is_empty()
        && world.obstacles.iter().all(|obstacle| obstacle.path.is_none())
        && world.bodies.iter().all(|body| body.load == Wrench::ZERO)
        && !world.joints.iter().any(|joint| joint.coordinates.iter().any(acts))
}

/// Mechanical energies of a world in a state.
#[must_use]
pub fn energy(world: &World, state: &WorldState) -> Energy {
    let mut energy = Energy::default();
    for ((body, pose), twist) in world.bodies.iter().zip(&state.poses).zip(&state.twists) {
        let inertia = pose.rotation * body.inertia * pose.rotation.transpose();
        energy.kinetic += 0.5 * body.mass * twist.linear.norm_squared();
        energy.kinetic += 0.5 * twist.angular.dot(&(inertia * twist.angular));
        energy.gravity -= body.mass * world.gravity.dot(&pose.translation);
    }
    for (joint, q) in world.joints.iter().zip(&state.coordinates) {
        let rates = joint.coordinates.iter().any(|c| c.rotor > 0.0).then(|| state.rates(joint));
        for (k, acting) in joint.coordinates.iter().enumerate() {
            if let Some(spring) = &acting.spring {
                energy.springs += 0.5 * spring.stiffness * (q[k] - spring.rest) * (q[k] - spring.rest);
            }
            if let Some(rates) = &rates {
                energy.kinetic += 0.5 * acting.rotor * rates[k] * rates[k];
            }
        }
    }
    energy
}
