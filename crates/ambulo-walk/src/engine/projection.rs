//! Positions at the end of a step: bodies are placed along their trees, then moved until contact points and loops
//! close.
//!
//! **Trees.** Coordinates advance by their rates, q := q + h q̇, driven ones to the values of their drives, and every
//! body is placed by its joint, parents first; a body without a joint moves by its own velocity. Joints are therefore
//! closed to rounding, however far bodies turn in a step. Placed like this, the mass centre of a tree is off from where
//! the velocities take it, to second order in h. If the root may translate, the tree is translated by the difference:
//! nothing but forces from outside moves the mass centre.
//!
//! **Contact points, limits, loops.** From the posture as placed, one solve of M δ = Jᵀ ν, J δ = -error with the factor
//! of the velocities gives the displacements with the least motion of mass, and the trees are placed again by them.
//! Gaps are those after bodies have turned, so loaded points lie on their surface to rounding, not to second order in
//! the step.
//!
//! **Loops that are still open** are solved again at the present positions, a few times (Gauss-Newton, moving the least
//! mass): displacements along the directions at the start of a step suffice only while bodies turn little in it.

use super::assemble::{Assembly, Prescribed, Span, twist};
use super::joint::{Coordinates, Frames, JointKind, MOST, advance, drift, orthonormal};
use super::state::{RowKey, WorldState};
use super::workspace::{Equations, StepSettings, StepWorkspace};
use super::world::{TreeJoint, World};
use crate::dynamics::{GraphSolution, LinkError, Six, project_displacements, solve_graph};
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
/// Errors up to this are the rounding of positions of some metres [m, rad].
const ROUNDING: f64 = 1e-15;
/// A driven angle of a rotation vector takes the value of its drive if it is this near to it [rad]: rates of rotation
/// vectors are no velocities.
const NEARLY_DRIVEN: f64 = 1e-3;

/// A motion of all trees: the parts of a solution, and the share of them to apply.
#[derive(Debug, Clone, Copy)]
struct Travel<'a> {
    motions: &'a [Six],
    coordinates: &'a [f64],
    share: f64,
}

/// Places from which drives take their coordinates.
#[derive(Debug, Clone, Copy)]
struct Drives<'a> {
    prescribed: &'a Prescribed,
    /// Rows of the step; some belong to drives that gave way.
    keys: &'a [RowKey],
    yielded: bool,
    /// Whether coordinates with a drive that gave way are coordinates of the graph.
    frees: bool,
}

impl Drives<'_> {
    #[inline(always)]
    fn gave_way(&self, joint: usize, k: usize) -> bool {
        self.yielded && self.keys.contains(&RowKey::Drive(joint, k))
    }

    /// Value of a coordinate with a drive that did not give way.
    #[inline(always)]
    fn goal(&self, joint: &TreeJoint, number: usize, k: usize) -> Option<f64> {
        let holds = joint.coordinates[k].drive.is_some() && !self.gave_way(number, k);
        holds.then(|| self.prescribed.value(number, k))
    }
}

/// Bodies and joints that a motion moves, with the graph that it was computed in.
struct Trees<'a> {
    world: &'a World,
    assembly: &'a Assembly,
    outwards: &'a [(usize, Option<usize>)],
    drives: Drives<'a>,
}

