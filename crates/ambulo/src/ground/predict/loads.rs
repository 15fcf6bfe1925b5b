//! Forces, centres of pressure and free moments of a foot in every frame from the estimate, with standard deviations.

use super::FootDeviation;
use super::deviation_calibration::{Misfit, scaling_at};
use super::evidence_filter::is_smoothed;
use super::expected::Expectation;
use super::forefoot::on_touching_part;
use super::geometry::nearest_on_sole;
use super::normal_equations::Solution;
use super::samples::{ComponentSample, EstimateInputs, frames_of, sample};
use super::stance_traits::HASTE;
use super::stances::{GaitType, Stance};
use super::unknowns::Curve;
use crate::model::Side;
use crate::spatial::{Vec3, Wrench};
use std::ops::Range;

/// Smallest vertical force by which a moment is divided to get the centre of pressure [body weights].
const LEAST_LOAD: f64 = 0.05;

/// Deviations were calibrated on walks; errors of the one available run are larger by this factor
/// (docs/measured/VALIDATION.md).
const RUN_DEVIATION: f64 = 3.0;

/// Loads of one foot, one entry per frame.
#[derive(Debug, Clone)]
pub(super) struct FootLoads {
    pub(super) force: Vec<Vec3>,
    pub(super) center: Vec<Vec3>,
    /// Moment about the vertical through the centre of pressure [N.m].
    pub(super) free_moment: Vec<f64>,
    /// Height of the ground [m].
    pub(super) height: Vec<f64>,
    pub(super) deviation: FootDeviation,
}

/// The estimate of a stance in one frame.
#[derive(Debug, Clone)]
pub(super) struct FrameEstimate {
    /// Expected centre of pressure [m].
    pub(super) center: Vec3,
    /// Estimates in the order of [`super::expected::Component::ALL`].
    parts: [Estimate; 6],
}

impl FrameEstimate {
    /// The force [N] and its moment about a point [N.m].
    pub(super) fn about(&self, point: Vec3, axes: [Vec3; 3]) -> Wrench {
        let along =
            |first: usize| axes.iter().zip(&self.parts[first..]).map(|(axis, part)| axis * part.value).sum::<Vec3>();
        let force = along(0);
        Wrench { force, moment: (self.center - point).cross(&force) + along(3) }
    }
}

/// The estimate of a stance in each of its frames ([`frames_of`]), with variances in the `wanted` ones.
pub(super) fn stance_estimates(
    inputs: &EstimateInputs<'_>,
    expectation: &Expectation<'_>,
    curves: &[Curve; 6],
    solution: &Solution,
    wanted: &Range<usize>,
) -> Vec<FrameEstimate> {
    let of_frame = |frame: usize| {
        let at = sample(inputs, expectation, curves, frame);
        let parts = std::array::from_fn(|c| Estimate::of(&at.parts[c], &curves[c], solution, wanted.contains(&frame)));
        FrameEstimate { center: at.center, parts }
    };
    frames_of(inputs, expectation.stance).map(of_frame).collect()
}

/// Loads of one foot in the `wanted` frames; zero in the others and in swing. Estimates and misfits have one entry per
/// stance.
pub(super) fn loads(
    side: Side,
    inputs: &EstimateInputs<'_>,
    estimates: &[Vec<FrameEstimate>],
    misfits: &[Misfit],
    wanted: &Range<usize>,
) -> FootLoads {
    let frames = inputs.grid.frames;
    let zeros = || vec![Vec3::zeros(); frames];
    let mut out = FootLoads {
        force: zeros(),
        center: zeros(),
        free_moment: vec![0.0; frames],
        height: vec![0.0; frames],
        deviation: FootDeviation { side, force: zeros(), center: zeros(), free_moment: vec![0.0; frames] },
    };
    let own = inputs.stances.iter().zip(estimates).zip(misfits).filter(|((stance, _), _)| stance.side == side);
    for ((stance, estimates), misfit) in own {
        for (frame, at) in frames_of(inputs, stance).zip(estimates).filter(|(frame, _)| wanted.contains(frame)) {
            let mut parts = at.parts.clone();
            let phase = stance.elapsed_share(inputs.grid.time(frame));
            let center_error = inputs.take_errors_off(stance, phase, &mut parts);
            let [forward, up, right, about_forward, about_up, about_right] = parts;
            let axes = stance.axes(inputs.body_scale.up);
            let vertical = up.value.max(LEAST_LOAD * inputs.body_scale.weight_n);
            out.force[frame] = axes[0] * forward.value + axes[1] * up.value + axes[2] * right.value;
            out.center[frame] = match inputs.prescribed.center_at(side, frame) {
                Some(center) => center,
                // δ × F = T for a centre of pressure at distance δ from its expected path.
                None => {
                    let moved = (axes[0] * about_right.value - axes[2] * about_forward.value) / vertical;
                    let place = &inputs.geometry.feet[side][frame];
                    let expected = at.center + moved + center_error;
                    let center = nearest_on_sole(&place.sole, inputs.half_widths[side], expected, axes[1]);
                    let is_on_forefoot = stance.is_on_forefoot(inputs.grid.time(frame));
                    if is_on_forefoot { on_touching_part(place, center, axes[1]) } else { center }
                }
            };
            (out.free_moment[frame], out.height[frame]) = (about_up.value, stance.height_m);
            let deviation = &mut out.deviation;
            let run_factor = if stance.gait == GaitType::Run { RUN_DEVIATION } else { 1.0 };
            let remaining = inputs.remaining(stance);
            let weight = inputs.body_scale.weight_n;
            let calibration = &inputs.parameters.calibration;
            let of_forces = inputs.force_variances(stance, phase, misfit, [&forward, &up, &right]);
            deviation.force[frame] = rotated(axes, of_forces) * run_factor;
            let [along, across] = [(0, &about_right), (1, &about_forward)].map(|(axis, of)| {
                let scaled = calibration.center[axis].variance(of.variance / vertical.powi(2), 1.0);
                remaining * (scaled + calibration.center_of_trial(axis, misfit))
            });
            deviation.center[frame] = rotated(axes, [along, 0.0, across]) * run_factor;
            deviation.free_moment[frame] = calibration.free_moment.variance(about_up.variance, weight).sqrt();
        }
    }
    out
}

