//! Frames that lack markers.
//!
//! In complete frames every marker has an offset from its place on the model, in the axes of its body. In a run of frames that lack
//! markers the offsets are what the posture makes of them ([`Sliding`]), and the rest goes straight from the complete frame before to the
//! one after. The frames are fitted twice:
//!
//! 1. to the markers that are seen, at their offsets: these agree with each other, so that one more or less moves the posture
//!    only by what the offsets changed meanwhile. Each counts by how far its offset strays ([`Strays`]). Fitted without offsets,
//!    the posture leaps by the pull of what is missing;
//! 2. to the markers that are seen, as they are, and to the missing ones where the first posture has them at their offsets. So parts
//!    of the body that miss nothing are fitted as ever, and all is continuous where the run begins and ends.
//!
//! Between both, unknowns that the seen markers do not determine follow a curve ([`bridge`]), drawn by springs, so that a single
//! marker of a foot still has its say. An error of one metre in each seen marker, root mean square, moves an unknown by its gain: above
//! [`LOOSE`] the curve helps, above [`UNSEEN`] nothing is known and the curve leads across for as long as the settings allow.
//!
//! Pinned by: tests/marker_gaps.rs

use super::bridge;
use super::frames::Frames;
use super::problem::Problem;
use super::sliding::Sliding;
use super::solve::Outcome;
use super::strays::{self, Strays};
use crate::spatial::Vec3;

/// Gain above which a curve helps [rad/m]: 5 mm make 7 degrees.
const LOOSE: f64 = 25.0;
/// Gain above which an unknown is not determined [rad/m]: 5 mm make 30 degrees.
const UNSEEN: f64 = 100.0;
/// Both count only above this multiple of the gain in the complete frame.
const LOSS: f64 = 3.0;
/// How far a marker's offset strays from a straight line in time [m].
const STRAY: f64 = strays::LEAST;
/// Fits of a frame at most, each with the offsets of the posture found before.
const PASSES: usize = 30;
/// The posture rests when no unknown moves by more from one to the next [rad or m].
const REST: f64 = 1e-7;
/// Third derivative of a joint's angle [rad/s³]: 0.3 rad at 2 Hz have 0.3 (4π)³.
const JERK: f64 = 600.0;

/// What became of each unknown in each frame.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum State {
    /// Markers determine it.
    Determined,
    /// Markers determine it badly, and a curve helps.
    Loose,
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
    let sliding = Sliding::learn(problem, frames, &complete);
    let mut strays = Strays::default();
    // Weight of each marker in frames that lack some.
    let mut weights = vec![0.0; frames.count() * frames.markers()];
    let mut frame = 0;
    while frame < frames.count() {
        let end = (frame..frames.count()).find(|&f| complete[f]).unwrap_or(frames.count());
        if end > frame {
            let own = gap_weights(problem, strays.in_gap(frames, &sliding, &complete, end + 1 - frame));
            for slots in weights.chunks_mut(frames.markers()).skip(frame).take(end - frame) {
                slots.copy_from_slice(&own);
            }
            refit_run(problem, frames, &sliding, (frame, end), &own, &mut states);
        }
        frame = end + 1;
    }
    bridge_all(problem, frames, longest_s, &weights, &mut states);
    for frame in (0..frames.count()).filter(|&frame| !complete[frame]) {
        if !states[frame * unknowns..(frame + 1) * unknowns].contains(&State::Gap) {
            fit_as_if_seen(problem, frames, frame);
        }
    }
    states
}

/// The inverse square of what each marker strays, 1 for [`STRAY`]; its own weight where that is not known.
fn gap_weights(problem: &Problem<'_>, strays: &[f64]) -> Vec<f64> {
    let weight = |(stray, own): (&f64, &f64)| if stray.is_finite() { (STRAY / stray).powi(2) } else { *own };
    strays.iter().zip(&problem.weights).map(weight).collect()
}

