//! Frames that lack markers.
//!
//! In complete frames every marker has an offset from its place on the model, in the axes of its body. In a run of frames that lack
//! markers the offsets go straight from those of the complete frame before to those of the one after, and the markers that are
//! seen are fitted at their offsets: they agree with each other, so that one more or less moves the posture only by what the
//! offsets changed meanwhile. Fitted without offsets, the posture leaps by the pull of what is missing.
//!
//! An unknown is determined if the seen markers hold it: an error of one metre in each, root mean square, may move it by
//! [`MOST_GAIN`], or by three times as much as in the complete frame. What is not determined follows [`bridge`] for as
//! long as the settings allow, drawn by springs, so that a single marker of a foot still has its say.
//!
//! Pinned by: tests/marker_gaps.rs

use super::bridge;
use super::frames::Frames;
use super::problem::Problem;
use super::solve::Outcome;
use crate::spatial::Vec3;

/// An unknown that moves by more than this for a metre of error in the markers is not determined [rad/m]: 5 mm make 10 degrees.
const MOST_GAIN: f64 = 35.0;
/// An unknown that the complete frame determines badly may be this much worse.
const MOST_LOSS: f64 = 3.0;
/// Stiffness of the springs [m²/rad²]: a marker 10 mm off weighs as much as 0.1 rad off the curve.
const STIFFNESS: f64 = 0.01;

/// What became of each unknown in each frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Markers determine it.
    Determined,
    /// No marker determines it, and a curve leads across.
    Bridged,
    /// No marker determines it for too long, or at an end of the recording.
    Gap,
}

/// Fits the frames that lack markers anew, and complete frames that were fitted otherwise. One state a frame and unknown.
pub(super) fn refit(problem: &mut Problem<'_>, frames: &mut Frames, longest_s: f64) -> Vec<State> {
    let unknowns = problem.tree.unknowns();
    let mut states = vec![State::Determined; frames.count() * unknowns];
    frames.choose_core();
    let complete: Vec<bool> = (0..frames.count()).map(|frame| frames.is_complete(frame)).collect();
    for frame in 0..frames.count() {
        if !complete[frame] || frames.is_plain(frame) {
            continue;
        }
        refit_complete(problem, frames, frame);
    }
    let mut frame = 0;
    while frame < frames.count() {
        let end = (frame..frames.count()).find(|&f| complete[f]).unwrap_or(frames.count());
        if end > frame {
            refit_run(problem, frames, frame, end, &mut states);
        }
        frame = end + 1;
    }
    bridge_all(problem, frames, longest_s, &mut states);
    states
}

fn refit_complete(problem: &mut Problem<'_>, frames: &mut Frames, frame: usize) {
    let Some(mut x) = nearby(frames, frame) else { return };
    frames.load(frame, problem);
    let outcome = problem.fit(&mut x);
    frames.keep(frame, problem, &x, outcome, true);
}

/// The posture of the frame, or of the nearest one that has one.
fn nearby(frames: &Frames, frame: usize) -> Option<Vec<f64>> {
    let has = |f: usize| frames.outcomes[f].is_some();
    let before = (0..=frame).rev().find(|&f| has(f));
    let after = (frame..frames.count()).find(|&f| has(f));
    let nearest = match (before, after) {
        (Some(a), Some(b)) => Some(if frame - a <= b - frame { a } else { b }),
        (a, b) => a.or(b),
    };
    nearest.map(|f| frames.posture(f).to_vec())
}

/// Frames `start..end` lack markers of the core; those beside them do not.
fn refit_run(problem: &mut Problem<'_>, frames: &mut Frames, start: usize, end: usize, states: &mut [State]) {
    let unknowns = problem.tree.unknowns();
    let before = start.checked_sub(1);
    let after = (end < frames.count()).then_some(end);
    let mut usual = vec![0.0; unknowns];
    let Some(reference) = before.or(after) else {
        // No frame at all is complete: what was fitted stays.
        for frame in start..end {
            judge(problem, frames, frame, &vec![0.0; unknowns], states);
        }
        return;
    };
    frames.load(reference, problem);
    let posture = frames.posture(reference).to_vec();
    problem.pose_at(&posture);
    problem.uncertainty(&mut usual);
    let mut offsets = vec![Vec3::zeros(); frames.markers()];
    for frame in start..end {
        frames.load(frame, problem);
        interpolate_offsets(problem, frames, [before, after], frame, &mut offsets);
        let Some(mut x) = nearby(frames, frame) else { continue };
        let outcome = problem.fit_with_offsets(&offsets, &mut x);
        frames.aim(frame, &offsets, &problem.frame_weights);
        frames.keep(frame, problem, &x, outcome, false);
        judge_loaded(problem, frame, &usual, states);
    }
}

