//! A fourth-order step without contacts: Runge-Kutta on the coordinates of the kinematic trees.
//!
//! The unknowns are a displacement δ and a rate q̇ of each coordinate; a body without a joint has six. For joints that
//! rotate freely, R = exp(δ) R₀, and δ̇ is not the rate but (Munthe-Kaas)
//!
//!   δ̇ = ω - ½ δ × ω + 1/12 δ × (δ × ω)
//!
//! with a next term of the order of δ⁴. Poses and twists follow from the coordinates, from the root outwards, so tree
//! joints are exact; the accelerations q̈ come from the constraint graph with
//!
//!   a_c = X a_p + S q̈ + w      w: b_α, and b_α × r + ω_p × (ω_p × s) + 2 ω_p × ṫ + ω_c × (ω_c × r)
//!
//! where r leads from the origin of C to the child's mass centre, s from the parent's mass centre to the origin of C, ṫ
//! is the translation rate of C in P, and b_α = Σ ė q̇ is the rotation of the joint's axes. Loops are closed at the
//! level of accelerations; after the step, positions and velocities are projected once onto the closures.
//!
//! The tree of this file is not `kinematics::plan`: that one belongs to a model whose axes are functions of
//! coordinates, while here bodies come in any order, joints are of seven fixed kinds, and free rotations are integrated
//! on the rotation group.
//!
//! Source: the classical method of Runge and Kutta; Munthe-Kaas 1998, "Runge-Kutta methods on Lie groups" (unverified
//! page).

use super::assemble::{Assembly, Slot, closing_rows, twist};
use super::forces::ContactForce;
use super::joint::{Frames, JointKind, MOST, orthonormal};
use super::projection::{closure_errors, closure_frames};
use super::state::{RowKey, WorldState, rates};
use super::workspace::Equations;
use super::world::{Figure, Owner, TreeJoint, World};
use crate::dynamics::{
    BodyTerms, Constraint, GraphWorkspace, Link, LinkError, Six, SolverSettings, parents_first, project_displacements,
    solve_graph,
};
use crate::kinematics::{BodyMotion, Posture, body_motion};
use crate::spatial::{Pose, Twist, Vec3, rotation, rotation_vector};

/// A body and the joint that carries it; a free body has a joint with six coordinates.
struct Branch {
    body: usize,
    parent: Option<usize>,
    parent_from_joint: Pose,
    joint_from_child: Pose,
    kind: JointKind,
    /// Pose of C in P at the start of the step.
    start: Pose,
    /// Coordinates at the start of the step; not used for free rotations.
    q: Vec<f64>,
    /// Index of the branch's first coordinate among all coordinates.
    first: usize,
    /// Index of the joint; `None` for a free body.
    joint: Option<usize>,
}

/// Displacements and rates of all coordinates.
#[derive(Clone)]
struct Motion {
    delta: Vec<f64>,
    rates: Vec<f64>,
}

/// The motion that a figure prescribes for a joint: pose of the child's mass centre frame in the parent's, with rates
/// and accelerations.
struct Goal {
    pose: Pose,
    rates: [f64; MOST],
    accelerations: [f64; MOST],
}

/// Advances the state by `h`. The forces of the first stage stay in `first`.
pub(crate) fn runge_kutta(
    world: &World,
    state: &mut WorldState,
    h: f64,
    settings: &SolverSettings,
    solver: &mut GraphWorkspace,
    first: &mut Equations,
    later: &mut Equations,
) -> Result<(), LinkError> {
    let tree = Tree::new(world, state);
    let mut here = state.clone();
    let start = Motion { delta: vec![0.0; tree.coordinates], rates: tree.start_rates(state) };
    let time = state.time_s;
    let slope1 = tree.slope(world, &start, time, &mut here, settings, solver, first)?;
    let slope2 =
        tree.slope(world, &start.plus(&slope1, 0.5 * h), time + 0.5 * h, &mut here, settings, solver, later)?;
    let slope3 =
        tree.slope(world, &start.plus(&slope2, 0.5 * h), time + 0.5 * h, &mut here, settings, solver, later)?;
    let slope4 = tree.slope(world, &start.plus(&slope3, h), time + h, &mut here, settings, solver, later)?;
    let mut end = start.clone();
    for (slope, weight) in [(slope1, 1.0), (slope2, 2.0), (slope3, 2.0), (slope4, 1.0)] {
        end = end.plus(&slope, weight * h / 6.0);
    }
    state.time_s = time + h;
    tree.place(world, &mut end, state);
    (0..world.joints.len()).for_each(|number| state.measure(world, number));
    state.guess.clear();
    if world.closures.iter().any(|c| c.active) {
        tree.close(world, state, settings, solver, later)?;
    }
    Ok(())
}

