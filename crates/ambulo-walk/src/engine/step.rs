//! One time step of a world.
//!
//! [`Integrator::Impulse`] is of first order and handles contacts, impacts, friction and limits.
//! [`Integrator::RungeKutta`] is of fourth order where there is no contact, dry friction or active limit. Where
//! surfaces meet within its step, it finds the instant, computes the impact there and continues. A step in which they
//! stay in contact is a step of impulses.

use super::contradiction::report_work;
use super::impact::impact;
use super::impulse::impulse_step;
use super::joint::JointKind;
use super::midpoint::midpoint_step;
use super::smooth::{self, runge_kutta};
use super::state::WorldState;
use super::touch::{ObstaclePoses, obstacle_motion};
use super::workspace::{
    ContactWorkspace, Equations, Integrator, SmoothWorkspace, StepKind, StepSettings, StepWorkspace,
};
use super::world::{ContactLaw, ImpactLaw, JointCoordinate, Owner, Surface, World};
use crate::dynamics::{Convergence, LinkError, SolverSettings};
use crate::findings::{Code, Findings};
use crate::spatial::Twist;

/// Surfaces nearer than this touch [m]; also the accuracy of an instant of contact.
const TOUCHING_M: f64 = 1e-10;
/// Largest number of impacts within one step; the rest of the step is then one of impulses.
const MOST_IMPACTS: usize = 8;
/// Bisections of the instant of contact: a step of 1 ms comes down to 1e-18 s.
const BISECTIONS: usize = 50;

/// Iterations of the solver in the smooth parts of one step, and in the search for an instant of contact; the rest of
/// the step is then one of impulses. An impact is found by 52 trials of four stages, which take 2 to 10 iterations
/// each.
const MOST_ITERATIONS: usize = 8_000;
/// Overlap at which an instant of contact ends a part of a step of impulses [m].
const OVERLAP_M: f64 = 1e-9;

/// If a body turns further than this in a smooth step [rad], the step is divided, since its error grows with the fifth
/// power of the angle.
const MOST_TURN: f64 = 0.1;
/// Largest number of parts of a smooth step.
const MOST_PARTS: f64 = 64.0;

/// Advances a world by one step.
///
/// Contradictory constraints produce findings: drives give way beyond their limit (or beyond any reasonable force), and
/// the constraint that is violated most is named.
///
/// # Errors
/// Joints that do not form trees.
pub fn step(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    w.impacts.all.clear();
    match settings.integrator {
        Integrator::Impulse => impulse_parts(world, state, settings, w, findings),
        Integrator::Midpoint => midpoint_step(world, state, settings, w, findings),
        Integrator::RungeKutta => smooth_step(world, state, settings, w, findings),
    }
}

/// Accelerations of all bodies at their mass centres [rad/s², m/s²], world axes, in a world without contacts. The
/// corresponding forces stay in the workspace.
///
/// # Errors
/// Joints that do not form trees.
pub fn accelerations(
    world: &World,
    state: &WorldState,
    solver: &SolverSettings,
    w: &mut StepWorkspace,
) -> Result<Vec<Twist>, LinkError> {
    w.step_s = 1.0;
    w.contact.touch.clear();
    smooth::accelerations(world, state, solver, &mut w.solver, &mut w.equations)
}

/// A step of impulses. It is divided at the instant at which a fast body touches a surface that it would have passed at
/// the end of the step. So bodies rebound in the step in which they overlap.
fn impulse_parts(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    let mut left = settings.step_s;
    for _ in 0..MOST_IMPACTS {
        let Some(until) = w.contact.passing(world, state, left) else { break };
        impulse_step(world, state, until, settings, w, findings)?;
        left -= until;
    }
    impulse_step(world, state, left, settings, w, findings)
}

/// A Runge-Kutta step: smooth parts and the impacts between them.
fn smooth_step(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    let mut left = settings.step_s;
    w.kind = StepKind::Smooth;
    w.smooth.iterations = 0;
    for _ in 0..MOST_IMPACTS {
        if w.smooth.iterations > MOST_ITERATIONS || !smooth_here(world, state, w, left) {
            break;
        }
        let mut end = state.clone();
        w.runge_kutta(world, &mut end, left, settings)?;
        if w.overloaded_or_limited(world, &end) {
            break;
        }
        if w.least_gap(world, &end) >= 0.0 {
            *state = end;
            w.report_contradictions(findings);
            return Ok(w.equations.solution.convergence);
        }
        if gives(world) {
            break;
        }
        let (mut before, mut after) = (0.0, left);
        for _ in 0..BISECTIONS {
            if w.smooth.iterations > MOST_ITERATIONS {
                break;
            }
            let middle = 0.5 * (before + after);
            end.clone_from(state);
            w.runge_kutta(world, &mut end, middle, settings)?;
            if w.least_gap(world, &end) >= 0.0 { before = middle } else { after = middle }
        }
        end.clone_from(state);
        w.runge_kutta(world, &mut end, before, settings)?;
        w.report_contradictions(findings);
        *state = end;
        left -= before;
        impact(world, state, settings, w, findings)?;
    }
    if w.smooth.iterations > MOST_ITERATIONS {
        let message = format!(
            "at {:.4} s the smooth parts of a step used up its work; the rest of it is a step of impulses",
            state.time_s
        );
        report_work(message, findings);
    }
    if left <= 0.0 {
        return Ok(w.equations.solution.convergence);
    }
    impulse_step(world, state, left, settings, w, findings)
}

