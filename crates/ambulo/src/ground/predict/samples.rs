//! Prior and splines of every stance, sampled at the frames that the estimate uses.

use super::center_path::center_path;
use super::expected::{Component, Expectation};
use super::fitted_parameters::FittedParameters;
use super::geometry::{Geometry, nearest_on_sole};
use super::personal::PersonalErrors;
use super::prescribed::Prescribed;
use super::stances::{BodyScale, GaitType, Stance};
use super::unknowns::{ActiveSplines, Curve};
use super::zero_moment_point::{share_along_soles, zero_moment_point};
use crate::model::BySide;
use crate::motion::TimeGrid;
use crate::motion::filter::LowPass;
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// Inputs of the estimate: the motion of feet and mass centre, the stances and the total wrench.
pub(super) struct EstimateInputs<'a> {
    pub(super) grid: TimeGrid,
    pub(super) geometry: &'a Geometry,
    /// Half the width of the right and the left sole [m].
    pub(super) half_widths: BySide<f64>,
    pub(super) stances: &'a [Stance],
    /// Total wrench about the world's origin.
    pub(super) total: &'a [Wrench],
    pub(super) body_scale: &'a BodyScale,
    pub(super) parameters: &'a FittedParameters,
    pub(super) prescribed: &'a Prescribed,
    pub(super) person: Option<&'a PersonalErrors>,
    /// The filter that the motion has passed.
    pub(super) motion_filter: Option<LowPass>,
    /// Its bandwidth before it [Hz].
    pub(super) motion_bandwidth_hz: Option<f64>,
}

impl EstimateInputs<'_> {
    /// Expected centre of pressure in a frame [m].
    pub(super) fn expected_center(&self, stance: &Stance, frame: usize) -> Vec3 {
        let place = &self.geometry.feet[stance.side][frame];
        let path = || center_path(place, stance, self.grid.time(frame), self.body_scale, self.parameters);
        let standing = || self.standing_center(stance, frame);
        self.prescribed.center_at(stance.side, frame).or_else(standing).unwrap_or_else(path)
    }

    /// The centre of pressure of a foot that stands, from the total wrench; `None` for steps, and where the feet carry
    /// little.
    fn standing_center(&self, stance: &Stance, frame: usize) -> Option<Vec3> {
        if stance.gait != GaitType::Stand {
            return None;
        }
        let BodyScale { up, weight_n, .. } = *self.body_scale;
        let point = zero_moment_point(&self.total[frame], stance.height_m, up, weight_n)?;
        let time = self.grid.time(frame);
        let is_other = |other: &&Stance| other.side != stance.side && (other.start_s..=other.end_s).contains(&time);
        let feet = self.geometry.feet.as_ref().map(|places| &places[frame]);
        let sole = &feet[stance.side].sole;
        if !self.stances.iter().any(|other| is_other(&other)) {
            return Some(nearest_on_sole(sole, self.half_widths[stance.side], point, up));
        }
        let place = sole[0] + (sole[2] - sole[0]) * share_along_soles(feet, point, up);
        Some(place + up * (stance.height_m - place.dot(&up)))
    }

    /// The total wrench about the mass centre.
    pub(super) fn about_mass_center(&self, frame: usize) -> Wrench {
        self.total[frame].about(-self.geometry.center[frame])
    }
}

/// One component of a load in one frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct ComponentSample {
    /// Prior mean and standard deviation [N or N.m].
    pub(super) mean: f64,
    pub(super) deviation: f64,
    /// The unknowns with influence.
    pub(super) active: ActiveSplines,
    /// The wrench about the mass centre for a component of 1.
    pub(super) unit: Wrench,
}

/// All components of a stance in one frame.
#[derive(Debug, Clone, Copy)]
pub(super) struct StanceSample {
    pub(super) parts: [ComponentSample; 6],
    /// Prior mean of the wrench about the mass centre.
    pub(super) expected: Wrench,
    /// Expected centre of pressure [m].
    pub(super) center: Vec3,
}

/// A stance sampled at every `stride`th frame.
#[derive(Debug, Clone)]
pub(super) struct StanceSamples {
    stride: usize,
    /// Frame of the first sample divided by the stride.
    first: usize,
    list: Vec<StanceSample>,
}

impl StanceSamples {
    /// Samples a stance.
    pub(super) fn new(
        inputs: &EstimateInputs<'_>,
        expectation: &Expectation<'_>,
        curves: &[Curve; 6],
        stride: usize,
    ) -> StanceSamples {
        let stance = expectation.stance;
        let frames = frames_of(inputs, stance);
        let first = frames.start.div_ceil(stride);
        let frames = (first * stride..frames.end).step_by(stride);
        let list = frames.map(|frame| sample(inputs, expectation, curves, frame)).collect();
        StanceSamples { stride, first, list }
    }

    /// The sample at a frame that is a multiple of the stride.
    pub(super) fn at(&self, frame: usize) -> Option<&StanceSample> {
        self.list.get((frame / self.stride).checked_sub(self.first)?)
    }
}

/// Frames of a stance.
pub(super) fn frames_of(inputs: &EstimateInputs<'_>, stance: &Stance) -> Range<usize> {
    let grid = inputs.grid;
    let last = grid.frames as f64;
    let place = |time: f64| (time - grid.start_s) / grid.step_s;
    let first = place(stance.start_s).ceil().clamp(0.0, last) as usize;
    let end = (place(stance.end_s).floor() + 1.0).clamp(0.0, last) as usize;
    first..end.max(first)
}

/// A stance in any of its frames.
pub(super) fn sample(
    inputs: &EstimateInputs<'_>,
    expectation: &Expectation<'_>,
    curves: &[Curve; 6],
    frame: usize,
) -> StanceSample {
    let stance = expectation.stance;
    let time = inputs.grid.time(frame);
    let center = inputs.expected_center(stance, frame);
    let lever = inputs.geometry.center[frame] - center;
    let arm = -lever;
    let axes = stance.axes(inputs.body_scale.up);
    let means = expectation.all(time, lever);
    let mut expected = Wrench::ZERO;
    let parts = std::array::from_fn(|c| {
        let unit = match Component::ALL[c] {
            Component::Force(i) => Wrench { force: axes[i], moment: arm.cross(&axes[i]) },
            Component::Moment(i) => Wrench { force: Vec3::zeros(), moment: axes[i] },
        };
        expected.force += unit.force * means[c].mean;
        expected.moment += unit.moment * means[c].mean;
        ComponentSample { mean: means[c].mean, deviation: means[c].deviation, active: curves[c].active(time), unit }
    });
    StanceSample { parts, expected, center }
}
