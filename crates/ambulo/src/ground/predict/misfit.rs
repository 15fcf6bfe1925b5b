//! The difference between the estimated force of both feet and the force that the motion requires, after the low-pass filters.
//!
//!   m² = mean over a stance of (G ∗ (H ∗) Σ_feet F_i - G ∗ F_total)², along forward, up and right
//!
//! | code      | symbol   | unit | meaning                                             |
//! | `filters` | G, H     |      | filters of the evidence ([`super::evidence_filter`]) |
//!
//! Noise that the estimate could explain is gone from it; what remains is motion that contradicts the shapes of forces of walking.

use super::evidence_filter::{EvidenceFilter, EvidenceFilters};
use super::loads::FrameEstimate;
use super::samples::{EstimateInputs, frames_of};
use crate::spatial::Vec3;

/// Root mean square of the difference in each stance, forward, up and to the right [N].
pub(super) fn misfits(
    inputs: &EstimateInputs<'_>,
    estimates: &[Vec<FrameEstimate>],
    filters: &EvidenceFilters,
) -> Vec<[f64; 3]> {
    let required: Vec<Vec3> = inputs.total.iter().map(|total| total.force).collect();
    let mut rest: Vec<Vec3> = low_passed(&required, &filters.gaussian).map(|force| -force).collect();
    for (filter, passing) in filters.estimated() {
        let mut estimated = vec![Vec3::zeros(); rest.len()];
        for (stance, estimates) in inputs.stances.iter().zip(estimates) {
            let axes = stance.axes(inputs.body_scale.up);
            for (frame, estimate) in frames_of(inputs, stance).zip(estimates) {
                let force = estimate.force(axes);
                let along = passing(stance.gait).iter().filter_map(|component| axes.get(*component));
                estimated[frame] += along.map(|axis| axis * force.dot(axis)).sum::<Vec3>();
            }
        }
        rest.iter_mut().zip(low_passed(&estimated, filter)).for_each(|(rest, force)| *rest += force);
    }
    let of_stance = |stance| {
        let instants = || frames_of(inputs, stance);
        let count = instants().count().max(1) as f64;
        let squares = instants().fold([0.0; 3], |sum, frame| {
            let along = stance.axes(inputs.body_scale.up).map(|axis| rest[frame].dot(&axis).powi(2));
            std::array::from_fn(|axis| sum[axis] + along[axis])
        });
        squares.map(|square| (square / count).sqrt())
    };
    inputs.stances.iter().map(of_stance).collect()
}

fn low_passed<'a>(series: &'a [Vec3], filter: &'a EvidenceFilter) -> impl Iterator<Item = Vec3> + 'a {
    let frames = series.len();
    (0..frames).map(move |frame| filter.around(frame, frames).map(|(tap, weight)| series[tap] * weight).sum())
}
