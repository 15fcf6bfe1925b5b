//! Where the frames of a joint lie at the start: from a point and directions of the world to frames on parent and child.
//!
//! | kind      | axes of P at the start                                                       |
//! | revolute, prismatic | z along `axis`                                                     |
//! | universal | x along `axis` when the first angle is zero; y of C along `second_axis`      |
//! | planar    | z along the normal, x along `along`                                          |
//! | others    | the world's                                                                  |

use super::joint::JointAxes as Asked;
use crate::simulation::joint::{Coordinates, JointKind, MOST, orthonormal, rotation};
use crate::spatial::{Mat3, Pose, Vec3};

/// A joint whose frames are known in the world.
pub(super) struct Placement {
    pub(super) kind: JointKind,
    /// `world_from_P` and `world_from_C`.
    pub(super) world_from_parent_side: Pose,
    pub(super) world_from_child_side: Pose,
    /// What the coordinates are called now, in the simulator's order.
    pub(super) values: Vec<f64>,
}

/// The simulator's coordinate k of a joint is the file's coordinate `order(kind)[k]`.
pub(super) fn order(kind: JointKind) -> [usize; MOST] {
    match kind {
        // The file turns first and then slides.
        JointKind::Planar => [1, 2, 0, 3, 4, 5],
        _ => [0, 1, 2, 3, 4, 5],
    }
}

/// Frames of a joint with its centre `at` in the world, while its coordinates are called `values`, in the file's order.
pub(super) fn place(asked: &Asked, at: Vec3, values: &[f64]) -> Placement {
    let kind = kind(asked);
    let mut q: Coordinates = [0.0; MOST];
    for (q, of_file) in q.iter_mut().zip(order(kind)).take(kind.freedom()) {
        *q = values.get(of_file).copied().unwrap_or(0.0);
    }
    let mut axes = axes(asked);
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
pub(super) fn kind(asked: &Asked) -> JointKind {
    match asked {
        Asked::Weld => JointKind::Weld,
        Asked::Revolute { .. } => JointKind::Revolute,
        Asked::Universal { .. } => JointKind::Universal,
        Asked::Ball => JointKind::Ball,
        Asked::Prismatic { .. } => JointKind::Prismatic,
        Asked::Planar { .. } => JointKind::Planar,
        Asked::Free => JointKind::Free,
    }
}

/// Right-handed axes in the world, with all coordinates zero.
pub(super) fn axes(asked: &Asked) -> Mat3 {
    match asked {
        Asked::Weld | Asked::Ball | Asked::Free => Mat3::identity(),
        Asked::Revolute { axis } | Asked::Prismatic { axis } => with_z(axis),
        Asked::Universal { axis, second_axis } => Mat3::from_columns(&[*axis, *second_axis, axis.cross(second_axis)]),
        Asked::Planar { normal, along } => Mat3::from_columns(&[*along, normal.cross(along), *normal]),
    }
}

/// Right-handed axes with this z; x is the world's x laid across it, or the world's y where x is nearly along z.
fn with_z(z: &Vec3) -> Mat3 {
    const NEARLY: f64 = 0.9;
    let first = if z.x.abs() < NEARLY { Vec3::x() } else { Vec3::y() };
    let x = (first - z * first.dot(z)).normalize();
    Mat3::from_columns(&[x, z.cross(&x), *z])
}
