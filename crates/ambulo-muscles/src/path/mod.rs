//! Paths of muscles in one posture: lengths, lengthening speeds and moment arms.
//!
//! A path of unit tension pulls on the bodies at the ends of its straight parts, along them. With the force f and the
//! moment n of these pulls on the bodies beyond a joint, about its centre, and the motion (ω, v) of these bodies per
//! unit of a generalised speed ([`ambulo_body::kinematics::JointMotion`]), the moment arm is the generalised force of
//! the path:
//!
//!   r = ω · n + v · f + Σ f_point · R dp/dq          = -dL/dq       [m, or 1 for a coordinate that is a length]
//!   dL/dt = Σ over parts e · (v_end - v_begin)                      [m/s]
//!
//! where e is the direction of a straight part, p is the place of a moving point on its body and v of such a point
//! contains its own motion. Pulls are summed from the ends of the body towards its root, so that nothing is
//! differentiated. For a joint whose speeds are angular velocities the arms belong to these, as the generalised forces
//! of inverse dynamics do. The arm about a coordinate that leads others by couplers contains theirs, Σ r
//! dq_follower/dq_leader, so only coordinates without a leader have arms (OpenSim's `MomentArmSolver`).
//!
//! | code       | symbol | unit  | shape                                                      |
//! |------------|--------|-------|------------------------------------------------------------|
//! | `lengths`  | L      | m     | one per muscle                                             |
//! | `speeds`   | dL/dt  | m/s   | one per muscle                                             |
//! | `arms`     | r      | m     | per muscle, one per coordinate that may change its length  |
//! | `wrenches` | f, n   | 1, m  | per muscle, one per body between the bodies of its path    |
//!
//! Source: virtual work; OpenSim 4.6, GeometryPath.cpp (`addInEquivalentForces`), ConditionalPathPoint.cpp and
//! MovingPathPoint.cpp, read. Difference: a moving point outside the range of its coordinate stands still, also for the
//! moment arm (OpenSim holds the place and keeps the slope); a moving point counts also if its neighbour is on the same
//! body.
//! Cost: linear in points and in joints between the bodies of a path. Pinned by: tests/paths.rs, tests/loads.rs

mod plan;

use crate::set::MuscleSet;
use crate::wrap::{Contact, PathAnchor, PathNode, PathRoute, PathSurface, WrapRule};
use ambulo_body::dynamics::BodyLoad;
use ambulo_body::kinematics::{Posture, PostureSweep};
use ambulo_body::model::{BodyId, CoordinateId, Drive, Function, Model};
use ambulo_body::spatial::{Pose, Vec3, Wrench};
use plan::{PathPlan, PathPlanPoint, Place};

/// The paths of all muscles of a model in one posture. Made once; [`PathWorkspace::update`] allocates nothing after the
/// first frames.
#[derive(Debug, Clone)]
pub struct PathWorkspace {
    rule: WrapRule,
    sweep: PostureSweep,
    /// Leader and function of each coordinate that follows another.
    couplers: Vec<Option<(usize, Function)>>,
    /// dq/dq_leader of each coordinate; 1 without a leader.
    slopes: Vec<f64>,
    plans: Vec<PathPlan>,
    surfaces: Vec<PathSurface>,
    routes: Vec<PathRoute>,
    lengths: Vec<f64>,
    speeds: Vec<f64>,
    arms: Vec<f64>,
    wrenches: Vec<Wrench>,
    /// Generalised forces of moving points.
    gears: Vec<f64>,
    /// The point about which `wrenches` are, in the world [m].
    about: Vec3,
    scratch: Scratch,
}

/// Memory for one muscle.
#[derive(Debug, Clone, Default)]
struct Scratch {
    anchors: Vec<PathAnchor>,
    /// Index of each anchor among the points of the path.
    points: Vec<usize>,
    surfaces: Vec<PathSurface>,
    /// Pull on each point of the path.
    pulls: Vec<Vec3>,
    swept: Vec<Wrench>,
}

