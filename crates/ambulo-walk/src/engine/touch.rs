//! Contact points of a step, and their rows in the constraint graph.
//!
//! A rigid contact requires at velocity level that its gap g stays open until the end of the step,
//!
//!   u_n ≥ -max(g, 0)/h          or, where surfaces meet faster than in resting contact, u_n ≥ -e u_n⁻
//!
//! Position projection removes overlap. A regularised contact is the same row with the compliance of a spring k and a
//! damper d, taken implicitly, F = -k (g + h u) - d u:
//!
//!   R = 1 / (h (h k + d))          target = -h k g R
//!
//! A Hunt-Crossley contact is the same with k and d the slopes of its law at the start of the step, and F its force
//! there. Its friction is a damper whose constant is the secant |F_t|/|v| of the law.
//!
//! Source: Faure, Debunne, Cani, Multon 1997, section 3.3 (contact as a joint that is destroyed when it would pull;
//! restitution zero by default).

use super::assemble::{Span, presses};
use super::state::{RowKey, WorldState};
use super::world::{ContactLaw, ImpactLaw, Material, Obstacle, Owner, Surface, World};
use crate::contact::{ContactPoint, HuntCrossley, candidate_pairs, contacts};
use crate::dynamics::{ActsOn, Constraint, ConstraintGraph, ConstraintGroup, Law, Six};
use crate::spatial::{Pose, Twist, Vec3, rotation_vector};

/// Surfaces nearer than this are examined even if nothing moves [m].
const MARGIN_M: f64 = 1e-4;
/// Slip below which the secant of smooth friction is taken at its start [m/s].
const STILL_M_S: f64 = 1e-6;

/// An approach is an impact if it is faster than the speed that gravity gives within this number of steps.
const RESTING_STEPS: f64 = 4.0;

/// Gaps below this count as closed [m]: the solver's tolerance divided by the step would otherwise set the points of
/// one body against each other. Position projection removes such gaps.
const CLOSED_M: f64 = 1e-10;
/// Surfaces this near touch at an instant of contact [m].
const MEETING_M: f64 = 1e-7;
/// Touching surfaces that separate faster than this are not in contact [m/s].
const PARTING_M_S: f64 = 1e-6;

/// One contact point in a step.
#[derive(Debug, Clone)]
pub(crate) struct Touch {
    /// Indices of the two surfaces.
    pub(crate) surfaces: (usize, usize),
    /// Geometry. The normal points from the second surface to the first.
    pub(crate) at: ContactPoint,
    /// Tangents; (normal, first, second) is a right-handed frame.
    pub(crate) tangents: [Vec3; 2],
    /// Rows of the point in the graph, once [`TouchWorkspace::add_rows`] has added them.
    pub(crate) rows: ContactRows,
    /// Normal velocity of the second surface itself, if it is an obstacle [m/s].
    pub(crate) surface_speed: f64,
    /// Whether position projection removes overlap.
    pub(crate) rigid: bool,
    /// For [`ImpactLaw::Sticking`]: whether the point was in contact before, or is compliant.
    pub(crate) known: bool,
    /// For [`ImpactLaw::Sticking`]: whether this is the point that loses all its velocity.
    pub(crate) sticks: bool,
}

impl Touch {
    /// Speed of approach of surfaces that are apart, will rebound, and would overlap after `h` by more than half of
    /// both [m/s]: they would then be taken for surfaces that leave on the other side.
    pub(super) fn passing_speed(
        &self,
        world: &World,
        state: &WorldState,
        obstacles: &ObstaclePoses,
        h: f64,
    ) -> Option<f64> {
        let [a, b] = [self.surfaces.0, self.surfaces.1].map(|surface| &world.surfaces[surface]);
        let material = combined(&world.materials[a.material], &world.materials[b.material]);
        let speed = -parting_speed(self, world, state, obstacles);
        let bounces = material.law == ContactLaw::Rigid
            && material.restitution > 0.0
            && speed > RESTING_STEPS * h * world.gravity.norm();
        let passes = speed * h - self.at.gap > a.shape.half_size() + b.shape.half_size();
        (bounces && passes && self.at.gap > 0.0).then_some(speed)
    }
}

