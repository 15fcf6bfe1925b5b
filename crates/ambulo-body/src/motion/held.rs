//! Held samples: values that repeat the sample before them exactly although the body moves.
//!
//! Programs that play, resample or fill a recording may repeat its last frame: every second frame, 20 frames per second
//! held as 100, the rest of a trial after the cameras stopped, or one marker while it was hidden. Measured values never
//! repeat exactly in motion, and the velocity jumps at the ends of a held stretch, as it does in no smooth movement.
//!
//! - A **frame** is held if all its values equal those of the frame before, and the change of the values right before
//!   or after the repeated frames is at least [`SUDDEN`] of the usual change between frames. Values that are rounded,
//!   and a person who stands still or comes to rest, repeat without such a change.
//! - A **marker** is held if it repeats at least [`FEWEST`] samples, moves faster than [`MOVING_M_S`] right before or
//!   after, by more than its rounding, and most other markers move meanwhile.
//!
//! Held samples are gaps. Sensors and poses of segments are judged by points that are fixed to them: the tips of two
//! axes of unit length, so that a distance of 1 m is a turn of 1 rad, and the origin of a pose.
//!
//! Pinned by: tests/motion_held.rs

use super::drawn::release_drawn_markers;
use super::gaps::{LONGEST_GAP_S, bridge_gaps};
use super::marker_recording::{MarkerPath, MarkerRecording};
use super::recording::Motion;
use super::segment_poses::{SegmentPoses, in_words};
use super::sensor_recording::SensorRecording;
use crate::findings::{Code, Findings};
use crate::model::{CoordinateKind, Model};
use crate::numerics::{counted, median};
use crate::spatial::{Mat3, Pose, Vec3};
use std::ops::Range;

/// The change at an end of a held stretch, as a share of the usual change between frames.
const SUDDEN: f64 = 0.3;
/// The body moves if the median marker moves further than this [m]; the sway of people who stand is smaller.
const MOVES_M: f64 = 0.05;
/// The body moves if an angle changes by more than this [rad].
const MOVES_RAD: f64 = 0.1;
/// A marker that repeats fewer samples may be at rest for a moment.
const FEWEST: usize = 2;
/// Least speed of a marker before or after a stretch in which a program holds it [m/s].
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

/// Makes gaps of the held samples of markers, and of those on lines that were drawn through gaps.
pub fn release_held_markers(recording: &mut MarkerRecording, findings: &mut Findings) {
    release(recording, "markers", findings);
    release_drawn_markers(recording, findings);
}

/// Makes gaps of the held samples of sensors, and drops the frames at both ends that have no sample afterwards.
pub fn release_held_sensors(sensors: &mut SensorRecording, findings: &mut Findings) {
    let of = |orientation: &Option<Mat3>, axis: usize| {
        orientation.map_or(Vec3::repeat(f64::NAN), |orientation| orientation.column(axis).into())
    };
    let paths = sensors.sensors.iter().flat_map(|sensor| {
        [0, 1].map(|axis| MarkerPath {
            name: sensor.name.clone(),
            positions: sensor.orientations.iter().map(|orientation| of(orientation, axis)).collect(),
        })
    });
    let mut tips = points(&sensors.times, paths.collect());
    if !release(&mut tips, "sensors", findings) {
        return;
    }
    for (sensor, tips) in sensors.sensors.iter_mut().zip(tips.markers.as_chunks::<2>().0) {
        hide(&mut sensor.orientations, tips);
    }
    let is_known = |frame: &usize| sensors.sensors.iter().any(|sensor| sensor.orientations[*frame].is_some());
    let frames = sensors.times.len();
    let kept = (0..frames).find(is_known).unwrap_or(0)..(0..frames).rfind(is_known).map_or(frames, |last| last + 1);
    sensors.times = sensors.times[kept.clone()].to_vec();
    sensors.sensors.iter_mut().for_each(|sensor| sensor.orientations = sensor.orientations[kept.clone()].to_vec());
}

