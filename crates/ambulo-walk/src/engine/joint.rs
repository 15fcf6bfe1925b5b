//! Joint kinematics: the free motions of a child relative to its parent, its pose, and its drift.
//!
//! P is a frame fixed to the parent, C one fixed to the child; with all coordinates zero they coincide. S are the free
//! directions, as motions of the child's mass centre: a rotation about e through the origin of C is (e, e × r), a
//! translation along e is (0, e), where r leads from the origin of C to the mass centre.
//!
//! | kind      | T = P from C            | coordinates                                              |
//! | weld      | 1                       | -                                                        |
//! | revolute  | R_z(q)                  | angle about z                                            |
//! | prismatic | t(q z)                  | distance along z                                         |
//! | universal | R_x(q₁) R_y(q₂)         | angle about x of P, angle about y of C                   |
//! | ball      | R                       | rotation vector in P; rates: angular velocity in P       |
//! | planar    | t(q₁ x + q₂ y) R_z(q₃)  | distances along x and y of P, angle about z              |
//! | free      | t R                     | rotation vector and position in P; rates in P            |
//!
//! Functions that run for every joint in every step are inlined, for the same reason as the functions of `Pose`.

use crate::dynamics::Six;
use crate::numerics::elementary::{atan2, sin_cos};
use crate::spatial::{Mat3, Pose, Twist, Vec3, rotation, rotation_vector};
use std::f64::consts::TAU;
use std::ops::Range;

/// The motions that a joint leaves free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// No free motion.
    Weld,
    /// A rotation about z.
    Revolute,
    /// A translation along z.
    Prismatic,
    /// A rotation about x of the parent's frame, then about y of the child's.
    Universal,
    /// All rotations.
    Ball,
    /// Translations along x and y, a rotation about z.
    Planar,
    /// All rotations and translations.
    Free,
}

/// Largest number of coordinates of a joint.
pub const MOST: usize = 6;

/// Coordinates of a joint; only the first [`JointKind::freedom`] are used.
pub(crate) type Coordinates = [f64; MOST];

/// Frames of a joint at one instant, world axes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Frames {
    /// `world_from_P`.
    pub(crate) parent: Pose,
    /// `world_from_C`.
    pub(crate) child: Pose,
}

/// Directions that a joint forbids, world axes.
#[derive(Debug, Clone)]
pub(crate) struct Constrained {
    /// The axes of the parent's frame.
    axes: [Vec3; 3],
    /// For a universal joint: the normal of its two axes, about which it cannot turn.
    normal: Option<Vec3>,
    turns: Range<usize>,
    slides: Range<usize>,
}

impl Constrained {
    /// Axes about which nothing turns.
    pub(crate) fn turns(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.axes[self.turns.clone()].iter().map(|axis| self.normal.unwrap_or(*axis))
    }

    /// Axes along which nothing slides.
    pub(crate) fn slides(&self) -> impl Iterator<Item = Vec3> + '_ {
        self.axes[self.slides.clone()].iter().copied()
    }
}

impl JointKind {
    /// Number of coordinates.
    #[must_use]
    pub fn freedom(self) -> usize {
        match self {
            JointKind::Weld => 0,
            JointKind::Revolute | JointKind::Prismatic => 1,
            JointKind::Universal => 2,
            JointKind::Ball | JointKind::Planar => 3,
            JointKind::Free => 6,
        }
    }

    /// Whether a coordinate is an angle [rad] rather than a distance [m].
    #[must_use]
    pub fn turns(self, coordinate: usize) -> bool {
        match self {
            JointKind::Weld | JointKind::Prismatic => false,
            JointKind::Revolute | JointKind::Universal | JointKind::Ball => true,
            JointKind::Planar => coordinate == 2,
            JointKind::Free => coordinate < 3,
        }
    }