impl Trees<'_> {
    /// Moves all coordinates and bodies.
    fn place(&self, state: &mut WorldState, travel: Travel<'_>) {
        for &(body, _) in self.outwards {
            match self.assembly.joint_of[body] {
                Some(number) => self.place_by_joint(state, travel, body, number),
                None => advance(&mut state.poses[body], &twist(&travel.motions[body]), travel.share),
            }
        }
    }

    #[inline(always)]
    fn place_by_joint(&self, state: &mut WorldState, travel: Travel<'_>, body: usize, number: usize) {
        let joint = &self.world.joints[number];
        let parent = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]);
        state.poses[body] = match self.drives.prescribed.goal(joint) {
            Some(goal) => parent * goal,
            None => {
                let q = self.advanced(joint, number, &state.coordinates[number], travel);
                state.coordinates[number].copy_from_slice(&q[..joint.kind.freedom()]);
                let child_frame = joint.kind.child_frame(&parent.with(&joint.parent_from_joint), &q);
                let pose = child_frame.without(&joint.child_from_joint);
                Pose { rotation: orthonormal(&pose.rotation), ..pose }
            }
        };
    }

    /// Coordinates of a joint after the motion.
    #[inline(always)]
    fn advanced(&self, joint: &TreeJoint, number: usize, q: &[f64], travel: Travel<'_>) -> Coordinates {
        let mut slot = self.assembly.first[joint.child];
        let mut along = [0.0; MOST];
        let mut driven = false;
        for k in 0..q.len() {
            let is_free = joint.coordinates[k].drive.is_none();
            if is_free || (self.drives.frees && self.drives.gave_way(number, k)) {
                along[k] = travel.share * travel.coordinates[slot];
                slot += 1;
            }
            driven |= !is_free;
        }
        if !driven {
            return joint.kind.moved(q, &along);
        }
        let goals: [Option<f64>; MOST] =
            std::array::from_fn(|k| if k < q.len() { self.drives.goal(joint, number, k) } else { None });
        let goal = std::array::from_fn(|k| goals[k].unwrap_or(q.get(k).copied().unwrap_or(0.0)));
        let displacement = joint.kind.displacement(q, &goal);
        for k in 0..q.len() {
            along[k] = if goals[k].is_some() { displacement[k] } else { along[k] };
        }
        let mut moved = joint.kind.moved(q, &along);
        for (value, goal) in moved.iter_mut().zip(goals) {
            *value = goal.filter(|goal| (goal - *value).abs() < NEARLY_DRIVEN).unwrap_or(*value);
        }
        moved
    }

    /// Translates the trees whose roots may translate, so that their mass centres are where they move to along straight
    /// lines; `off` has the difference of each body from its own line, and becomes the sum over its tree.
    fn center(&self, state: &mut WorldState, off: &mut [Vec3], masses: &mut Vec<f64>) {
        masses.clear();
        masses.extend(self.world.bodies.iter().map(|body| body.mass));
        for (body, off) in off.iter_mut().enumerate() {
            *off *= masses[body];
        }
        for &(body, parent) in self.outwards.iter().rev() {
            if let Some(parent) = parent {
                masses[parent] += masses[body];
                let sum = off[body];
                off[parent] += sum;
            }
        }
        for &(body, parent) in self.outwards {
            off[body] = match parent {
                Some(parent) => off[parent],
                None if masses[body] > 0.0 => self.slide(state, body, off[body] / -masses[body]),
                None => Vec3::zeros(),
            };
            state.poses[body].translation += off[body];
        }
    }

    /// The part of a translation that a root allows; its coordinates take it.
    fn slide(&self, state: &mut WorldState, root: usize, shift: Vec3) -> Vec3 {
        let Some(number) = self.assembly.joint_of[root] else { return shift };
        let joint = &self.world.joints[number];
        let mut allowed = Vec3::zeros();
        for (k, axis) in slides(joint) {
            if joint.coordinates[k].drive.is_none() || self.drives.gave_way(number, k) {
                let axis = joint.parent_from_joint.rotation.column(axis);
                let along = axis.dot(&shift);
                state.coordinates[number][k] += along;
                allowed += axis * along;
            }
        }
        allowed
    }

    /// Whether a tree of several bodies has a root that may translate.
    fn floats(&self) -> bool {
        let may_slide = |root: usize| match self.assembly.joint_of[root] {
            None => true,
            Some(number) => slides(&self.world.joints[number]).next().is_some(),
        };
        let carries = |(body, parent): &(usize, Option<usize>)| parent.is_none() && may_slide(*body);
        self.outwards.iter().any(|(_, parent)| parent.is_some()) && self.outwards.iter().any(carries)
    }
}

/// Coordinates along which a joint slides, with the axes of the parent's frame.
fn slides(joint: &TreeJoint) -> impl Iterator<Item = (usize, usize)> {
    let (first, axes) = match joint.kind {
        _ if joint.follows.is_some() => (0, 0..0),
        JointKind::Prismatic => (0, 2..3),
        JointKind::Planar => (0, 0..2),
        JointKind::Free => (3, 0..3),
        JointKind::Weld | JointKind::Revolute | JointKind::Universal | JointKind::Ball => (0, 0..0),
    };
    axes.enumerate().map(move |(k, axis)| (first + k, axis))
}

