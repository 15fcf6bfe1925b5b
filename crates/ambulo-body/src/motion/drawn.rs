//! Gaps that a program filled by a straight line at constant speed.
//!
//! A measured path has noise and curves. One that is straight to the resolution of the file, for 0.1 s and on a way of
//! 10 mm or more, was drawn, if the marker's other stretches of that length are curved and other markers do not follow
//! lines meanwhile. Its samples are gaps: the other markers show the body better than a line does.
//!
//! Pinned by: tests/motion_held.rs

use super::marker_recording::MarkerRecording;
use crate::findings::{Code, Findings};
use crate::numerics::{counted, median};
use crate::spatial::Vec3;
use std::ops::Range;

/// Shortest line [s], and its fewest samples.
const SHORTEST_S: f64 = 0.1;
const FEWEST: usize = 8;
/// Shortest way of a line [m]; a marker may be at rest.
const TRAVELLED_M: f64 = 0.01;
/// Other stretches of the marker are curved by so many times the resolution.
const CURVED: f64 = 10.0;

/// Makes gaps of straight lines in the paths of single markers.
pub(super) fn release_drawn_markers(recording: &mut MarkerRecording, findings: &mut Findings) {
    let resolution_m = recording.resolution_m();
    let found: Vec<(usize, Vec<Range<usize>>)> =
        (0..recording.markers.len()).map(|marker| (marker, lines(recording, marker, resolution_m))).collect();
    let mut named = Vec::new();
    for (marker, lines) in found.iter().filter(|(_, lines)| !lines.is_empty()) {
        let path = &mut recording.markers[*marker];
        lines.iter().for_each(|line| path.positions[line.clone()].fill(Vec3::repeat(f64::NAN)));
        let frames = counted(lines.iter().map(ExactSizeIterator::len).sum(), "frame");
        named.push(format!("`{}` {frames} from {:.3} s", path.name, recording.times[lines[0].start]));
    }
    if !named.is_empty() {
        let message = format!(
            "markers follow a straight line at constant speed while the others do not, as if a gap had been filled by \
             a line; these samples were treated as gaps: {}. hint: leave gaps open, or fill them from other markers of \
             the segment",
            named.join(", ")
        );
        findings.report(Code::MarkersDrawn, message);
    }
}

/// The samples inside of the lines of a marker; their ends were measured.
fn lines(recording: &MarkerRecording, marker: usize, resolution_m: f64) -> Vec<Range<usize>> {
    let path = &recording.markers[marker].positions;
    let farthest_m = path.iter().map(Vec3::amax).filter(|x| x.is_finite()).fold(0.0, f64::max);
    // Files have single precision.
    let least_m = resolution_m + 4.0 * f64::from(f32::EPSILON) * farthest_m;
    let is_straight = |i: usize| (path[i - 1] - 2.0 * path[i] + path[i + 1]).amax() <= 2.0 * least_m;
    let inner: Vec<usize> = (1..path.len().saturating_sub(1)).collect();
    let stretches = inner.chunk_by(|a, b| is_straight(*a) == is_straight(*b)).filter(|run| is_straight(run[0]));
    let fewest = FEWEST.max((SHORTEST_S * recording.rate_hz).ceil() as usize);
    let is_drawn = |run: &Range<usize>| {
        let [from, to] = [run.start - 1, run.end];
        if bend_m(&path[from..=to]) > least_m || (path[to] - path[from]).norm() < TRAVELLED_M {
            return false;
        }
        let curved = |path: &[Vec3], from: usize| bend_m(&path[from..from + run.len() + 2]);
        let starts = (0..path.len().saturating_sub(run.len() + 1)).step_by(run.len().div_ceil(2));
        let apart = starts.filter(|start| start + run.len() < from || *start > to);
        let usual_m = median(apart.map(|start| curved(path, start)).filter(|bend| bend.is_finite()));
        let others = recording.markers.iter().enumerate().filter(|(other, _)| *other != marker);
        let bends: Vec<f64> = others.map(|(_, other)| curved(&other.positions, from)).collect();
        let together = bends.iter().filter(|bend| **bend <= least_m).count();
        usual_m.is_some_and(|usual| usual > CURVED * least_m) && 3 * together <= bends.len()
    };
    let runs = stretches.filter_map(|run| Some(*run.first()?..run.last()? + 1));
    runs.filter(|run| run.len() >= fewest && is_drawn(run)).collect()
}

/// The largest distance from the straight line at constant speed between both ends [m]; not a number with gaps.
fn bend_m(path: &[Vec3]) -> f64 {
    let [Some(first), Some(last)] = [path.first(), path.last()] else { return f64::NAN };
    let off =
        |(i, place): (usize, &Vec3)| (place - first - (last - first) * (i as f64 / (path.len() - 1) as f64)).amax();
    path.iter().enumerate().map(off).fold(0.0, |largest: f64, off| if off <= largest { largest } else { off })
}