/// Accelerations of all bodies at their mass centres, world axes, without contacts; the forces stay in `first`.
pub(crate) fn accelerations(
    world: &World,
    state: &WorldState,
    settings: &SolverSettings,
    solver: &mut GraphWorkspace,
    first: &mut Equations,
) -> Result<Vec<Twist>, LinkError> {
    let tree = Tree::new(world, state);
    let motion = Motion { delta: vec![0.0; tree.coordinates], rates: tree.start_rates(state) };
    tree.slope(world, &motion, state.time_s, &mut state.clone(), settings, solver, first)?;
    Ok(first.solution.motions.iter().map(twist).collect())
}

/// Known part of the effort along an undriven coordinate [N.m or N].
#[derive(Debug, Clone, Copy)]
pub(super) enum KnownEffort {
    /// The whole effort.
    All(f64),
    /// Limits and dry friction; springs and motors obey their laws.
    Besides(f64),
}

/// Forces that are known when a world is balanced at an instant.
pub(super) struct Known<'a> {
    /// Forces at contact points.
    pub(super) contacts: &'a [ContactForce],
    /// Efforts by joint and coordinate; efforts of driven coordinates are not used.
    pub(super) efforts: Vec<Vec<KnownEffort>>,
}

impl Known<'_> {
    /// Adds the forces to a graph of accelerations.
    fn act(&self, world: &World, state: &WorldState, assembly: &mut Assembly) {
        for contact in self.contacts {
            for (surface, force) in [(contact.surfaces.0, contact.force), (contact.surfaces.1, -contact.force)] {
                let Owner::Body(body) = world.surfaces[surface].owner else { continue };
                let moment = (contact.point - state.poses[body].translation).cross(&force);
                assembly.graph.wrenches[body] += Six::new(moment.x, moment.y, moment.z, force.x, force.y, force.z);
            }
        }
        for (index, slot) in assembly.slots.iter().enumerate() {
            let known = slot.joint.and_then(|joint| self.efforts[joint].get(slot.coordinate));
            match known {
                Some(KnownEffort::All(effort)) => {
                    (assembly.graph.efforts[index], assembly.graph.rotors[index]) = (*effort, 0.0);
                }
                Some(KnownEffort::Besides(effort)) => assembly.graph.efforts[index] += effort,
                None => {}
            }
        }
    }
}

/// Solves for the accelerations and the unknown forces of a state in which coordinates have these rates; sets the
/// twists of the bodies. The forces stay in `stage`.
pub(super) fn balance(
    world: &World,
    state: &mut WorldState,
    rates: Vec<f64>,
    known: &Known<'_>,
    settings: &SolverSettings,
    solver: &mut GraphWorkspace,
    stage: &mut Equations,
) -> Result<(), LinkError> {
    let tree = Tree::new(world, state);
    let still = || vec![0.0; tree.coordinates];
    let mut motion = Motion { delta: still(), rates };
    tree.place(world, &mut motion, state);
    let mut slope = Motion { delta: still(), rates: still() };
    tree.fill(world, state, &motion, &mut slope, &mut stage.assembly);
    known.act(world, state, &mut stage.assembly);
    stage.solution.lambda.clear();
    solve_graph(&stage.assembly.graph, settings, solver, &mut stage.solution)?;
    Ok(())
}

/// Rates of all coordinates of a state, for [`balance`].
pub(super) fn rates_at(world: &World, state: &WorldState) -> Vec<f64> {
    Tree::new(world, state).start_rates(state)
}

