//! The constraint graph of one velocity step.
//!
//! The unknowns are the velocities v at the end of the step:
//!
//!   M v = M v⁻ + h f + Jᵀ λ          λ: impulses
//!
//! where f is gravity, loads and the gyroscopic moment -ω × I ω. The gyroscopic moment is implicit, by one Newton step
//! of I (ω - ω⁻) + h ω × I ω = 0, because an explicit one feeds energy to fast spins (Catto 2015, unverified). Springs,
//! dampers and motors on coordinates are implicit too: with q + h q̇ at the end of the step,
//!
//!   (.. + r + h d + h² k) q̇ = r q̇⁻ + h k (rest - q)
//!
//! A drive moves its coordinate to the value of its signal at the end of the step: q̇ = (s(t + h) - q)/h.

use super::joint::{Constrained, Coordinates, Frames, JointKind};
use super::signal::Instant;
use super::state::{RowKey, WorldState, rates};
use super::world::{Closure, JointCoordinate, TreeJoint, World};
use crate::dynamics::{
    ActsOn, BodyTerms, Constraint, ConstraintGraph, ConstraintGroup, Law, Link, Six, relative_slide, relative_turn,
};
use crate::spatial::{Mat3, Pose, Twist, Vec3, rotation_vector};

/// Drives that give way beyond their limit in this step: (joint, coordinate, limit).
pub(crate) type Yielding = Vec<(usize, usize, f64)>;

/// The time span of one velocity solve.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Span {
    /// Duration [s].
    pub(crate) h: f64,
    /// Whether the solve is for an instant, an impact.
    pub(crate) instant: bool,
    /// Whether the velocities are those in the middle of a step of 2 h, and the laws of unilateral rows and of friction
    /// hold at its end ([`super::midpoint`]).
    pub(crate) halfway: bool,
}

impl Span {
    /// The time span of a first-order step [s].
    pub(crate) fn step(h: f64) -> Span {
        Span { h, instant: false, halfway: false }
    }

    /// An impact; `h` [s] is the span in which gaps close.
    pub(crate) fn instant(h: f64) -> Span {
        Span { h, instant: true, halfway: false }
    }

    /// The first half of a midpoint step [s].
    pub(crate) fn half(h: f64) -> Span {
        Span { h, instant: false, halfway: true }
    }
}

impl Span {
    /// The lowest rate at which a distance from a limit may change, from the distance and its rate at the start.
    fn lowest_rate(self, distance: f64, rate: f64, pressed: bool) -> f64 {
        match self.halfway {
            false => (-distance / self.h).min(0.0),
            // The rate at the end of the step, 2 u - u⁻, must not be negative.
            true if pressed || distance + 2.0 * self.h * rate <= 0.0 => 0.5 * rate,
            true => (-0.5 * distance / self.h).min(0.0),
        }
    }
}

/// Whether a unilateral row bore load in the last step.
pub(super) fn presses(state: &WorldState, key: &RowKey) -> bool {
    state.guess.get(key).is_some_and(|impulses| impulses[0] != 0.0)
}

/// Largest number of Newton steps for the spin of a body in the middle of a step.
const ROUNDS: usize = 8;

/// A coordinate of the graph: where it belongs.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Slot {
    pub(crate) body: usize,
    /// `None` for a body without a joint.
    pub(crate) joint: Option<usize>,
    pub(crate) coordinate: usize,
}

/// The graph of a step, with the parts of the world that its rows and coordinates belong to.
#[derive(Debug, Clone, Default)]
pub(crate) struct Assembly {
    pub(crate) graph: ConstraintGraph,
    /// The constraint of each group of rows.
    pub(crate) keys: Vec<RowKey>,
    /// The coordinate of the world for each coordinate of the graph.
    pub(crate) slots: Vec<Slot>,
    pub(crate) directions: JointDirections,
    /// Joint of each body.
    pub(crate) joint_of: Vec<Option<usize>>,
    /// First coordinate of the graph of each body.
    pub(crate) first: Vec<usize>,
    /// Angular velocities at which the gyroscopic moments of bodies are taken [rad/s]; without one it is predicted from
    /// the body alone.
    pub(crate) spins: Vec<Option<Vec3>>,
}

