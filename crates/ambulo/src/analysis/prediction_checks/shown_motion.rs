//! Checks whether the recording still shows foot strikes.
//!
//! In fast walking and running the force after a strike rises within a tenth of a second. A motion that was low-passed
//! before it was recorded does not show this peak, whatever is computed from it.

use super::CheckedPrediction;
use super::judgement::{Criterion, Judgement, TimedValue};
use super::record::Record;
use crate::findings::Code;
use crate::ground::predict::SMOOTHED_HZ;
use crate::numerics::mean;
use crate::spatial::Vec3;

/// From this speed V / √(g L) on the peak counts.
const FAST: f64 = 0.45;

/// The bandwidth of the recorded motion against what the speed needs.
pub(super) fn check(evidence: &CheckedPrediction<'_>, record: &Record, judgement: &mut Judgement<'_>) {
    let level = |velocity: &Vec3| (velocity - record.up * velocity.dot(&record.up)).norm();
    let speed_m_s = mean(&record.velocity.iter().map(level).collect::<Vec<f64>>());
    let model = evidence.model;
    let speed = speed_m_s / (model.stature().leg_length_m * model.gravity().norm()).sqrt();
    let least = if speed < FAST { 0.0 } else { SMOOTHED_HZ };
    let criterion = Criterion { name: "motion_bandwidth", allowed: [least, f64::INFINITY], unit: "Hz" };
    let Some(value) = evidence.prediction.motion_bandwidth_hz else {
        return judgement.skip(criterion, "the bandwidth of the recorded motion is not known");
    };
    let time_s = [record.grid.start_s, record.grid.end_s()];
    if !judgement.take(criterion, TimedValue { value, time_s }) {
        let message = format!(
            "the recorded motion ends at {value:.1} Hz, it was smoothed before; at {speed_m_s:.1} m/s foot strikes \
             need {least:.1} Hz: their peaks are not in it, and predicted forces are less accurate"
        );
        judgement.report(Code::PredictionMotionSmoothed, message);
    }
}