/// The mean of the rates before and after a step of impulses, whose velocities afterwards belong to the axes before.
pub(super) fn mean_rates(world: &World, before: &WorldState, after: &[Twist]) -> Vec<f64> {
    let tree = Tree::new(world, before);
    let later = WorldState { twists: after.to_vec(), ..before.clone() };
    let pairs = tree.start_rates(before).into_iter().zip(tree.start_rates(&later));
    pairs.map(|(one, other)| 0.5 * (one + other)).collect()
}

impl Motion {
    fn plus(&self, slope: &Motion, h: f64) -> Motion {
        let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + h * b).collect();
        Motion { delta: sum(&self.delta, &slope.delta), rates: sum(&self.rates, &slope.rates) }
    }
}

/// The kinematic trees of a world at the start of a step.
struct Tree {
    /// Parents before children.
    outwards: Vec<Branch>,
    coordinates: usize,
}

impl Tree {
    fn new(world: &World, state: &WorldState) -> Tree {
        let joint_of = world.joint_of_body();
        let mut outwards = Vec::with_capacity(world.bodies.len());
        let mut coordinates = 0;
        for body in parents_first(joint_of.iter().map(|joint| joint.and_then(|j| world.joints[j].parent))) {
            let branch = Branch::new(world, state, body, joint_of[body], coordinates);
            coordinates += branch.kind.freedom();
            outwards.push(branch);
        }
        Tree { outwards, coordinates }
    }

    fn start_rates(&self, state: &WorldState) -> Vec<f64> {
        self.outwards.iter().flat_map(|branch| branch.rates(state)).collect()
    }

    /// Sets poses and twists from the coordinates, and writes the prescribed coordinates into the motion.
    fn place(&self, world: &World, motion: &mut Motion, state: &mut WorldState) {
        let goals = Goals::at(world, state.time_s);
        for branch in &self.outwards {
            branch.prescribe(world, &goals, motion, state.time_s);
            let parent = branch.parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * branch.parent_from_joint;
            let child = parent * branch.moved(motion);
            let pose = child * branch.joint_from_child;
            let pose = Pose { rotation: orthonormal(&pose.rotation), ..pose };
            state.poses[branch.body] = pose;
            let frames = Frames { parent, child };
            let mut six = branch.parent.map_or(Six::zeros(), |p| {
                let (t, arm) = (&state.twists[p], pose.translation - state.poses[p].translation);
                let v = t.velocity_at(arm);
                Six::new(t.angular.x, t.angular.y, t.angular.z, v.x, v.y, v.z)
            });
            let directions = branch.kind.directions(&frames, &(pose.translation - child.translation));
            for (k, direction) in directions.iter().enumerate().take(branch.kind.freedom()) {
                six.axpy(motion.rates[branch.first + k], direction, 1.0);
            }
            state.twists[branch.body] = twist(&six);
        }
    }

