//! Checks the forces against the motion of the mass centre: weight and impulse over whole gait cycles.

use super::CheckedPrediction;
use super::judgement::{Criterion, Judgement, TimedValue};
use super::record::Record;
use crate::findings::Code;
use crate::model::Side;
use crate::spatial::{STANDARD_GRAVITY, Vec3};
use std::ops::Range;

/// Speed over the floor below which the person stays in place [m/s].
const UNDER_WAY_M_S: f64 = 0.2;

/// Allowed difference of the mean vertical force from body weight, as a share of it.
const WEIGHT_SHARE: f64 = 0.05;
/// Allowed difference of the mean force of the feet along the walking direction from m Δv / T [body weights].
const ALONG_BW: f64 = 0.03;

/// Mean forces over whole cycles.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Balance {
    /// Start and end [s].
    time_s: [f64; 2],
    /// Mean vertical force of both feet [body weights].
    feet: f64,
    /// Mean vertical force that the motion needs [body weights].
    total: f64,
    /// Mean force of the feet along the walking direction less m Δv / T [body weights]; `None` if the person stays in
    /// place.
    along: Option<f64>,
}

pub(super) fn check(evidence: &CheckedPrediction<'_>, record: &Record, judgement: &mut Judgement<'_>) {
    let weight = [1.0 - WEIGHT_SHARE, 1.0 + WEIGHT_SHARE];
    let feet = Criterion { name: "vertical_force_feet", allowed: weight, unit: "BW" };
    let needed = Criterion { name: "vertical_force_needed", ..feet };
    let along = Criterion { name: "fore_aft_impulse", allowed: [-ALONG_BW, ALONG_BW], unit: "BW" };
    let Some(balance) = balance(evidence, record) else {
        return [feet, needed, along]
            .into_iter()
            .for_each(|criterion| judgement.skip(criterion, "no whole gait cycle"));
    };
    let time_s = balance.time_s;
    for (criterion, value, source) in
        [(feet, balance.feet, "on the feet"), (needed, balance.total, "that the motion needs")]
    {
        if !judgement.take(criterion, TimedValue { value, time_s }) {
            let message = format!(
                "the mean vertical force {source} is {value:.2} body weights over whole gait cycles ({:.3} to {:.3} \
                 s); expected 1.00",
                time_s[0], time_s[1]
            );
            judgement.report(Code::PredictionWeight, message);
        }
    }
    let Some(value) = balance.along else { return judgement.skip(along, "the person stays in place") };
    if !judgement.take(along, TimedValue { value, time_s }) {
        let message = format!(
            "the mean force on the feet along the walking direction differs by {value:+.3} body weights from the rate \
             of change of momentum ({:.3} to {:.3} s)",
            time_s[0], time_s[1]
        );
        judgement.report(Code::PredictionImpulse, message);
    }
}

/// Means over all whole cycles together; without any, over the whole recording if it begins and ends at rest.
fn balance(evidence: &CheckedPrediction<'_>, record: &Record) -> Option<Balance> {
    let frames = whole_cycles(evidence, record).or_else(|| at_rest(record))?;
    let duration = (frames.end - 1 - frames.start) as f64 * record.grid.step_s;
    let force = |frame: usize| evidence.prediction.ground.bodies.iter().map(|foot| foot.force[frame]).sum::<Vec3>();
    let feet = mean(&frames, force) / record.weight;
    let total = mean(&frames, |frame| record.total[frame].force) / record.weight;
    let way = mean(&frames, |frame| record.velocity[frame]);
    let way = way - record.up * way.dot(&record.up);
    let gravity = evidence.model.gravity().norm();
    let along = (way.norm() > UNDER_WAY_M_S).then(|| {
        let change = record.velocity[frames.end - 1] - record.velocity[frames.start];
        (feet - change / (duration * gravity)).dot(&way.normalize())
    });
    let time_s = [frames.start, frames.end - 1].map(|frame| record.grid.time(frame));
    Some(Balance { time_s, feet: feet.dot(&record.up), total: total.dot(&record.up), along })
}

/// Time from the first to the last strike of a foot's whole cycles; the longer one of both feet.
fn whole_cycles(evidence: &CheckedPrediction<'_>, record: &Record) -> Option<Range<usize>> {
    let frame = |time: f64| ((time - record.grid.start_s) / record.grid.step_s).round().max(0.0) as usize;
    let of_side = |side| {
        let cycles = || evidence.cycles.iter().filter(move |cycle| cycle.side == side);
        let start = cycles().map(|cycle| cycle.start_s).min_by(f64::total_cmp)?;
        let end = cycles().map(|cycle| cycle.end_s).max_by(f64::total_cmp)?;
        Some(frame(start)..(frame(end) + 1).min(record.grid.frames))
    };
    let spans = Side::BOTH.into_iter().filter_map(of_side).filter(|span| span.len() > 2);
    spans.max_by_key(Range::len)
}

/// The whole recording, if the change of vertical velocity changes the mean force by less than 1 %.
fn at_rest(record: &Record) -> Option<Range<usize>> {
    const SHARE: f64 = 0.01;
    let frames = 0..record.grid.frames;
    let (first, last) = (record.velocity.first()?, record.velocity.last()?);
    let change = (last - first).dot(&record.up).abs();
    let duration = frames.len().saturating_sub(1) as f64 * record.grid.step_s;
    (frames.len() > 2 && change < SHARE * STANDARD_GRAVITY * duration).then_some(frames)
}

/// Mean over time, by the trapezium rule; at least two frames.
fn mean(frames: &Range<usize>, value: impl Fn(usize) -> Vec3) -> Vec3 {
    let (first, last) = (frames.start, frames.end - 1);
    let inner: Vec3 = (first + 1..last).map(&value).sum();
    (inner + (value(first) + value(last)) * 0.5) / (last - first) as f64
}
