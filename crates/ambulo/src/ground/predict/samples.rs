//! What is expected of every stance, and how its unknowns act, on the instants that the estimate looks at.

use super::center_path::center_path;
use super::expected::{Component, Expectation};
use super::geometry::Geometry;
use super::known::Known;
use super::stances::{Measure, Stance};
use super::unknowns::{Active, Curve};
use super::weights::Weights;
use crate::model::BySide;
use crate::motion::TimeGrid;
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// What the estimate is made from: the motion of feet and mass centre, the stances and the total wrench.
pub(super) struct Evidence<'a> {
    pub(super) grid: TimeGrid,
    pub(super) geometry: &'a Geometry,
    /// Half the breadth of right and left sole [m].
    pub(super) half_widths: BySide<f64>,
    pub(super) stances: &'a [Stance],
    /// About the world's origin.
    pub(super) total: &'a [Wrench],
    pub(super) measure: &'a Measure,
    pub(super) weights: &'a Weights,
    pub(super) known: &'a Known,
}

impl Evidence<'_> {
    /// The centre of pressure that is expected at a frame [m].
    pub(super) fn expected_center(&self, stance: &Stance, frame: usize) -> Vec3 {
        let place = &self.geometry.feet[stance.side][frame];
        let path = || center_path(place, stance, self.grid.time(frame), self.measure, self.weights);
        self.known.center_at(stance.side, frame).unwrap_or_else(path)
    }

    /// The total wrench about the mass centre.
    pub(super) fn about_mass_center(&self, frame: usize) -> Wrench {
        self.total[frame].about(-self.geometry.center[frame])
    }
}

/// One component at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Part {
    /// What is expected [N or N.m], and its deviation.
    pub(super) mean: f64,
    pub(super) deviation: f64,
    /// The unknowns that act.
    pub(super) active: Active,
    /// The load on the body about its mass centre when the component is one.
    pub(super) unit: Wrench,
}

/// A stance at one instant.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) parts: [Part; 6],
    /// The expected load about the mass centre.
    pub(super) expected: Wrench,
    /// The expected centre of pressure [m].
    pub(super) center: Vec3,
}

/// A stance on every `stride`th frame.
#[derive(Debug, Clone)]
pub(super) struct Samples {
    stride: usize,
    /// Frame of the first sample over the stride.
    first: usize,
    list: Vec<Sample>,
}

impl Samples {
    /// Of a stance.
    pub(super) fn new(
        evidence: &Evidence<'_>,
        expectation: &Expectation<'_>,
        curves: &[Curve; 6],
        stride: usize,
    ) -> Samples {
        let stance = expectation.stance;
        let frames = frames_of(evidence, stance);
        let first = frames.start.div_ceil(stride);
        let frames = (first * stride..frames.end).step_by(stride);
        let list = frames.map(|frame| sample(evidence, expectation, curves, frame)).collect();
        Samples { stride, first, list }
    }

    /// At a frame that is a multiple of the stride.
    pub(super) fn at(&self, frame: usize) -> Option<&Sample> {
        self.list.get((frame / self.stride).checked_sub(self.first)?)
    }
}

/// Frames of a stance.
pub(super) fn frames_of(evidence: &Evidence<'_>, stance: &Stance) -> Range<usize> {
    let grid = evidence.grid;
    let last = grid.frames as f64;
    let place = |time: f64| (time - grid.start_s) / grid.step_s;
    let first = place(stance.start_s).ceil().clamp(0.0, last) as usize;
    let end = (place(stance.end_s).floor() + 1.0).clamp(0.0, last) as usize;
    first..end.max(first)
}

/// A stance at any of its frames.
pub(super) fn sample(
    evidence: &Evidence<'_>,
    expectation: &Expectation<'_>,
    curves: &[Curve; 6],
    frame: usize,
) -> Sample {
    let stance = expectation.stance;
    let time = evidence.grid.time(frame);
    let center = evidence.expected_center(stance, frame);
    let lever = evidence.geometry.center[frame] - center;
    let arm = -lever;
    let axes = [stance.forward, evidence.measure.up, stance.right];
    let means = expectation.all(time, lever);
    let mut expected = Wrench::ZERO;
    let parts = std::array::from_fn(|c| {
        let unit = match Component::ALL[c] {
            Component::Force(i) => Wrench { force: axes[i], moment: arm.cross(&axes[i]) },
            Component::Moment(i) => Wrench { force: Vec3::zeros(), moment: axes[i] },
        };
        expected.force += unit.force * means[c].mean;
        expected.moment += unit.moment * means[c].mean;
        Part { mean: means[c].mean, deviation: means[c].deviation, active: curves[c].active(time), unit }
    });
    Sample { parts, expected, center }
}