    /// The derivatives (δ̇, q̈) at a motion.
    #[expect(
        clippy::too_many_arguments,
        reason = "the parts of one evaluation; a struct would hold them for four calls"
    )]
    fn slope(
        &self,
        world: &World,
        motion: &Motion,
        time_s: f64,
        here: &mut WorldState,
        settings: &SolverSettings,
        solver: &mut GraphWorkspace,
        stage: &mut Equations,
    ) -> Result<Motion, LinkError> {
        let mut motion = motion.clone();
        here.time_s = time_s;
        self.place(world, &mut motion, here);
        let mut slope = Motion { delta: vec![0.0; self.coordinates], rates: vec![0.0; self.coordinates] };
        self.fill(world, here, &motion, &mut slope, &mut stage.assembly);
        stage.solution.lambda.clear();
        solve_graph(&stage.assembly.graph, settings, solver, &mut stage.solution)?;
        stage.note(world);
        let mut next = stage.assembly.slots.iter().zip(&stage.solution.coordinates);
        // Slots were filled body by body; branches are in another order.
        let mut accelerations = std::collections::BTreeMap::new();
        for (slot, value) in next.by_ref() {
            accelerations.insert((slot.body, slot.coordinate), *value);
        }
        for branch in &self.outwards {
            for k in 0..branch.kind.freedom() {
                if let Some(value) = accelerations.get(&(branch.body, k)) {
                    slope.rates[branch.first + k] = *value;
                }
            }
            branch.displacement_rates(&motion, &mut slope);
        }
        Ok(slope)
    }

    /// Fills the graph of accelerations.
    fn fill(&self, world: &World, state: &WorldState, motion: &Motion, slope: &mut Motion, assembly: &mut Assembly) {
        assembly.begin(world);
        let goals = Goals::at(world, state.time_s);
        let mut of_body: Vec<Option<&Branch>> = vec![None; world.bodies.len()];
        self.outwards.iter().for_each(|branch| of_body[branch.body] = Some(branch));
        for (body, branch) in of_body.into_iter().enumerate() {
            let (about, pose, omega) = (&world.bodies[body], &state.poses[body], state.twists[body].angular);
            let inertia = pose.rotation * about.inertia * pose.rotation.transpose();
            let moment = about.load.moment - omega.cross(&(inertia * omega));
            let force = world.gravity * about.mass + about.load.force;
            assembly.graph.bodies.push(BodyTerms { mass: about.mass, inertia });
            assembly.graph.wrenches.push(Six::new(moment.x, moment.y, moment.z, force.x, force.y, force.z));
            let Some(branch) = branch else { continue };
            branch.fill(world, state, motion, &goals, slope, assembly);
        }
        for (number, closure) in world.closures.iter().enumerate().filter(|(_, c)| c.active) {
            let frames = closure_frames(world, state, number);
            let centers = (state.poses[closure.first].translation, closure.second.map(|p| state.poses[p].translation));
            let constrained = closure.kind.constrained(&frames);
            let mut rows: Vec<Constraint> = closing_rows(&constrained, &frames, centers).collect();
            aim(&mut rows, world, state, number, &frames);
            assembly.close(number, closure, rows.into_iter());
        }
    }

    /// Projects positions and velocities onto the closures.
    fn close(
        &self,
        world: &World,
        state: &mut WorldState,
        settings: &SolverSettings,
        solver: &mut GraphWorkspace,
        stage: &mut Equations,
    ) -> Result<(), LinkError> {
        let mut motion =
            Motion { delta: vec![0.0; self.coordinates], rates: Tree::new(world, state).start_rates(state) };
        let mut slope = motion.clone();
        let tree = Tree::new(world, state);
        motion.delta.iter_mut().for_each(|d| *d = 0.0);
        tree.fill(world, state, &motion, &mut slope, &mut stage.assembly);
        let graph = &mut stage.assembly.graph;
        for (b, (body, t)) in graph.wrenches.iter_mut().zip(graph.bodies.iter().zip(&state.twists)) {
            let (w, v) = (t.angular, t.linear);
            *b = body.times(&Six::new(w.x, w.y, w.z, v.x, v.y, v.z));
        }
        let rates: Vec<f64> = stage.assembly.slots.iter().map(|slot| tree.rate(&motion, slot)).collect();
        for ((effort, rotor), rate) in graph.efforts.iter_mut().zip(&graph.rotors).zip(rates) {
            *effort = rotor * rate;
        }
        for branch in &tree.outwards {
            graph.terms.offset[branch.body] = branch.driven_velocity(world, state, &motion);
        }
        graph.rows.iter_mut().for_each(|row| row.target = 0.0);
        stage.solution.lambda.clear();
        solve_graph(graph, settings, solver, &mut stage.solution)?;
        stage.note(world);
        let graph = &mut stage.assembly.graph;
        for (t, motion) in state.twists.iter_mut().zip(&stage.solution.motions) {
            *t = twist(motion);
        }
        let mut targets = Vec::with_capacity(graph.rows.len());
        for key in &stage.assembly.keys {
            if let RowKey::Closure(number) = key {
                targets.extend(closure_errors(world, state, *number).map(|error| -error));
            }
        }
        graph.terms.offset.iter_mut().for_each(|w| *w = Six::zeros());
        let (mut displacements, mut shifts) = (Vec::new(), Vec::new());
        project_displacements(graph, &targets, solver, &mut displacements, &mut shifts);
        for (pose, six) in state.poses.iter_mut().zip(&displacements) {
            let t = twist(six);
            pose.translation += t.linear;
            pose.rotation = orthonormal(&(rotation(&t.angular) * pose.rotation));
        }
        Ok(())
    }

    fn rate(&self, motion: &Motion, slot: &Slot) -> f64 {
        let branch = self.outwards.iter().find(|b| b.body == slot.body);
        branch.map_or(0.0, |b| motion.rates[b.first + slot.coordinate])
    }
}

