//! Varus and rotation of the knees over the frames of an outcome, smoothed as its motion.

use super::origin::Tracking;
use super::outcome::Outcome;
use crate::model::{BySide, Side};
use crate::motion::filter::{LowPass, low_pass};
use crate::motion::{Smoother, interpolate};

impl Outcome {
    /// Varus (adduction) and internal rotation of each knee from the markers of thigh and shank alone, one entry per
    /// frame [rad]; not a number in gaps. `None` without markers that determine both segments, and for a model whose
    /// knee turns in these planes itself.
    #[must_use]
    pub fn knee_angles(&self) -> BySide<Option<[Vec<f64>; 2]>> {
        let Some(Tracking::Markers(tracked)) = &self.tracking else { return BySide::default() };
        let times = &tracked.body.fit.motion.times;
        BySide::from_fn(|side: Side| {
            let raw = tracked.body.knees[side].as_ref()?;
            Some(raw.each_ref().map(|angles| self.on_frames(times, angles)))
        })
    }

    /// A series at the times of the recording, smoothed and at the times of the results.
    fn on_frames(&self, times: &[f64], values: &[f64]) -> Vec<f64> {
        let mut smooth = values.to_vec();
        if let Some(filter) = filter(self.processing.smoother) {
            let rate_hz = (times.len().max(2) - 1) as f64 / (times[times.len() - 1] - times[0]);
            // Each part without a gap is smoothed alone; parts that are too short for the filter stay as they are.
            for part in smooth.chunk_by_mut(|a, b| a.is_finite() == b.is_finite()).filter(|part| part[0].is_finite()) {
                if let Ok(filtered) = low_pass(part, rate_hz, filter) {
                    part.copy_from_slice(&filtered);
                }
            }
        }
        self.analysis.trajectory.grid().times().iter().map(|time| interpolate(times, &smooth, *time)).collect()
    }
}

fn filter(smoother: Smoother) -> Option<LowPass> {
    match smoother {
        Smoother::Off => None,
        Smoother::Butterworth(filter) => Some(filter),
        Smoother::Spline => Some(LowPass::MOTION),
    }
}
