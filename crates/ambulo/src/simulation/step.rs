//! One step in time.
//!
//! [`Integrator::Impulse`] is of first order and takes everything: contacts, impacts, friction, limits. [`Integrator::RungeKutta`] is
//! of fourth order where nothing touches, rubs or runs against a limit; where surfaces come to touch within the step, it
//! finds the instant, lets them collide there and goes on; a step in which they stay in touch is one of impulses.

use super::assemble::{Assembly, Prescribed};
use super::forces::{Impact, StepForces};
use super::impact::impact;
use super::impulse::{impulse_step, obstacle_motion};
use super::joint::JointKind;
use super::smooth::{self, Stage, runge_kutta};
use super::state::{RowKey, WorldState};
use super::touch::{ObstacleMotion, Touch, TouchWorkspace};
use super::world::{ContactLaw, World};
use crate::dynamics::{
    ConstraintGroup, Convergence, GraphSolution, GraphWorkspace, LinkError, Six, SolverSettings, undetermined_rows,
};
use crate::findings::Findings;
use crate::spatial::Twist;

/// Surfaces nearer than this touch [m]; what an instant of contact is found to.
const TOUCHING_M: f64 = 1e-10;
/// Collisions within one step before it is finished by impulses.
const MOST_COLLISIONS: usize = 8;
/// Bisections of the instant of contact: a step of 1 ms comes down to 1e-18 s.
const BISECTIONS: usize = 50;

/// A body that turns further in a smooth step [rad] has the step taken in parts, at most so many: the error grows with the
/// fifth power of the angle.
const MOST_TURN: f64 = 0.1;
const MOST_PARTS: f64 = 64.0;

/// How to step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepSettings {
    /// Step [s].
    pub step_s: f64,
    /// The method.
    pub integrator: Integrator,
    /// Whether drift of positions is removed.
    pub projection: bool,
    /// The solver's limits.
    pub solver: SolverSettings,
}

/// How positions and velocities follow from forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Integrator {
    /// First order, by impulses.
    Impulse,
    /// Fourth order where motion is smooth.
    RungeKutta,
}

impl Integrator {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Integrator::Impulse => "impulse",
            Integrator::RungeKutta => "runge-kutta",
        }
    }
}

impl Default for StepSettings {
    /// 1 ms, by impulses, with projection.
    fn default() -> Self {
        StepSettings {
            step_s: 1e-3,
            integrator: Integrator::Impulse,
            projection: true,
            solver: SolverSettings::default(),
        }
    }
}

/// Scratch of stepping, and the forces of the last step.
#[derive(Debug, Clone, Default)]
pub struct StepWorkspace {
    pub(crate) assembly: Assembly,
    pub(crate) touch: TouchWorkspace,
    pub(crate) solver: GraphWorkspace,
    pub(crate) solution: GraphSolution,
    /// Scratch of the later stages of a smooth step, and of closing loops.
    pub(crate) later: (Assembly, GraphSolution),
    /// First stages of the parts of a smooth step but the first.
    spare: (Assembly, GraphSolution),
    /// Solver of closing loops.
    pub(crate) closing: GraphWorkspace,
    pub(crate) targets: Vec<f64>,
    pub(crate) displacements: Vec<Six>,
    pub(crate) shifts: Vec<f64>,
    pub(crate) obstacles: ObstacleMotion,
    pub(crate) prescribed: Prescribed,
    /// Where surfaces touch, before any is dropped.
    pub(crate) found: Vec<Touch>,
    /// Wrench impulse of each body's joint on it, at its mass centre, once read.
    pub(crate) wrenches: Vec<Six>,
    pub(crate) step_s: f64,
    /// Collisions within the last step.
    pub(crate) impacts: Vec<Impact>,
    /// Twists of all bodies after the last of them; without meaning if there was none.
    pub(crate) after_impacts: Vec<Twist>,
}

impl StepWorkspace {
    /// The forces of the last step: means over it by impulses, those at its start by Runge-Kutta.
    #[must_use]
    pub fn forces(&self, world: &World) -> StepForces {
        StepForces::of(world, self)
    }

    /// Closures some of whose forces the motion of the last step does not determine, because their rows repeat others; they got
    /// the least-squares ones.
    #[must_use]
    pub fn undetermined_closures(&mut self) -> Vec<usize> {
        let rows = undetermined_rows(&self.assembly.graph, &mut self.solver);
        let groups = self.assembly.keys.iter().zip(&self.assembly.graph.groups);
        let repeats = |group: &ConstraintGroup| rows.iter().any(|row| group.rows.contains(row));
        groups
            .filter_map(|(key, group)| match key {
                RowKey::Closure(number) if repeats(group) => Some(*number),
                _ => None,
            })
            .collect()
    }

    /// Impacts of the last step that are apart from its forces: a smooth step's collisions, or those of
    /// [`ImpactLaw::Sticking`](super::ImpactLaw::Sticking).
    #[must_use]
    pub fn impacts(&self) -> &[Impact] {
        &self.impacts
    }
}

/// One step of the world.
///
/// Rows that contradict each other give findings: drives beyond their limit, or beyond reason, give way; the row that
/// remains unsatisfied is named.
///
/// # Errors
/// Joints that are no forest.
pub fn step(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    w.impacts.clear();
    match settings.integrator {
        Integrator::Impulse => impulse_step(world, state, settings.step_s, settings, w, findings),
        Integrator::RungeKutta => smooth_step(world, state, settings, w, findings),
    }
}

