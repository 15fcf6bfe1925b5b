//! Positions at the end of a step of impulses: drift is removed along M⁻¹ Jᵀ, and tree joints are placed exactly.
//!
//! Most steps reuse the factor of the velocities: one solve of M δ = Jᵀ ν, J δ = -error gives the displacements.
//!
//! **Figures that only translate.** If all joints of a figure follow a motion and its root does not turn freely (a walker with a
//! driven trunk), every posture is placed exactly. One projection then translates the figure so that its mass centre has moved
//! as the velocities say, or as closely as loaded contact points allow:
//!
//!   min ½ Σ m |e + d|²,  d = x(exact) - (x + h v)          j e = -gap of the posture as placed
//!
//! Gaps are taken after the bodies have turned, so loaded points lie on their surface to rounding, not to second order in the
//! step.
//!
//! **Loops.** These displacements suffice while bodies turn little in a step. Loops that are still open are solved again at the
//! present positions, a few times (Gauss-Newton, moving the least mass).

use super::assemble::{Prescribed, Span, twist};
use super::joint::{Coordinates, Frames, JointKind, MOST, advance, drift, orthonormal, rotation_vector};
use super::state::{RowKey, WorldState};
use super::touch::Touch;
use super::workspace::{StepSettings, StepWorkspace};
use super::world::{TreeJoint, World};
use crate::dynamics::{LinkError, Six, project_displacements, project_placed, solve_graph};
use crate::spatial::{Pose, Vec3};

/// Largest speed at which position projection closes loops or separates bodies [m/s, rad/s].
const CLOSING_SPEED: f64 = 1.0;
/// Displacements are scaled down to this many times the largest error.
const MOST_LEVERAGE: f64 = 10.0;
/// A closure counts as closed within this [m, rad].
const CLOSED: f64 = 1e-7;
/// A closure that is farther apart at the start of a step is still closing [m, rad].
const FAR: f64 = 1e-4;
/// Largest number of rounds.
const ROUNDS: usize = 8;

impl StepWorkspace {
    /// Removes drift along M⁻¹ Jᵀ after motions of duration `h`; contact points were found `step_s` before their end.
    pub(super) fn project(&mut self, world: &World, state: &mut WorldState, prescribed: &Prescribed, h: f64) {
        let most = CLOSING_SPEED * h;
        for (body, joint) in self.assembly.joint_of.iter().enumerate() {
            self.assembly.graph.terms.offset[body] = match joint {
                None => Six::zeros(),
                Some(number) => {
                    let joint = &world.joints[*number];
                    joint_correction(state, joint, &state.coordinates[*number], prescribed)
                }
            };
        }
        let graph = &self.assembly.graph;
        self.targets.clear();
        self.targets.resize(graph.rows.len(), 0.0);
        for (key, group) in self.assembly.keys.iter().zip(&graph.groups) {
            if let RowKey::Closure(number) = key {
                let (_, errors) = closure_errors(world, state, *number);
                for (row, error) in group.rows.clone().zip(errors) {
                    self.targets[row] = -error.clamp(-most, most);
                }
            } else if let Some((joint, k, limit)) = limit_of(world, *key) {
                let row = group.rows.start;
                let rate = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates);
                self.targets[row] = (limit - state.coordinates[joint][k] - h * rate).clamp(-most, most);
            }
        }
        for touch in self.touch.touches.iter().filter(|t| t.rigid) {
            let (group, row) = (&graph.groups[touch.rows.group], touch.rows.normal);
            let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates) - touch.surface_speed;
            let gap = touch.at.gap + self.step_s * u;
            self.targets[row] = (-gap).clamp(-most, most);
        }
        self.displace(world, state);
    }

    /// Moves bodies by the displacements that carry rows to their targets.
    fn displace(&mut self, world: &World, state: &mut WorldState) {
        let graph = &self.assembly.graph;
        project_displacements(graph, &self.targets, &mut self.solver, &mut self.displacements, &mut self.shifts);
        let offsets = &self.assembly.graph.terms.offset;
        let share = share_of_displacements(&self.targets, offsets, &self.displacements);
        for (body, (pose, displacement)) in state.poses.iter_mut().zip(&self.displacements).enumerate() {
            // Bodies without freedom are placed by their joints next.
            let free = graph.links[body].freedom > 0 || self.assembly.joint_of[body].is_none();
            let straight = |number: usize| goes_straight(world.joints[number].kind);
            if free || !self.assembly.joint_of[body].is_some_and(straight) {
                advance(pose, &twist(displacement), share);
            }
        }
    }

    /// Places every child exactly as its joint's coordinates say; without projection, only measures the coordinates.
    pub(super) fn place_joints(&self, world: &World, state: &mut WorldState, prescribed: &Prescribed, exactly: bool) {
        for &(body, _) in self.solver.outwards() {
            if let Some(number) = self.assembly.joint_of[body] {
                self.place_joint(world, state, prescribed, (body, number), exactly);
            }
        }
    }

    /// Places one body by the joint that carries it.
    #[inline(always)]
    fn place_joint(
        &self,
        world: &World,
        state: &mut WorldState,
        prescribed: &Prescribed,
        (body, number): (usize, usize),
        exactly: bool,
    ) {
        let joint = &world.joints[number];
        let mut q = [0.0; MOST];
        if joint.follows.is_none() {
            q = self.coordinates(state, joint, number, prescribed, exactly);
            state.coordinates[number].copy_from_slice(&q[..joint.kind.freedom()]);
        }
        if !exactly {
            return;
        }
        let parent = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]);
        state.poses[body] = match prescribed.goal(joint) {
            Some(goal) => parent * goal,
            None => {
                let child_frame = joint.kind.child_frame(&parent.with(&joint.parent_from_joint), &q);
                let pose = child_frame.without(&joint.child_from_joint);
                Pose { rotation: orthonormal(&pose.rotation), ..pose }
            }
        };
    }

    /// Coordinates of a joint, measured from the poses; with `exactly`, driven coordinates have the values of their drives,
    /// unless the drive gave way.
    #[inline(always)]
    fn coordinates(
        &self,
        state: &WorldState,
        joint: &TreeJoint,
        number: usize,
        prescribed: &Prescribed,
        exactly: bool,
    ) -> Coordinates {
        let held = |k: usize| exactly && joint.coordinates[k].drive.is_some() && !self.gave_way(number, k);
        let drives = 0..joint.kind.freedom();
        let mut q = if goes_straight(joint.kind) && drives.clone().all(held) {
            [0.0; MOST]
        } else {
            state.measured(joint, &state.coordinates[number])
        };
        for k in drives {
            let target = prescribed.value(number, k);
            if held(k) && (goes_straight(joint.kind) || (target - q[k]).abs() < 1e-3) {
                q[k] = target;
            }
        }
        q
    }

    fn gave_way(&self, joint: usize, coordinate: usize) -> bool {
        self.yielded && self.assembly.keys.contains(&RowKey::Drive(joint, coordinate))
    }
}