/// Loads what is believed in a frame, with these weights.
fn load_weighted(problem: &mut Problem<'_>, frames: &Frames, frame: usize, weights: &[f64]) {
    frames.load(frame, problem);
    for (loaded, weight) in problem.frame_weights.iter_mut().zip(weights).filter(|(loaded, _)| **loaded > 0.0) {
        *loaded = *weight;
    }
}

fn refit_complete(problem: &mut Problem<'_>, frames: &mut Frames, frame: usize) {
    let Some(mut x) = nearby(frames, frame) else { return };
    frames.load(frame, problem);
    let outcome = problem.fit(&mut x);
    frames.keep(frame, problem, &x, outcome, true);
}

/// The posture of the frame, or of the last one before it that has one, or of the first after it.
fn nearby(frames: &Frames, frame: usize) -> Option<Vec<f64>> {
    let has = |f: &usize| frames.outcomes[*f].is_some();
    let before = (0..=frame).rev().find(has);
    let found = before.or_else(|| (frame..frames.count()).find(has));
    found.map(|f| frames.posture(f).to_vec())
}

/// Frames `start..end` lack markers of the core; those beside them do not.
fn refit_run(
    problem: &mut Problem<'_>,
    frames: &mut Frames,
    sliding: &Sliding,
    (start, end): (usize, usize),
    weights: &[f64],
    states: &mut [State],
) {
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
    load_weighted(problem, frames, reference, weights);
    let posture = frames.posture(reference).to_vec();
    problem.pose_at(&posture);
    problem.uncertainty(&mut usual);
    let mut offsets = vec![Vec3::zeros(); frames.markers()];
    for frame in start..end {
        let Some(mut x) = nearby(frames, frame) else { continue };
        let mut outcome = None;
        // How far markers slid depends on the posture that is sought.
        for _ in 0..PASSES {
            load_weighted(problem, frames, frame, weights);
            interpolate_offsets(problem, frames, sliding, [before, after], (frame, &x), &mut offsets);
            frames.aim(frame, &offsets);
            let known = known_offsets(problem, frames, frame);
            let before = x.clone();
            outcome = Some(problem.fit_with_offsets(&known, &mut x));
            if x.iter().zip(&before).all(|(now, before)| (now - before).abs() < REST) {
                break;
            }
        }
        let Some(outcome) = outcome else { continue };
        frames.keep(frame, problem, &x, outcome, false);
        judge_loaded(problem, frame, &usual, states);
    }
}

