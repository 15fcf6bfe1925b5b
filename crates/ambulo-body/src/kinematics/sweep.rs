//! Forward kinematics: poses, twists and accelerations of all bodies in one sweep from the root outwards.
//!
//! For a joint between parent p and child c, with r from p's mass centre to the joint centre J and s from J to c's
//! mass centre, all in world axes:
//!
//!   ω_c = ω_p + Σ aₖ θ̇ₖ                     α_c = α_p + Σ (aₖ θ̈ₖ + ω × aₖ θ̇ₖ)      ω before the k-th rotation
//!   v_J = v_p + ω_p × r + Σ eᵢ ḋᵢ            a_J = a_p + α_p × r + ω_p × (ω_p × r) + 2 ω_p × Σ eᵢ ḋᵢ + Σ eᵢ d̈ᵢ
//!   v_c = v_J + ω_c × s                      a_c = a_J + α_c × s + ω_c × (ω_c × s)
//!
//! | code         | symbol     | unit          | meaning                                        |
//! | `axes`       | aₖ, eᵢ     | -             | rotation and translation axes, world           |
//! | `value`      | θ, d       | rad, m        | angle or displacement along an axis            |
//! | `omega`      | ω          | rad/s         | angular velocity                               |
//! | `alpha`      | α          | rad/s²        | angular acceleration                           |
//! | `v`, `a`     | v, a       | m/s, m/s²     | velocity and acceleration of the mass centre   |
//!
//! Source: rigid-body kinematics in absolute coordinates, e.g. Featherstone 2008, "Rigid Body Dynamics Algorithms",
//! ch. 2 (unverified page); axes as OpenSim's `SpatialTransform` (model::joint).
//! Cost: linear in bodies. Pinned by: tests/independent.rs, tests/identities.rs

use super::lanes::{Lanes, M3, V3};
use super::plan::{Axis, Direction, Plan, PlannedEnd, Segment, Source, Spherical};
use crate::model::arc;
use crate::numerics::sin_cos::sin_cos;
use crate::spatial::{Mat3, Pose, Twist, Vec3};

/// Motion of one body in N frames: axes of M and mass centre.
#[derive(Debug, Clone, Copy)]
#[repr(C, align(64))]
pub(crate) struct BodyState<const N: usize> {
    pub(crate) rotation: M3<N>,
    pub(crate) center: V3<N>,
    pub(crate) omega: V3<N>,
    pub(crate) alpha: V3<N>,
    pub(crate) v: V3<N>,
    pub(crate) a: V3<N>,
    /// Vector from the parent's mass centre to the joint centre [m].
    pub(crate) to_joint: V3<N>,
    /// Vector from the joint centre to the mass centre [m].
    pub(crate) to_center: V3<N>,
}

impl<const N: usize> BodyState<N> {
    /// Pose and velocity, in the world, of a frame on the body in one of the N frames of time.
    pub(crate) fn frame(&self, end: &PlannedEnd, lane: usize) -> (Pose, Twist) {
        let body = self.rotation.lane(lane);
        let arm = body * end.from_center;
        let center = Twist { angular: self.omega.lane(lane), linear: self.v.lane(lane) };
        let pose = Pose { rotation: body * end.axes, translation: self.center.lane(lane) + arm };
        (pose, Twist { linear: center.velocity_at(arm), ..center })
    }
}

/// Scratch memory of N frames.
#[derive(Debug, Clone)]
pub struct Scratch<const N: usize> {
    /// Coordinates, rates and accelerations, one entry each.
    pub q: Vec<[f64; N]>,
    pub qd: Vec<[f64; N]>,
    pub qdd: Vec<[f64; N]>,
    pub(crate) axes: AxisStates<N>,
    /// Ground, then one state per body.
    pub(crate) states: Vec<BodyState<N>>,
    /// Axes of F, for ball-like joints and arcs only.
    pub(crate) joint_frames: Vec<M3<N>>,
}

/// Displacement along each axis of the plan, and its direction.
#[derive(Debug, Clone)]
pub(crate) struct AxisStates<const N: usize> {
    value: Vec<[f64; N]>,
    rate: Vec<Lanes<N>>,
    acceleration: Vec<Lanes<N>>,
    /// dθ/dq.
    pub(crate) slope: Vec<Lanes<N>>,
    sin: Vec<[f64; N]>,
    cos: Vec<[f64; N]>,
    /// Directions of the axes in the world.
    pub(crate) direction: Vec<V3<N>>,
}