/// Offsets on a straight line in time between two frames; markers without any are left out of what is loaded.
fn interpolate_offsets(
    problem: &mut Problem<'_>,
    frames: &Frames,
    ends: [Option<usize>; 2],
    frame: usize,
    offsets: &mut [Vec3],
) {
    for (i, offset) in offsets.iter_mut().enumerate() {
        let at = |end: Option<usize>| {
            let end = end?;
            let offset = frames.offsets(end)[i];
            offset.iter().all(|x| x.is_finite()).then_some((problem.times[end], offset))
        };
        *offset = match (at(ends[0]), at(ends[1])) {
            (Some((t0, a)), Some((t1, b))) => a + (b - a) * ((problem.times[frame] - t0) / (t1 - t0)),
            (Some((_, a)), None) | (None, Some((_, a))) => a,
            (None, None) => {
                problem.frame_weights[i] = 0.0;
                Vec3::zeros()
            }
        };
    }
}

fn judge(problem: &mut Problem<'_>, frames: &Frames, frame: usize, usual: &[f64], states: &mut [State]) {
    frames.load(frame, problem);
    if frames.outcomes[frame].is_none() {
        let unknowns = usual.len();
        states[frame * unknowns..(frame + 1) * unknowns].fill(State::Gap);
        return;
    }
    let posture = frames.posture(frame).to_vec();
    problem.pose_at(&posture);
    judge_loaded(problem, frame, usual, states);
}

/// Notes which unknowns the markers that are loaded do not determine, at the posture of the problem.
fn judge_loaded(problem: &mut Problem<'_>, frame: usize, usual: &[f64], states: &mut [State]) {
    let unknowns = usual.len();
    let mut gains = vec![0.0; unknowns];
    problem.uncertainty(&mut gains);
    for (u, gain) in gains.iter().enumerate() {
        if *gain > MOST_GAIN.max(MOST_LOSS * usual[u]) {
            states[frame * unknowns + u] = State::Gap;
        }
    }
}

/// Leads curves across stretches in which an unknown is not determined, and fits those frames once more on springs.
fn bridge_all(problem: &mut Problem<'_>, frames: &mut Frames, longest_s: f64, states: &mut [State]) {
    let (count, unknowns) = (frames.count(), problem.tree.unknowns());
    let step_s = (problem.times[count - 1] - problem.times[0]) / (count.max(2) - 1) as f64;
    let mut touched = vec![false; count];
    let mut curves = vec![f64::NAN; count * unknowns];
    for u in 0..unknowns {
        let known: Vec<bool> = (0..count).map(|f| states[f * unknowns + u] == State::Determined).collect();
        if known.iter().all(|k| *k) {
            continue;
        }
        let mut values: Vec<f64> = (0..count).map(|f| frames.posture(f)[u]).collect();
        for (start, end) in stretches(&known) {
            touched[start..end].fill(true);
            let inside = start > 0 && end < count;
            let length_s = (end - start) as f64 * step_s;
            if inside && length_s <= longest_s + 0.5 * step_s {
                bridge::fill(&mut values, &known, start, end, step_s);
                (start..end).for_each(|f| states[f * unknowns + u] = State::Bridged);
            } else {
                draw(&mut values, start, end);
            }
            (start..end).for_each(|f| curves[f * unknowns + u] = values[f]);
        }
    }
    for frame in (0..count).filter(|&frame| touched[frame]) {
        fit_on_springs(problem, frames, frame, &curves[frame * unknowns..(frame + 1) * unknowns]);
    }
}

/// Stretches without knowledge, as first frame and end.
fn stretches(known: &[bool]) -> Vec<(usize, usize)> {
    let mut list = Vec::new();
    let mut start = None;
    for (i, known) in known.iter().chain([&true]).enumerate() {
        match (known, start) {
            (false, None) => start = Some(i),
            (true, Some(first)) => {
                list.push((first, i));
                start = None;
            }
            _ => {}
        }
    }
    list
}

/// A straight line across a stretch, level at the ends of the recording: where the other unknowns find the body meanwhile.
fn draw(values: &mut [f64], start: usize, end: usize) {
    let before = start.checked_sub(1).map(|i| values[i]);
    let after = values.get(end).copied();
    let (a, b) = match (before, after) {
        (Some(a), Some(b)) => (a, b),
        (Some(a), None) => (a, a),
        (None, Some(b)) => (b, b),
        (None, None) => return,
    };
    for i in start..end {
        values[i] = a + (b - a) * (i + 1 - start) as f64 / (end + 1 - start) as f64;
    }
}

/// Fits a frame with springs that draw some unknowns to their curves.
fn fit_on_springs(problem: &mut Problem<'_>, frames: &mut Frames, frame: usize, curves: &[f64]) {
    let Some(mut x) = nearby(frames, frame) else { return };
    for (u, curve) in curves.iter().enumerate().filter(|(_, curve)| curve.is_finite()) {
        (problem.bounds.stiffness[u], problem.bounds.anchor[u]) = (STIFFNESS, *curve);
        x[u] = *curve;
    }
    frames.load(frame, problem);
    let mut offsets = frames.targets(frame).to_vec();
    for (i, offset) in offsets.iter_mut().enumerate().filter(|(_, o)| !o.iter().all(|x| x.is_finite())) {
        problem.frame_weights[i] = 0.0;
        *offset = Vec3::zeros();
    }
    let outcome: Outcome = problem.fit_with_offsets(&offsets, &mut x);
    problem.bounds.stiffness.fill(0.0);
    frames.keep(frame, problem, &x, outcome, false);
}
