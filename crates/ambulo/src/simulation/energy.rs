//! Mechanical energy of a world.

use super::state::WorldState;
use super::world::World;

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