/// Rows of a contact point in the graph.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct ContactRows {
    /// Group of the normal row.
    pub(crate) group: usize,
    /// Row of the normal force.
    pub(crate) normal: usize,
    /// Rows of friction along the two tangents; none without friction.
    pub(crate) tangents: Option<[usize; 2]>,
}

/// Scratch memory of contact detection.
#[derive(Debug, Clone, Default)]
pub(crate) struct TouchWorkspace {
    pub(crate) touches: Vec<Touch>,
    boxes: Vec<Option<(Vec3, Vec3)>>,
    poses: Vec<Pose>,
    /// Upper bounds on the speed of each surface's points [m/s].
    speeds: Vec<f64>,
    /// Parent of each body.
    parents: Vec<Option<usize>>,
    pairs: Vec<(usize, usize)>,
    points: Vec<ContactPoint>,
}

/// Poses and twists of obstacles at an instant.
pub(crate) type ObstaclePoses = Vec<(Pose, Twist)>;

/// Computes the poses of obstacles at the start of a step, with their mean twists over it.
pub(super) fn obstacle_motion(world: &World, time_s: f64, h: f64, motion: &mut ObstaclePoses) {
    let over_step = |obstacle: &Obstacle| {
        let (now, _) = obstacle.at(time_s);
        if obstacle.path.is_none() {
            return (now, Twist::ZERO);
        }
        let (then, _) = obstacle.at(time_s + h);
        let turn = rotation_vector(&(then.rotation * now.rotation.transpose()));
        (now, Twist { angular: turn / h, linear: (then.translation - now.translation) / h })
    };
    motion.clear();
    motion.extend(world.obstacles.iter().map(over_step));
}

impl TouchWorkspace {
    /// Finds all points where surfaces touch, or could touch within the step.
    pub(crate) fn detect(&mut self, world: &World, state: &WorldState, obstacles: &ObstaclePoses, step_s: f64) {
        self.touches.clear();
        if world.surfaces.is_empty() {
            return;
        }
        self.poses.clear();
        self.boxes.clear();
        self.speeds.clear();
        for surface in &world.surfaces {
            let (owner, speed) = owner_motion(state, obstacles, surface);
            let pose = placed(&owner, surface);
            let reach = Vec3::repeat(MARGIN_M + step_s * speed);
            self.boxes.push(surface.shape.bounding(&pose).map(|(low, high)| (low - reach, high + reach)));
            self.poses.push(pose);
            self.speeds.push(speed);
        }
        self.parents.clear();
        self.parents.resize(world.bodies.len(), None);
        world.joints.iter().for_each(|joint| self.parents[joint.child] = joint.parent);
        let apart = |a: usize, b: usize| may_touch(world, &self.parents, a, b);
        candidate_pairs(&self.boxes, apart, &mut self.pairs);
        for &(a, b) in &self.pairs {
            let (first, second) = (&world.surfaces[a], &world.surfaces[b]);
            self.points.clear();
            let reach = MARGIN_M + step_s * (self.speeds[a] + self.speeds[b]);
            contacts(&first.shape, &self.poses[a], &second.shape, &self.poses[b], reach, &mut self.points);
            self.touches.extend(self.points.iter().map(|point| Touch {
                surfaces: (a, b),
                at: *point,
                tangents: tangents(&point.normal),
                rows: ContactRows::default(),
                surface_speed: 0.0,
                rigid: true,
                known: false,
                sticks: false,
            }));
        }
    }

    /// Gap of a contact point at the present poses of the bodies [m], `h` after detection. To first order in the turn
    /// of a surface; exact for the centres of spheres.
    pub(crate) fn gap_now(&self, world: &World, state: &WorldState, touch: &Touch, h: f64) -> f64 {
        let moved = |surface: usize| {
            let about = &world.surfaces[surface];
            let Owner::Body(body) = about.owner else { return Vec3::zeros() };
            let before = &self.poses[surface];
            if about.shape.is_sphere() {
                return state.poses[body].place(about.owner_from_shape.translation) - before.translation;
            }
            let now = state.poses[body] * about.owner_from_shape;
            let turn = rotation_vector(&(now.rotation * before.rotation.transpose()));
            now.translation - before.translation + turn.cross(&(touch.at.point - before.translation))
        };
        let (first, second) = touch.surfaces;
        touch.at.gap + touch.at.normal.dot(&(moved(first) - moved(second))) - h * touch.surface_speed
    }