/// Free directions of all joints at the mass centres of their children, including driven ones; joint by joint.
#[derive(Debug, Clone, Default)]
pub(crate) struct JointDirections {
    /// Index of the first direction of each joint.
    first: Vec<usize>,
    all: Vec<Six>,
}

impl JointDirections {
    /// Takes the joints of a world; the caller sets the directions of each.
    fn begin(&mut self, world: &World) {
        self.first.clear();
        let mut count = 0;
        for joint in &world.joints {
            self.first.push(count);
            count += joint.kind.freedom();
        }
        self.all.resize(count, Six::zeros());
    }

    /// One direction of a joint.
    #[inline(always)]
    pub(crate) fn at(&self, joint: usize, coordinate: usize) -> &Six {
        &self.all[self.first[joint] + coordinate]
    }

    /// Directions of a joint.
    #[inline(always)]
    pub(crate) fn of_mut(&mut self, joint: usize, kind: JointKind) -> &mut [Six] {
        let first = self.first[joint];
        &mut self.all[first..first + kind.freedom()]
    }
}

/// Positions that drives and figures prescribe at one instant.
#[derive(Debug, Clone, Default)]
pub(crate) struct Prescribed {
    /// Poses of the bodies of every figure.
    figures: Vec<Vec<Pose>>,
    /// Index of the first coordinate of each joint in `values`.
    first: Vec<usize>,
    /// Values of the drives; zero for coordinates without one.
    values: Vec<f64>,
}

impl Prescribed {
    pub(crate) fn at(world: &World, time_s: f64) -> Prescribed {
        let mut this = Prescribed::default();
        this.fill(world, time_s);
        this
    }

    pub(crate) fn fill(&mut self, world: &World, time_s: f64) {
        self.figures.clear();
        self.figures.extend(world.figures.iter().map(|figure| figure.poses(time_s)));
        self.first.clear();
        self.values.clear();
        let mut instant = Instant::new(time_s);
        for joint in &world.joints {
            self.first.push(self.values.len());
            for coordinate in &joint.coordinates {
                self.values.push(coordinate.drive.as_ref().map_or(0.0, |drive| instant.value(&drive.signal)));
            }
        }
    }

    /// Value of the drive of a coordinate.
    #[inline(always)]
    pub(crate) fn value(&self, joint: usize, coordinate: usize) -> f64 {
        self.values[self.first[joint] + coordinate]
    }

    /// Prescribed pose of a joint's child relative to its parent, if the joint follows a figure.
    pub(crate) fn goal(&self, joint: &TreeJoint) -> Option<Pose> {
        let follows = joint.follows?;
        let poses = &self.figures[follows.figure];
        let parent = follows.parent.map_or(Pose::IDENTITY, |p| poses[p]);
        Some(parent.inverse() * poses[follows.body])
    }
}

impl Assembly {
    /// Fills the graph with bodies, joints, closures and coordinates. Contacts are added later.
    pub(crate) fn fill(
        &mut self,
        world: &World,
        state: &WorldState,
        prescribed: &Prescribed,
        yielding: &Yielding,
        span: Span,
    ) {
        self.begin(world);
        for body in 0..world.bodies.len() {
            self.first.push(self.slots.len());
            self.add_body(world, state, body, span);
            match self.joint_of[body] {
                Some(joint) => self.add_joint(world, state, prescribed, yielding, joint, span),
                None => self.add_free(body),
            }
        }
        for slot in 0..self.slots.len() {
            self.add_coordinate(world, state, prescribed, yielding, slot, span);
        }
        self.add_closures(world, state);
    }

    /// Removes the rows of coordinates: only loops remain.
    pub(crate) fn keep_loops(&mut self, world: &World, state: &WorldState) {
        self.graph.rows.clear();
        self.graph.groups.clear();
        self.keys.clear();
        self.add_closures(world, state);
    }

