//! Checks the friction of feet in stance.

use super::CheckedPrediction;
use super::judgement::{Criterion, Judgement};
use super::record::Record;
use super::sustained::sustained_maximum;
use crate::findings::Code;
use crate::ground::CENTER_OF_PRESSURE_LOAD_N;

/// Horizontal over vertical force of each loaded foot in stance.
pub(super) fn check(evidence: &CheckedPrediction<'_>, record: &Record, judgement: &mut Judgement<'_>) {
    let thresholds = evidence.thresholds;
    let criterion = Criterion { name: "friction", allowed: [0.0, thresholds.friction], unit: "1" };
    let least = (thresholds.friction_load_bw * record.weight).max(CENTER_OF_PRESSURE_LOAD_N);
    let of_foot = |foot: usize| {
        let forces = &evidence.prediction.ground.bodies.get(foot)?.force;
        let standing = (0..record.grid.frames).filter(|&frame| record.stands_on[foot][frame].is_some());
        let ratio = |frame: usize| {
            let vertical = forces[frame].dot(&record.up);
            let level = (forces[frame] - record.up * vertical).norm();
            (vertical > least).then(|| (record.grid.time(frame), level / vertical))
        };
        let series: Vec<(f64, f64)> = standing.filter_map(ratio).collect();
        Some((foot, sustained_maximum(&series, record.grid.step_s, thresholds.shortest_s)?))
    };
    let Some((foot, found)) = (0..2).filter_map(of_foot).max_by(|a, b| a.1.value.total_cmp(&b.1.value)) else {
        return judgement.skip(criterion, "no foot is loaded");
    };
    if !judgement.take(criterion, found) {
        let side = if foot == 0 { "right" } else { "left" };
        let message = format!(
            "the predicted force on the {side} foot in stance needs a coefficient of friction of {:.2} (at {:.3} s); \
             {:.2} is available",
            found.value, found.time_s[0], thresholds.friction
        );
        judgement.report(Code::PredictionFriction, message);
    }
}
