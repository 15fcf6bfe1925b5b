//! Frames of a closure at the time at which it becomes active.

use super::closure::{Anchor, ClosureEntry};
use super::joint_axes::JointAxes;
use super::placement::axes;
use crate::spatial::{Pose, Vec3};

/// A closure between bodies of the world.
#[derive(Debug, Clone)]
pub(super) struct Closing {
    kind: JointAxes,
    /// The bodies; `None` is the world. The first one is never the world.
    pub(super) first: usize,
    pub(super) second: Option<usize>,
    /// Points in the frames of both; `None`: the present position of the other one's point.
    on_first: Option<Vec3>,
    on_second: Option<Vec3>,
}

impl Closing {
    /// `ends` are the bodies of `first` and `second` in the file, `poses` their initial poses.
    pub(super) fn new(closure: &ClosureEntry, ends: [Option<usize>; 2], poses: [Pose; 2]) -> Option<Closing> {
        let points = match closure.anchor {
            Anchor::Start { at } => poses.map(|pose| Some(pose.inverse().place(at))),
            Anchor::Points { on_first, on_second } => [Some(on_first), Some(on_second)],
            Anchor::AsFound { on_first } => [Some(on_first), None],
        };
        match ends {
            [Some(first), second] => {
                Some(Closing { kind: closure.kind, first, second, on_first: points[0], on_second: points[1] })
            }
            // The world comes second, so that the axis is fixed in the parent.
            [None, Some(first)] => Some(Closing {
                kind: exchanged(closure.kind),
                first,
                second: None,
                on_first: points[1],
                on_second: points[0],
            }),
            [None, None] => None,
        }
    }

    /// `first_from_joint` and `second_from_joint` for these poses of both bodies: the axes keep their present
    /// directions in the world, the points are fixed in the bodies.
    pub(super) fn frames(&self, first: &Pose, second: &Pose) -> (Pose, Pose) {
        let points = [self.on_first.map(|p| first.place(p)), self.on_second.map(|p| second.place(p))];
        let [a, b] = match points {
            [Some(a), Some(b)] => [a, b],
            [Some(a), None] | [None, Some(a)] => [a, a],
            [None, None] => [first.translation; 2],
        };
        let rotation = axes(&self.kind);
        let at = |translation: Vec3| Pose { rotation, translation };
        (first.inverse() * at(a), second.inverse() * at(b))
    }

    /// Distance of the two points along the constrained directions [m].
    pub(super) fn gap(&self, first: &Pose, second: &Pose) -> f64 {
        let (on_first, on_second) = self.frames(first, second);
        let apart = (*second * on_second).translation - (*first * on_first).translation;
        match self.kind {
            JointAxes::Prismatic { axis } => apart.cross(&axis).norm(),
            JointAxes::Planar { normal, .. } => apart.dot(&normal).abs(),
            _ => apart.norm(),
        }
    }
}

/// The same joint with parent and child exchanged.
fn exchanged(kind: JointAxes) -> JointAxes {
    match kind {
        JointAxes::Universal { axis, second_axis } => JointAxes::Universal { axis: second_axis, second_axis: axis },
        other => other,
    }
}