impl Branch {
    fn new(world: &World, state: &WorldState, body: usize, number: Option<usize>, first: usize) -> Branch {
        let joint = number.map(|n| &world.joints[n]);
        let follows = joint.is_some_and(|j| j.follows.is_some());
        let parent = joint.and_then(|j| j.parent);
        let frames = joint.filter(|_| !follows);
        let parent_from_joint = frames.map_or(Pose::IDENTITY, |j| j.parent_from_joint);
        let child_from_joint = frames.map_or(Pose::IDENTITY, |j| j.child_from_joint);
        let p = parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * parent_from_joint;
        Branch {
            body,
            parent,
            parent_from_joint,
            joint_from_child: child_from_joint.inverse(),
            kind: frames.map_or(JointKind::Free, |j| j.kind),
            start: p.inverse() * (state.poses[body] * child_from_joint),
            q: number.filter(|_| !follows).map_or_else(Vec::new, |n| state.coordinates[n].clone()),
            first,
            joint: number,
        }
    }

    fn frames(&self, state: &WorldState) -> Frames {
        let parent = self.parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * self.parent_from_joint;
        Frames { parent, child: state.poses[self.body] * self.joint_from_child.inverse() }
    }

    fn rates(&self, state: &WorldState) -> Vec<f64> {
        let like = TreeJoint {
            name: String::new(),
            child: self.body,
            parent: self.parent,
            parent_from_joint: self.parent_from_joint,
            child_from_joint: self.joint_from_child.inverse(),
            kind: self.kind,
            coordinates: Vec::new(),
            follows: None,
        };
        rates(state, &like, &self.frames(state))[..self.kind.freedom()].to_vec()
    }