impl StepWorkspace {
    /// Whether every body is carried by a joint that follows a motion, or is a root that only translates.
    pub(super) fn only_translates(&self, world: &World) -> bool {
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

    /// Places all bodies of figures that only translate at the end of a step.
    pub(super) fn place_translated(&mut self, world: &World, state: &mut WorldState, prescribed: &Prescribed, h: f64) {
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
                self.place_joint(world, state, prescribed, (body, number), true);
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
                let row = touch.rows.normal;
                self.targets[row] = -self.gap_as_placed(world, state, touch, h);
            }
        }
        self.shift(world, state, h);
    }

    /// Gap of a contact point at the present poses [m].
    fn gap_as_placed(&self, world: &World, state: &WorldState, touch: &Touch, h: f64) -> f64 {
        let moved = |surface: usize| self.touch.moved(world, state, surface);
        match (moved(touch.surfaces.0), moved(touch.surfaces.1)) {
            (Some(first), Some(second)) => touch.at.gap + touch.at.normal.dot(&(first - second)),
            _ => {
                let graph = &self.assembly.graph;
                let (group, row) = (&graph.groups[touch.rows.group], touch.rows.normal);
                let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates);
                let placed = graph.reading(group, row, &self.displacements, &self.solution.coordinates);
                touch.at.gap + h * (u - touch.surface_speed) + placed
            }
        }
    }

    /// Translates each figure with its root.
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

impl StepWorkspace {
    /// Closes the loops that the step has left open.
    pub(super) fn close(
        &mut self,
        world: &World,
        state: &mut WorldState,
        prescribed: &Prescribed,
        settings: &StepSettings,
    ) -> Result<(), LinkError> {
        let h = self.step_s;
        for _ in 0..ROUNDS {
            if !self.open(world, state) {
                break;
            }
            let (assembly, solution) = &mut self.later;
            assembly.fill(world, state, prescribed, &Vec::new(), Span::step(h));
            let graph = &mut assembly.graph;
            graph.wrenches.fill(Six::zeros());
            graph.efforts.fill(0.0);
            graph.terms.offset.fill(Six::zeros());
            let closures = assembly.keys.iter().map(|key| matches!(key, RowKey::Closure(_)));
            let mut held = closures.clone();
            graph.groups.retain(|_| held.next().unwrap_or(false));
            self.targets.clear();
            self.targets.resize(graph.rows.len(), 0.0);
            let numbers = assembly.keys.iter().filter_map(|key| match key {
                RowKey::Closure(number) => Some(*number),
                _ => None,
            });
            for (group, number) in graph.groups.iter().zip(numbers) {
                for (row, error) in group.rows.clone().zip(closure_errors(world, state, number).1) {
                    (graph.rows[row].target, self.targets[row]) = (-error, -error);
                }
            }
            solution.lambda.clear();
            solve_graph(graph, &settings.solver, &mut self.closing, solution)?;
            let share = share_of_displacements(&self.targets, &[], &solution.motions);
            for (pose, displacement) in state.poses.iter_mut().zip(&solution.motions) {
                advance(pose, &twist(displacement), share);
            }
            self.place_joints(world, state, prescribed, true);
        }
        Ok(())
    }