impl PathWorkspace {
    /// Memory for the muscles of a model. `set` belongs to `model`.
    #[must_use]
    pub fn new(model: &Model, set: &MuscleSet, rule: WrapRule) -> PathWorkspace {
        let coupler = |c: &ambulo_body::model::Coordinate| match &c.drive {
            Drive::Coupled(leader, function) => Some((leader.index(), function.clone())),
            _ => None,
        };
        let mut counts = plan::Counts::default();
        let plans: Vec<PathPlan> =
            set.muscles.iter().map(|m| PathPlan::new(model, set, &m.path, rule, &mut counts)).collect();
        let surface = |wrap: &crate::set::WrapObject| PathSurface {
            body: wrap.body,
            pose: wrap.pose,
            shape: wrap.shape,
            quadrant: wrap.quadrant,
            active: wrap.active,
            first: 0,
            last: 0,
        };
        PathWorkspace {
            rule,
            sweep: PostureSweep::new(model),
            couplers: model.coordinates().iter().map(coupler).collect(),
            slopes: vec![1.0; model.coordinates().len()],
            surfaces: set.wraps.iter().map(surface).collect(),
            routes: vec![PathRoute::default(); plans.len()],
            lengths: vec![0.0; plans.len()],
            speeds: vec![0.0; plans.len()],
            arms: vec![0.0; counts.arms],
            wrenches: vec![Wrench::ZERO; counts.slots],
            gears: vec![0.0; counts.gears],
            about: Vec3::zeros(),
            plans,
            scratch: Scratch::default(),
        }
    }

    /// Computes all paths in another posture.
    ///
    /// # Panics
    /// If the length of a slice of `posture` differs from the number of coordinates.
    pub fn update(&mut self, posture: Posture<'_>) {
        self.sweep.update(posture);
        self.about = self.sweep.bodies().first().map_or(Vec3::zeros(), |body| body.center);
        for (slope, coupler) in self.slopes.iter_mut().zip(&self.couplers) {
            *slope = coupler.as_ref().map_or(1.0, |(leader, function)| function.at(posture.q[*leader])[1]);
        }
        for muscle in 0..self.plans.len() {
            self.find(muscle, posture);
            self.pull(muscle, posture);
            self.project(muscle);
        }
    }

    /// Number of muscles.
    #[inline]
    #[must_use]
    pub fn muscles(&self) -> usize {
        self.plans.len()
    }

    /// Length of the path of each muscle [m].
    #[inline]
    #[must_use]
    pub fn lengths(&self) -> &[f64] {
        &self.lengths
    }

    /// Lengthening speed of each muscle [m/s].
    #[inline]
    #[must_use]
    pub fn speeds(&self) -> &[f64] {
        &self.speeds
    }

    /// The coordinates that may change the length of a muscle, in the order of the model; the same in every posture.
    #[inline]
    #[must_use]
    pub fn coordinates(&self, muscle: usize) -> &[CoordinateId] {
        &self.plans[muscle].coordinates
    }

    /// Moment arms of a muscle about [`PathWorkspace::coordinates`] [m, or 1 for a coordinate that is a length]: the
    /// generalised force per newton of tension.
    #[inline]
    #[must_use]
    pub fn arms(&self, muscle: usize) -> &[f64] {
        let plan = &self.plans[muscle];
        &self.arms[plan.first_arm..plan.first_arm + plan.coordinates.len()]
    }

    /// Moment arm of a muscle about a coordinate; zero about those that do not change its length or follow others.
    #[must_use]
    pub fn arm(&self, muscle: usize, coordinate: CoordinateId) -> f64 {
        self.coordinates(muscle).binary_search(&coordinate).map_or(0.0, |i| self.arms(muscle)[i])
    }

    /// The points of a path in the world, with the ends of its arcs.
    #[inline]
    #[must_use]
    pub fn nodes(&self, muscle: usize) -> &[PathNode] {
        self.routes[muscle].nodes()
    }

