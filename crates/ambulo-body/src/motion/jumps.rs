//! Jumps in recorded coordinates: whole turns of angles are removed, others are reported.

use super::recording::Motion;
use crate::findings::{Code, Findings, and_more_times};
use crate::model::{CoordinateId, CoordinateKind, Model};
use crate::numerics::median;
use std::f64::consts::{PI, TAU};

/// An angle that is within this of its last value after whole turns are removed did not jump otherwise [rad].
const SAME_ANGLE: f64 = 1.0;
/// A jump is this many times larger than the usual change between the frames around it.
const SUDDEN: f64 = 10.0;
/// Frames before and after a change with which it is compared.
pub(super) const AROUND: usize = 5;
/// Fewer changes than this around a change do not show what is usual.
const ENOUGH_AROUND: usize = 4;

/// Limits above which a change between two frames is a jump, for one kind of coordinate.
struct Limits {
    /// Fastest movement of a person [rad/s or m/s].
    fastest: f64,
    /// A change is a jump above the fastest movement during one frame, between these bounds [rad or m].
    bounds: [f64; 2],
}

const ROTATION: Limits = Limits { fastest: 30.0, bounds: [0.1, 0.3] };

/// Removes changes of angles by whole turns, and whole turns that bring an angle into its range, with a note for each
/// column.
pub(super) fn without_whole_turns(model: &Model, motion: &mut Motion, findings: &mut Findings) {
    for (coordinate, column) in model.coordinates().iter().zip(&mut motion.columns) {
        let (CoordinateKind::Rotation, Some(column)) = (coordinate.kind, column) else { continue };
        let turns = unwrapped(column);
        let beyond = coordinate.range.map_or(0.0, |range| turns_beyond(column, range));
        column.iter_mut().for_each(|x| *x -= beyond * TAU);
        if turns.is_empty() && beyond != 0.0 {
            let message = format!(
                "`{}` was beyond its range by whole turns, {:+.0} deg; they were removed",
                coordinate.name,
                beyond * 360.0
            );
            findings.report(Code::MotionUnwrapped, message);
        }
        if let [first, ..] = turns[..] {
            let message = format!(
                "`{}` jumps by a whole turn {}{}; the turns were removed",
                coordinate.name,
                place(&motion.times, first),
                and_more_times(turns.len())
            );
            findings.report(Code::MotionUnwrapped, message);
        }
    }
}

/// Sudden changes of one coordinate that no person makes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Jumps {
    /// The coordinate that jumps.
    pub coordinate: CoordinateId,
    /// The frames after the changes; at least one.
    pub frames: Vec<usize>,
}

/// The jumps of a motion, without coordinates that have none.
pub fn jumps(model: &Model, motion: &Motion) -> Vec<Jumps> {
    let of_coordinate = |coordinate: CoordinateId| {
        let limits = limits(model.coordinates()[coordinate.index()].kind)?;
        let frames = jumps_of_column(&motion.times, motion.columns[coordinate.index()].as_ref()?, &limits);
        (!frames.is_empty()).then_some(Jumps { coordinate, frames })
    };
    model.coordinate_ids().filter_map(of_coordinate).collect()
}

/// Limits beyond which a coordinate jumps; `None` for a coupled coordinate.
fn limits(kind: CoordinateKind) -> Option<Limits> {
    match kind {
        CoordinateKind::Rotation => Some(ROTATION),
        CoordinateKind::Translation => Some(Limits { fastest: 10.0, bounds: [0.03, 0.1] }),
        CoordinateKind::Coupled => None,
    }
}

/// The change in the middle of successive values [rad or m] if it is a jump.
pub(super) fn jump_in_the_middle(kind: CoordinateKind, values: &[f64], step_s: f64) -> Option<f64> {
    let (limits, middle) = (limits(kind)?, values.len() / 2);
    let change = values[middle] - values[middle - 1];
    // Most changes are smaller than the smallest jump; the others are compared with those around them.
    (change.abs() > limits.bounds[0]).then_some(())?;
    let times: Vec<f64> = (0..values.len()).map(|place| place as f64 * step_s).collect();
    jumps_of_column(&times, values, &limits).contains(&middle).then_some(change)
}

