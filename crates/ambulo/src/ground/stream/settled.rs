//! Motion of feet and mass centre in the settled frames of a stream, which later frames do not change.

use crate::ground::footfalls::{SignalFrame, Signals};
use crate::ground::predict::{Geometry, GeometryFrame};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use crate::motion::TimeGrid;
use crate::spatial::Wrench;
use std::collections::VecDeque;

/// Quantities of one frame that a prediction uses.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyFrame {
    signals: SignalFrame,
    geometry: GeometryFrame,
}

/// The frames of a trajectory.
pub(super) fn body_frames(model: &Model, soles: &BySide<Sole>, trajectory: &Trajectory) -> Vec<BodyFrame> {
    let mut frames = Vec::with_capacity(trajectory.grid().frames);
    let all_soles = soles.as_ref().map(|sole| Some(*sole));
    each_body_motion(model, trajectory, |_, bodies| {
        frames.push(BodyFrame {
            signals: SignalFrame::of(model, &all_soles, bodies),
            geometry: GeometryFrame::of(model, soles, bodies),
        });
    });
    frames
}

/// The settled frames of the window, the oldest first.
#[derive(Debug, Clone)]
pub(super) struct SettledFrames {
    frames: VecDeque<BodyFrame>,
    /// Number of the next frame that will be settled.
    pub(super) next: usize,
}

impl SettledFrames {
    pub(super) fn with_capacity(frames: usize) -> SettledFrames {
        SettledFrames { frames: VecDeque::with_capacity(frames), next: 0 }
    }

    /// Adds frames, and drops those before the number `oldest`.
    pub(super) fn extend(&mut self, frames: Vec<BodyFrame>, oldest: usize) {
        for frame in frames {
            self.frames.push_back(frame);
            self.next += 1;
            self.forget_before(oldest);
        }
    }

    /// Drops the frames before a number.
    pub(super) fn forget_before(&mut self, oldest: usize) {
        while self.first() < oldest && self.frames.pop_front().is_some() {}
        self.next = self.next.max(oldest);
    }

    /// Number of the oldest frame.
    fn first(&self) -> usize {
        self.next - self.frames.len()
    }

    /// Every `stride`th frame up to the one before the number `end`, a multiple of the stride before it, with the
    /// number of the first.
    pub(super) fn before(&self, end: usize, stride: usize) -> (usize, impl Iterator<Item = &BodyFrame>) {
        let count = (end - self.first()) / stride;
        let first = end - count * stride;
        (first, self.frames.iter().skip(first - self.first()).step_by(stride))
    }

    /// Allocated memory [bytes].
    pub(super) fn bytes(&self) -> usize {
        self.frames.capacity() * size_of::<BodyFrame>()
    }
}

/// Signals, geometry and total wrench of a window.
pub(super) fn window<'f>(
    model: &Model,
    soles: &BySide<Option<Sole>>,
    grid: TimeGrid,
    frames: impl Iterator<Item = &'f BodyFrame>,
) -> (Signals, Geometry, Vec<Wrench>) {
    let mut signals = Signals::empty(model, grid, soles);
    let mut geometry = Geometry::with_capacity(grid.frames);
    let mut total = Vec::with_capacity(grid.frames);
    for frame in frames {
        signals.push(&frame.signals);
        geometry.push(&frame.geometry);
        total.push(frame.signals.total);
    }
    (signals, geometry, total)
}
