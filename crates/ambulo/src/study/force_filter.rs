//! Low-pass filter of the measured forces: given, or chosen by the movement.
//!
//! - **Walking**: 25 Hz. Plates record frequencies that markers lose. At the 6 Hz of the motion, hip and knee moments
//!   after foot strike are too small; the loss is larger than the artefact of unequal filters (docs/PLUG_IN_GAIT.md has
//!   the comparison).
//! - **Running, jumps and landings**: as the motion, at least 8 Hz. At impacts a force that is sharper than the
//!   accelerations makes peaks of hip and knee moments that the person did not make (Bisseling and Hof 2006,
//!   Kristianslund 2012; unverified). 6 Hz would take 5 % of the peak force of a run, 8 Hz takes 1 %.
//!
//! The movement is a run, jump or landing if the feet together carry more than 1.8 times the body weight; walks on
//! level ground and stairs stay below 1.6 (unverified for stairs).
//! Pinned by: tests/force_filter.rs

use crate::model::Model;
use crate::motion::filter::LowPass;
use crate::motion::{ForceRecording, Smoother, TimeGrid};
use crate::spatial::Vec3;

/// How measured forces are filtered.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum ForceFilter {
    /// By the movement: 25 Hz for walking; for running and landing as the motion, at least 8 Hz. Not filtered if the
    /// motion is not.
    #[default]
    ByMovement,
    /// This filter.
    LowPass(LowPass),
    /// No filter.
    Off,
}

/// Cut-off frequency for walking [Hz].
const WALKING_HZ: f64 = 25.0;
/// Lowest cut-off frequency for running and landing [Hz].
const IMPACT_HZ: f64 = 8.0;
/// Loads above this many body weights do not occur in walking.
const IMPACT_BW: f64 = 1.8;
/// Shorter loads are errors of the signal [s].
const SHORTEST_IMPACT_S: f64 = 0.02;
/// Highest cut-off frequency that is chosen, as a share of the sampling rate; a filter allows less than half.
const HIGHEST_SHARE: f64 = 0.4;

impl ForceFilter {
    /// The filter for these measured forces and the smoothing of the motion.
    pub(super) fn of(self, model: &Model, forces: &[ForceRecording], smoother: Smoother) -> Option<LowPass> {
        let motion = match (self, smoother) {
            (ForceFilter::LowPass(filter), _) => return Some(filter),
            (ForceFilter::Off, _) | (ForceFilter::ByMovement, Smoother::Off) => return None,
            (ForceFilter::ByMovement, Smoother::Butterworth(filter)) => filter,
            (ForceFilter::ByMovement, Smoother::Spline) => LowPass::MOTION,
        };
        let least_hz = if has_impacts(model, forces) { IMPACT_HZ } else { WALKING_HZ };
        let rates = forces.iter().filter_map(|force| TimeGrid::spanning(&force.times)).map(|grid| grid.rate_hz());
        let allowed_hz = HIGHEST_SHARE * rates.fold(f64::INFINITY, f64::min);
        Some(LowPass { cutoff_hz: least_hz.min(allowed_hz).max(motion.cutoff_hz), ..motion })
    }
}

/// Whether the feet together carry a load that does not occur in walking.
fn has_impacts(model: &Model, forces: &[ForceRecording]) -> bool {
    let Some(first) = forces.first() else { return false };
    let Some(grid) = TimeGrid::spanning(&first.times) else { return false };
    let up = model.up();
    let carried = |force: &ForceRecording, t: f64| {
        let sample = force.times.partition_point(|time| *time < t - 0.5 * grid.step_s);
        let vector = force.force.get(sample).copied().unwrap_or(Vec3::zeros());
        let load = if force.force_frame.is_none() { vector.dot(&up) } else { vector.norm() };
        if load.is_finite() { load } else { 0.0 }
    };
    let limit_n = IMPACT_BW * model.mass() * model.gravity().norm();
    let is_above = |t: &&f64| forces.iter().map(|force| carried(force, **t)).sum::<f64>() > limit_n;
    limit_n > 0.0 && first.times.iter().filter(is_above).count() as f64 * grid.step_s > SHORTEST_IMPACT_S
}