    /// Removes all contact points.
    pub(crate) fn clear(&mut self) {
        self.touches.clear();
    }

    /// At an instant of contact: closes the gaps of surfaces that nearly touch, and drops all other points.
    pub(crate) fn close_gaps(&mut self) {
        self.touches.retain(|touch| touch.at.gap < MEETING_M);
        self.touches.iter_mut().for_each(|touch| touch.at.gap = 0.0);
    }

    /// Whether any surfaces nearer than `touching` [m] do not separate.
    pub(crate) fn approaches(
        &self,
        world: &World,
        state: &WorldState,
        obstacles: &ObstaclePoses,
        touching: f64,
    ) -> bool {
        self.touches
            .iter()
            .filter(|touch| touch.at.gap <= touching)
            .any(|touch| parting_speed(touch, world, state, obstacles) <= PARTING_M_S)
    }

    /// For sticking impacts: drops points that do not touch yet, and marks those that were in contact before.
    pub(crate) fn keep_touching(&mut self, world: &World, state: &WorldState) {
        self.touches.retain_mut(|touch| {
            let (a, b) = touch.surfaces;
            let law = |surface: usize| world.materials[world.surfaces[surface].material].law;
            let gives = law(a) != ContactLaw::Rigid || law(b) != ContactLaw::Rigid;
            let past = state.guess.get(&RowKey::Contact(a, b, touch.at.feature));
            touch.known = gives || past.is_some();
            // A point that carried load may have been lifted a little by the second-order error of the step.
            let pressed = past.is_some_and(|impulses| impulses[0] > 0.0);
            gives || touch.at.gap < if pressed { MARGIN_M } else { MEETING_M }
        });
    }

    /// The point that struck first, judged by its overlap and speed.
    pub(crate) fn next_striker(&self, world: &World, state: &WorldState, obstacles: &ObstaclePoses) -> Option<usize> {
        let mut first: Option<(usize, f64)> = None;
        for (number, touch) in self.touches.iter().enumerate().filter(|(_, touch)| !touch.known) {
            let speed = -parting_speed(touch, world, state, obstacles);
            if speed > 0.0 {
                let since = -touch.at.gap / speed;
                if first.is_none_or(|(_, longest)| since > longest) {
                    first = Some((number, since));
                }
            }
        }
        first.map(|(number, _)| number)
    }

    /// Adds the rows of all contact points to the graph; drops points without effect in this step.
    pub(crate) fn add_rows(
        &mut self,
        world: &World,
        state: &WorldState,
        obstacles: &ObstaclePoses,
        span: Span,
        graph: &mut ConstraintGraph,
        keys: &mut Vec<RowKey>,
    ) {
        self.touches.retain_mut(|touch| {
            let mut rows = RowWriter { world, state, obstacles, span, graph, keys };
            rows.add(touch)
        });
    }
}

/// Adds the rows of contact points to a graph.
struct RowWriter<'a> {
    world: &'a World,
    state: &'a WorldState,
    obstacles: &'a ObstaclePoses,
    span: Span,
    graph: &'a mut ConstraintGraph,
    keys: &'a mut Vec<RowKey>,
}