    fn add_closures(&mut self, world: &World, state: &WorldState) {
        for (number, closure) in world.closures.iter().enumerate().filter(|(_, c)| c.active) {
            let parent = closure.second.map_or(Pose::IDENTITY, |p| state.poses[p]);
            let frames = Frames {
                parent: parent.with(&closure.second_from_joint),
                child: state.poses[closure.first].with(&closure.first_from_joint),
            };
            let centers = (state.poses[closure.first].translation, closure.second.map(|p| state.poses[p].translation));
            self.close(number, closure, closing_rows(&closure.kind.constrained(&frames), &frames, centers));
        }
    }

    /// Clears the graph and keeps its memory. The caller sets the directions of every joint.
    pub(crate) fn begin(&mut self, world: &World) {
        self.graph.clear();
        self.keys.clear();
        self.slots.clear();
        self.first.clear();
        self.directions.begin(world);
        self.joint_of.clear();
        self.joint_of.resize(world.bodies.len(), None);
        for (number, joint) in world.joints.iter().enumerate() {
            self.joint_of[joint.child] = Some(number);
        }
    }

    /// Adds the rows of a closure, if it has any.
    pub(crate) fn close(&mut self, number: usize, closure: &Closure, rows: impl Iterator<Item = Constraint>) {
        let start = self.graph.rows.len();
        self.graph.rows.extend(rows);
        if self.graph.rows.len() == start {
            return;
        }
        let on = ActsOn::Bodies { first: closure.first, second: closure.second };
        self.graph.groups.push(ConstraintGroup { on, rows: start..self.graph.rows.len(), law: Law::EQUALITY });
        self.keys.push(RowKey::Closure(number));
    }

    fn add_body(&mut self, world: &World, state: &WorldState, body: usize, Span { h, halfway, .. }: Span) {
        let (about, pose, twist) = (&world.bodies[body], &state.poses[body], &state.twists[body]);
        let inertia = turned_inertia(&pose.rotation, &about.inertia);
        let momentum = match self.spins.get(body).copied().flatten() {
            Some(spin) => inertia * twist.angular - spin.cross(&(inertia * spin)) * h,
            None => {
                inertia
                    * (twist.angular + gyroscopic_change(&inertia, &twist.angular, h, if halfway { ROUNDS } else { 1 }))
            }
        };
        let moment = momentum + about.load.moment * h;
        let force = twist.linear * about.mass + (world.gravity * about.mass + about.load.force) * h;
        self.graph.bodies.push(BodyTerms { mass: about.mass, inertia });
        self.graph.wrenches.push(Six::new(moment.x, moment.y, moment.z, force.x, force.y, force.z));
    }

    fn add_free(&mut self, body: usize) {
        self.graph.links.push(Link { parent: None, freedom: 6 });
        self.graph.terms.arm.push(Vec3::zeros());
        self.graph.terms.offset.push(Six::zeros());
        for k in 0..6 {
            let mut direction = Six::zeros();
            direction[k] = 1.0;
            self.graph.terms.directions.push(direction);
            self.graph.efforts.push(0.0);
            self.graph.rotors.push(0.0);
            self.slots.push(Slot { body, joint: None, coordinate: k });
        }
    }

