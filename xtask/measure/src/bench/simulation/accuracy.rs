//! Accuracy over many steps: change of energy, and position errors of joints.

use super::run::{DURATION_S, STEP_S, Simulation};
use super::worlds;
use ambulo::simulation::{Integrator, StepSettings, energy};

/// The chain of both tests.
const LINKS: usize = 20;
/// Duration of the flailing motion [s].
const FLAILING_S: f64 = 60.0;

/// What was found.
pub(super) struct Accuracy {
    /// Chain without damping, 10 s by Runge-Kutta.
    pub(super) smooth: EnergyDrift,
    /// The same by the midpoint rule.
    pub(super) midpoint: EnergyDrift,
    /// The same by impulses.
    pub(super) impulses: EnergyDrift,
    /// Chain flailing for 60 s by impulses: largest joint error [m] with and without position projection.
    pub(super) joint_error_m: [f64; 2],
}

/// Energies of a motion.
pub(super) struct EnergyDrift {
    /// Largest distance of the total energy from its start [J].
    pub(super) change_j: f64,
    /// Energy turned over: the largest kinetic energy of the motion [J].
    pub(super) turned_over_j: f64,
}

impl EnergyDrift {
    pub(super) fn share(&self) -> f64 {
        self.change_j / self.turned_over_j
    }
}

/// Both tests.
pub(super) fn measure() -> Result<Accuracy, String> {
    Ok(Accuracy {
        smooth: energy_drift(Integrator::RungeKutta)?,
        midpoint: energy_drift(Integrator::Midpoint)?,
        impulses: energy_drift(Integrator::Impulse)?,
        joint_error_m: [flail(true)?, flail(false)?],
    })
}

fn steps(duration_s: f64) -> usize {
    (duration_s / STEP_S).round() as usize
}

fn energy_drift(integrator: Integrator) -> Result<EnergyDrift, String> {
    let world = worlds::chain(LINKS);
    let mut simulation =
        Simulation::new(&world, StepSettings { step_s: STEP_S, integrator, ..StepSettings::default() });
    let start = simulation.energy();
    let mut drift = EnergyDrift { change_j: 0.0, turned_over_j: 0.0 };
    for _ in 0..steps(DURATION_S) {
        simulation.step()?;
        let now = energy(&world, &simulation.state);
        drift.change_j = drift.change_j.max((now.total() - start).abs());
        drift.turned_over_j = drift.turned_over_j.max(now.kinetic);
    }
    Ok(drift)
}

fn flail(projection: bool) -> Result<f64, String> {
    let world = worlds::chain(LINKS);
    let mut simulation =
        Simulation::new(&world, StepSettings { step_s: STEP_S, projection, ..StepSettings::default() });
    let mut worst = 0.0_f64;
    for _ in 0..steps(FLAILING_S) {
        simulation.step()?;
        worst = worst.max(simulation.joint_error());
    }
    Ok(worst)
}