/// Accelerations of all bodies at their mass centres [rad/s², m/s²], world axes, of a world in which nothing touches; the
/// forces that go with them stay in the workspace.
///
/// # Errors
/// Joints that are no forest.
pub fn accelerations(
    world: &World,
    state: &WorldState,
    solver: &SolverSettings,
    w: &mut StepWorkspace,
) -> Result<Vec<Twist>, LinkError> {
    w.step_s = 1.0;
    w.touch.clear();
    let mut first = Stage { assembly: &mut w.assembly, solution: &mut w.solution };
    smooth::accelerations(world, state, solver, &mut w.solver, &mut first)
}

/// Smooth stretches and the collisions between them.
fn smooth_step(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    let mut left = settings.step_s;
    for _ in 0..MOST_COLLISIONS {
        if !smooth_here(world, state, w, left) {
            break;
        }
        let mut end = state.clone();
        w.runge_kutta(world, &mut end, left, settings)?;
        if w.overloaded_or_limited(world, &end) {
            break;
        }
        if w.least_gap(world, &end) >= 0.0 {
            *state = end;
            return Ok(w.solution.convergence);
        }
        let (mut before, mut after) = (0.0, left);
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (before + after);
            end.clone_from(state);
            w.runge_kutta(world, &mut end, middle, settings)?;
            if w.least_gap(world, &end) >= 0.0 { before = middle } else { after = middle }
        }
        end.clone_from(state);
        w.runge_kutta(world, &mut end, before, settings)?;
        *state = end;
        left -= before;
        impact(world, state, settings, w, findings)?;
    }
    if left <= 0.0 {
        return Ok(w.solution.convergence);
    }
    impulse_step(world, state, left, settings, w, findings)
}

/// Whether nothing touches that does not part, and nothing rubs.
fn smooth_here(world: &World, state: &WorldState, w: &mut StepWorkspace, h: f64) -> bool {
    let rubs = world.joints.iter().any(|j| j.coordinates.iter().any(|c| c.friction > 0.0));
    // The derivatives of a driven rotation vector are no angular velocity and acceleration.
    let turned = world.joints.iter().any(|j| {
        let turns = matches!(j.kind, JointKind::Ball | JointKind::Free);
        turns && j.coordinates.iter().take(3).any(|c| c.drive.is_some())
    });
    let soft = world.materials.iter().any(|m| m.law != ContactLaw::Rigid);
    if rubs || turned || (soft && !world.surfaces.is_empty() && w.least_gap(world, state) < 0.0) {
        return false;
    }
    obstacle_motion(world, state.time_s, h, &mut w.obstacles);
    w.touch.detect(world, state, &w.obstacles, h);
    !w.touch.approaches(world, state, &w.obstacles, TOUCHING_M)
}

impl StepWorkspace {
    fn runge_kutta(
        &mut self,
        world: &World,
        state: &mut WorldState,
        h: f64,
        settings: &StepSettings,
    ) -> Result<(), LinkError> {
        self.step_s = 1.0; // multipliers of accelerations are forces
        self.touch.clear();
        let fastest = state.twists.iter().map(|t| t.angular.norm()).fold(0.0, f64::max);
        let parts = (fastest * h / MOST_TURN).ceil().clamp(1.0, MOST_PARTS);
        for part in 0..parts as usize {
            // The first part's forces are those of the step.
            let begun = if part == 0 {
                (&mut self.assembly, &mut self.solution)
            } else {
                (&mut self.spare.0, &mut self.spare.1)
            };
            let mut first = Stage { assembly: begun.0, solution: begun.1 };
            let mut later = Stage { assembly: &mut self.later.0, solution: &mut self.later.1 };
            runge_kutta(world, state, h / parts, &settings.solver, &mut self.solver, &mut first, &mut later)?;
        }
        if settings.projection {
            self.close(world, state, &Prescribed::at(world, state.time_s), settings)?;
        }
        Ok(())
    }

    fn overloaded_or_limited(&self, world: &World, end: &WorldState) -> bool {
        let limited = world.joints.iter().zip(&end.coordinates).any(|(joint, q)| {
            joint.coordinates.iter().zip(q).any(|(acting, q)| {
                acting.limits.0.is_some_and(|low| *q <= low) || acting.limits.1.is_some_and(|high| *q >= high)
            })
        });
        let bounded = |c: &super::world::JointCoordinate| c.drive.as_ref().and_then(|d| d.max);
        if limited || !world.joints.iter().any(|j| j.coordinates.iter().any(|c| bounded(c).is_some())) {
            return limited;
        }
        let forces = self.forces(world);
        world.joints.iter().zip(&forces.efforts).any(|(joint, efforts)| {
            joint.coordinates.iter().zip(efforts).any(|(c, effort)| bounded(c).is_some_and(|max| effort.abs() > max))
        })
    }

    /// Least distance of surfaces that may touch [m]; infinite if none come near.
    fn least_gap(&mut self, world: &World, state: &WorldState) -> f64 {
        let mut obstacles = ObstacleMotion::new();
        obstacle_motion(world, state.time_s, 1e-9, &mut obstacles);
        let mut probe = std::mem::take(&mut self.touch);
        probe.detect(world, state, &obstacles, 0.0);
        let least = probe.touches.iter().map(|t| t.at.gap).fold(f64::INFINITY, f64::min);
        probe.clear();
        self.touch = probe;
        least
    }
}
