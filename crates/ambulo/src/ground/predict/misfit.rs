//! The difference between the estimated wrench of both feet and the wrench that the motion requires, after the low-pass
//! filters.
//!
//!   w   = G ∗ (H ∗) Σ_feet (F_i, r_i × F_i + T_i) - G ∗ (F_total, M_total), moments about the mass centre
//!   m_F = rms of the force of w along an axis over a stance
//!   m_P = rms of (M_w - r × F_w) / weight over a stance: about the axis to the right along the foot,
//!         about forward across it
//!
//! | code      | symbol   | unit | meaning                                                 |
//! | `filters` | G, H     |      | filters of the evidence ([`super::evidence_filter`])    |
//! | `arm`     | r        | m    | from the mass centre to the expected centre of pressure |
//!
//! Noise that the estimate can explain is not in w. The rest is motion that contradicts the shapes of forces
//! of walking: because markers are missing (on the trunk, for example), or because the body moves fast.

use super::deviation_calibration::Misfit;
use super::evidence_filter::{EvidenceFilter, EvidenceFilters};
use super::loads::FrameEstimate;
use super::samples::{EstimateInputs, frames_of};
use super::stances::Stance;
use crate::spatial::Wrench;
use std::ops::Range;

/// The misfit of each stance, over its frames with evidence.
pub(super) fn misfits(
    inputs: &EstimateInputs<'_>,
    estimates: &[Vec<FrameEstimate>],
    filters: &EvidenceFilters,
    evidence: &Range<usize>,
) -> Vec<Misfit> {
    let frames = inputs.grid.frames;
    let required: Vec<Wrench> = (0..frames).map(|frame| inputs.about_mass_center(frame)).collect();
    let mut rest = low_passed(&required, &filters.gaussian, evidence);
    if let Some(filter) = filters.smoothed() {
        let up = inputs.body_scale.up;
        for (rest, own) in rest.iter_mut().zip(low_passed(&required, filter, evidence)) {
            rest.force += up * (own.force - rest.force).dot(&up);
        }
    }
    rest.iter_mut().for_each(|wrench| *wrench = Wrench { force: -wrench.force, moment: -wrench.moment });
    for (filter, passing) in filters.estimated() {
        let mut estimated = vec![Wrench::ZERO; frames];
        for (stance, estimates) in inputs.stances.iter().zip(estimates) {
            let axes = stance.axes(inputs.body_scale.up);
            for (frame, estimate) in frames_of(inputs, stance).zip(estimates) {
                let Wrench { force, moment } = estimate.about(inputs.geometry.center[frame], axes);
                for row in passing(stance.gait) {
                    let axis = axes[row % 3];
                    match row {
                        0..3 => estimated[frame].force += axis * force.dot(&axis),
                        _ => estimated[frame].moment += axis * moment.dot(&axis),
                    }
                }
            }
        }
        for (rest, of_feet) in rest.iter_mut().zip(low_passed(&estimated, filter, evidence)) {
            *rest = Wrench { force: rest.force + of_feet.force, moment: rest.moment + of_feet.moment };
        }
    }
    let of_stance = |(stance, estimates): (&Stance, &Vec<FrameEstimate>)| {
        let axes = stance.axes(inputs.body_scale.up);
        let (mut squares, mut count) = (Misfit::default(), 0.0);
        for (frame, estimate) in frames_of(inputs, stance).zip(estimates).filter(|(frame, _)| evidence.contains(frame))
        {
            count += 1.0;
            let arm = estimate.center - inputs.geometry.center[frame];
            let Wrench { force, moment } = rest[frame];
            let about_center = (moment - arm.cross(&force)) / inputs.body_scale.weight_n;
            squares.force.iter_mut().zip(axes).for_each(|(sum, axis)| *sum += force.dot(&axis).powi(2));
            squares
                .center
                .iter_mut()
                .zip([axes[2], axes[0]])
                .for_each(|(sum, axis)| *sum += about_center.dot(&axis).powi(2));
        }
        let count = f64::max(count, 1.0);
        Misfit {
            force: squares.force.map(|square| (square / count).sqrt()),
            center: squares.center.map(|square| (square / count).sqrt()),
        }
    };
    inputs.stances.iter().zip(estimates).map(of_stance).collect()
}

/// Zero outside of the `wanted` frames.
fn low_passed(series: &[Wrench], filter: &EvidenceFilter, wanted: &Range<usize>) -> Vec<Wrench> {
    let at = |frame| {
        if !wanted.contains(&frame) {
            return Wrench::ZERO;
        }
        filter.around(frame, series.len()).fold(Wrench::ZERO, |sum, (tap, weight)| Wrench {
            force: sum.force + series[tap].force * weight,
            moment: sum.moment + series[tap].moment * weight,
        })
    };
    (0..series.len()).map(at).collect()
}
