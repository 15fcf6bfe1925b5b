//! Positions of figures whose joints all follow and whose roots slide but do not turn freely: a walker with a driven trunk.
//!
//! Such a figure can only shift as a whole: every posture is placed exactly, and one projection shifts it so that its mass
//! centre has gone where the velocities say, or as near as the points that press upon others allow:
//!
//!   min ½ Σ m |e + d|²,  d = x(exact) - (x + h v)          j e = -gap of the posture as placed
//!
//! The same displacements as elsewhere ([`super::projection`]), with gaps taken after the bodies have turned: points that
//! press do so on their surface to rounding, and not to the second order of the step.

use super::assemble::{Prescribed, twist};
use super::impulse::advance;
use super::joint::JointKind;
use super::projection::{CLOSING_SPEED, goes_straight, limit_of, share_of_displacements};
use super::state::WorldState;
use super::step::StepWorkspace;
use super::touch::Touch;
use super::world::{TreeJoint, World};
use crate::dynamics::{Six, project_placed};

impl StepWorkspace {
    /// Whether every body hangs on a joint that follows, or on a root that only slides.
    pub(super) fn only_slides(&self, world: &World) -> bool {
        let driven =
            |number: usize, k: usize| world.joints[number].coordinates[k].drive.is_some() && !self.gave_way(number, k);
        let fits = |(number, joint): (usize, &TreeJoint)| match (joint.parent, joint.kind) {
            _ if joint.follows.is_some() => true,
            (None, JointKind::Planar) => driven(number, 2),
            (None, JointKind::Prismatic) => true,
            (_, kind) => goes_straight(kind) && (0..kind.freedom()).all(|k| driven(number, k)),
        };
        let hangs = self.assembly.joint_of.iter().all(Option::is_some);
        hangs && self.solver.is_lumped() && world.closures.is_empty() && world.joints.iter().enumerate().all(fits)
    }

    /// Places all bodies at the end of the step.
    pub(super) fn slide(&mut self, world: &World, state: &mut WorldState, prescribed: &Prescribed, h: f64) {
        self.displacements.clear();
        self.displacements.resize(world.bodies.len(), Six::zeros());
        for at in 0..self.solver.outwards().len() {
            let (body, parent) = self.solver.outwards()[at];
            let pose = &mut state.poses[body];
            let straight = pose.translation + state.twists[body].linear * h;
            if parent.is_none() {
                advance(pose, &state.twists[body], h);
            }
            if let Some(number) = self.assembly.joint_of[body] {
                self.seat_body(world, state, prescribed, (body, number), true);
            }
            let off = state.poses[body].translation - straight;
            self.displacements[body] = Six::new(0.0, 0.0, 0.0, off.x, off.y, off.z);
        }
        self.targets.clear();
        self.targets.resize(self.assembly.graph.rows.len(), 0.0);
        for (key, group) in self.assembly.keys.iter().zip(&self.assembly.graph.groups) {
            if let Some((joint, k, limit)) = limit_of(world, *key) {
                self.targets[group.rows.start] = limit - state.coordinates[joint][k];
            }
        }
        for number in 0..self.touch.touches.len() {
            let touch = &self.touch.touches[number];
            if touch.rigid {
                let row = self.assembly.graph.groups[touch.group].rows.start;
                self.targets[row] = -self.gap_as_placed(world, state, touch, h);
            }
        }
        self.shift(world, state, h);
    }

    /// Gap of a touch where the bodies are now [m].
    fn gap_as_placed(&self, world: &World, state: &WorldState, touch: &Touch, h: f64) -> f64 {
        let moved = |surface: usize| self.touch.moved(world, state, surface);
        match (moved(touch.surfaces.0), moved(touch.surfaces.1)) {
            (Some(first), Some(second)) => touch.at.gap + touch.at.normal.dot(&(first - second)),
            _ => {
                let group = &self.assembly.graph.groups[touch.group];
                let (row, graph) = (group.rows.start, &self.assembly.graph);
                let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates);
                let placed = graph.reading(group, row, &self.displacements, &self.solution.coordinates);
                touch.at.gap + h * (u - touch.surface_speed) + placed
            }
        }
    }

    /// Step 4: all that a root carries goes with it.
    fn shift(&mut self, world: &World, state: &mut WorldState, h: f64) {
        let most = CLOSING_SPEED * h;
        self.targets.iter_mut().for_each(|target| *target = target.clamp(-most, most));
        let graph = &self.assembly.graph;
        let off = std::mem::take(&mut self.displacements);
        project_placed(graph, &off, &self.targets, &mut self.solver, &mut self.displacements, &mut self.shifts);
        let share = share_of_displacements(&self.targets, &off, &self.displacements);
        for (pose, displacement) in state.poses.iter_mut().zip(&self.displacements) {
            pose.translation += twist(displacement).linear * share;
        }
        for (number, joint) in world.joints.iter().enumerate().filter(|(_, joint)| joint.parent.is_none()) {
            let measured = state.measured(joint, &state.coordinates[number]);
            let free = |k: &usize| joint.coordinates[*k].drive.is_none();
            for k in (0..joint.kind.freedom()).filter(free) {
                state.coordinates[number][k] = measured[k];
            }
        }
    }
}