impl StepWorkspace {
    /// Places all bodies at the end of a motion of duration `h` with the velocities of the last solution; contact
    /// points were found `step_s` before its end.
    pub(super) fn place(&mut self, world: &World, state: &mut WorldState, h: f64) {
        let drives = Drives {
            prescribed: &self.prescribed,
            keys: &self.equations.assembly.keys,
            yielded: self.yielded,
            frees: true,
        };
        let trees = Trees { world, assembly: &self.equations.assembly, outwards: self.solver.outwards(), drives };
        let GraphSolution { motions, coordinates, .. } = &self.equations.solution;
        let travel = Travel { motions, coordinates, share: h };
        if trees.floats() {
            self.projection.off.clear();
            self.projection.off.extend(
                state.poses.iter().zip(motions).map(|(pose, motion)| pose.translation + twist(motion).linear * h),
            );
            trees.place(state, travel);
            for (off, pose) in self.projection.off.iter_mut().zip(&state.poses) {
                *off = pose.translation - *off;
            }
            trees.center(state, &mut self.projection.off, &mut self.projection.masses);
        } else {
            trees.place(state, travel);
        }
        self.aim(world, state, h);
        if self.projection.targets.iter().any(|target| target.abs() > ROUNDING) {
            self.displace(world, state);
        }
    }

    /// Sets the displacements that rows require at the present positions.
    fn aim(&mut self, world: &World, state: &WorldState, h: f64) {
        let most = CLOSING_SPEED * h;
        let graph = &self.equations.assembly.graph;
        self.projection.targets.clear();
        self.projection.targets.resize(graph.rows.len(), 0.0);
        for (key, group) in self.equations.assembly.keys.iter().zip(&graph.groups) {
            if let RowKey::Closure(number) = key {
                for (row, error) in group.rows.clone().zip(closure_errors(world, state, *number)) {
                    self.projection.targets[row] = -error.clamp(-most, most);
                }
            } else if let Some((joint, k, limit)) = limit_of(world, *key) {
                self.projection.targets[group.rows.start] = (limit - state.coordinates[joint][k]).clamp(-most, most);
            }
        }
        for touch in self.contact.touch.touches.iter().filter(|t| t.rigid) {
            let gap = self.contact.touch.gap_now(world, state, touch, self.step_s);
            self.projection.targets[touch.rows.normal] = (-gap).clamp(-most, most);
        }
    }

    /// Moves bodies by the displacements that carry rows to their targets.
    fn displace(&mut self, world: &World, state: &mut WorldState) {
        let graph = &self.equations.assembly.graph;
        project_displacements(
            graph,
            &self.projection.targets,
            &mut self.solver,
            &mut self.projection.displacements,
            &mut self.projection.shifts,
        );
        let share = share_of_displacements(&self.projection.targets, &self.projection.displacements);
        let drives = Drives {
            prescribed: &self.prescribed,
            keys: &self.equations.assembly.keys,
            yielded: self.yielded,
            frees: true,
        };
        let trees = Trees { world, assembly: &self.equations.assembly, outwards: self.solver.outwards(), drives };
        trees.place(
            state,
            Travel { motions: &self.projection.displacements, coordinates: &self.projection.shifts, share },
        );
    }

    /// Measures the coordinates of all joints from the poses.
    pub(super) fn measure_joints(&self, world: &World, state: &mut WorldState) {
        for number in (0..world.joints.len()).filter(|number| world.joints[*number].follows.is_none()) {
            state.measure(world, number);
        }
    }
}