    /// Names of the coordinates, to follow the name of the joint.
    #[must_use]
    pub fn coordinate_names(self) -> &'static [&'static str] {
        match self {
            JointKind::Weld => &[],
            JointKind::Revolute => &["angle"],
            JointKind::Prismatic => &["distance"],
            JointKind::Universal => &["angle_x", "angle_y"],
            JointKind::Ball => &["turn_x", "turn_y", "turn_z"],
            JointKind::Planar => &["distance_x", "distance_y", "angle_z"],
            JointKind::Free => &["turn_x", "turn_y", "turn_z", "place_x", "place_y", "place_z"],
        }
    }

    /// T for these coordinates.
    #[doc(hidden)] // for tests
    pub fn parent_from_child(self, q: &Coordinates) -> Pose {
        let turn = |rotation| Pose { rotation, translation: Vec3::zeros() };
        match self {
            JointKind::Weld => Pose::IDENTITY,
            JointKind::Revolute => turn(about_z(q[0])),
            JointKind::Prismatic => Pose::at(Vec3::new(0.0, 0.0, q[0])),
            JointKind::Universal => {
                let ((sa, ca), (sb, cb)) = (sin_cos(q[0]), sin_cos(q[1]));
                turn(Mat3::new(cb, 0.0, sb, sa * sb, ca, -sa * cb, -ca * sb, sa, ca * cb))
            }
            JointKind::Ball => turn(rotation(&Vec3::new(q[0], q[1], q[2]))),
            JointKind::Planar => Pose { rotation: about_z(q[2]), translation: Vec3::new(q[0], q[1], 0.0) },
            JointKind::Free => {
                Pose { rotation: rotation(&Vec3::new(q[0], q[1], q[2])), translation: Vec3::new(q[3], q[4], q[5]) }
            }
        }
    }

    /// `world_from_C` from `world_from_P`: P T without the products by zero and one of a hinge.
    #[inline(always)]
    #[doc(hidden)] // for tests
    pub fn child_frame(self, parent: &Pose, q: &Coordinates) -> Pose {
        match self {
            JointKind::Revolute => Pose { rotation: turned(&parent.rotation, q[0]), translation: parent.translation },
            JointKind::Planar => {
                Pose { rotation: turned(&parent.rotation, q[2]), translation: parent.place(Vec3::new(q[0], q[1], 0.0)) }
            }
            _ => *parent * self.parent_from_child(q),
        }
    }

    /// Coordinates of a T that may have drifted; angles are the ones nearest to `last`.
    pub(crate) fn coordinates(self, t: &Pose, last: &[f64]) -> Coordinates {
        let (r, p) = (&t.rotation, &t.translation);
        let near = |angle: f64, k: usize| nearest_turn(angle, last.get(k).copied().unwrap_or(0.0));
        let mut q = [0.0; MOST];
        match self {
            JointKind::Weld => {}
            JointKind::Revolute => q[0] = near(atan2(r[(1, 0)] - r[(0, 1)], r[(0, 0)] + r[(1, 1)]), 0),
            JointKind::Prismatic => q[0] = p.z,
            // R_x(a) R_y(b): third column is (sin b, -sin a cos b, cos a cos b), second is (0, cos a, sin a).
            JointKind::Universal => {
                q[0] = near(atan2(r[(2, 1)], r[(1, 1)]), 0);
                q[1] = near(atan2(r[(0, 2)], r[(0, 0)]), 1);
            }
            JointKind::Ball => q[..3].copy_from_slice(near_vector(rotation_vector(r), last).as_slice()),
            JointKind::Planar => {
                (q[0], q[1]) = (p.x, p.y);
                q[2] = near(atan2(r[(1, 0)] - r[(0, 1)], r[(0, 0)] + r[(1, 1)]), 2);
            }
            JointKind::Free => {
                q[..3].copy_from_slice(near_vector(rotation_vector(r), last).as_slice());
                q[3..].copy_from_slice(p.as_slice());
            }
        }
        q
    }

    /// The displacement along the free directions from `q` to `goal`: their difference; for rotation vectors, the
    /// rotation between them.
    pub(crate) fn displacement(self, q: &[f64], goal: &Coordinates) -> Coordinates {
        let mut displacement = [0.0; MOST];
        for (displacement, (goal, q)) in displacement.iter_mut().zip(goal.iter().zip(q)) {
            *displacement = goal - q;
        }
        if matches!(self, JointKind::Ball | JointKind::Free) {
            let [now, then] = [q, goal].map(|q| rotation(&Vec3::new(q[0], q[1], q[2])));
            displacement[..3].copy_from_slice(rotation_vector(&(then * now.transpose())).as_slice());
        }
        displacement
    }

    /// Coordinates after a displacement along the free directions: their sum; for rotation vectors, the rotation vector
    /// of the two rotations in turn.
    #[inline(always)]
    pub(crate) fn moved(self, q: &[f64], along: &Coordinates) -> Coordinates {
        let mut moved = [0.0; MOST];
        for (moved, (q, along)) in moved.iter_mut().zip(q.iter().zip(along)) {
            *moved = q + along;
        }
        if matches!(self, JointKind::Ball | JointKind::Free) {
            let [turn, then] = [along.as_slice(), q].map(|v| rotation(&Vec3::new(v[0], v[1], v[2])));
            moved[..3].copy_from_slice(near_vector(rotation_vector(&(turn * then)), q).as_slice());
        }
        moved
    }

    /// T without its drift: the nearest pose that the joint allows.
    pub(crate) fn without_drift(self, t: &Pose, last: &[f64]) -> Pose {
        match self {
            // The rotation is free: no need to go through angles.
            JointKind::Ball => Pose { rotation: t.rotation, translation: Vec3::zeros() },
            JointKind::Free => *t,
            JointKind::Revolute => Pose { rotation: nearest_about_z(&t.rotation), translation: Vec3::zeros() },
            _ => self.parent_from_child(&self.coordinates(t, last)),
        }
    }

    /// S, world axes, as motions of a mass centre that lies at `to_center` from the origin of C.
    pub(crate) fn directions(self, frames: &Frames, to_center: &Vec3) -> [Six; MOST] {
        let mut s = [Six::zeros(); MOST];
        let of_parent = |k: usize| frames.parent.rotation.column(k).into_owned();
        self.write_directions(of_parent, || frames.child.rotation.column(1).into_owned(), to_center, &mut s);
        s
    }

    /// The same from the axes of P and the second axis of C, of which only those that the joint needs are computed.
    /// Directions beyond [`JointKind::freedom`] stay as they are.
    #[inline(always)]
    pub(crate) fn write_directions(
        self,
        p: impl Fn(usize) -> Vec3,
        second_of_child: impl Fn() -> Vec3,
        to_center: &Vec3,
        s: &mut [Six],
    ) {
        let turn = |e: Vec3| {
            let v = e.cross(to_center);
            Six::new(e.x, e.y, e.z, v.x, v.y, v.z)
        };
        let slide = |e: Vec3| Six::new(0.0, 0.0, 0.0, e.x, e.y, e.z);
        match self {
            JointKind::Weld => {}
            JointKind::Revolute => s[0] = turn(p(2)),
            JointKind::Prismatic => s[0] = slide(p(2)),
            JointKind::Universal => (s[0], s[1]) = (turn(p(0)), turn(second_of_child())),
            JointKind::Ball => (s[0], s[1], s[2]) = (turn(p(0)), turn(p(1)), turn(p(2))),
            JointKind::Planar => (s[0], s[1], s[2]) = (slide(p(0)), slide(p(1)), turn(p(2))),
            JointKind::Free => {
                (s[0], s[1], s[2]) = (turn(p(0)), turn(p(1)), turn(p(2)));
                (s[3], s[4], s[5]) = (slide(p(0)), slide(p(1)), slide(p(2)));
            }
        }
    }

    /// Constrained directions, world axes: rotations that the joint forbids, then translations.
    #[inline(always)]
    pub(crate) fn constrained(self, frames: &Frames) -> Constrained {
        let [x, y, z] = [0, 1, 2].map(|k| frames.parent.rotation.column(k).into_owned());
        let (turns, slides) = match self {
            JointKind::Weld => (0..3, 0..3),
            JointKind::Revolute => (0..2, 0..3),
            JointKind::Prismatic => (0..3, 0..2),
            JointKind::Universal => {
                let normal = x.cross(&frames.child.rotation.column(1)).try_normalize(1e-9);
                let turns = 0..usize::from(normal.is_some());
                return Constrained { axes: [x, y, z], normal, turns, slides: 0..3 };
            }
            JointKind::Ball => (0..0, 0..3),
            JointKind::Planar => (0..2, 2..3),
            JointKind::Free => (0..0, 0..0),
        };
        Constrained { axes: [x, y, z], normal: None, turns, slides }
    }
}