    fn add_joint(
        &mut self,
        world: &World,
        state: &WorldState,
        prescribed: &Prescribed,
        yielding: &Yielding,
        number: usize,
        Span { h, instant, .. }: Span,
    ) {
        let joint = &world.joints[number];
        let center = state.poses[joint.child].translation;
        let arm = joint.parent.map_or(Vec3::zeros(), |p| center - state.poses[p].translation);
        self.graph.terms.arm.push(arm);
        if let Some(goal) = prescribed.goal(joint) {
            self.graph.links.push(Link { parent: joint.parent, freedom: 0 });
            let offset = if instant { carried_along(state, joint) } else { following(state, joint, &goal, h) };
            self.graph.terms.offset.push(offset);
            return;
        }
        let directions = self.directions.of_mut(number, joint.kind);
        write_directions(joint, state, directions);
        let mut offset = Six::zeros();
        let mut freedom = 0;
        let q = &state.coordinates[number];
        let drive_of = |k: usize| {
            let gives_way = yielding.iter().any(|(j, c, _)| (*j, *c) == (number, k));
            joint.coordinates[k].drive.as_ref().filter(|_| !gives_way)
        };
        // During an impact, drives keep their rates.
        let (displacement, h) = match (instant, joint.kind) {
            (true, _) => (rates(state, joint, &state.frames(joint)), 1.0),
            (false, JointKind::Ball | JointKind::Free) if joint.coordinates.iter().any(|c| c.drive.is_some()) => {
                let goal = std::array::from_fn(|k| match q.get(k) {
                    Some(q) => drive_of(k).map_or(*q, |_| prescribed.value(number, k)),
                    None => 0.0,
                });
                (joint.kind.displacement(q, &goal), h)
            }
            (false, _) => (Coordinates::default(), h),
        };
        let straight = !instant && !matches!(joint.kind, JointKind::Ball | JointKind::Free);
        for k in 0..q.len() {
            if drive_of(k).is_some() {
                let displacement = if straight { prescribed.value(number, k) - q[k] } else { displacement[k] };
                offset.axpy(displacement / h, &directions[k], 1.0);
                continue;
            }
            freedom += 1;
            self.graph.terms.directions.push(directions[k]);
            self.graph.efforts.push(0.0);
            self.graph.rotors.push(0.0);
            self.slots.push(Slot { body: joint.child, joint: Some(number), coordinate: k });
        }
        self.graph.links.push(Link { parent: joint.parent, freedom });
        self.graph.terms.offset.push(offset);
    }

    /// Adds springs, motors, limits and friction of one coordinate.
    fn add_coordinate(
        &mut self,
        world: &World,
        state: &WorldState,
        prescribed: &Prescribed,
        yielding: &Yielding,
        slot: usize,
        span: Span,
    ) {
        let h = span.h;
        let Slot { joint: Some(number), coordinate, .. } = self.slots[slot] else { return };
        let joint = &world.joints[number];
        let acting: &JointCoordinate = &joint.coordinates[coordinate];
        let q = state.coordinates[number][coordinate];
        let rate = if span.halfway { state.rates(joint)[coordinate] } else { 0.0 };
        if acting.rotor > 0.0 {
            self.graph.rotors[slot] += acting.rotor;
            self.graph.efforts[slot] += acting.rotor * state.rates(joint)[coordinate];
        }
        self.graph.efforts[slot] += h * acting.effort;
        if let Some(spring) = &acting.spring {
            self.graph.rotors[slot] += h * spring.damping + h * h * spring.stiffness;
            self.graph.efforts[slot] += h * spring.stiffness * (spring.rest - q);
        }
        let mut add = |key: RowKey, target: f64, compliance: f64, least: f64, most: f64| {
            let start = self.graph.rows.len();
            let (on_first, on_second) = (Six::zeros(), Six::zeros());
            self.graph.rows.push(Constraint { on_first, on_second, target, compliance });
            let on = ActsOn::Coordinate { body: joint.child, coordinate: slot };
            self.graph.groups.push(ConstraintGroup { on, rows: start..start + 1, law: Law::Bounded { least, most } });
            self.keys.push(key);
        };
        if let Some((_, _, max)) = yielding.iter().find(|(j, c, _)| (*j, *c) == (number, coordinate)) {
            let target = acting.drive.as_ref().map_or(q, |_| prescribed.value(number, coordinate));
            add(RowKey::Drive(number, coordinate), (target - q) / h, 0.0, -h * max, h * max);
        }
        if let Some(motor) = &acting.motor {
            let [target, rate, _] = motor.target.at(state.time_s + h);
            let yields = h * motor.kd + h * h * motor.kp;
            if yields > 0.0 {
                let compliance = 1.0 / yields;
                let wanted = compliance * h * (motor.kp * (target - q) + motor.kd * rate);
                add(RowKey::Motor(number, coordinate), wanted, compliance, -h * motor.max, h * motor.max);
            }
        }
        if acting.friction > 0.0 {
            let most = h * acting.friction;
            add(RowKey::Friction(number, coordinate), 0.5 * rate, 0.0, -most, most);
        }
        if let Some(lower) = acting.limits.0 {
            let key = RowKey::LowerLimit(number, coordinate);
            let target = span.lowest_rate(q - lower, rate, presses(state, &key));
            add(key, target, 0.0, 0.0, f64::INFINITY);
        }
        if let Some(upper) = acting.limits.1 {
            let key = RowKey::UpperLimit(number, coordinate);
            let target = -span.lowest_rate(upper - q, -rate, presses(state, &key));
            add(key, target, 0.0, f64::NEG_INFINITY, 0.0);
        }
    }
}

