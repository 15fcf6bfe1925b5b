//! Whether something else holds the body: forces while no foot stands, and forces downwards.

use super::judgement::{Judgement, Looked};
use super::lasting::lasting;
use super::low_pass::{LowPassed, SHORTEST_S};
use super::record::Record;
use crate::analysis::feasibility::Check;
use crate::findings::Code;

/// A low-passed flight keeps less than this [body weights].
const HELD_BW: f64 = 0.2;
/// Noise of the acceleration pulls down by less than this [body weights].
const PULL_BW: f64 = -0.15;

pub(super) fn check(record: &Record, low_passed: &LowPassed, judgement: &mut Judgement<'_>) {
    held(record, low_passed, judgement);
    pull(record, low_passed, judgement);
}

/// The low-pass reaches over what lasts less than twice its reach: such flights are not seen.
fn held(record: &Record, low_passed: &LowPassed, judgement: &mut Judgement<'_>) {
    let looked = Looked { name: "held_without_feet", allowed: [f64::NEG_INFINITY, HELD_BW], unit: "BW" };
    let nobody = low_passed.instants.iter().filter(|instant| !instant.someone_stands);
    let series: Vec<(f64, f64)> = nobody.map(|i| (i.time_s, i.vertical(record))).collect();
    let Some(found) = lasting(&series, low_passed.step_s, SHORTEST_S) else {
        return judgement.skip(looked, "a foot stands at all times, or flights are short");
    };
    if !judgement.take(looked, found) {
        let message = format!(
            "no foot stands from {:.3} to {:.3} s, yet the motion needs {:.2} body weights or more from below: something else holds the body (a harness, a seat, hands), or a step was not seen",
            found.time_s[0], found.time_s[1], found.value
        );
        judgement.oppose(Check::Support, looked, found, message);
    }
}

fn pull(record: &Record, low_passed: &LowPassed, judgement: &mut Judgement<'_>) {
    let looked = Looked { name: "pull", allowed: [PULL_BW, f64::INFINITY], unit: "BW" };
    let series: Vec<(f64, f64)> = low_passed.instants.iter().map(|i| (i.time_s, -i.vertical(record))).collect();
    let Some(mut found) = lasting(&series, low_passed.step_s, SHORTEST_S) else {
        return judgement.skip(looked, "the recording is too short");
    };
    found.value = -found.value;
    if !judgement.take(looked, found) {
        let message = format!(
            "the motion falls faster than gravity: it needs a pull of {:.2} body weights downwards from {:.3} to {:.3} s, which no floor gives. hint: are the motion's unit and rate right?",
            -found.value, found.time_s[0], found.time_s[1]
        );
        judgement.report(Code::PredictionPull, message);
    }
}
