//! Times the steps of a world in the same way as the peers' programs.

use super::super::timing::Timing;
use ambulo::dynamics::Convergence;
use ambulo::findings::Findings;
use ambulo::simulation::{
    StepForces, StepSettings, StepWorkspace, World, WorldState, energy, largest_joint_error, step,
};
use cpu_time::ThreadTime;

/// Step [s].
pub(super) const STEP_S: f64 = 1e-3;
/// Simulated time of a case, unless the budget ends it [s].
pub(super) const DURATION_S: f64 = 10.0;
/// CPU time of a case's steps [s].
const BUDGET_S: f64 = 20.0;
/// From this number of bodies on each step is timed alone; fewer step in tens, so that the clock itself does not count.
const LARGE: usize = 1000;
/// Steps between checks of the errors.
const WATCH: usize = 10;

/// A world with its state.
pub(super) struct Simulation<'a> {
    pub(super) world: &'a World,
    settings: StepSettings,
    pub(super) state: WorldState,
    workspace: StepWorkspace,
    findings: Findings,
}

/// The results of a case.
pub(super) struct Run {
    /// CPU time of one step [us].
    pub(super) step_us: Timing,
    pub(super) steps: usize,
    /// Largest joint or loop error [m] at any time, and the median of the checked steps.
    pub(super) worst_m: f64,
    pub(super) median_m: f64,
    /// Tree solves of a step, mean.
    pub(super) iterations: f64,
    /// Steps whose residual stayed above the tolerance.
    pub(super) unconverged: usize,
    /// Energy at the end minus at the start [J].
    pub(super) energy_change_j: f64,
}

impl<'a> Simulation<'a> {
    pub(super) fn new(world: &'a World, settings: StepSettings) -> Simulation<'a> {
        let (workspace, findings) = (StepWorkspace::default(), Findings::default());
        Simulation { world, settings, state: WorldState::new(world), workspace, findings }
    }

    /// Goes on in another world of the same bodies.
    pub(super) fn in_world<'b>(self, world: &'b World) -> Simulation<'b> {
        let Simulation { settings, state, workspace, findings, .. } = self;
        Simulation { world, settings, state, workspace, findings }
    }

    pub(super) fn step(&mut self) -> Result<Convergence, String> {
        let done = step(self.world, &mut self.state, &self.settings, &mut self.workspace, &mut self.findings);
        done.map_err(|e| e.to_string())
    }

    /// CPU time of one of `count` steps [us].
    pub(super) fn time(&mut self, count: usize, mut seen: impl FnMut(Convergence)) -> Result<f64, String> {
        let start = ThreadTime::now();
        for _ in 0..count {
            seen(self.step()?);
        }
        Ok(start.elapsed().as_secs_f64() * 1e6 / count as f64)
    }

    pub(super) fn forces(&self) -> StepForces {
        self.workspace.forces(self.world)
    }

    pub(super) fn energy(&self) -> f64 {
        energy(self.world, &self.state).total()
    }

    /// Largest distance of points that a joint or closure keeps together [m]; what is not a number counts as infinite.
    pub(super) fn joint_error(&self) -> f64 {
        let lost = self.state.poses.iter().any(|pose| !pose.translation.iter().all(|x| x.is_finite()));
        if lost { f64::INFINITY } else { largest_joint_error(self.world, &self.state) }
    }
}

/// Steps of 1 ms up to the duration or the budget.
pub(super) fn run(world: &World, settings: StepSettings) -> Result<Run, String> {
    let mut simulation = Simulation::new(world, StepSettings { step_s: STEP_S, ..settings });
    let before = simulation.energy();
    let batch = if world.bodies.len() >= LARGE { 1 } else { WATCH };
    let (mut samples, mut errors) = (Vec::new(), Vec::new());
    let (mut steps, mut spent_us, mut solves, mut unconverged) = (0, 0.0, 0, 0);
    while steps < (DURATION_S / STEP_S).round() as usize && spent_us < BUDGET_S * 1e6 {
        let us = simulation.time(batch, |convergence| {
            solves += convergence.iterations;
            unconverged += usize::from(!convergence.converged);
        })?;
        samples.push(us);
        steps += batch;
        spent_us += us * batch as f64;
        if steps % WATCH == 0 {
            errors.push(simulation.joint_error());
        }
    }
    errors.sort_by(f64::total_cmp);
    Ok(Run {
        step_us: Timing::of(samples),
        steps,
        worst_m: errors.last().copied().unwrap_or(f64::INFINITY),
        median_m: errors.get(errors.len() / 2).copied().unwrap_or(f64::INFINITY),
        iterations: solves as f64 / steps as f64,
        unconverged,
        energy_change_j: simulation.energy() - before,
    })
}