impl EstimateInputs<'_> {
    /// Adds the mean errors of walking and of the person to the force estimates; returns the mean error of the centre
    /// of pressure [m].
    fn take_errors_off(&self, stance: &Stance, phase: f64, estimates: &mut [Estimate; 6]) -> Vec3 {
        if !repeats(stance) {
            return Vec3::zeros();
        }
        let (side, errors) = (stance.side, &self.parameters.errors);
        let own = self.person.map_or(([0.0; 3], [0.0; 2]), |p| (p.force(side, phase), p.center(side, phase)));
        let (force, center) = (errors.force(side, phase, &stance.traits), errors.usual.center(side, phase));
        for (of, error) in estimates.iter_mut().zip((0..3).map(|axis| force[axis] + own.0[axis])) {
            of.value += error * self.body_scale.weight_n;
        }
        let [along, across] = [0, 1].map(|axis| (center[axis] + own.1[axis]) * self.body_scale.height_m);
        stance.forward * along + stance.right * across
    }

    /// Calibrated variances of the forces forward, up and to the right [N²].
    fn force_variances(&self, stance: &Stance, phase: f64, misfit: &Misfit, forces: [&Estimate; 3]) -> [f64; 3] {
        let calibration = &self.parameters.calibration;
        let haste = if stance.gait == GaitType::Walk { stance.traits[HASTE] } else { 0.0 };
        let is_smoothed = is_smoothed(self.motion_bandwidth_hz);
        std::array::from_fn(|axis| {
            let scaling = scaling_at(&calibration.force[axis], phase);
            let scaled = scaling.variance(forces[axis].variance, self.body_scale.weight_n);
            let wider = calibration.widening(axis, haste, is_smoothed).powi(2);
            self.remaining(stance) * wider * (scaled + calibration.of_trial(axis, misfit, forces[2].value))
        })
    }

    /// Share of the variance of the errors that remains for this person.
    fn remaining(&self, stance: &Stance) -> f64 {
        match self.person {
            Some(person) if repeats(stance) => person.remaining(stance.side),
            _ => 1.0,
        }
    }
}

/// Whether the mean errors apply to a stance: they were learned in walking on even ground with heel strikes.
fn repeats(stance: &Stance) -> bool {
    stance.gait == GaitType::Walk && stance.heel_down_s.is_none() && !stance.on_stairs
}

/// Value and variance of a component.
#[derive(Debug, Clone)]
struct Estimate {
    value: f64,
    variance: f64,
}

impl Estimate {
    /// The variance is zero if it is not wanted.
    fn of(part: &ComponentSample, curve: &Curve, solution: &Solution, has_variance: bool) -> Estimate {
        let (k, splines) = part.active;
        let numbers = &curve.numbers[k..k + 4];
        let z: f64 = numbers.iter().zip(splines).map(|(n, a)| a * solution.values[*n]).sum();
        let variance = if has_variance { solution.covariances.variance(numbers, &splines) } else { 0.0 };
        Estimate {
            value: part.mean + part.deviation * z,
            variance: part.deviation * part.deviation * variance.max(0.0),
        }
    }
}

/// Standard deviations along the world's axes from variances along other axes.
fn rotated(axes: [Vec3; 3], variances: [f64; 3]) -> Vec3 {
    let along = |world: usize| (0..3).map(|i| axes[i][world].powi(2) * variances[i]).sum::<f64>();
    Vec3::new(along(0), along(1), along(2)).map(f64::sqrt)
}