/// Makes gaps of the held samples of poses; returns whether there were any.
pub fn release_held_poses(poses: &mut SegmentPoses, findings: &mut Findings) -> bool {
    let missing = Vec3::repeat(f64::NAN);
    let paths = poses.segments.iter().flat_map(|(segment, path)| {
        let of = |place: fn(&Pose) -> Vec3| MarkerPath {
            name: in_words(*segment),
            positions: path.iter().map(|pose| pose.as_ref().map_or(missing, place)).collect(),
        };
        [of(|pose| pose.translation), of(|pose| pose.place(Vec3::x())), of(|pose| pose.place(Vec3::y()))]
    });
    let mut fixed = points(&poses.times, paths.collect());
    let is_held = release(&mut fixed, "segments", findings);
    for ((_, path), points) in poses.segments.iter_mut().zip(fixed.markers.as_chunks::<3>().0) {
        hide(path, points);
    }
    is_held
}

/// Points that are fixed to sensors or segments.
fn points(times: &[f64], markers: Vec<MarkerPath>) -> MarkerRecording {
    let duration_s = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    let rate_hz = times.len().saturating_sub(1) as f64 / duration_s.max(f64::MIN_POSITIVE);
    MarkerRecording { name: String::new(), rate_hz, times: times.to_vec(), markers }
}

/// Removes samples that repeat the one before them and of which a point was released.
fn hide<T: Clone + PartialEq>(samples: &mut [Option<T>], points: &[MarkerPath]) {
    let recorded = samples.to_vec();
    for frame in 1..samples.len() {
        if recorded[frame] == recorded[frame - 1] && points.iter().any(|point| !point.is_seen(frame)) {
            samples[frame] = None;
        }
    }
}

/// Makes gaps of the held samples of markers, or of points of the named things; returns whether there were any.
fn release(recording: &mut MarkerRecording, things: &str, findings: &mut Findings) -> bool {
    let spread = recording.markers.iter().map(|marker| extent(&marker.positions));
    if median(spread).is_none_or(|moved| moved < MOVES_M) {
        return false;
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
    release_single_markers(recording, things, findings) || !held.is_empty()
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

/// Finds the stretches of frames that repeat the frame before them, in a recording whose values change otherwise.
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

/// Returns the mean change from the frame before, relative to the range of each column, or `None` if nothing changes.
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

/// Finds the stretches of frames, from the second one on, that have a property.
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

fn release_single_markers(recording: &mut MarkerRecording, things: &str, findings: &mut Findings) -> bool {
    let step = recording.resolution_m();
    let found: Vec<(usize, Vec<Range<usize>>)> = (0..recording.markers.len())
        .map(|marker| (marker, held_of_marker(recording, marker, step)))
        .filter(|(_, runs)| !runs.is_empty())
        .collect();
    let mut named = Vec::new();
    for (marker, runs) in &found {
        let path = &mut recording.markers[*marker];
        runs.iter().for_each(|run| path.positions[run.clone()].fill(Vec3::repeat(f64::NAN)));
        let frames: usize = runs.iter().map(ExactSizeIterator::len).sum();
        named.push(format!(
            "`{}` {} from {:.3} s",
            path.name,
            counted(frames, "frame"),
            recording.times[runs[0].start]
        ));
    }
    named.dedup();
    if !named.is_empty() {
        let message = format!(
            "{things} stay exactly in place while the others move, as if a gap had been filled by holding the last \
             position; these samples were treated as gaps: {}",
            named.join(", ")
        );
        findings.report(Code::MarkersHeldInPlace, message);
    }
    !named.is_empty()
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
         they were treated as gaps",
        times.len(),
        times[first.start],
        pattern(times, held)
    );
    findings.report(Code::MotionHeldFrames, message);
}

/// Describes the pattern of held frames in words, such as the frame rate at which they were recorded.
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