impl<const N: usize> Scratch<N> {
    pub(crate) fn new(plan: &Plan) -> Scratch<N> {
        let (coordinates, axes) = (plan.coordinates, plan.axes.len());
        let ground = BodyState {
            rotation: M3::splat(&Mat3::identity()),
            center: V3::ZERO,
            omega: V3::ZERO,
            alpha: V3::ZERO,
            v: V3::ZERO,
            a: V3::ZERO,
            to_joint: V3::ZERO,
            to_center: V3::ZERO,
        };
        Scratch {
            q: vec![[0.0; N]; coordinates],
            qd: vec![[0.0; N]; coordinates],
            qdd: vec![[0.0; N]; coordinates],
            axes: AxisStates {
                value: vec![[0.0; N]; axes],
                rate: vec![Lanes::ZERO; axes],
                acceleration: vec![Lanes::ZERO; axes],
                slope: vec![Lanes::ZERO; axes],
                sin: vec![[0.0; N]; axes],
                cos: vec![[0.0; N]; axes],
                direction: vec![V3::ZERO; axes],
            },
            states: vec![ground; plan.segments.len() + 1],
            joint_frames: vec![M3::splat(&Mat3::identity()); plan.segments.len()],
        }
    }
}

/// Computes the state of every body from `q`, `qd`, `qdd`.
#[inline(always)]
pub(crate) fn forward<const N: usize>(plan: &Plan, scratch: &mut Scratch<N>) {
    follow_coordinates(plan, scratch);
    let Scratch { axes, states, joint_frames, .. } = scratch;
    for &i in &plan.outwards {
        let segment = &plan.segments[i];
        let (before, after) = states.split_at_mut(i + 1);
        place(plan, segment, &before[segment.parent], axes, &mut after[0], &mut joint_frames[i]);
    }
}

/// Axis values with two derivatives: θ = f(q), θ̇ = f' q̇, θ̈ = f' q̈ + f'' q̇².
#[inline(always)]
fn follow_coordinates<const N: usize>(plan: &Plan, scratch: &mut Scratch<N>) {
    let Scratch { q, qd, qdd, axes: s, .. } = scratch;
    for (k, axis) in plan.axes.iter().enumerate() {
        match &axis.source {
            Source::Fixed(value) => s.value[k] = [*value; N],
            Source::Line { coordinate: c, slope, intercept } => {
                s.value[k] = (Lanes(q[*c]) * *slope + Lanes::splat(*intercept)).0;
                s.rate[k] = Lanes(qd[*c]) * *slope;
                s.acceleration[k] = Lanes(qdd[*c]) * *slope;
                s.slope[k] = Lanes::splat(*slope);
            }
            Source::Curve { coordinate: c, function } => {
                for l in 0..N {
                    let [f, df, ddf] = function.at(q[*c][l]);
                    let rate = qd[*c][l];
                    s.value[k][l] = f;
                    s.rate[k].0[l] = df * rate;
                    s.acceleration[k].0[l] = df * qdd[*c][l] + ddf * rate * rate;
                    s.slope[k].0[l] = df;
                }
            }
        }
    }
    sin_cos(s.value.as_flattened(), s.sin.as_flattened_mut(), s.cos.as_flattened_mut());
}

