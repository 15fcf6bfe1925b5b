//! Mean position of the whole body's force relative to the feet in single support.
//!
//! A push or pull on one side shifts it to the same side of both feet; support in front shifts it forwards. These means
//! need more time than a centre of pressure outside the soles, but are more sensitive: 15 % of body weight 0.45 m to
//! the side of the body shift it by 67 mm.

use super::CheckedPrediction;
use super::judgement::{Criterion, Judgement, TimedValue};
use super::low_pass::LowPassed;
use super::record::Record;
use crate::analysis::feasibility::Check;

pub(super) fn check(
    evidence: &CheckedPrediction<'_>,
    record: &Record,
    low_passed: &LowPassed,
    judgement: &mut Judgement<'_>,
) {
    let margin = evidence.thresholds.sole_margin_m;
    let sideways = Criterion { name: "sideways_offset", allowed: [-margin, margin], unit: "m" };
    let forward = Criterion { name: "forward_offset", ..sideways };
    let Some(([right, ahead], time_s)) = offsets(record, low_passed) else {
        return [sideways, forward]
            .into_iter()
            .for_each(|criterion| judgement.skip(criterion, "there is no single support of each foot"));
    };
    let mut add = |criterion: Criterion, value: f64, directions: [&str; 2]| {
        let found = TimedValue { value, time_s };
        if judgement.take(criterion, found) {
            return;
        }
        let message = format!(
            "the whole body's force acts on average {:.0} mm {} in single support ({:.0} mm are allowed): something \
             else supports or pulls the body there (a hand on a rail, a load), or its mass distribution is wrong",
            1e3 * value.abs(),
            directions[usize::from(value > 0.0)],
            1e3 * margin
        );
        judgement.report_infeasible(Check::CenterOfPressure, criterion, found, message);
    };
    add(forward, ahead, ["behind the heels", "ahead of the balls of the feet"]);
    match record.plane_normal {
        None => {
            add(sideways, right, ["to the left of the middle of the feet", "to the right of the middle of the feet"])
        }
        Some(_) => judgement.skip(sideways, "the figure moves in a plane"),
    }
}

/// Mean offsets in single support [m], and its first and last time [s]: to the right of the middle of the feet; ahead
/// of the balls or (negative) behind the heels, zero between them. `None` unless there is single support of each foot.
fn offsets(record: &Record, low_passed: &LowPassed) -> Option<([f64; 2], [f64; 2])> {
    let mut feet: [Vec<[f64; 3]>; 2] = [Vec::new(), Vec::new()];
    for instant in &low_passed.instants {
        let (Some(foot), Some(center)) = (instant.single_support_foot, instant.center(record)) else { continue };
        let [rear, ball, tip] = record.soles[foot][instant.frame];
        let along = tip - rear;
        let along = (along - record.up * along.dot(&record.up)).try_normalize(f64::MIN_POSITIVE)?;
        let right = along.cross(&record.up);
        feet[foot].push([(center - rear).dot(&right), (center - rear).dot(&along), (center - ball).dot(&along)]);
    }
    // Both feet have equal weight, regardless of the number of samples.
    let mean = |list: &[[f64; 3]], k: usize| list.iter().map(|v| v[k]).sum::<f64>() / list.len() as f64;
    let [right, ahead_of_rear, ahead_of_ball] = [0, 1, 2].map(|k| 0.5 * (mean(&feet[0], k) + mean(&feet[1], k)));
    let forward = ahead_of_ball.max(0.0) + ahead_of_rear.min(0.0);
    let (first, last) = (low_passed.instants.first()?, low_passed.instants.last()?);
    right.is_finite().then_some(([right, forward], [first.time_s, last.time_s]))
}