    /// Whether a closure of the step is open.
    fn open(&self, world: &World, state: &WorldState) -> bool {
        self.assembly.keys.iter().any(|key| match key {
            RowKey::Closure(number) => largest_error(world, state, *number) > CLOSED,
            _ => false,
        })
    }
}

/// Largest error of a closure [m, rad].
fn largest_error(world: &World, state: &WorldState, number: usize) -> f64 {
    closure_errors(world, state, number).1.iter().fold(0.0, |m: f64, e| m.max(e.abs()))
}

/// Whether a closure is still closing, as after it was added by an event: such closures close at limited speed.
pub(super) fn still_closing(world: &World, state: &WorldState) -> bool {
    (0..world.closures.len()).any(|number| world.closures[number].active && largest_error(world, state, number) > FAR)
}

/// Whether a constant rate moves a coordinate exactly by rate times duration; not where rotations do not commute.
fn goes_straight(kind: JointKind) -> bool {
    matches!(kind, JointKind::Weld | JointKind::Revolute | JointKind::Prismatic | JointKind::Planar)
}

/// The share of the displacements to apply: all of them, unless they are far larger than the errors that they remove. In
/// stretched loops a small error along the loop needs a large displacement across it, beyond the linear range.
fn share_of_displacements(targets: &[f64], offsets: &[Six], displacements: &[Six]) -> f64 {
    let slide = |six: &Six| six.fixed_rows::<3>(3).amax();
    let error = targets.iter().map(|t| t.abs()).chain(offsets.iter().map(slide)).fold(0.0, f64::max);
    let largest = displacements.iter().map(slide).fold(0.0, f64::max);
    if largest > MOST_LEVERAGE * error { MOST_LEVERAGE * error / largest } else { 1.0 }
}

/// Joint, coordinate and value of the limit that a row belongs to.
fn limit_of(world: &World, key: RowKey) -> Option<(usize, usize, f64)> {
    let limits = |joint: usize, k: usize| world.joints[joint].coordinates[k].limits;
    match key {
        RowKey::LowerLimit(joint, k) => limits(joint, k).0.map(|limit| (joint, k, limit)),
        RowKey::UpperLimit(joint, k) => limits(joint, k).1.map(|limit| (joint, k, limit)),
        _ => None,
    }
}

/// The displacement of a child's mass centre relative to its parent that removes its drift.
fn joint_correction(state: &WorldState, joint: &TreeJoint, last: &[f64], prescribed: &Prescribed) -> Six {
    let frames = state.frames(joint);
    let (turn, shift) = match prescribed.goal(joint) {
        None => drift(joint.kind, &frames, last),
        Some(goal) => {
            let target = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * goal * joint.child_from_joint;
            let turn = rotation_vector(&(frames.child.rotation * target.rotation.transpose()));
            (turn, frames.child.translation - target.translation)
        }
    };
    let to_center = state.poses[joint.child].translation - frames.child.translation;
    let linear = -shift - turn.cross(&to_center);
    Six::new(-turn.x, -turn.y, -turn.z, linear.x, linear.y, linear.z)
}

/// Frames of a closure, and its errors along its rows [rad, m].
pub(crate) fn closure_errors(world: &World, state: &WorldState, number: usize) -> (Frames, Vec<f64>) {
    let closure = &world.closures[number];
    let parent = closure.second.map_or(Pose::IDENTITY, |p| state.poses[p]);
    let frames = Frames {
        parent: parent * closure.second_from_joint,
        child: state.poses[closure.first] * closure.first_from_joint,
    };
    let (turn, shift) = drift(closure.kind, &frames, &[]);
    let (turns, slides) = closure.kind.constrained(&frames);
    let errors = turns.iter().map(|e| e.dot(&turn)).chain(slides.iter().map(|e| e.dot(&shift))).collect();
    (frames, errors)
}

/// Largest position error of any joint or active closure [m].
#[must_use]
pub fn largest_joint_error(world: &World, state: &WorldState) -> f64 {
    let joints =
        world.joints.iter().zip(&state.coordinates).filter(|(j, _)| j.follows.is_none()).map(|(joint, last)| {
            let (_, shift) = drift(joint.kind, &state.frames(joint), last);
            shift.norm()
        });
    joints
        .chain((0..world.closures.len()).filter(|c| world.closures[*c].active).map(|closure| {
            let (frames, _) = closure_errors(world, state, closure);
            let (_, shift): (Vec3, Vec3) = drift(world.closures[closure].kind, &frames, &[]);
            shift.norm()
        }))
        .fold(0.0, f64::max)
}