    /// The joint's description; `None` for a free body.
    fn joint<'w>(&self, world: &'w World) -> Option<&'w TreeJoint> {
        self.joint.map(|n| &world.joints[n])
    }

    /// Pose of C in P for a motion.
    fn moved(&self, motion: &Motion) -> Pose {
        let d = &motion.delta[self.first..self.first + self.kind.freedom()];
        match self.kind {
            JointKind::Ball | JointKind::Free => Pose {
                rotation: rotation(&Vec3::new(d[0], d[1], d[2])) * self.start.rotation,
                translation: match d.get(3..6) {
                    Some(shift) => self.start.translation + Vec3::new(shift[0], shift[1], shift[2]),
                    None => Vec3::zeros(),
                },
            },
            _ => {
                let mut q = [0.0; MOST];
                for (k, value) in q.iter_mut().enumerate().take(d.len()) {
                    *value = self.q[k] + d[k];
                }
                self.kind.parent_from_child(&q)
            }
        }
    }

    /// Writes δ̇ from the rates.
    fn displacement_rates(&self, motion: &Motion, slope: &mut Motion) {
        let range = self.first..self.first + self.kind.freedom();
        slope.delta[range.clone()].copy_from_slice(&motion.rates[range]);
        if matches!(self.kind, JointKind::Ball | JointKind::Free) {
            let three = |list: &[f64]| Vec3::new(list[self.first], list[self.first + 1], list[self.first + 2]);
            let (delta, omega) = (three(&motion.delta), three(&motion.rates));
            let turned = delta.cross(&omega);
            let rate = omega - turned * 0.5 + delta.cross(&turned) / 12.0;
            slope.delta[self.first..self.first + 3].copy_from_slice(rate.as_slice());
        }
    }

    /// Overwrites the coordinates that drives and figures prescribe.
    fn prescribe(&self, world: &World, goals: &Goals, motion: &mut Motion, time_s: f64) {
        let Some(joint) = self.joint(world) else { return };
        if let Some(goal) = goals.of(joint) {
            let turn = rotation_vector(&(goal.pose.rotation * self.start.rotation.transpose()));
            let shift = goal.pose.translation - self.start.translation;
            motion.delta[self.first..self.first + 3].copy_from_slice(turn.as_slice());
            motion.delta[self.first + 3..self.first + 6].copy_from_slice(shift.as_slice());
            motion.rates[self.first..self.first + 6].copy_from_slice(&goal.rates);
            return;
        }
        for (k, acting) in joint.coordinates.iter().enumerate() {
            if let Some(drive) = &acting.drive {
                let [value, rate, _] = drive.signal.at(time_s);
                motion.delta[self.first + k] = value - self.q[k];
                motion.rates[self.first + k] = rate;
            }
        }
    }

    /// The velocity that drives and figures prescribe.
    fn driven_velocity(&self, world: &World, state: &WorldState, motion: &Motion) -> Six {
        let mut offset = Six::zeros();
        let Some(joint) = self.joint(world) else { return offset };
        let frames = self.frames(state);
        let directions =
            self.kind.directions(&frames, &(state.poses[self.body].translation - frames.child.translation));
        for k in 0..self.kind.freedom() {
            let driven = joint.follows.is_some() || joint.coordinates[k].drive.is_some();
            if driven {
                offset.axpy(motion.rates[self.first + k], &directions[k], 1.0);
            }
        }
        offset
    }

    /// Adds this branch to the graph; prescribed accelerations go to the slope.
    fn fill(
        &self,
        world: &World,
        state: &WorldState,
        motion: &Motion,
        goals: &Goals,
        slope: &mut Motion,
        assembly: &mut Assembly,
    ) {
        let frames = self.frames(state);
        let center = state.poses[self.body].translation;
        let to_center = center - frames.child.translation;
        let directions = self.kind.directions(&frames, &to_center);
        let arm = self.parent.map_or(Vec3::zeros(), |p| center - state.poses[p].translation);
        let mut offset = self.velocity_products(state, &frames, motion, &directions, &to_center);
        let joint = self.joint(world);
        let goal = joint.and_then(|j| goals.of(j));
        let mut freedom = 0;
        for k in 0..self.kind.freedom() {
            let acting = joint.and_then(|j| j.coordinates.get(k));
            let prescribed = match (&goal, acting.and_then(|a| a.drive.as_ref())) {
                (Some(goal), _) => Some(goal.accelerations[k]),
                (None, drive) => drive.map(|d| d.signal.at(state.time_s)[2]),
            };
            if let Some(acceleration) = prescribed {
                offset.axpy(acceleration, &directions[k], 1.0);
                slope.rates[self.first + k] = acceleration;
                continue;
            }
            freedom += 1;
            let graph = &mut assembly.graph;
            graph.terms.directions.push(directions[k]);
            let q = self.q.get(k).map_or(0.0, |q| q + motion.delta[self.first + k]);
            let rate = motion.rates[self.first + k];
            graph.efforts.push(acting.map_or(0.0, |a| a.smooth_effort(q, rate, state.time_s)));
            graph.rotors.push(acting.map_or(0.0, |a| a.rotor));
            assembly.slots.push(Slot { body: self.body, joint: self.joint, coordinate: k });
        }
        let graph = &mut assembly.graph;
        graph.links.push(Link { parent: self.parent, freedom });
        graph.terms.arm.push(arm);
        graph.terms.offset.push(offset);
        if let (Some(number), None) = (self.joint, &goal) {
            let freedom = self.kind.freedom();
            assembly.directions.of_mut(number, self.kind).copy_from_slice(&directions[..freedom]);
        }
    }

    /// The part of w that depends on velocities only.
    fn velocity_products(
        &self,
        state: &WorldState,
        frames: &Frames,
        motion: &Motion,
        directions: &[Six; MOST],
        r: &Vec3,
    ) -> Six {
        let omega_c = state.twists[self.body].angular;
        let (omega_p, s) = match self.parent {
            Some(p) => (state.twists[p].angular, frames.child.translation - state.poses[p].translation),
            None => (Vec3::zeros(), Vec3::zeros()),
        };
        let (mut turning, mut slide) = (Vec3::zeros(), Vec3::zeros());
        for k in 0..self.kind.freedom() {
            let (d, rate) = (&directions[k], motion.rates[self.first + k]);
            if self.kind.turns(k) {
                // The second axis of a universal joint turns with the child.
                let carried = if (self.kind, k) == (JointKind::Universal, 1) { omega_c } else { omega_p };
                turning += carried.cross(&(Vec3::new(d[0], d[1], d[2]) * rate));
            } else {
                slide += Vec3::new(d[3], d[4], d[5]) * rate;
            }
        }
        let linear = turning.cross(r)
            + omega_p.cross(&omega_p.cross(&s))
            + omega_p.cross(&slide) * 2.0
            + omega_c.cross(&omega_c.cross(r));
        Six::new(turning.x, turning.y, turning.z, linear.x, linear.y, linear.z)
    }
}