/// Names every other jump.
pub(super) fn report_jumps(model: &Model, motion: &Motion, findings: &mut Findings) {
    for Jumps { coordinate, frames } in jumps(model, motion) {
        let Some(column) = &motion.columns[coordinate.index()] else { continue };
        let coordinate = &model.coordinates()[coordinate.index()];
        let (factor, unit) = match coordinate.kind {
            CoordinateKind::Rotation => (1f64.to_degrees(), "deg"),
            CoordinateKind::Translation | CoordinateKind::Coupled => (1.0, "m"),
        };
        if let [first, ..] = frames[..] {
            let change = factor * (column[first] - column[first - 1]);
            let message = format!(
                "`{}` jumps by {change:.3} {unit} {}{}; its rate, and the forces, are wrong there. hint: correct these \
                 frames, or leave them out",
                coordinate.name,
                place(&motion.times, first),
                and_more_times(frames.len())
            );
            findings.report(Code::MotionJump, message);
        }
    }
}

fn place(times: &[f64], frame: usize) -> String {
    format!("between frames {} and {} ({:.4} s)", frame, frame + 1, times[frame])
}

/// The whole turns in a change of an angle that is one but for a usual change.
pub(super) fn whole_turns(change: f64) -> Option<f64> {
    let whole = (change / TAU).round();
    (change.abs() > PI && (change - whole * TAU).abs() < SAME_ANGLE).then_some(whole)
}

/// Removes whole turns; returns the frames where they began. Most of the angles keep their values.
pub(super) fn unwrapped(column: &mut [f64]) -> Vec<usize> {
    let mut found = Vec::new();
    let (mut turns, mut last) = (0.0, f64::NAN);
    let mut removed = Vec::with_capacity(column.len());
    for (frame, x) in column.iter_mut().enumerate() {
        if let Some(whole) = whole_turns(*x - turns * TAU - last) {
            turns += whole;
            found.push(frame);
        }
        *x -= turns * TAU;
        removed.push(turns);
        if x.is_finite() {
            last = *x;
        }
    }
    let usual = median(removed).unwrap_or(0.0).round();
    column.iter_mut().for_each(|x| *x += usual * TAU);
    found
}

/// Whole turns by which most of the angles are outside a range that they would be inside without; zero if there are
/// none.
fn turns_beyond(column: &[f64], [low, high]: [f64; 2]) -> f64 {
    let Some(usual) = median(column.iter().copied()) else { return 0.0 };
    let turns = ((usual - 0.5 * (low + high)) / TAU).round();
    let is_inside = |angle: f64| (low..=high).contains(&angle);
    if !is_inside(usual) && is_inside(usual - turns * TAU) { turns } else { 0.0 }
}

/// The frames after sudden changes of an angle [rad].
pub(super) fn jumps_of_angle(times: &[f64], angles: &[f64]) -> Vec<usize> {
    jumps_of_column(times, angles, &ROTATION)
}

/// The frames after sudden changes.
fn jumps_of_column(times: &[f64], column: &[f64], limits: &Limits) -> Vec<usize> {
    let changes: Vec<f64> = column.windows(2).map(|pair| (pair[1] - pair[0]).abs()).collect();
    let is_jump = |i: &usize| {
        let [least, most] = limits.bounds;
        let allowed = (limits.fastest * (times[i + 1] - times[*i])).clamp(least, most);
        if changes[*i] <= allowed || !changes[*i].is_finite() {
            return false;
        }
        let from = i.saturating_sub(AROUND);
        let to = (i + AROUND + 1).min(changes.len());
        let around = changes[from..*i].iter().chain(&changes[i + 1..to]).copied().filter(|change| change.is_finite());
        let around: Vec<f64> = around.collect();
        around.len() >= ENOUGH_AROUND && changes[*i] > SUDDEN * median(around).unwrap_or(f64::INFINITY)
    };
    (0..changes.len()).filter(is_jump).map(|i| i + 1).collect()
}
