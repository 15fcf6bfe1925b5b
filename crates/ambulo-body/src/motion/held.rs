//! Held samples: values that repeat the sample before them exactly although the body moves.
//!
//! Programs that play, resample or fill a recording may repeat its last frame: every second frame, 20 frames per second
//! held as 100, the rest of a trial after the cameras stopped, or one marker while it was hidden. Measured values never
//! repeat exactly in motion, in contrast to a smooth movement, whose curves pass through a held stretch with a jump of
//! the velocity.
//!
//! - A **frame** is held if all its values equal those of the frame before, and the change of the values right before
//!   or after the repeated frames is at least [`SUDDEN`] of the usual change between frames. Values that are rounded,
//!   and a person who stands still or comes to rest, repeat without such a change.
//! - A **marker** is held if it repeats at least [`FEWEST`] samples, moves faster than [`MOVING_M_S`] right before or
//!   after, by more than its rounding, and most other markers move meanwhile.
//!
//! Held samples are gaps. Pinned by: tests/motion_held.rs

use super::gaps::{LONGEST_GAP_S, bridge_gaps};
use super::marker_recording::MarkerRecording;
use super::recording::Motion;
use crate::findings::{Code, Findings};
use crate::model::{CoordinateKind, Model};
use crate::numerics::median;
use crate::spatial::Vec3;
use std::ops::Range;

/// The change at an end of a held stretch, as a share of the usual change between frames.
const SUDDEN: f64 = 0.3;
/// A body moves whose markers move further than this, median [m]; people who stand sway less.
const MOVES_M: f64 = 0.05;
/// A body moves of which an angle changes by more than this [rad].
const MOVES_RAD: f64 = 0.1;
/// A marker that repeats fewer samples may be at rest for a moment.
const FEWEST: usize = 2;
/// A marker that a program holds moved faster than this before or afterwards [m/s].
const MOVING_M_S: f64 = 0.3;
/// Changes of fewer steps than this are rounding.
const STEPS: f64 = 3.5;
/// Another marker moves if it travels further than this while one is held [m].
const TRAVELLED_M: f64 = 0.003;
/// Fewer frames do not show how much the values usually change.
const FEWEST_FRAMES: usize = 12;
/// Frames that are repeated regularly: at least this share of the stretches has the most common length.
const REGULAR: f64 = 0.7;
/// Fewer stretches do not show a pattern.
const PATTERN: usize = 5;

/// Makes gaps of the held samples of markers.
pub fn release_held_markers(recording: &mut MarkerRecording, findings: &mut Findings) {
    let spread = recording.markers.iter().map(|marker| extent(&marker.positions));
    if median(spread).is_none_or(|moved| moved < MOVES_M) {
        return;
    }
    let columns: Vec<Vec<f64>> = recording
        .markers
        .iter()
        .flat_map(|marker| (0..3).map(|axis| marker.positions.iter().map(|place| place[axis]).collect()))
        .collect();
    let held = held_frames(&columns.iter().map(Vec::as_slice).collect::<Vec<_>>());
    for marker in &mut recording.markers {
        held.iter().for_each(|run| marker.positions[run.clone()].fill(Vec3::repeat(f64::NAN)));
    }
    report_frames(&recording.times, &held, findings);
    release_single_markers(recording, findings);
}

/// Bridges the held samples of coordinates. Frames that are held at an end of the recording are dropped, and a held
/// stretch that is too long to be bridged is a gap.
pub fn release_held_coordinates(model: &Model, motion: &mut Motion, findings: &mut Findings) {
    let moves = model.coordinates().iter().zip(&motion.columns).any(|(coordinate, column)| {
        let least = match coordinate.kind {
            CoordinateKind::Rotation => MOVES_RAD,
            CoordinateKind::Translation => MOVES_M,
            CoordinateKind::Coupled => return false,
        };
        column.as_ref().is_some_and(|column| range(column) > least)
    });
    let columns: Vec<&[f64]> = motion.columns.iter().flatten().map(Vec::as_slice).collect();
    let held = if moves { held_frames(&columns) } else { Vec::new() };
    if held.is_empty() {
        return;
    }
    report_frames(&motion.times, &held, findings);
    let is_known = |frame: &usize| !held.iter().any(|run| run.contains(frame));
    let frames = motion.times.len();
    let kept = (0..frames).find(is_known).unwrap_or(0)..(0..frames).rfind(is_known).map_or(frames, |last| last + 1);
    for column in motion.columns.iter_mut().flatten() {
        held.iter().for_each(|run| column[run.clone()].fill(f64::NAN));
        *column = column[kept.clone()].to_vec();
    }
    motion.times = motion.times[kept].to_vec();
    let times = &motion.times;
    motion.columns.iter_mut().flatten().for_each(|column| drop(bridge_gaps(times, column, LONGEST_GAP_S)));
}