/// Whether motion is smooth: no dry friction, and no contact except of surfaces that separate.
fn smooth_here(world: &World, state: &WorldState, w: &mut StepWorkspace, h: f64) -> bool {
    let rubs = world.joints.iter().any(|j| j.coordinates.iter().any(|c| c.friction > 0.0));
    // The derivatives of a driven rotation vector are not an angular velocity and acceleration.
    let turned = world.joints.iter().any(|j| {
        let turns = matches!(j.kind, JointKind::Ball | JointKind::Free);
        turns && j.coordinates.iter().take(3).any(|c| c.drive.is_some())
    });
    if rubs || turned || (gives(world) && w.least_gap(world, state) < 0.0) {
        return false;
    }
    obstacle_motion(world, state.time_s, h, &mut w.contact.obstacles);
    w.contact.touch.detect(world, state, &w.contact.obstacles, h);
    !w.contact.touch.approaches(world, state, &w.contact.obstacles, TOUCHING_M)
}

/// Whether any material is compliant: its contacts act over time, and have no impacts.
fn gives(world: &World) -> bool {
    world.materials.iter().any(|m| m.law != ContactLaw::Rigid)
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
        self.contact.touch.clear();
        let SmoothWorkspace { later, first_of_part, .. } = &mut self.smooth;
        for equations in [&mut self.equations, later, first_of_part] {
            (equations.iterations, equations.contradiction) = (0, None);
        }
        let fastest = state.twists.iter().map(|t| t.angular.norm()).fold(0.0, f64::max);
        let parts = (fastest * h / MOST_TURN).ceil().clamp(1.0, MOST_PARTS);
        for part in 0..parts as usize {
            // The forces of the step are the forces of its first part.
            let SmoothWorkspace { later, first_of_part, .. } = &mut self.smooth;
            let first = if part == 0 { &mut self.equations } else { first_of_part };
            runge_kutta(world, state, h / parts, &settings.solver, &mut self.solver, first, later)?;
        }
        self.smooth.iterations += self.stages().map(|equations| equations.iterations).sum::<usize>();
        if settings.projection {
            self.prescribed.fill(world, state.time_s);
            self.close(world, state, settings)?;
        }
        Ok(())
    }

    /// The equations of the stages of a smooth step.
    fn stages(&self) -> impl Iterator<Item = &Equations> {
        [&self.equations, &self.smooth.first_of_part, &self.smooth.later].into_iter()
    }

    /// Reports what the stages of a smooth step that was made violate.
    fn report_contradictions(&self, findings: &mut Findings) {
        for message in self.stages().filter_map(|equations| equations.contradiction.clone()) {
            findings.report(Code::SolverNotConverged, message);
        }
    }

    /// Whether a coordinate has reached a limit, or a drive needs more than it may have.
    fn overloaded_or_limited(&self, world: &World, end: &WorldState) -> bool {
        let limited = world.joints.iter().zip(&end.coordinates).any(|(joint, q)| {
            joint.coordinates.iter().zip(q).any(|(acting, q)| {
                acting.limits.0.is_some_and(|low| *q <= low) || acting.limits.1.is_some_and(|high| *q >= high)
            })
        });
        limited || self.overloaded_drive(world)
    }

    fn overloaded_drive(&self, world: &World) -> bool {
        let most = |c: &JointCoordinate| c.drive.as_ref().and_then(|d| d.max);
        let bounded = world.joints.iter().any(|j| j.coordinates.iter().any(|c| most(c).is_some()));
        bounded && {
            let forces = self.forces(world);
            world.joints.iter().zip(&forces.efforts).any(|(joint, efforts)| {
                joint.coordinates.iter().zip(efforts).any(|(c, effort)| most(c).is_some_and(|max| effort.abs() > max))
            })
        }
    }

    /// Smallest distance of surfaces that may touch [m]; infinite if none are near.
    fn least_gap(&mut self, world: &World, state: &WorldState) -> f64 {
        let mut obstacles = ObstaclePoses::new();
        obstacle_motion(world, state.time_s, 1e-9, &mut obstacles);
        let probe = &mut self.contact.touch;
        probe.detect(world, state, &obstacles, 0.0);
        let least = probe.touches.iter().map(|t| t.at.gap).fold(f64::INFINITY, f64::min);
        probe.clear();
        least
    }
}

impl ContactWorkspace {
    /// The time until a fast body that rebounds meets a surface that it would have passed after `h` [s]: the first such
    /// instant, with an overlap that makes it an impact.
    fn passing(&mut self, world: &World, state: &WorldState, h: f64) -> Option<f64> {
        let is_fast = |surface: &Surface| match surface.owner {
            Owner::Body(body) => state.twists[body].linear.norm() * h > surface.shape.half_size(),
            Owner::Obstacle(_) => false,
        };
        let rebounds = world.impact == ImpactLaw::Coulomb && world.materials.iter().any(|m| m.restitution > 0.0);
        if !rebounds || !world.surfaces.iter().any(is_fast) {
            return None;
        }
        obstacle_motion(world, state.time_s, h, &mut self.obstacles);
        self.touch.detect(world, state, &self.obstacles, h);
        let until = self.touch.touches.iter().filter_map(|touch| {
            let speed = touch.passing_speed(world, state, &self.obstacles, h)?;
            Some((touch.at.gap + OVERLAP_M) / speed).filter(|until| *until < h)
        });
        until.min_by(f64::total_cmp)
    }
}
