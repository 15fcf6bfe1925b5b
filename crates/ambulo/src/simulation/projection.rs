//! Positions at the end of a step of impulses: what has drifted goes back along M⁻¹ Jᵀ, joints of trees are seated exactly.

use super::assemble::{Prescribed, twist};
use super::impulse::advance;
use super::joint::{Coordinates, JointKind, MOST, drift, orthonormal};
use super::state::{RowKey, WorldState};
use super::step::StepWorkspace;
use super::world::{TreeJoint, World};
use crate::dynamics::{Six, project_displacements};
use crate::spatial::{Pose, Vec3};

/// Fastest that position projection pulls loops together or bodies apart [m/s, rad/s].
pub(super) const CLOSING_SPEED: f64 = 1.0;
/// Displacements larger than so many times the largest error are cut.
const MOST_LEVERAGE: f64 = 10.0;
impl StepWorkspace {
    /// Step 4: what has drifted goes back along M⁻¹ Jᵀ.
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
            let group = &graph.groups[touch.group];
            let row = group.rows.start;
            let u = graph.reading(group, row, &self.solution.motions, &self.solution.coordinates) - touch.surface_speed;
            let gap = touch.at.gap + h * u;
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
            // Those that their joints carry are put in their seats next.
            let free = graph.links[body].freedom > 0 || self.assembly.joint_of[body].is_none();
            let straight = |number: usize| goes_straight(world.joints[number].kind);
            if free || !self.assembly.joint_of[body].is_some_and(straight) {
                advance(pose, &twist(displacement), share);
            }
        }
    }

    /// Puts every child exactly where its joint's coordinates have it (without projection, only reads the coordinates).
    pub(super) fn seat(&self, world: &World, state: &mut WorldState, prescribed: &Prescribed, exactly: bool) {
        for &(body, _) in self.solver.outwards() {
            if let Some(number) = self.assembly.joint_of[body] {
                self.seat_body(world, state, prescribed, (body, number), exactly);
            }
        }
    }

    /// One body with the joint that carries it.
    #[inline(always)]
    pub(super) fn seat_body(
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
                let seat = parent * joint.parent_from_joint * joint.kind.parent_from_child(&q);
                let pose = seat * joint.child_from_joint.inverse();
                Pose { rotation: orthonormal(&pose.rotation), ..pose }
            }
        };
    }

    /// Coordinates of a joint as the poses have them; with `exactly`, driven ones where their drives take them. A drive that
    /// gave way stays where it is.
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

    pub(super) fn gave_way(&self, joint: usize, coordinate: usize) -> bool {
        !self.assembly.keys.is_empty() && self.assembly.keys.contains(&RowKey::Drive(joint, coordinate))
    }
}

/// Whether a rate held over a step takes a coordinate all the way, however far: not so where turns do not commute.
pub(super) fn goes_straight(kind: JointKind) -> bool {
    matches!(kind, JointKind::Weld | JointKind::Revolute | JointKind::Prismatic | JointKind::Planar)
}

/// All of the displacements, unless they are far larger than the errors that they undo: where loops are stretched, a small
/// error along them calls for a large displacement across, and the linear picture ends.
pub(super) fn share_of_displacements(targets: &[f64], offsets: &[Six], displacements: &[Six]) -> f64 {
    let slide = |six: &Six| six.fixed_rows::<3>(3).amax();
    let error = targets.iter().map(|t| t.abs()).chain(offsets.iter().map(slide)).fold(0.0, f64::max);
    let largest = displacements.iter().map(slide).fold(0.0, f64::max);
    if largest > MOST_LEVERAGE * error { MOST_LEVERAGE * error / largest } else { 1.0 }
}

/// TreeJoint, coordinate and value of a limit.
pub(super) fn limit_of(world: &World, key: RowKey) -> Option<(usize, usize, f64)> {
    let limits = |joint: usize, k: usize| world.joints[joint].coordinates[k].limits;
    match key {
        RowKey::LowerLimit(joint, k) => limits(joint, k).0.map(|limit| (joint, k, limit)),
        RowKey::UpperLimit(joint, k) => limits(joint, k).1.map(|limit| (joint, k, limit)),
        _ => None,
    }
}

/// The displacement of a child's mass centre against its parent that undoes its drift.
fn joint_correction(state: &WorldState, joint: &TreeJoint, last: &[f64], prescribed: &Prescribed) -> Six {
    let frames = state.frames(joint);
    let (turn, shift) = match prescribed.goal(joint) {
        None => drift(joint.kind, &frames, last),
        Some(goal) => {
            let seat = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * goal * joint.child_from_joint;
            let turn = super::joint::rotation_vector(&(frames.child.rotation * seat.rotation.transpose()));
            (turn, frames.child.translation - seat.translation)
        }
    };
    let to_center = state.poses[joint.child].translation - frames.child.translation;
    let linear = -shift - turn.cross(&to_center);
    Six::new(-turn.x, -turn.y, -turn.z, linear.x, linear.y, linear.z)
}

/// Frames of a closure, and its errors along its rows [rad, m].
pub(crate) fn closure_errors(world: &World, state: &WorldState, number: usize) -> (super::joint::Frames, Vec<f64>) {
    let closure = &world.closures[number];
    let parent = closure.second.map_or(Pose::IDENTITY, |p| state.poses[p]);
    let frames = super::joint::Frames {
        parent: parent * closure.second_from_joint,
        child: state.poses[closure.first] * closure.first_from_joint,
    };
    let (turn, shift) = drift(closure.kind, &frames, &[]);
    let (turns, slides) = closure.kind.held(&frames);
    let errors = turns.iter().map(|e| e.dot(&turn)).chain(slides.iter().map(|e| e.dot(&shift))).collect();
    (frames, errors)
}

/// Largest distance of any joint or closure from where it holds [m].
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
