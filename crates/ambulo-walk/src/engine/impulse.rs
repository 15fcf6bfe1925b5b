//! A first-order step: impulses at velocity level, then positions.
//!
//!   1. contact points and constraints: the graph at (x, v⁻)
//!   2. v, λ from the graph                                        (dynamics::solve_graph)
//!   3. q := q + h q̇, and bodies are placed along their trees        (`projection`)
//!   4. linearised displacements: M δ = Jᵀ ν, J δ = -error, with the factor of 2
//!
//! The multipliers λ/h are the forces of joints, drives, contacts and friction.
//!
//! Source: Faure, Debunne, Cani, Multon 1997, section 3.1 (steps 1-3 for accelerations, velocities, linearised
//! displacements), 3.2 (drives), 3.3 (contact). Time stepping by impulses after Moreau (unverified).

use super::assemble::{Assembly, Span, Yielding, twist};
use super::contradiction::report_unsatisfied;
use super::forces::ContactForce;
use super::joint::advance;
use super::projection::still_closing;
use super::state::{RowKey, WorldState};
use super::touch::obstacle_motion;
use super::workspace::{StepKind, StepSettings, StepWorkspace};
use super::world::{ImpactLaw, Owner, TreeJoint, World};
use crate::dynamics::{ConstraintGroup, Convergence, Law, LinkError, Six, solve_graph};
use crate::findings::{Code, Findings};
use crate::spatial::STANDARD_GRAVITY;

/// A force beyond this many times the total weight is a sign of contradictory constraints: drives without a limit give
/// way there, and no force is larger where the solver fails.
const UNREASONABLE_WEIGHTS: f64 = 1000.0;

/// Advances the state by `h`.
pub(super) fn impulse_step(
    world: &World,
    state: &mut WorldState,
    h: f64,
    settings: &StepSettings,
    w: &mut StepWorkspace,
    findings: &mut Findings,
) -> Result<Convergence, LinkError> {
    (w.step_s, w.kind) = (h, StepKind::Impulses);
    w.prescribed.fill(world, state.time_s + h);
    obstacle_motion(world, state.time_s, h, &mut w.contact.obstacles);
    let closing = still_closing(world, state);
    w.contact.touch.detect(world, state, &w.contact.obstacles, h);
    if world.impact == ImpactLaw::Sticking {
        w.contact.touch.keep_touching(world, state);
        w.strike(world, state, settings, findings)?;
        w.step_s = h;
    }
    w.solve(world, state, Span::step(h), settings, findings)?;
    for (twist_now, motion) in state.twists.iter_mut().zip(&w.equations.solution.motions) {
        *twist_now = twist(motion);
    }
    state.time_s += h;
    w.remember(state);
    if settings.projection {
        w.place(world, state, h);
    } else {
        for (pose, twist) in state.poses.iter_mut().zip(&state.twists) {
            advance(pose, twist, h);
        }
        w.measure_joints(world, state);
    }
    if settings.projection && !closing {
        w.close(world, state, settings)?;
    }
    Ok(w.equations.solution.convergence)
}

impl StepWorkspace {
    /// Solves for velocities and impulses; overloaded drives give way.
    pub(super) fn solve(
        &mut self,
        world: &World,
        state: &WorldState,
        span: Span,
        settings: &StepSettings,
        findings: &mut Findings,
    ) -> Result<(), LinkError> {
        let h = span.h;
        self.halfway = span.halfway;
        let unreasonable = match span.instant {
            // An impact has an impulse, not a force.
            true => f64::INFINITY,
            false => UNREASONABLE_WEIGHTS * world.mass() * world.gravity.norm().max(STANDARD_GRAVITY),
        };
        let mut yielding: Yielding = Vec::new();
        self.contact.found.clone_from(&self.contact.touch.touches);
        loop {
            self.equations.assembly.fill(world, state, &self.prescribed, &yielding, span);
            let Assembly { graph, keys, .. } = &mut self.equations.assembly;
            self.contact.touch.add_rows(world, state, &self.contact.obstacles, span, graph, keys);
            self.guess(state);
            solve_graph(
                &self.equations.assembly.graph,
                &settings.solver,
                &mut self.solver,
                &mut self.equations.solution,
            )?;
            let more = self.overloaded(world, &yielding, unreasonable);
            if more.is_empty() {
                break;
            }
            yielding.extend(more);
            self.contact.touch.touches.clone_from(&self.contact.found);
        }
        self.yielded = !yielding.is_empty();
        if !self.equations.solution.convergence.converged
            && self.equations.solution.lambda.iter().any(|l| l.abs() > h * unreasonable)
        {
            self.bound(h * unreasonable);
            solve_graph(
                &self.equations.assembly.graph,
                &settings.solver,
                &mut self.solver,
                &mut self.equations.solution,
            )?;
            self.read_wrenches();
        }
        self.report(world, state, &yielding, findings);
        Ok(())
    }