/// Computes the state of one body from the state of its parent.
#[inline(always)]
fn place<const N: usize>(
    plan: &Plan,
    segment: &Segment,
    parent: &BodyState<N>,
    s: &mut AxisStates<N>,
    state: &mut BodyState<N>,
    joint_frame: &mut M3<N>,
) {
    let mut rotation = match &segment.offset {
        None => parent.rotation,
        Some(offset) => parent.rotation.times_fixed(offset),
    };
    // Translations, while the axes are still the axes of F.
    let mut to_joint = parent.rotation.turn_fixed(&segment.to_joint);
    let mut slide = [V3::ZERO; 2];
    for k in segment.translations.clone() {
        let axis = along(&rotation, &plan.axes[k]);
        to_joint += axis * Lanes(s.value[k]);
        slide[0] += axis * s.rate[k];
        slide[1] += axis * s.acceleration[k];
        s.direction[k] = axis;
    }
    if segment.spherical.is_some() || segment.arc.is_some() {
        *joint_frame = rotation;
    }

    let (mut omega, mut alpha) = (parent.omega, parent.alpha);
    for k in segment.rotations.clone() {
        let axis = rotate(&mut rotation, &plan.axes[k], Lanes(s.sin[k]), Lanes(s.cos[k]));
        let spin = axis * s.rate[k];
        alpha += axis * s.acceleration[k] + omega.cross(spin);
        omega += spin;
        s.direction[k] = axis;
    }
    let sliding = slide_with_rotation(segment, joint_frame, &rotation, parent, omega, alpha);
    if let Some(sliding) = &sliding {
        to_joint += sliding[0];
        slide[0] += sliding[1];
        slide[1] += sliding[2];
    }

    let carry = parent.omega.cross(to_joint);
    let mut v = parent.v + carry;
    let mut a = parent.a + parent.alpha.cross(to_joint) + parent.omega.cross(carry);
    if !segment.translations.is_empty() || sliding.is_some() {
        v += slide[0];
        a += slide[1] + parent.omega.cross(slide[0]) * Lanes::splat(2.0);
    }
    let to_center = rotation.turn_fixed(&segment.to_center);
    let swing = omega.cross(to_center);
    state.rotation = rotation;
    state.center = parent.center + to_joint + to_center;
    state.omega = omega;
    state.alpha = alpha;
    state.v = v + swing;
    state.a = a + alpha.cross(to_center) + omega.cross(swing);
    state.to_joint = to_joint;
    state.to_center = to_center;
}

/// Rotates the frame about an axis and returns the axis in the world.
#[inline(always)]
fn rotate<const N: usize>(frame: &mut M3<N>, axis: &Axis, sin: Lanes<N>, cos: Lanes<N>) -> V3<N> {
    match &axis.direction {
        Direction::Principal(k) => frame.turn_about(*k, sin, cos),
        Direction::General(d) => {
            let along = frame.turn_fixed(d);
            *frame = turned_about_general(frame, d, sin, cos);
            along
        }
    }
}

/// R (I + sin [d]x + (1 - cos) [d]x²): Rodrigues, with the two constant matrices applied to R's columns.
#[inline(always)]
fn turned_about_general<const N: usize>(r: &M3<N>, d: &Vec3, sin: Lanes<N>, cos: Lanes<N>) -> M3<N> {
    let cross = d.cross_matrix();
    let (once, twice) = (r.times_fixed(&cross), r.times_fixed(&(cross * cross)));
    let versine = Lanes::splat(1.0) - cos;
    M3([0, 1, 2].map(|j| r.col(j) + once.col(j) * sin + twice.col(j) * versine))
}

#[inline(always)]
fn along<const N: usize>(frame: &M3<N>, axis: &Axis) -> V3<N> {
    match &axis.direction {
        Direction::Principal(k) => frame.col(*k),
        Direction::General(d) => frame.turn_fixed(d),
    }
}

/// Position, velocity and acceleration relative to F, in world axes, of an origin of M that slides as M turns; `None`
/// if it does not. On an ellipsoid this is the point p = radii * n, where n is the z axis of M: ṅ = w × n,
/// n̈ = ẇ × n + w × (w × n), with w the angular velocity of M in F.
#[inline(always)]
fn slide_with_rotation<const N: usize>(
    segment: &Segment,
    frame: &M3<N>,
    rotation: &M3<N>,
    parent: &BodyState<N>,
    omega: V3<N>,
    alpha: V3<N>,
) -> Option<[V3<N>; 3]> {
    let radii = segment.spherical.as_ref().and_then(|spherical| spherical.radii);
    match (radii, segment.arc) {
        (Some(radii), _) => Some(axis_in_motion(2, rotation, parent, omega, alpha).map(|n| {
            let V3([x, y, z]) = frame.turn_back(n);
            frame.turn(V3([x * radii[0], y * radii[1], z * radii[2]]))
        })),
        (None, Some(length)) => Some(slide_on_arc(length, frame, rotation, parent, omega, alpha)),
        (None, None) => None,
    }
}

