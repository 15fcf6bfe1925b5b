//! Detects support other than the feet: upward forces while no foot is in stance, and downward forces.

use super::judgement::{Criterion, Judgement};
use super::low_pass::{LowPassed, SHORTEST_S};
use super::record::Record;
use super::sustained::sustained_maximum;
use crate::analysis::feasibility::Check;
use crate::findings::Code;

/// Largest low-passed vertical force in real flight [body weights].
const HELD_BW: f64 = 0.2;
/// Noise of the acceleration causes downward forces smaller than this [body weights].
const PULL_BW: f64 = -0.15;

pub(super) fn check(record: &Record, low_passed: &LowPassed, judgement: &mut Judgement<'_>) {
    held(record, low_passed, judgement);
    pull(record, low_passed, judgement);
}

/// Flights shorter than twice the reach of the low-pass are not detected.
fn held(record: &Record, low_passed: &LowPassed, judgement: &mut Judgement<'_>) {
    let criterion = Criterion { name: "held_without_feet", allowed: [f64::NEG_INFINITY, HELD_BW], unit: "BW" };
    let without_stance = low_passed.instants.iter().filter(|instant| !instant.any_foot_stands);
    let series: Vec<(f64, f64)> = without_stance.map(|i| (i.time_s, i.vertical(record))).collect();
    let Some(found) = sustained_maximum(&series, low_passed.step_s, SHORTEST_S) else {
        return judgement.skip(criterion, "a foot is in stance at all times, or flights are short");
    };
    if !judgement.take(criterion, found) {
        let message = format!(
            "no foot is in stance from {:.3} to {:.3} s, yet the motion needs an upward force of at least {:.2} body \
             weights: something else supports the body (a harness, a seat, hands), or a stance was not detected",
            found.time_s[0], found.time_s[1], found.value
        );
        judgement.report_infeasible(Check::Support, criterion, found, message);
    }
}

fn pull(record: &Record, low_passed: &LowPassed, judgement: &mut Judgement<'_>) {
    let criterion = Criterion { name: "pull", allowed: [PULL_BW, f64::INFINITY], unit: "BW" };
    let series: Vec<(f64, f64)> = low_passed.instants.iter().map(|i| (i.time_s, -i.vertical(record))).collect();
    let Some(mut found) = sustained_maximum(&series, low_passed.step_s, SHORTEST_S) else {
        return judgement.skip(criterion, "the recording is too short");
    };
    found.value = -found.value;
    if !judgement.take(criterion, found) {
        let message = format!(
            "the body falls faster than in free fall: from {1:.3} to {2:.3} s the motion needs a downward force of \
             {0:.2} body weights, which a floor cannot supply. hint: check unit and frame rate of the motion",
            -found.value, found.time_s[0], found.time_s[1]
        );
        judgement.report(Code::PredictionPull, message);
    }
}