    /// Keeps the impulses as first guess of the next step.
    pub(super) fn remember(&self, state: &mut WorldState) {
        let groups = || self.equations.assembly.keys.iter().zip(&self.equations.assembly.graph.groups);
        let impulses = |group: &ConstraintGroup| {
            let mut impulses = [0.0; 6];
            impulses[..group.rows.len()].copy_from_slice(&self.equations.solution.lambda[group.rows.clone()]);
            impulses
        };
        if state.guess.len() == groups().count() && groups().all(|(key, _)| state.guess.contains_key(key)) {
            groups().for_each(|(key, group)| {
                state.guess.entry(*key).and_modify(|past| *past = impulses(group));
            });
            return;
        }
        state.guess.clear();
        state.guess.extend(groups().map(|(key, group)| (*key, impulses(group))));
    }

    /// Sets the first guess: the impulses of the last step. A new contact is assumed to push and to stick.
    fn guess(&mut self, state: &WorldState) {
        let lambda = &mut self.equations.solution.lambda;
        lambda.clear();
        lambda.resize(self.equations.assembly.graph.rows.len(), 0.0);
        for (key, group) in self.equations.assembly.keys.iter().zip(&self.equations.assembly.graph.groups) {
            match state.guess.get(key) {
                Some(impulses) => lambda[group.rows.clone()].copy_from_slice(&impulses[..group.rows.len()]),
                None => {
                    lambda[group.rows.start] = if matches!(key, RowKey::Contact(..)) { f64::MIN_POSITIVE } else { 0.0 }
                }
            }
        }
    }

    /// Drives whose effort exceeds their limit, or any reasonable force.
    fn overloaded(&mut self, world: &World, yielding: &Yielding, unreasonable: f64) -> Yielding {
        let driven = |j: &TreeJoint| j.coordinates.iter().any(|c| c.drive.is_some());
        if !world.joints.iter().any(driven) {
            return Vec::new();
        }
        self.read_wrenches();
        let mut more = Vec::new();
        for (number, joint) in world.joints.iter().enumerate() {
            for (k, acting) in joint.coordinates.iter().enumerate() {
                let Some(drive) = &acting.drive else { continue };
                let most = drive.max.unwrap_or(unreasonable);
                let known = || yielding.iter().any(|(j, c, _)| (*j, *c) == (number, k));
                if self.effort(joint.child, number, k).abs() > most && !known() {
                    more.push((number, k, most));
                }
            }
        }
        more
    }

    /// Bounds every force.
    fn bound(&mut self, most: f64) {
        for group in &mut self.equations.assembly.graph.groups {
            group.law = match group.law {
                Law::Bounded { least, most: upper } => Law::Bounded { least: least.max(-most), most: upper.min(most) },
                Law::Contact { friction, bound } => Law::Contact { friction, bound: bound.min(most) },
            };
        }
    }

    /// Whether a drive presses on another body, as the finger of a gripper does: contacts with bodies that the drive
    /// does not carry bear at least half of its effort. The limit of such a drive is its intended force and is not
    /// reported. Obstacles do not count, so that a leg that is too weak on the ground is still reported.
    fn presses_on_a_body(&self, world: &World, state: &WorldState, number: usize, coordinate: usize) -> bool {
        let child = world.joints[number].child;
        let carried = world.carried_by(child);
        let side = |surface: usize| match world.surfaces[surface].owner {
            Owner::Body(body) => Some(carried[body]),
            Owner::Obstacle(_) => None,
        };
        let direction = self.equations.assembly.directions.at(number, coordinate);
        let along = |contact: ContactForce| {
            let force = match (side(contact.surfaces.0), side(contact.surfaces.1)) {
                (Some(true), Some(false)) => contact.force,
                (Some(false), Some(true)) => -contact.force,
                _ => return 0.0,
            };
            let moment = (contact.point - state.poses[child].translation).cross(&force);
            direction.dot(&Six::new(moment.x, moment.y, moment.z, force.x, force.y, force.z))
        };
        let borne: f64 = self.contacts().map(along).sum();
        let effort = self.effort(child, number, coordinate);
        borne * effort < 0.0 && borne.abs() >= 0.5 * effort.abs()
    }

    fn report(&self, world: &World, state: &WorldState, yielding: &Yielding, findings: &mut Findings) {
        for &(number, coordinate, max) in yielding {
            let joint = &world.joints[number];
            let limited = joint.coordinates[coordinate].drive.as_ref().is_some_and(|drive| drive.max.is_some());
            if limited && self.presses_on_a_body(world, state, number, coordinate) {
                continue;
            }
            let name = joint.kind.coordinate_names()[coordinate];
            let unit = if joint.kind.turns(coordinate) { "N.m" } else { "N" };
            let joint = &joint.name;
            if limited {
                let message = format!("the drive of `{joint}` ({name}) is at its limit of {max:.4} {unit}");
                findings.report(Code::DriveAtLimit, message);
            } else {
                let message =
                    format!("the drive of `{joint}` ({name}) gave way: its motion needs more than {max:.4} {unit}");
                findings.report(Code::DriveGaveWay, message);
            }
        }
        report_unsatisfied(world, &self.equations, state.time_s, findings);
    }
}