/// An axis of M with its rate and acceleration relative to F, in world axes.
#[inline(always)]
fn axis_in_motion<const N: usize>(
    axis: usize,
    rotation: &M3<N>,
    parent: &BodyState<N>,
    omega: V3<N>,
    alpha: V3<N>,
) -> [V3<N>; 3] {
    let relative = omega - parent.omega;
    // The rate of the relative angular velocity, relative to F.
    let relative_rate = alpha - parent.alpha - parent.omega.cross(relative);
    let n = rotation.col(axis);
    let rate = relative.cross(n);
    [n, rate, relative_rate.cross(n) + relative.cross(rate)]
}

/// Position, velocity and acceleration relative to F, in world axes, of the end of an arc: p = d f (n + y) with f a
/// function of c = n · y, so that ṗ = d (f' ċ (n + y) + f ṅ) and p̈ = d ((f'' ċ² + f' c̈) (n + y) + 2 f' ċ ṅ + f n̈).
#[inline(always)]
fn slide_on_arc<const N: usize>(
    length: f64,
    frame: &M3<N>,
    rotation: &M3<N>,
    parent: &BodyState<N>,
    omega: V3<N>,
    alpha: V3<N>,
) -> [V3<N>; 3] {
    let [n, rate, acceleration] = axis_in_motion(1, rotation, parent, omega, alpha);
    let y = frame.col(1);
    let ([f, df, ddf], sum) = (arc_factor(n.dot(y), length), n + y);
    let (c1, c2) = (rate.dot(y), acceleration.dot(y));
    [
        sum * f,
        sum * (df * c1) + rate * f,
        sum * (ddf * c1 * c1 + df * c2) + rate * (df * c1 * Lanes::splat(2.0)) + acceleration * f,
    ]
}

/// d f and its derivatives by the cosine.
#[inline(always)]
fn arc_factor<const N: usize>(cosine: Lanes<N>, length: f64) -> [Lanes<N>; 3] {
    let found = cosine.0.map(|c| arc::factor(c).map(|f| length * f));
    [0, 1, 2].map(|k| Lanes(found.map(|derivatives| derivatives[k])))
}

/// Velocity of the end of an arc relative to F, in world axes, while M turns with the angular velocity `omega` in F.
pub(crate) fn arc_velocity(length: f64, index: usize, s: &Scratch<1>, omega: Vec3) -> Vec3 {
    let (n, y) = (s.states[index + 1].rotation.col(1), s.joint_frames[index].col(1));
    let [f, df, _] = arc_factor(n.dot(y), length);
    let (rate, n, y) = (omega.cross(&n.lane(0)), n.lane(0), y.lane(0));
    (n + y) * (df.0[0] * rate.dot(&y)) + rate * f.0[0]
}

/// The moment about the origin of M that has the power of a force on the end of an arc: ṗ = d (f' (w × n)·y (n + y) + f
/// w × n) with the angular velocity w, so that the moment is n × d (f F + f' (F·(n + y)) y).
#[inline(always)]
pub(crate) fn arc_moment<const N: usize>(length: f64, index: usize, s: &Scratch<N>, force: V3<N>) -> V3<N> {
    let (n, y) = (s.states[index + 1].rotation.col(1), s.joint_frames[index].col(1));
    let [f, df, _] = arc_factor(n.dot(y), length);
    n.cross(force * f + y * (df * force.dot(n + y)))
}

/// Angular velocity of M in F, in axes of F [rad/s].
#[inline(always)]
pub(crate) fn relative_omega<const N: usize>(segment: &Segment, index: usize, s: &Scratch<N>) -> V3<N> {
    s.joint_frames[index].turn_back(s.states[index + 1].omega - s.states[segment.parent].omega)
}

/// Generalised moments about the axes of F of a force and a moment at the origin of M, for a ball-like joint.
#[inline(always)]
pub(crate) fn spherical_moment<const N: usize>(
    spherical: &Spherical,
    index: usize,
    s: &Scratch<N>,
    force: V3<N>,
    moment: V3<N>,
) -> V3<N> {
    let frame = &s.joint_frames[index];
    let moment = frame.turn_back(moment);
    let Some(radii) = spherical.radii else { return moment };
    // The power of the force is f · ṗ with ṗ = radii * (w × n): its moment is n × (radii * f).
    let V3([x, y, z]) = frame.turn_back(force);
    let normal = frame.turn_back(s.states[index + 1].rotation.col(2));
    moment + normal.cross(V3([x * radii[0], y * radii[1], z * radii[2]]))
}