/// What the posture `x` makes of each marker's offset, and the rest on a straight line in time between two frames; not a number for
/// markers without any.
fn interpolate_offsets(
    problem: &Problem<'_>,
    frames: &Frames,
    sliding: &Sliding,
    ends: [Option<usize>; 2],
    (frame, x): (usize, &[f64]),
    offsets: &mut [Vec3],
) {
    for (i, offset) in offsets.iter_mut().enumerate() {
        let at = |end: Option<usize>| {
            let end = end?;
            let offset = frames.offsets(end)[i] - sliding.at(i, frames.posture(end)) + sliding.at(i, x);
            offset.iter().all(|x| x.is_finite()).then_some((problem.times[end], offset))
        };
        *offset = match (at(ends[0]), at(ends[1])) {
            (Some((t0, a)), Some((t1, b))) => a + (b - a) * ((problem.times[frame] - t0) / (t1 - t0)),
            (Some((_, a)), None) | (None, Some((_, a))) => a,
            (None, None) => Vec3::repeat(f64::NAN),
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
        let usual = LOSS * usual[u];
        if *gain > LOOSE.max(usual) {
            states[frame * unknowns + u] = if *gain > UNSEEN.max(usual) { State::Gap } else { State::Loose };
        }
    }
}

/// Leads curves across stretches in which an unknown is badly determined, and fits those frames once more on springs.
fn bridge_all(problem: &mut Problem<'_>, frames: &mut Frames, longest_s: f64, weights: &[f64], states: &mut [State]) {
    let markers = frames.markers();
    let (count, unknowns) = (frames.count(), problem.tree.unknowns());
    let step_s = (problem.times[count - 1] - problem.times[0]) / (count.max(2) - 1) as f64;
    let mut touched = vec![false; count];
    // Value and stiffness of each spring.
    let mut springs = vec![(f64::NAN, 0.0); count * unknowns];
    for u in 0..unknowns {
        let known: Vec<bool> = (0..count).map(|f| states[f * unknowns + u] == State::Determined).collect();
        if known.iter().all(|k| *k) {
            continue;
        }
        let mut values: Vec<f64> = (0..count).map(|f| frames.posture(f)[u]).collect();
        for (start, end) in stretches(&known) {
            touched[start..end].fill(true);
            let length_s = (end - start) as f64 * step_s;
            if start > 0 && end < count {
                bridge::fill(&mut values, &known, start, end, step_s);
            } else {
                draw(&mut values, start, end);
            }
            bridge_gaps(&mut states[u..], unknowns, [start, end, count], longest_s + 0.5 * step_s, step_s);
            (start..end).for_each(|f| springs[f * unknowns + u] = (values[f], stiffness(length_s)));
        }
    }
    for frame in (0..count).filter(|&frame| touched[frame]) {
        let springs = &springs[frame * unknowns..(frame + 1) * unknowns];
        fit_on_springs(problem, frames, frame, &weights[frame * markers..(frame + 1) * markers], springs);
    }
}

/// Of the stretch, what is not seen for a short time is bridged.
fn bridge_gaps(states: &mut [State], stride: usize, [start, end, count]: [usize; 3], longest_s: f64, step_s: f64) {
    let seen: Vec<bool> = (start..end).map(|f| states[f * stride] != State::Gap).collect();
    for (a, b) in stretches(&seen) {
        let inside = start + a > 0 && start + b < count;
        if inside && (b - a) as f64 * step_s <= longest_s {
            (start + a..start + b).for_each(|f| states[f * stride] = State::Bridged);
        }
    }
}

/// Weight of a curve across a stretch [s] against markers [m²/rad²]: its error grows as that of a parabola under jerk, J (T/2)³ / 6.
fn stiffness(length_s: f64) -> f64 {
    let error = JERK * (0.5 * length_s).powi(3) / 6.0;
    (STRAY / error).powi(2).min(1.0)
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
fn fit_on_springs(
    problem: &mut Problem<'_>,
    frames: &mut Frames,
    frame: usize,
    weights: &[f64],
    springs: &[(f64, f64)],
) {
    let Some(mut x) = nearby(frames, frame) else { return };
    for (u, (value, stiffness)) in springs.iter().enumerate().filter(|(_, (value, _))| value.is_finite()) {
        (problem.bounds.stiffness[u], problem.bounds.anchor[u]) = (*stiffness, *value);
        x[u] = *value;
    }
    load_weighted(problem, frames, frame, weights);
    let offsets = known_offsets(problem, frames, frame);
    let outcome: Outcome = problem.fit_with_offsets(&offsets, &mut x);
    problem.bounds.stiffness.fill(0.0);
    frames.keep(frame, problem, &x, outcome, false);
}

/// The offsets of a frame that lacks markers; markers without one are left out of what is loaded.
fn known_offsets(problem: &mut Problem<'_>, frames: &Frames, frame: usize) -> Vec<Vec3> {
    let mut offsets = frames.targets(frame).to_vec();
    for (i, offset) in offsets.iter_mut().enumerate().filter(|(_, o)| !o.iter().all(|x| x.is_finite())) {
        problem.frame_weights[i] = 0.0;
        *offset = Vec3::zeros();
    }
    offsets
}

/// Fits a frame to the markers that are seen and to the missing ones where the posture has them at their offsets.
fn fit_as_if_seen(problem: &mut Problem<'_>, frames: &mut Frames, frame: usize) {
    let Some(mut x) = nearby(frames, frame) else { return };
    frames.load_as_if_seen(frame, problem, true);
    let outcome = problem.fit(&mut x);
    frames.load(frame, problem);
    frames.keep(frame, problem, &x, outcome, false);
}