    /// What a path has to do with each of its surfaces, in the order of [`crate::set::MusclePath::wraps`].
    #[inline]
    #[must_use]
    pub fn contacts(&self, muscle: usize) -> &[Contact] {
        self.routes[muscle].contacts()
    }

    /// The bodies and joints in the posture.
    #[inline]
    #[must_use]
    pub fn sweep(&self) -> &PostureSweep {
        &self.sweep
    }

    /// The loads of muscles with these tensions [N] on the bodies: one entry per body, in the order of the model.
    ///
    /// Moving points also have [`PathWorkspace::add_gear_forces`], which act on coordinates and not on bodies.
    ///
    /// # Panics
    /// If there are fewer tensions than muscles.
    pub fn loads(&self, tensions: &[f64], loads: &mut Vec<BodyLoad>) {
        let none = |i| BodyLoad { body: BodyId(i), point: self.about, wrench: Wrench::ZERO };
        loads.clear();
        loads.extend((0..self.sweep.bodies().len()).map(none));
        for (plan, tension) in self.plans.iter().zip(tensions) {
            for (slot, wrench) in plan.slots.iter().zip(&self.wrenches[plan.first_slot..]) {
                if let Some(body) = slot.body {
                    let total = &mut loads[body].wrench;
                    total.force += wrench.force * *tension;
                    total.moment += wrench.moment * *tension;
                }
            }
        }
    }

    /// Adds the generalised forces of moving points of muscles with these tensions [N]: the mechanism that moves such a
    /// point on its body takes up the work of the pull. One entry per coordinate of the model; a coordinate that
    /// follows others has its own.
    pub fn add_gear_forces(&self, tensions: &[f64], forces: &mut [f64]) {
        for (plan, tension) in self.plans.iter().zip(tensions) {
            for (coordinate, force) in plan.gears.iter().zip(&self.gears[plan.first_gear..]) {
                forces[*coordinate] += force * tension;
            }
        }
    }

    fn pose(&self, body: Option<usize>) -> Pose {
        body.map_or(Pose::IDENTITY, |body| self.sweep.bodies()[body].pose)
    }

    /// The active points in the world, and the shortest path through them.
    fn find(&mut self, muscle: usize, posture: Posture<'_>) {
        let plan = &self.plans[muscle];
        let mut scratch = std::mem::take(&mut self.scratch);
        scratch.anchors.clear();
        scratch.points.clear();
        for (i, point) in plan.points.iter().enumerate() {
            if let Some(place) = point.place.at(posture.q) {
                let place = self.pose(point.body).place(place);
                scratch.anchors.push(PathAnchor { body: point.body.map(BodyId), place });
                scratch.points.push(i);
            }
        }
        scratch.surfaces.clear();
        for wrap in &plan.wraps {
            let surface = self.surfaces[wrap.object];
            let first = scratch.points.iter().take_while(|&&i| i < wrap.first).count();
            let after = scratch.points.iter().take_while(|&&i| i <= wrap.last).count();
            let pose = self.pose(surface.body.map(BodyId::index)) * surface.pose;
            scratch.surfaces.push(PathSurface { pose, first, last: after.saturating_sub(1), ..surface });
        }
        self.routes[muscle].find(self.rule, &scratch.anchors, &scratch.surfaces);
        self.scratch = scratch;
        self.lengths[muscle] = self.routes[muscle].length();
    }