/// The stretches of frames that repeat the frame before them while the values change.
fn held_frames(columns: &[&[f64]]) -> Vec<Range<usize>> {
    let ranges: Vec<f64> = columns.iter().map(|column| range(column)).collect();
    let moving: Vec<(&[f64], f64)> =
        columns.iter().copied().zip(ranges).filter(|(_, range)| *range > 0.0 && range.is_finite()).collect();
    let frames = columns.first().map_or(0, |column| column.len());
    if frames < FEWEST_FRAMES {
        return Vec::new();
    }
    let changes: Vec<Option<f64>> = (1..frames).map(|frame| change(&moving, frame)).collect();
    let Some(usual) = median(changes.iter().flatten().copied()) else { return Vec::new() };
    let is_sudden = |pair: Option<usize>| {
        let change = pair.and_then(|pair| *changes.get(pair)?);
        change.is_some_and(|change| change >= SUDDEN * usual)
    };
    runs(frames, |frame| changes[frame - 1].is_none())
        .into_iter()
        .filter(|run| moving.iter().any(|(column, _)| column[run.start].is_finite()))
        .filter(|run| is_sudden(run.start.checked_sub(2)) || is_sudden(Some(run.end - 1)))
        .collect()
}

/// Mean change from the frame before, relative to the range of each column; `None` if nothing changes.
fn change(columns: &[(&[f64], f64)], frame: usize) -> Option<f64> {
    let same = |(column, _): &(&[f64], f64)| {
        let [before, now] = [column[frame - 1], column[frame]];
        before.to_bits() == now.to_bits() || before.is_nan() && now.is_nan()
    };
    if columns.iter().all(same) {
        return None;
    }
    let changes = columns.iter().map(|(column, range)| (column[frame] - column[frame - 1]).abs() / range);
    let known: Vec<f64> = changes.filter(|change| change.is_finite()).collect();
    Some(known.iter().sum::<f64>() / known.len().max(1) as f64)
}

/// Stretches of frames, from the second one on, for which something holds.
fn runs(frames: usize, holds: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let all: Vec<usize> = (1..frames).collect();
    let stretches = all.chunk_by(|a, b| holds(*a) == holds(*b));
    stretches.filter(|run| holds(run[0])).filter_map(|run| Some(*run.first()?..run.last()? + 1)).collect()
}

fn range(values: &[f64]) -> f64 {
    let known = || values.iter().copied().filter(|value| value.is_finite());
    known().fold(f64::NEG_INFINITY, f64::max) - known().fold(f64::INFINITY, f64::min)
}

/// Diagonal of the box around a path [m].
fn extent(path: &[Vec3]) -> f64 {
    let side = |axis: usize| range(&path.iter().map(|place| place[axis]).collect::<Vec<f64>>());
    Vec3::new(side(0), side(1), side(2)).norm()
}

// ---- single markers ----

fn release_single_markers(recording: &mut MarkerRecording, findings: &mut Findings) {
    let step = smallest_change(recording);
    let found: Vec<(usize, Vec<Range<usize>>)> = (0..recording.markers.len())
        .map(|marker| (marker, held_of_marker(recording, marker, step)))
        .filter(|(_, runs)| !runs.is_empty())
        .collect();
    let mut named = Vec::new();
    for (marker, runs) in &found {
        let path = &mut recording.markers[*marker];
        runs.iter().for_each(|run| path.positions[run.clone()].fill(Vec3::repeat(f64::NAN)));
        let frames: usize = runs.iter().map(ExactSizeIterator::len).sum();
        named.push(format!("`{}` {frames} frames from {:.3} s", path.name, recording.times[runs[0].start]));
    }
    if !named.is_empty() {
        let message = format!(
            "markers stay exactly in place while the others move, as if a gap had been filled by holding the last \
             position; these samples were treated as gaps: {}",
            named.join(", ")
        );
        findings.report(Code::MarkersHeldInPlace, message);
    }
}

