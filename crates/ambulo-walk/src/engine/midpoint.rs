//! A step by the midpoint rule, of second order: an undamped motion keeps its energy, and contacts may open, close,
//! stick and slip.
//!
//! With h half of the step and u the velocities in its middle,
//!
//!   x* = x⁻ + h v⁻                                        the configuration in the middle, predicted
//!   M (u - v⁻) = h f + Jᵀ λ/2,  J u = 0                   M and J at x*; springs, dampers and motors at x⁻ + h u
//!   x⁺ = x⁻ + 2 h u                                       then drift is removed as in a step of impulses
//!   v⁺ = 2 u - v⁻                                         angular velocities in the axes of the body
//!
//! Joints and closed loops do no work, because the change of the kinetic energy is uᵀ M (v⁺ - v⁻) = 2 h uᵀ f + uᵀ Jᵀ λ
//! and J u = 0. The weight does its work over the displacement 2 h u, and a linear spring releases its own energy. What
//! is left is the removal of drift, of third order in a step.
//!
//! Laws of contact, friction and limits hold for the velocities at the end of the step. So sticking points stand still
//! and an impact without restitution ends at once (Moreau's sweeping process with the theta method at one half):
//!
//!   2 u_n - u_n⁻ ≥ -e u_n⁻,  λ_n ≥ 0, complementary        friction against 2 u_t - u_t⁻
//!
//! Source: Moreau 1999, "Numerical aspects of the sweeping process"; Acary and Brogliato 2008, "Numerical Methods for
//! Nonsmooth Dynamical Systems" (both unverified).
//! Pinned by: tests/simulation_midpoint.rs

use super::assemble::{Span, twist};
use super::impulse::impulse_step;
use super::joint::advance;
use super::projection::still_closing;
use super::state::{RowKey, WorldState};
use super::touch::obstacle_motion;
use super::workspace::{StepKind, StepSettings, StepWorkspace};
use super::world::{ImpactLaw, World};
use crate::dynamics::{BodyTerms, Convergence, LinkError};
use crate::findings::Findings;
use crate::spatial::Twist;

/// Gyroscopic moments that change less than this share of the angular momentum in half a step are zero but for
/// rounding.
const NEGLIGIBLE: f64 = 1e-12;
/// A body that turns further in half a step [rad] keeps the gyroscopic moment that is predicted for it alone, which
/// does no work on it.
const MOST_TURN: f64 = 0.2;

/// Advances the state by one step.
pub(super) fn midpoint_step(
    world: &World,
    state: &mut WorldState,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    let whole = settings.step_s;
    if needs_impulses(world) || still_closing(world, state) || has_new_loop(world, state) {
        return impulse_step(world, state, whole, settings, w, findings);
    }
    let half = 0.5 * whole;
    w.prescribed.fill(world, state.time_s + whole);
    w.kind = StepKind::Midpoint;
    w.midpoint(world, state, half, settings, findings)?;
    Ok(w.equations.solution.convergence)
}

/// Whether a closed loop is new: velocities may contradict it. The midpoint rule would turn the contradiction around in
/// every step, and a step of impulses removes it.
pub(super) fn has_new_loop(world: &World, state: &WorldState) -> bool {
    let is_new = |number: usize| !state.guess.contains_key(&RowKey::Closure(number));
    world.closures.iter().enumerate().any(|(number, closure)| closure.active && is_new(number))
}

/// Whether every step of a world is one of impulses.
pub(super) fn needs_impulses(world: &World) -> bool {
    is_driven(world) || world.impact == ImpactLaw::Sticking
}

/// Whether anything prescribes the motion of a body: its velocities at the end of a step are then no result of forces.
pub(super) fn is_driven(world: &World) -> bool {
    world.joints.iter().any(|joint| joint.follows.is_some() || joint.coordinates.iter().any(|c| c.drive.is_some()))
}

impl StepWorkspace {
    fn midpoint(
        &mut self,
        world: &World,
        state: &mut WorldState,
        half: f64,
        settings: &StepSettings,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        let mut middle = state.clone();
        for (pose, before) in middle.poses.iter_mut().zip(&state.twists) {
            advance(pose, before, half);
        }
        self.step_s = half;
        obstacle_motion(world, state.time_s + half, half, &mut self.contact.obstacles);
        self.contact.touch.detect(world, &middle, &self.contact.obstacles, half);
        self.solve_halfway(world, &middle, half, settings, findings)?;
        self.remember(state);
        for (twist_now, motion) in state.twists.iter_mut().zip(&self.equations.solution.motions) {
            *twist_now = twist(motion);
        }
        state.time_s += 2.0 * half;
        if settings.projection {
            self.place(world, state, 2.0 * half);
            self.close(world, state, settings)?;
        } else {
            for (pose, twist) in state.poses.iter_mut().zip(&state.twists) {
                advance(pose, twist, 2.0 * half);
            }
            self.measure_joints(world, state);
        }
        let bodies = state.twists.iter_mut().zip(&state.poses).zip(middle.twists.iter().zip(&middle.poses));
        for ((mean, pose), (before, middle)) in bodies {
            let angular = middle.rotation.transpose() * (mean.angular * 2.0 - before.angular);
            *mean = Twist { angular: pose.rotation * angular, linear: mean.linear * 2.0 - before.linear };
        }
        Ok(())
    }

    /// Solves for the velocities in the middle. Joints and contacts change the spin of a body, so its gyroscopic moment
    /// is taken again at the spin that the first solution has.
    fn solve_halfway(
        &mut self,
        world: &World,
        middle: &WorldState,
        half: f64,
        settings: &StepSettings,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        self.solve(world, middle, Span::half(half), settings, findings)?;
        let precesses = |(body, before): (&BodyTerms, &Twist)| {
            let momentum = body.inertia * before.angular;
            let turns = before.angular.norm() * half <= MOST_TURN;
            turns && before.angular.cross(&momentum).norm() * half > NEGLIGIBLE * momentum.norm()
        };
        let again: Vec<bool> = self.equations.assembly.graph.bodies.iter().zip(&middle.twists).map(precesses).collect();
        if again.contains(&true) {
            let spins = again.iter().zip(&self.equations.solution.motions);
            self.equations.assembly.spins.extend(spins.map(|(again, motion)| again.then(|| twist(motion).angular)));
            self.contact.touch.detect(world, middle, &self.contact.obstacles, half);
            let solved = self.solve(world, middle, Span::half(half), settings, findings);
            self.equations.assembly.spins.clear();
            solved?;
        }
        Ok(())
    }
}