impl RowWriter<'_> {
    /// Adds the rows of one point; returns whether it has any.
    fn add(&mut self, touch: &mut Touch) -> bool {
        let (a, b) = touch.surfaces;
        let (first, second) = (&self.world.surfaces[a], &self.world.surfaces[b]);
        let material = combined(&self.world.materials[first.material], &self.world.materials[second.material]);
        // A body comes first.
        let flipped = matches!(first.owner, Owner::Obstacle(_));
        let sign = if flipped { -1.0 } else { 1.0 };
        let (one, other) = if flipped { (second, first) } else { (first, second) };
        let Owner::Body(body) = one.owner else { return false };
        let on = match other.owner {
            Owner::Body(second) => ActsOn::Bodies { first: body, second: Some(second) },
            Owner::Obstacle(_) => ActsOn::Bodies { first: body, second: None },
        };
        let directions = [touch.at.normal, touch.tangents[0], touch.tangents[1]];
        let mut rows = directions.map(|d| self.row(touch.at.point, d * sign, body, other));
        let u = rows.map(|row| self.velocity(&row, on) - row.target);
        touch.surface_speed = rows[0].target;
        let h = self.span.h;
        // Springs yield from the gap at the start of the step.
        let gap = touch.at.gap - if self.span.halfway { h * u[0] } else { 0.0 };
        let feature = touch.at.feature;
        match material.law {
            ContactLaw::Rigid => {
                if !self.aim(touch, &mut rows[0], u[0], material.restitution) {
                    return false;
                }
            }
            ContactLaw::Regularised { stiffness, damping } => {
                touch.rigid = false;
                rows[0].compliance = 1.0 / (h * (h * stiffness + damping));
                rows[0].target -= h * stiffness * gap * rows[0].compliance;
            }
            ContactLaw::HuntCrossley(law) => {
                touch.rigid = false;
                return self.add_soft(touch, &law, rows, (gap, u), on, (a, b));
            }
        }
        if self.span.halfway {
            // Slip at the end of the step is 2 u - u⁻.
            rows[1].target += 0.5 * u[1];
            rows[2].target += 0.5 * u[2];
        }
        if touch.sticks {
            self.add_sticking(touch, &rows, on);
            return true;
        }
        let (group, normal) = self.push(&rows, on, Law::Contact { friction: material.friction, bound: f64::INFINITY });
        touch.rows = ContactRows { group, normal, tangents: Some([normal + 1, normal + 2]) };
        self.keys.push(RowKey::Contact(a, b, feature));
        true
    }

    /// Sets the target of the normal row of a rigid point to the velocity that its law requires; returns whether the
    /// point acts in this step. `u` is the normal velocity at the start of the step.
    fn aim(&self, touch: &mut Touch, row: &mut Constraint, u: f64, restitution: f64) -> bool {
        let (gap, h) = (touch.at.gap, self.span.h);
        let resting = RESTING_STEPS * h * self.world.gravity.norm();
        let rebounds = restitution > 0.0 && self.world.impact == ImpactLaw::Coulomb;
        let bounces = rebounds && u < -resting;
        if !self.span.halfway {
            touch.rigid = !bounces;
            row.target += if bounces { -restitution * u } else { -open(gap) / h };
            return !bounces || gap <= 0.0;
        }
        let (a, b) = touch.surfaces;
        let pressed = presses(self.state, &RowKey::Contact(a, b, touch.at.feature)) && gap < MARGIN_M;
        let meets = gap + h * u <= CLOSED_M;
        touch.rigid = !(bounces && meets);
        row.target += match (meets, pressed) {
            // The velocity at the end of the step, 2 u - u⁻, is -e u⁻, and without a rebound zero.
            (true, _) if bounces => 0.5 * (1.0 - restitution) * u,
            (true, _) | (false, true) => 0.5 * u,
            (false, false) => -open(gap) / h,
        };
        true
    }

    /// A point that loses all its velocity in an impact: one unilateral row along the normal, two bilateral rows along
    /// the tangents.
    fn add_sticking(&mut self, touch: &mut Touch, rows: &[Constraint; 3], on: ActsOn) {
        let ((a, b), feature) = (touch.surfaces, touch.at.feature);
        let (group, normal) = self.push(&rows[..1], on, Law::Bounded { least: 0.0, most: f64::INFINITY });
        self.keys.push(RowKey::Contact(a, b, feature));
        let (_, first) = self.push(&rows[1..], on, Law::EQUALITY);
        self.keys.push(RowKey::SoftFriction(a, b, feature));
        touch.rows = ContactRows { group, normal, tangents: Some([first, first + 1]) };
    }

    /// One row: the velocity of the first body's point relative to the second owner, along a direction.
    fn row(&self, point: Vec3, direction: Vec3, body: usize, other: &Surface) -> Constraint {
        let at = |center: Vec3| {
            let moment = (point - center).cross(&direction);
            Six::new(moment.x, moment.y, moment.z, direction.x, direction.y, direction.z)
        };
        let on_first = at(self.state.poses[body].translation);
        match other.owner {
            Owner::Body(second) => Constraint {
                on_first,
                on_second: -at(self.state.poses[second].translation),
                target: 0.0,
                compliance: 0.0,
            },
            Owner::Obstacle(obstacle) => {
                let (pose, twist) = &self.obstacles[obstacle];
                let target = direction.dot(&twist.velocity_at(point - pose.translation));
                Constraint { on_first, on_second: Six::zeros(), target, compliance: 0.0 }
            }
        }
    }

    /// J v before the step.
    fn velocity(&self, row: &Constraint, on: ActsOn) -> f64 {
        let of = |body: usize, j: &Six| {
            let t = &self.state.twists[body];
            Vec3::new(j[0], j[1], j[2]).dot(&t.angular) + Vec3::new(j[3], j[4], j[5]).dot(&t.linear)
        };
        match on {
            ActsOn::Bodies { first, second } => {
                of(first, &row.on_first) + second.map_or(0.0, |s| of(s, &row.on_second))
            }
            ActsOn::Coordinate { .. } => 0.0,
        }
    }

    /// Adds a group of rows; returns the number of the group and the number of its first row.
    fn push(&mut self, rows: &[Constraint], on: ActsOn, law: Law) -> (usize, usize) {
        let start = self.graph.rows.len();
        self.graph.rows.extend_from_slice(rows);
        self.graph.groups.push(ConstraintGroup { on, rows: start..start + rows.len(), law });
        (self.graph.groups.len() - 1, start)
    }

    /// A Hunt-Crossley contact: one row for the normal force, two for friction.
    fn add_soft(
        &mut self,
        touch: &mut Touch,
        law: &HuntCrossley,
        mut rows: [Constraint; 3],
        (gap, u): (f64, [f64; 3]),
        on: ActsOn,
        (a, b): (usize, usize),
    ) -> bool {
        let h = self.span.h;
        let surfaces = [&self.world.surfaces[a], &self.world.surfaces[b]];
        let radius = surfaces.iter().filter_map(|s| s.shape.radius()).fold(f64::INFINITY, f64::min);
        let (depth, rate) = (-gap, -u[0]);
        if !radius.is_finite() || depth <= 0.0 {
            return false;
        }
        let slip = Vec3::new(u[1], u[2], 0.0);
        let (force, friction) = law.force(radius, depth, rate, slip);
        // Slopes by finite differences, with steps (0.1 um, 10 um/s) far below the scale on which the law bends.
        let stiffness = ((law.force(radius, depth + 1e-7, rate, slip).0 - force) / 1e-7).max(0.0);
        let damping = ((law.force(radius, depth, rate + 1e-5, slip).0 - force) / 1e-5).max(0.0);
        let yields = h * (h * stiffness + damping);
        if force <= 0.0 || yields <= 0.0 {
            return false;
        }
        let compliance = 1.0 / yields;
        rows[0].compliance = compliance;
        rows[0].target += compliance * h * (force + damping * u[0]);
        let (group, normal) = self.push(&rows[..1], on, Law::Bounded { least: 0.0, most: f64::INFINITY });
        touch.rows = ContactRows { group, normal, tangents: None };
        self.keys.push(RowKey::Contact(a, b, touch.at.feature));
        let speed = slip.norm();
        let secant = if speed > STILL_M_S {
            friction.norm() / speed
        } else {
            law.force(radius, depth, rate, Vec3::new(STILL_M_S, 0.0, 0.0)).1.norm() / STILL_M_S
        };
        if secant > 0.0 {
            for row in &mut rows[1..] {
                row.compliance = 1.0 / (h * secant);
            }
            let (_, first) = self.push(&rows[1..], on, Law::EQUALITY);
            touch.rows.tangents = Some([first, first + 1]);
            self.keys.push(RowKey::SoftFriction(a, b, touch.at.feature));
        }
        true
    }
}

