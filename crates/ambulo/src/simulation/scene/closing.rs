//! Frames of a closure at the moment it becomes active.

use super::closure::{Anchor, ClosureEntry};
use super::joint::JointAxes as Asked;
use super::placement::axes;
use crate::spatial::{Pose, Vec3};

/// A closure with its ends on bodies of the world.
#[derive(Debug, Clone)]
pub(super) struct Closing {
    kind: Asked,
    /// Bodies; `None` is the world. The first is one.
    pub(super) first: usize,
    pub(super) second: Option<usize>,
    /// Points in the frames of the two; `None` is where the other one's point is at the moment.
    on_first: Option<Vec3>,
    on_second: Option<Vec3>,
}

impl Closing {
    /// `ends` are the bodies of the file's first and second; `poses` theirs at the start.
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
            // The world comes second; then its axis is the parent's.
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

    /// `first_from_joint` and `second_from_joint` for these poses of the two: axes as the world has them now, points where
    /// they are fixed.
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

    /// How far the two points are apart, as far as the closure minds [m].
    pub(super) fn gap(&self, first: &Pose, second: &Pose) -> f64 {
        let (on_first, on_second) = self.frames(first, second);
        let apart = (*second * on_second).translation - (*first * on_first).translation;
        match self.kind {
            Asked::Prismatic { axis } => apart.cross(&axis).norm(),
            Asked::Planar { normal, .. } => apart.dot(&normal).abs(),
            _ => apart.norm(),
        }
    }
}

/// The same joint with parent and child exchanged.
fn exchanged(kind: Asked) -> Asked {
    match kind {
        Asked::Universal { axis, second_axis } => Asked::Universal { axis: second_axis, second_axis: axis },
        other => other,
    }
}
