//! Where the whole body's force passes the feet on average while they stand alone.
//!
//! What pushes or pulls on one side moves it to that side of both feet alike; what carries in front moves it ahead. Both are slower to
//! tell than a centre of pressure outside of the soles, and finer: 15 % of body weight at 0.45 m beside the body move it by 67 mm.

use super::CheckedPrediction;
use super::judgement::{Found, Judgement, Looked};
use super::low_pass::LowPassed;
use super::record::Record;
use crate::analysis::feasibility::Check;

/// Mean places while each foot stood alone [m].
#[derive(Debug, Clone, Copy)]
struct Offsets {
    /// To the right of the feet's middles.
    right: f64,
    /// Ahead of the balls, or, negative, behind the rears; zero between them.
    forward: f64,
    time_s: [f64; 2],
}

pub(super) fn check(
    evidence: &CheckedPrediction<'_>,
    record: &Record,
    low_passed: &LowPassed,
    judgement: &mut Judgement<'_>,
) {
    let margin = evidence.thresholds.sole_margin_m;
    let sideways = Looked { name: "sideways_offset", allowed: [-margin, margin], unit: "m" };
    let forward = Looked { name: "forward_offset", ..sideways };
    let Some(offsets) = offsets(record, low_passed) else {
        return [sideways, forward]
            .into_iter()
            .for_each(|looked| judgement.skip(looked, "not every foot stands alone"));
    };
    let time_s = offsets.time_s;
    let mut say = |looked: Looked, value: f64, wheres: [&str; 2]| {
        let found = Found { value, time_s };
        if judgement.take(looked, found) {
            return;
        }
        let message = format!(
            "the whole body's force passes {:.0} mm {} on average while they stand alone ({:.0} mm are allowed): something carries or pulls there (a hand on a rail, a load), or the body's masses lie elsewhere",
            1e3 * value.abs(),
            wheres[usize::from(value > 0.0)],
            1e3 * margin
        );
        judgement.oppose(Check::CenterOfPressure, looked, found, message);
    };
    say(forward, offsets.forward, ["behind the heels", "ahead of the balls of the feet"]);
    match record.plane_normal {
        None => {
            say(sideways, offsets.right, ["to the left of both feet's middles", "to the right of both feet's middles"])
        }
        Some(_) => judgement.skip(sideways, "the figure moves in a plane"),
    }
}

/// `None` unless each foot stands alone at some time.
fn offsets(record: &Record, low_passed: &LowPassed) -> Option<Offsets> {
    let mut feet: [Vec<[f64; 3]>; 2] = [Vec::new(), Vec::new()];
    for instant in &low_passed.instants {
        let (Some(foot), Some(center)) = (instant.alone, instant.center(record)) else { continue };
        let [rear, ball, tip] = record.soles[foot][instant.frame];
        let along = tip - rear;
        let along = (along - record.up * along.dot(&record.up)).try_normalize(f64::MIN_POSITIVE)?;
        let right = along.cross(&record.up);
        feet[foot].push([(center - rear).dot(&right), (center - rear).dot(&along), (center - ball).dot(&along)]);
    }
    // Each foot counts once, however often it was seen.
    let mean = |list: &[[f64; 3]], k: usize| list.iter().map(|v| v[k]).sum::<f64>() / list.len() as f64;
    let [right, ahead_of_rear, ahead_of_ball] = [0, 1, 2].map(|k| 0.5 * (mean(&feet[0], k) + mean(&feet[1], k)));
    let forward = ahead_of_ball.max(0.0) + ahead_of_rear.min(0.0);
    let (first, last) = (low_passed.instants.first()?, low_passed.instants.last()?);
    right.is_finite().then_some(Offsets { right, forward, time_s: [first.time_s, last.time_s] })
}