/// Drift of a child: rotation [rad] and translation [m] of C, world axes, from the pose that the joint allows.
#[inline(always)]
pub(crate) fn drift(kind: JointKind, frames: &Frames, last: &[f64]) -> (Vec3, Vec3) {
    if kind == JointKind::Revolute {
        // A rotation is one about z followed by one across z, which takes z of P to z of C.
        let (p, c) = (frames.parent.rotation.column(2), frames.child.rotation.column(2));
        let across = p.cross(&c);
        let (sine, cosine) = (across.norm(), p.dot(&c));
        let stretch = if sine <= 1e-6 { 1.0 } else { atan2(sine, cosine) / sine };
        if cosine > 0.0 {
            return (across * stretch, frames.child.translation - frames.parent.translation);
        }
    }
    if kind == JointKind::Ball {
        return (Vec3::zeros(), frames.child.translation - frames.parent.translation);
    }
    let t = frames.parent.inverse() * frames.child;
    let allowed = kind.without_drift(&t, last);
    let turn = rotation_vector(&(t.rotation * allowed.rotation.transpose()));
    (frames.parent.rotation * turn, frames.parent.rotation * (t.translation - allowed.translation))
}

fn about_z(angle: f64) -> Mat3 {
    let (sin, cos) = sin_cos(angle);
    Mat3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}