/// Sets the targets of a closure's rows: the contribution of velocities to the second derivative of its errors.
fn aim(rows: &mut [Constraint], world: &World, state: &WorldState, number: usize, frames: &Frames) {
    let closure = &world.closures[number];
    let c = &state.twists[closure.first];
    let still = (Twist::ZERO, Vec3::zeros());
    let (p, center) = closure.second.map_or(still, |p| (state.twists[p], state.poses[p].translation));
    let origin = frames.child.translation;
    let r = state.poses[closure.first].translation - origin;
    let s = origin - center;
    let u = c.velocity_at(-r) - p.velocity_at(s);
    let (w_c, w_p) = (c.angular, p.angular);
    let linear = w_c.cross(&w_c.cross(&r)) + w_p.cross(&w_p.cross(&s)) + w_p.cross(&u) * 2.0;
    let constrained = closure.kind.constrained(frames);
    let relative = w_c - w_p;
    let universal = closure.kind == JointKind::Universal;
    for (row, e) in rows.iter_mut().zip(constrained.turns()) {
        let turned = if universal {
            let (x, y) = (frames.parent.rotation.column(0).into_owned(), frames.child.rotation.column(1).into_owned());
            (w_p.cross(&x).cross(&y) + x.cross(&w_c.cross(&y))) / x.cross(&y).norm()
        } else {
            w_p.cross(&e)
        };
        row.target = -turned.dot(&relative);
    }
    for (row, e) in rows.iter_mut().skip(constrained.turns().count()).zip(constrained.slides()) {
        row.target = e.dot(&linear);
    }
}

/// Motions of the bodies of every figure at one instant.
struct Goals(Vec<Vec<BodyMotion>>);

impl Goals {
    fn at(world: &World, time_s: f64) -> Goals {
        let of = |figure: &Figure| {
            let values: Vec<[f64; 3]> = figure.coordinates.iter().map(|signal| signal.at(time_s)).collect();
            let [q, qd, qdd] = [0, 1, 2].map(|k| values.iter().map(|v| v[k]).collect::<Vec<f64>>());
            body_motion(&figure.model, Posture { q: &q, qd: &qd, qdd: &qdd })
        };
        Goals(world.figures.iter().map(of).collect())
    }

    /// Motion of a joint's child relative to its parent, mass centre to mass centre, in the parent's axes.
    fn of(&self, joint: &TreeJoint) -> Option<Goal> {
        let follows = joint.follows?;
        let motions = &self.0[follows.figure];
        let child = &motions[follows.body];
        let still =
            BodyMotion { pose: Pose::IDENTITY, center: Vec3::zeros(), twist: Twist::ZERO, acceleration: Twist::ZERO };
        let parent = follows.parent.map_or(still, |p| motions[p]);
        let back = parent.pose.rotation.transpose();
        let r = child.center - parent.center;
        let (w, al) = (parent.twist.angular, parent.acceleration.angular);
        let relative = child.twist.angular - w;
        let slide = child.twist.linear - parent.twist.velocity_at(r);
        let turning = child.acceleration.angular - al - w.cross(&relative);
        let sliding = child.acceleration.linear
            - parent.acceleration.linear
            - al.cross(&r)
            - w.cross(&w.cross(&r))
            - w.cross(&slide) * 2.0;
        let six = |a: Vec3, b: Vec3| {
            let (a, b) = (back * a, back * b);
            [a.x, a.y, a.z, b.x, b.y, b.z]
        };
        Some(Goal {
            pose: Pose { rotation: back * child.pose.rotation, translation: back * r },
            rates: six(relative, slide),
            accelerations: six(turning, sliding),
        })
    }
}