impl StepWorkspace {
    /// Closes the loops that the step has left open.
    pub(super) fn close(
        &mut self,
        world: &World,
        state: &mut WorldState,
        settings: &StepSettings,
    ) -> Result<(), LinkError> {
        let h = self.step_s;
        for _ in 0..ROUNDS {
            if !self.open(world, state) {
                break;
            }
            let Equations { assembly, solution, .. } = &mut self.closing.equations;
            assembly.fill(world, state, &self.prescribed, &Vec::new(), Span::step(h));
            let graph = &mut assembly.graph;
            graph.wrenches.fill(Six::zeros());
            graph.efforts.fill(0.0);
            graph.terms.offset.fill(Six::zeros());
            let closures = assembly.keys.iter().map(|key| matches!(key, RowKey::Closure(_)));
            let mut held = closures.clone();
            graph.groups.retain(|_| held.next().unwrap_or(false));
            self.projection.targets.clear();
            self.projection.targets.resize(graph.rows.len(), 0.0);
            let numbers = assembly.keys.iter().filter_map(|key| match key {
                RowKey::Closure(number) => Some(*number),
                _ => None,
            });
            for (group, number) in graph.groups.iter().zip(numbers) {
                for (row, error) in group.rows.clone().zip(closure_errors(world, state, number)) {
                    (graph.rows[row].target, self.projection.targets[row]) = (-error, -error);
                }
            }
            solution.lambda.clear();
            solve_graph(graph, &settings.solver, &mut self.closing.solver, solution)?;
            let share = share_of_displacements(&self.projection.targets, &solution.motions);
            let drives = Drives {
                prescribed: &self.prescribed,
                keys: &self.equations.assembly.keys,
                yielded: self.yielded,
                frees: false,
            };
            let trees = Trees { world, assembly, outwards: self.closing.solver.outwards(), drives };
            trees.place(state, Travel { motions: &solution.motions, coordinates: &solution.coordinates, share });
        }
        Ok(())
    }

    /// Whether a closure of the step is open.
    fn open(&self, world: &World, state: &WorldState) -> bool {
        self.equations.assembly.keys.iter().any(|key| match key {
            RowKey::Closure(number) => largest_error(world, state, *number) > CLOSED,
            _ => false,
        })
    }
}

/// Largest error of a closure [m, rad].
fn largest_error(world: &World, state: &WorldState, number: usize) -> f64 {
    closure_errors(world, state, number).fold(0.0, |most: f64, error| most.max(error.abs()))
}

/// Whether a closure is still closing, as after it was added by an event: such closures close at limited speed.
pub(super) fn still_closing(world: &World, state: &WorldState) -> bool {
    (0..world.closures.len()).any(|number| world.closures[number].active && largest_error(world, state, number) > FAR)
}

/// The share of the displacements to apply: 1, or less if displacements are far larger than the errors that they
/// remove. In stretched loops a small error along the loop needs a large displacement across it, beyond the linear
/// range.
fn share_of_displacements(targets: &[f64], displacements: &[Six]) -> f64 {
    let slide = |six: &Six| six.fixed_rows::<3>(3).amax();
    let error = targets.iter().map(|t| t.abs()).fold(0.0, f64::max);
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

/// Frames of a closure.
pub(crate) fn closure_frames(world: &World, state: &WorldState, number: usize) -> Frames {
    let closure = &world.closures[number];
    let parent = closure.second.map_or(Pose::IDENTITY, |p| state.poses[p]);
    Frames {
        parent: parent.with(&closure.second_from_joint),
        child: state.poses[closure.first].with(&closure.first_from_joint),
    }
}

/// Errors of a closure along its rows [rad, m].
pub(crate) fn closure_errors(world: &World, state: &WorldState, number: usize) -> impl Iterator<Item = f64> {
    let kind = world.closures[number].kind;
    let frames = closure_frames(world, state, number);
    let (turn, shift) = drift(kind, &frames, &[]);
    let mut errors = [0.0; MOST];
    let constrained = kind.constrained(&frames);
    let all = constrained.turns().map(|e| e.dot(&turn)).chain(constrained.slides().map(|e| e.dot(&shift)));
    let mut count = 0;
    for error in all {
        errors[count] = error;
        count += 1;
    }
    errors.into_iter().take(count)
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
            let (_, shift) = drift(world.closures[closure].kind, &closure_frames(world, state, closure), &[]);
            shift.norm()
        }))
        .fold(0.0, f64::max)
}