    /// The pulls of unit tension on the bodies and on moving points, and the lengthening speed.
    fn pull(&mut self, muscle: usize, posture: Posture<'_>) {
        let plan = &self.plans[muscle];
        let wrenches = &mut self.wrenches[plan.first_slot..plan.first_slot + plan.slots.len()];
        wrenches.fill(Wrench::ZERO);
        let Scratch { pulls, points, .. } = &mut self.scratch;
        pulls.clear();
        pulls.resize(plan.points.len(), Vec3::zeros());
        let nodes = self.routes[muscle].nodes();
        let mut anchors = points.iter();
        let mut before = Vec3::zeros();
        let mut speed = 0.0;
        let mut last: Option<(&PathNode, Vec3)> = None;
        for (i, node) in nodes.iter().enumerate() {
            let after = nodes.get(i + 1).map_or(Vec3::zeros(), |next| pull_towards(node, next, self.rule));
            let pull = after - before;
            before = after;
            let slot = match node.surface {
                Some(surface) => plan.wraps[surface].slot,
                None => {
                    let Some(&point) = anchors.next() else { continue };
                    pulls[point] = pull;
                    plan.points[point].slot
                }
            };
            wrenches[slot].force += pull;
            wrenches[slot].moment += (node.acts_at - self.about).cross(&pull);
            let velocity = plan.slots[slot].body.map_or(Vec3::zeros(), |body| {
                let motion = &self.sweep.bodies()[body];
                motion.twist.velocity_at(node.acts_at - motion.center)
            });
            if let Some((from, slower)) = last {
                // The ends of an arc are on one body: its chord changes only where OpenSim takes other places for it.
                speed += direction(from, node).dot(&(velocity - slower));
            }
            last = Some((node, velocity));
        }
        let gears = &mut self.gears[plan.first_gear..plan.first_gear + plan.gears.len()];
        for point in &plan.moving {
            let PathPlanPoint { body, place, .. } = &plan.points[point.index];
            let Place::Moving { frame, axes } = place else { continue };
            let turn = body.map_or(frame.rotation, |body| self.sweep.bodies()[body].pose.rotation * frame.rotation);
            let pull = turn.tr_mul(&pulls[point.index]);
            for (axis, gear) in point.gears.iter().enumerate() {
                let Some(gear) = *gear else { continue };
                gears[gear] = pull[axis] * axes[axis].at(posture.q)[1];
                speed -= gears[gear] * posture.qd[plan.gears[gear]];
            }
        }
        self.speeds[muscle] = speed;
    }

    /// Moment arms, from the leaves to the root.
    fn project(&mut self, muscle: usize) {
        let plan = &self.plans[muscle];
        let arms = &mut self.arms[plan.first_arm..plan.first_arm + plan.coordinates.len()];
        arms.fill(0.0);
        for (gear, (coordinate, arm)) in plan.gear_arms.iter().enumerate() {
            arms[*arm] += self.gears[plan.first_gear + gear] * self.slopes[*coordinate];
        }
        let swept = &mut self.scratch.swept;
        swept.clear();
        swept.extend_from_slice(&self.wrenches[plan.first_slot..plan.first_slot + plan.slots.len()]);
        for i in (0..plan.slots.len()).rev() {
            let (slot, wrench) = (&plan.slots[i], swept[i]);
            let (Some(body), Some(parent)) = (slot.body, slot.parent) else { continue };
            let at_joint = wrench.about(self.about - self.sweep.joint_centers()[body]);
            for (motion, arm) in self.sweep.joint_motions(BodyId(body)).iter().zip(&slot.arms) {
                arms[*arm] += at_joint.power(&motion.twist) * self.slopes[motion.coordinate.index()];
            }
            swept[parent].force += wrench.force;
            swept[parent].moment += wrench.moment;
        }
    }
}

/// Pull of unit tension on a node towards the next: along a straight part, zero along an arc.
fn pull_towards(node: &PathNode, next: &PathNode, rule: WrapRule) -> Vec3 {
    // Such a part has no effect unless its pulls are not in balance, as in OpenSim, which leaves it out.
    let is_idle = rule == WrapRule::OpenSim && node.body == next.body && node.surface.or(next.surface).is_some();
    if node.arc.is_some() || is_idle { Vec3::zeros() } else { direction(node, next) }
}

/// Unit vector from a node to the next; zero between nodes in one place.
fn direction(node: &PathNode, next: &PathNode) -> Vec3 {
    (next.place - node.place).try_normalize(f64::MIN_POSITIVE).unwrap_or_default()
}