/// Writes the directions of a joint's coordinates at the centre of its child.
fn write_directions(joint: &TreeJoint, state: &WorldState, directions: &mut [Six]) {
    let (parent, child) = (joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]), &state.poses[joint.child]);
    let axis = |k: usize| parent.rotation * joint.parent_from_joint.rotation.column(k);
    let of_child = || child.rotation * joint.child_from_joint.rotation.column(1);
    let to_center = child.translation - child.place(joint.child_from_joint.translation);
    joint.kind.write_directions(axis, of_child, &to_center, directions);
}

/// R I Rᵀ of a symmetric I.
#[inline(always)]
fn turned_inertia(r: &Mat3, inertia: &Mat3) -> Mat3 {
    let half = r * inertia;
    let entry = |i: usize, j: usize| half.row(i).dot(&r.row(j));
    let [xx, xy, xz, yy, yz, zz] = [entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)];
    Mat3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// ω - ω⁻ of a free body: Newton steps of I (ω - ω⁻) + h ω × I ω = 0, from ω⁻ on.
fn gyroscopic_change(inertia: &Mat3, before: &Vec3, h: f64, rounds: usize) -> Vec3 {
    let mut change = Vec3::zeros();
    for _ in 0..rounds {
        let omega = before + change;
        let momentum = inertia * omega;
        let off = inertia * change + omega.cross(&momentum) * h;
        if off.norm_squared() < 1e-32 * momentum.norm_squared() {
            break;
        }
        let slope = inertia + (omega.cross_matrix() * inertia - momentum.cross_matrix()) * h;
        let [x, y, z] = [0, 1, 2].map(|k| slope.column(k).into_owned());
        let across = y.cross(&z);
        let determinant = x.dot(&across);
        if determinant == 0.0 {
            break;
        }
        // Cramer's rule.
        change -= Vec3::new(across.dot(&off), z.cross(&x).dot(&off), x.cross(&y).dot(&off)) / determinant;
    }
    change
}

/// The twist of the child's mass centre relative to its parent that moves a following body to its prescribed pose in
/// one step.
fn following(state: &WorldState, joint: &TreeJoint, goal: &Pose, h: f64) -> Six {
    let now = state.poses[joint.child];
    let goal = joint.parent.map_or(Pose::IDENTITY, |p| state.poses[p]) * *goal;
    let turn = rotation_vector(&(goal.rotation * now.rotation.transpose())) / h;
    let shift = (goal.translation - now.translation) / h;
    Six::new(turn.x, turn.y, turn.z, shift.x, shift.y, shift.z)
}

/// The present twist of the child's mass centre relative to its parent.
fn carried_along(state: &WorldState, joint: &TreeJoint) -> Six {
    let (child, center) = (state.twists[joint.child], state.poses[joint.child].translation);
    let (angular, linear) = joint.parent.map_or((child.angular, child.linear), |p| {
        let parent = state.twists[p];
        (child.angular - parent.angular, child.linear - parent.velocity_at(center - state.poses[p].translation))
    });
    Six::new(angular.x, angular.y, angular.z, linear.x, linear.y, linear.z)
}

/// Rows of a closure, with targets of zero.
pub(crate) fn closing_rows(
    constrained: &Constrained,
    frames: &Frames,
    (first, second): (Vec3, Option<Vec3>),
) -> impl Iterator<Item = Constraint> {
    let point = frames.child.translation;
    let from_second = second.map_or(Vec3::zeros(), |c| point - c);
    let slides = constrained.slides().map(move |e| relative_slide(e, first - point, from_second));
    constrained.turns().map(relative_turn).chain(slides)
}

/// Twist of a body from the six numbers of the solver.
pub(crate) fn twist(motion: &Six) -> Twist {
    Twist { angular: Vec3::new(motion[0], motion[1], motion[2]), linear: Vec3::new(motion[3], motion[4], motion[5]) }
}