/// The smallest change of any coordinate: the resolution of the file [m].
fn smallest_change(recording: &MarkerRecording) -> f64 {
    let paths = recording.markers.iter().map(|marker| &marker.positions);
    let changes = paths.flat_map(|path| path.windows(2).flat_map(|pair| [0, 1, 2].map(|i| pair[1][i] - pair[0][i])));
    changes.map(f64::abs).filter(|change| *change > 0.0).fold(f64::INFINITY, f64::min)
}

fn held_of_marker(recording: &MarkerRecording, marker: usize, step: f64) -> Vec<Range<usize>> {
    let path = &recording.markers[marker].positions;
    let moved = |from: usize, to: usize| Some((path.get(to)? - path.get(from)?).norm());
    let moves = |from: Option<usize>, to: usize| {
        let Some((from, moved)) = from.and_then(|from| Some((from, moved(from, to)?))) else { return false };
        let time_s = recording.times.get(to).map_or(f64::NAN, |t| t - recording.times[from]);
        moved > MOVING_M_S * time_s && moved > STEPS * step
    };
    let others_travel = |run: &Range<usize>| {
        let travelled = |other: &Vec<Vec3>| (other[run.end - 1] - other[run.start - 1]).norm();
        let others = (0..recording.markers.len()).filter(|other| *other != marker);
        let known: Vec<f64> =
            others.map(|other| travelled(&recording.markers[other].positions)).filter(|way| way.is_finite()).collect();
        2 * known.iter().filter(|way| **way > TRAVELLED_M).count() > known.len()
    };
    runs(path.len(), |frame| path[frame] == path[frame - 1])
        .into_iter()
        .filter(|run| run.len() >= FEWEST && others_travel(run))
        .filter(|run| moves(run.start.checked_sub(2), run.start - 1) || moves(Some(run.end - 1), run.end))
        .collect()
}

// ---- words ----

fn report_frames(times: &[f64], held: &[Range<usize>], findings: &mut Findings) {
    let Some(first) = held.first() else { return };
    let count: usize = held.iter().map(ExactSizeIterator::len).sum();
    let message = format!(
        "{count} of {} frames repeat the frame before them exactly while the body moves, the first at {:.3} s: {}; \
         they \
         were treated as gaps",
        times.len(),
        times[first.start],
        pattern(times, held)
    );
    findings.report(Code::MotionHeldFrames, message);
}

/// What held frames look like.
fn pattern(times: &[f64], held: &[Range<usize>]) -> String {
    let duration_s = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    let rate_hz = (times.len() - 1) as f64 / duration_s;
    let (first, last) = (&held[0], &held[held.len() - 1]);
    let inside = last.end + 1 - first.start;
    let count: usize = held.iter().map(ExactSizeIterator::len).sum();
    let true_hz = rate_hz * (inside - count.min(inside - 1)) as f64 / inside as f64;
    let is_regular = |length: usize| {
        let is_next = |pair: &&[Range<usize>]| pair[1].start - pair[0].start == length + 1;
        held.windows(2).filter(is_next).count() as f64 >= REGULAR * (held.len() - 1) as f64
    };
    let longest = held.iter().max_by_key(|run| run.len()).unwrap_or(first);
    let lasts_s = times[longest.end - 1] - times[longest.start - 1];
    match held.len() {
        PATTERN.. if is_regular(1) => "every second frame is the one before it".to_owned(),
        PATTERN.. if lasts_s < LONGEST_GAP_S => {
            format!("it looks like {true_hz:.0} frames per second that were held as {rate_hz:.0}")
        }
        _ if longest.end == times.len() => format!("the motion is frozen from {:.3} s on", times[longest.start - 1]),
        1 if longest.len() == 1 => "one doubled frame".to_owned(),
        _ => format!(
            "{} stretches, the longest from {:.3} to {:.3} s",
            held.len(),
            times[longest.start - 1],
            times[longest.end - 1]
        ),
    }
}