/// Speed at which the surfaces of a contact point separate [m/s].
fn parting_speed(touch: &Touch, world: &World, state: &WorldState, obstacles: &ObstaclePoses) -> f64 {
    let velocity = |surface: usize| match world.surfaces[surface].owner {
        Owner::Body(body) => state.twists[body].velocity_at(touch.at.point - state.poses[body].translation),
        Owner::Obstacle(o) => obstacles[o].1.velocity_at(touch.at.point - obstacles[o].0.translation),
    };
    let (a, b) = touch.surfaces;
    touch.at.normal.dot(&(velocity(a) - velocity(b)))
}

/// The part of a gap that may close within the step [m].
fn open(gap: f64) -> f64 {
    if gap > CLOSED_M { gap } else { 0.0 }
}

/// Pose of a surface's owner, and an upper bound on the speed of the surface's points [m/s].
fn owner_motion(state: &WorldState, obstacles: &ObstaclePoses, surface: &Surface) -> (Pose, f64) {
    let (pose, twist) = match surface.owner {
        Owner::Body(body) => (state.poses[body], state.twists[body]),
        Owner::Obstacle(obstacle) => obstacles[obstacle],
    };
    let arm =
        surface.shape.bounding(&surface.owner_from_shape).map_or(0.0, |(low, high)| low.abs().sup(&high.abs()).norm());
    (pose, twist.linear.norm() + arm * twist.angular.norm())
}

