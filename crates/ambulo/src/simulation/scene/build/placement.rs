//! Frames of joints and closures: from a point and directions of the world to frames on the two bodies.
//!
//! | kind      | axes of P at the start                                                       |
//! | revolute, prismatic | z along `axis`                                                     |
//! | universal | x along `axis` when the first angle is zero; y of C along `second_axis`      |
//! | planar    | z along the normal, x along `along`                                          |
//! | others    | the world's                                                                  |

use crate::simulation::joint::{Coordinates, JointKind, MOST, orthonormal, rotation};
use crate::simulation::scene::file::{Anchor, ClosureEntry, JointAxes};
use crate::spatial::{Mat3, Pose, Vec3};

/// The frames of a joint in the world.
pub(super) struct Placement {
    pub(super) kind: JointKind,
    /// `world_from_P` and `world_from_C`.
    pub(super) world_from_parent_side: Pose,
    pub(super) world_from_child_side: Pose,
    /// Present values of the coordinates, in the simulator's order.
    pub(super) values: Vec<f64>,
}

/// The simulator's coordinate k of a joint is the file's coordinate `order(kind)[k]`.
pub(super) fn order(kind: JointKind) -> [usize; MOST] {
    match kind {
        // In the file, rotations come first.
        JointKind::Planar => [1, 2, 0, 3, 4, 5],
        _ => [0, 1, 2, 3, 4, 5],
    }
}

/// Frames of a joint with its centre `at` in the world and these values of its coordinates, in the file's order.
pub(super) fn place(axes: &JointAxes, at: Vec3, values: &[f64]) -> Placement {
    let kind = kind(axes);
    let mut q: Coordinates = [0.0; MOST];
    for (q, of_file) in q.iter_mut().zip(order(kind)).take(kind.freedom()) {
        *q = values.get(of_file).copied().unwrap_or(0.0);
    }
    let mut rotated = rotation_of(axes);
    if kind == JointKind::Universal {
        rotated *= rotation(&Vec3::new(-q[0], 0.0, 0.0));
    }
    let moved = kind.parent_from_child(&q);
    let parent_side = Pose { rotation: orthonormal(&rotated), translation: at - rotated * moved.translation };
    Placement {
        kind,
        world_from_parent_side: parent_side,
        world_from_child_side: parent_side * moved,
        values: q[..kind.freedom()].to_vec(),
    }
}

/// The simulator's kind of joint.
pub(super) fn kind(axes: &JointAxes) -> JointKind {
    match axes {
        JointAxes::Weld => JointKind::Weld,
        JointAxes::Revolute { .. } => JointKind::Revolute,
        JointAxes::Universal { .. } => JointKind::Universal,
        JointAxes::Ball => JointKind::Ball,
        JointAxes::Prismatic { .. } => JointKind::Prismatic,
        JointAxes::Planar { .. } => JointKind::Planar,
        JointAxes::Free => JointKind::Free,
    }
}

/// Right-handed axes of P in the world, with all coordinates zero.
fn rotation_of(axes: &JointAxes) -> Mat3 {
    match axes {
        JointAxes::Weld | JointAxes::Ball | JointAxes::Free => Mat3::identity(),
        JointAxes::Revolute { axis } | JointAxes::Prismatic { axis } => with_z(axis),
        JointAxes::Universal { axis, second_axis } => {
            Mat3::from_columns(&[*axis, *second_axis, axis.cross(second_axis)])
        }
        JointAxes::Planar { normal, along } => Mat3::from_columns(&[*along, normal.cross(along), *normal]),
    }
}

/// Right-handed axes with this z; x is the projection of the world's x, or of the world's y if x is nearly along z.
fn with_z(z: &Vec3) -> Mat3 {
    const NEARLY: f64 = 0.9;
    let first = if z.x.abs() < NEARLY { Vec3::x() } else { Vec3::y() };
    let x = (first - z * first.dot(z)).normalize();
    Mat3::from_columns(&[x, z.cross(&x), *z])
}

/// A closure between bodies of the world: gives its frames at the moment it becomes active.
#[derive(Debug, Clone)]
pub(in crate::simulation::scene) struct ClosurePlacement {
    axes: JointAxes,
    /// The two bodies; `None` is the world.
    pub(in crate::simulation::scene) first: usize,
    pub(in crate::simulation::scene) second: Option<usize>,
    /// Points in the frames of the two; `None` is the place of the other point when the closure becomes active.
    on_first: Option<Vec3>,
    on_second: Option<Vec3>,
}

impl ClosurePlacement {
    /// From the bodies at both ends and their poses at the start; `None` if both ends are the world.
    pub(in crate::simulation::scene) fn new(
        closure: &ClosureEntry,
        ends: [Option<usize>; 2],
        poses: [Pose; 2],
    ) -> Option<ClosurePlacement> {
        let points = match closure.anchor {
            Anchor::Start { at } => poses.map(|pose| Some(pose.inverse().place(at))),
            Anchor::Points { on_first, on_second } => [Some(on_first), Some(on_second)],
            Anchor::AsFound { on_first } => [Some(on_first), None],
        };
        match ends {
            [Some(first), second] => {
                Some(ClosurePlacement { axes: closure.kind, first, second, on_first: points[0], on_second: points[1] })
            }
            // The world comes second, as the parent.
            [None, Some(first)] => Some(ClosurePlacement {
                axes: exchanged(closure.kind),
                first,
                second: None,
                on_first: points[1],
                on_second: points[0],
            }),
            [None, None] => None,
        }
    }

    /// `first_from_joint` and `second_from_joint` for poses of the two bodies: the axes are directions of the world now, the
    /// points are fixed in the bodies.
    pub(in crate::simulation::scene) fn frames(&self, first: &Pose, second: &Pose) -> (Pose, Pose) {
        let points = [self.on_first.map(|p| first.place(p)), self.on_second.map(|p| second.place(p))];
        let [a, b] = match points {
            [Some(a), Some(b)] => [a, b],
            [Some(a), None] | [None, Some(a)] => [a, a],
            [None, None] => [first.translation; 2],
        };
        let rotation = rotation_of(&self.axes);
        let at = |translation: Vec3| Pose { rotation, translation };
        (first.inverse() * at(a), second.inverse() * at(b))
    }

    /// Distance of the two points along the constrained directions [m].
    pub(in crate::simulation::scene) fn gap(&self, first: &Pose, second: &Pose) -> f64 {
        let (on_first, on_second) = self.frames(first, second);
        let apart = (*second * on_second).translation - (*first * on_first).translation;
        match self.axes {
            JointAxes::Prismatic { axis } => apart.cross(&axis).norm(),
            JointAxes::Planar { normal, .. } => apart.dot(&normal).abs(),
            _ => apart.norm(),
        }
    }
}

/// The axes with parent and child exchanged.
fn exchanged(axes: JointAxes) -> JointAxes {
    match axes {
        JointAxes::Universal { axis, second_axis } => JointAxes::Universal { axis: second_axis, second_axis: axis },
        other => other,
    }
}
