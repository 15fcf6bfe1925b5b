//! Initial frames of a joint on parent and child, from a point and directions in the world.
//!
//! | kind      | axes of P at the start                                                       |
//! | revolute, prismatic | z along `axis`                                                     |
//! | universal | x along `axis` when the first angle is zero; y of C along `second_axis`      |
//! | planar    | z along the normal, x along `along`                                          |
//! | others    | the world's axes                                                             |

use super::joint_axes::JointAxes;
use crate::engine::joint::{Coordinates, JointKind, MOST, orthonormal};
use crate::spatial::{Mat3, Pose, Vec3, rotation};

/// A joint with its frames in the world.
pub(super) struct Placement {
    pub(super) kind: JointKind,
    /// `world_from_P` and `world_from_C`.
    pub(super) world_from_parent_side: Pose,
    pub(super) world_from_child_side: Pose,
    /// Initial values of the coordinates, in the simulator's order.
    pub(super) values: Vec<f64>,
}

/// The simulator's coordinate k of a joint is the file's coordinate `order(kind)[k]`.
pub(super) fn order(kind: JointKind) -> [usize; MOST] {
    match kind {
        // In the file, rotations come before translations.
        JointKind::Planar => [1, 2, 0, 3, 4, 5],
        _ => [0, 1, 2, 3, 4, 5],
    }
}

/// Frames of a joint with its centre `at` in the world and coordinates `values`, in the file's order.
pub(super) fn place(joint_axes: &JointAxes, at: Vec3, values: &[f64]) -> Placement {
    let kind = kind(joint_axes);
    let mut q: Coordinates = [0.0; MOST];
    for (q, of_file) in q.iter_mut().zip(order(kind)).take(kind.freedom()) {
        *q = values.get(of_file).copied().unwrap_or(0.0);
    }
    let mut axes = axes(joint_axes);
    if kind == JointKind::Universal {
        axes *= rotation(&Vec3::new(-q[0], 0.0, 0.0));
    }
    let moved = kind.parent_from_child(&q);
    let parent_side = Pose { rotation: orthonormal(&axes), translation: at - axes * moved.translation };
    Placement {
        kind,
        world_from_parent_side: parent_side,
        world_from_child_side: parent_side * moved,
        values: q[..kind.freedom()].to_vec(),
    }
}

/// The simulator's kind.
pub(super) fn kind(joint_axes: &JointAxes) -> JointKind {
    match joint_axes {
        JointAxes::Weld => JointKind::Weld,
        JointAxes::Revolute { .. } => JointKind::Revolute,
        JointAxes::Universal { .. } => JointKind::Universal,
        JointAxes::Ball => JointKind::Ball,
        JointAxes::Prismatic { .. } => JointKind::Prismatic,
        JointAxes::Planar { .. } => JointKind::Planar,
        JointAxes::Free => JointKind::Free,
    }
}

/// Right-handed axes in the world, with all coordinates zero.
pub(super) fn axes(joint_axes: &JointAxes) -> Mat3 {
    match joint_axes {
        JointAxes::Weld | JointAxes::Ball | JointAxes::Free => Mat3::identity(),
        JointAxes::Revolute { axis } | JointAxes::Prismatic { axis } => with_z(axis),
        JointAxes::Universal { axis, second_axis } => {
            Mat3::from_columns(&[*axis, *second_axis, axis.cross(second_axis)])
        }
        JointAxes::Planar { normal, along } => Mat3::from_columns(&[*along, normal.cross(along), *normal]),
    }
}

/// Right-handed axes with this z; x is the world's x made perpendicular to it, or the world's y if x is nearly along z.
fn with_z(z: &Vec3) -> Mat3 {
    const NEARLY: f64 = 0.9;
    let first = if z.x.abs() < NEARLY { Vec3::x() } else { Vec3::y() };
    let x = (first - z * first.dot(z)).normalize();
    Mat3::from_columns(&[x, z.cross(&x), *z])
}