/// The pose of a surface's shape. Spheres have no axes, so they keep their owner's axes.
#[inline(always)]
fn placed(owner: &Pose, surface: &Surface) -> Pose {
    match surface.shape.is_sphere() {
        true => Pose { translation: owner.place(surface.owner_from_shape.translation), ..*owner },
        false => *owner * surface.owner_from_shape,
    }
}

/// Whether two surfaces can be in contact: not two obstacles, not connected bodies, not an ignored pair, and limbs with
/// limbs only.
pub(crate) fn may_touch(world: &World, parents: &[Option<usize>], first: usize, second: usize) -> bool {
    let is_limb = |surface: usize| world.limbs.iter().any(|&(a, b)| surface == a || surface == b);
    if is_limb(first) || is_limb(second) {
        return world.limbs.contains(&(first.min(second), first.max(second)));
    }
    let [a, b] = [first, second].map(|surface| &world.surfaces[surface]);
    let closed = |x: usize, y: usize| {
        world
            .closures
            .iter()
            .filter(|c| c.active)
            .any(|c| (c.first == x && c.second == Some(y)) || (c.first == y && c.second == Some(x)))
    };
    let joined = |x: usize, y: usize| parents[x] == Some(y) || parents[y] == Some(x) || closed(x, y);
    let ignored = || world.ignored.iter().any(|p| *p == (a.owner, b.owner) || *p == (b.owner, a.owner));
    match (a.owner, b.owner) {
        (Owner::Obstacle(_), Owner::Obstacle(_)) => false,
        (Owner::Body(x), Owner::Body(y)) => x != y && !joined(x, y) && !ignored(),
        _ => !ignored(),
    }
}

/// Material of a pair of surfaces.
fn combined(a: &Material, b: &Material) -> Material {
    let law = match (a.law, b.law) {
        (ContactLaw::Rigid, other) | (other, ContactLaw::Rigid) => other,
        (ContactLaw::HuntCrossley(law), _) | (_, ContactLaw::HuntCrossley(law)) => ContactLaw::HuntCrossley(law),
        // Springs in series.
        (
            ContactLaw::Regularised { stiffness: k1, damping: d1 },
            ContactLaw::Regularised { stiffness: k2, damping: d2 },
        ) => ContactLaw::Regularised { stiffness: k1 * k2 / (k1 + k2), damping: d1.min(d2) },
    };
    Material { friction: (a.friction * b.friction).sqrt(), restitution: a.restitution.max(b.restitution), law }
}

/// Two unit vectors that form a right-handed frame with a unit normal (Duff et al. 2017, "Building an orthonormal
/// basis, revisited", unverified page).
fn tangents(n: &Vec3) -> [Vec3; 2] {
    let sign = 1.0_f64.copysign(n.z);
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    [Vec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3::new(b, sign + n.y * n.y * a, -n.y)]
}