/// R R_z(angle).
#[inline(always)]
fn turned(r: &Mat3, angle: f64) -> Mat3 {
    let (sin, cos) = sin_cos(angle);
    let [x, y, z] = [0, 1, 2].map(|k| r.column(k).into_owned());
    Mat3::from_columns(&[x * cos + y * sin, y * cos - x * sin, z])
}

/// The rotation about z that is nearest to a rotation; the identity for half a turn about another axis.
fn nearest_about_z(r: &Mat3) -> Mat3 {
    let (y, x) = (r[(1, 0)] - r[(0, 1)], r[(0, 0)] + r[(1, 1)]);
    let length = (x * x + y * y).sqrt();
    if length <= 0.0 {
        return Mat3::identity();
    }
    let (sin, cos) = (y / length, x / length);
    Mat3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
}

/// Moves a pose with a twist at its origin for a time `h` [s].
#[inline(always)]
pub(super) fn advance(pose: &mut Pose, twist: &Twist, h: f64) {
    pose.translation += twist.linear * h;
    pose.rotation = orthonormal(&(rotation(&(twist.angular * h)) * pose.rotation));
}

/// R (3 - RᵀR)/2: one Newton step towards a rotation matrix, enough to keep rounding from growing.
#[inline(always)]
pub(crate) fn orthonormal(r: &Mat3) -> Mat3 {
    let [x, y, z] = [0, 1, 2].map(|k| r.column(k).into_owned());
    // R (3 - RᵀR)/2 by columns; the second factor is symmetric.
    let (xx, yy, zz) = (1.5 - 0.5 * x.dot(&x), 1.5 - 0.5 * y.dot(&y), 1.5 - 0.5 * z.dot(&z));
    let (xy, xz, yz) = (0.5 * x.dot(&y), 0.5 * x.dot(&z), 0.5 * y.dot(&z));
    Mat3::from_columns(&[x * xx - y * xy - z * xz, y * yy - x * xy - z * yz, z * zz - x * xz - y * yz])
}

/// Of the rotation vectors of one rotation, v + 2π k v/|v|, the one nearest to the first three of `last`.
fn near_vector(v: Vec3, last: &[f64]) -> Vec3 {
    let &[x, y, z, ..] = last else { return v };
    let angle = v.norm();
    // Near the identity the axis is the one of `last`, if that has whole turns.
    let near = Vec3::new(x, y, z);
    let axis = if angle > 1e-9 { Some(v / angle) } else { near.try_normalize(1.0) };
    let Some(axis) = axis else { return v };
    axis * nearest_turn(v.dot(&axis), near.dot(&axis))
}

fn nearest_turn(angle: f64, last: f64) -> f64 {
    let turns = (last - angle) / TAU;
    if turns.abs() < 0.5 { angle } else { angle + TAU * turns.round() }
}
