//! Markers that are far from their places for long: labels swapped without a jump, and misplaced markers.
//!
//! The detection of jumps ([`super::sequence`]) misses labels that were swapped where a gap was filled by a curve,
//! because the markers glide from place to place, and markers that were never where the standing trial has them. Both
//! are detected after all frames are fitted:
//!
//! - two markers far from their places, each near the place of the other, have swapped labels if the frame fits better
//!   and both come much nearer when they are swapped back; while they glide, both are excluded;
//! - a marker that over the whole recording is far off, and many times as far as its neighbours, is misplaced. Its
//!   weight is reduced by the square of the ratio of its neighbours' distance to its own (the weight for that error).
//!
//! Pinned by: tests/marker_misplaced.rs

use super::frames::Frames;
use super::problem::FitProblem;

/// A marker further than this from its place is far off [m]: skin slides by at most 20 to 30 mm.
const FAR: f64 = 0.040;
/// Swapped back, both markers must be nearer than this share of their distance.
const NEARER: f64 = 0.5;
/// Near a swap, markers further off than this [m] are excluded for as long as a filled gap may last [s].
const GLIDING: f64 = 0.020;
const GLIDE_S: f64 = 0.3;
/// Minimum number of swapped frames.
const FEWEST_FRAMES: usize = 5;
/// A misplaced marker is this many times as far off as its neighbours.
const TIMES: f64 = 4.0;
/// Neighbours are the markers on the same body; if there are fewer than this, also those on adjacent bodies.
const NEIGHBOURS: usize = 3;
/// Markers with less than this share of the largest weight are expected to move on the body.
const MOVABLE: f64 = 0.05;
const ROUNDS: usize = 6;

/// A marker that is far from its place on the body in the whole recording.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Misplaced {
    pub(super) marker: usize,
    /// Root mean square distance from its place [m].
    pub(super) rms_m: f64,
    /// Median of the distances of its neighbours [m].
    pub(super) usual_m: f64,
}

/// Swaps labels back where both markers glided to the place of the other.
pub(super) fn exchange_back(problem: &mut FitProblem<'_>, frames: &mut Frames) {
    for _ in 0..ROUNDS {
        let Some((a, b)) = most_exchanged(problem, frames) else { return };
        let exchanged: Vec<usize> =
            (0..frames.count()).filter(|&frame| exchange_in(problem, frames, frame, (a, b))).collect();
        if exchanged.is_empty() {
            return;
        }
        reject_gliding(problem, frames, &exchanged, (a, b));
    }
}

/// Loads a frame and its posture; returns false if the frame is not fitted.
fn enter(problem: &mut FitProblem<'_>, frames: &Frames, frame: usize) -> bool {
    let is_fitted = frames.outcomes[frame].is_some();
    if is_fitted {
        frames.load(frame, problem);
        problem.pose_at(frames.posture(frame));
    }
    is_fitted
}

/// Markers far from their places in the loaded frame.
fn far(problem: &FitProblem<'_>) -> Vec<usize> {
    (0..problem.points.len()).filter(|&i| is_firm(problem, i) && problem.distance(i) > FAR).collect()
}

/// Whether a marker is loaded and not expected to move on its body.
fn is_firm(problem: &FitProblem<'_>, marker: usize) -> bool {
    let largest = problem.weights.iter().copied().fold(0.0, f64::max);
    problem.frame_weights[marker] > 0.0 && problem.weights[marker] > MOVABLE * largest
}

/// Whether two markers are each much nearer to the place of the other.
fn are_exchanged(problem: &FitProblem<'_>, a: usize, b: usize) -> bool {
    let to = |marker: usize, place: usize| problem.offset(place, &problem.positions[marker]).norm();
    to(b, a) < NEARER * problem.distance(a) && to(a, b) < NEARER * problem.distance(b)
}

/// The pair that is swapped in most frames.
fn most_exchanged(problem: &mut FitProblem<'_>, frames: &Frames) -> Option<(usize, usize)> {
    let mut counts = std::collections::BTreeMap::<(usize, usize), usize>::new();
    for frame in 0..frames.count() {
        if !enter(problem, frames, frame) {
            continue;
        }
        let far = far(problem);
        for (k, &a) in far.iter().enumerate() {
            for &b in far[k + 1..].iter().filter(|&&b| are_exchanged(problem, a, b)) {
                *counts.entry((a, b)).or_default() += 1;
            }
        }
    }
    counts
        .into_iter()
        .filter(|(_, count)| *count >= FEWEST_FRAMES)
        .max_by_key(|(_, count)| *count)
        .map(|(pair, _)| pair)
}

/// Swaps two labels in a frame if that brings both near and lowers the cost; returns whether it did.
fn exchange_in(problem: &mut FitProblem<'_>, frames: &mut Frames, frame: usize, (a, b): (usize, usize)) -> bool {
    if !enter(problem, frames, frame) {
        return false;
    }
    let loaded = [a, b].iter().all(|&i| problem.frame_weights[i] > 0.0);
    let before = [problem.distance(a), problem.distance(b)];
    if !loaded || before.iter().any(|d| *d < FAR) {
        return false;
    }
    let mut x = frames.posture(frame).to_vec();
    let cost = problem.pose_at(&x);
    let kept = frames.paths(frame).to_vec();
    let mut paths = kept.clone();
    paths.swap(a, b);
    frames.exchange(frame, &paths);
    frames.load(frame, problem);
    let outcome = problem.fit(&mut x);
    let is_near = |i: usize, before: f64| problem.distance(i) < NEARER * before;
    if outcome.cost < cost && is_near(a, before[0]) && is_near(b, before[1]) {
        let complete = frames.is_complete(frame);
        frames.keep(frame, problem, &x, outcome, complete);
        return true;
    }
    frames.exchange(frame, &kept);
    false
}

/// Near swapped frames, excludes markers that are at neither place.
fn reject_gliding(problem: &mut FitProblem<'_>, frames: &mut Frames, exchanged: &[usize], (a, b): (usize, usize)) {
    let reach = problem.times.windows(2).next().map_or(0, |t| (GLIDE_S / (t[1] - t[0])).ceil() as usize);
    for frame in 0..frames.count() {
        let next = exchanged.partition_point(|&f| f < frame);
        let beside = [next.checked_sub(1), Some(next)];
        let near = beside.iter().flatten().filter_map(|&k| exchanged.get(k)).any(|&f| f.abs_diff(frame) <= reach);
        if !near || !enter(problem, frames, frame) {
            continue;
        }
        let off: Vec<usize> = [a, b].into_iter().filter(|&i| problem.distance(i) > GLIDING).collect();
        off.iter().for_each(|&i| frames.set_used(frame, i, false));
    }
}

/// Reduces the weights of misplaced markers, the furthest first, and fits again.
pub(super) fn reduce_weights(problem: &mut FitProblem<'_>, frames: &mut Frames) -> Vec<Misplaced> {
    let mut found: Vec<Misplaced> = Vec::new();
    for _ in 0..ROUNDS {
        let rms = distances(problem, frames);
        let candidates = (0..rms.len()).filter(|i| found.iter().all(|m| m.marker != *i));
        let misplaced = candidates.filter_map(|i| misplaced(problem, &rms, i));
        let Some(worst) = misplaced.max_by(|a, b| a.rms_m.total_cmp(&b.rms_m)) else { break };
        problem.weights[worst.marker] *= (worst.usual_m / worst.rms_m).powi(2);
        for frame in 0..frames.count() {
            if problem.solver.budget.is_spent() {
                frames.leave_unfinished(frame);
            } else if enter(problem, frames, frame) && frames.is_complete(frame) {
                let mut x = frames.posture(frame).to_vec();
                let outcome = problem.fit(&mut x);
                frames.keep(frame, problem, &x, outcome, true);
            }
        }
        found.push(worst);
    }
    found
}

/// RMS distance of each marker from its place, over the frames fitted without offsets [m].
fn distances(problem: &mut FitProblem<'_>, frames: &Frames) -> Vec<f64> {
    let mut sums = vec![(0.0, 0_usize); frames.markers()];
    for frame in 0..frames.count() {
        if !frames.is_plain(frame) || !enter(problem, frames, frame) {
            continue;
        }
        for (i, sum) in sums.iter_mut().enumerate().filter(|(i, _)| problem.frame_weights[*i] > 0.0) {
            *sum = (sum.0 + problem.distance(i).powi(2), sum.1 + 1);
        }
    }
    sums.into_iter().map(|(sum, count)| (sum / count as f64).sqrt()).collect()
}

fn misplaced(problem: &FitProblem<'_>, rms: &[f64], marker: usize) -> Option<Misplaced> {
    let largest = problem.weights.iter().copied().fold(0.0, f64::max);
    let firm = |i: &usize| problem.weights[*i] > MOVABLE * largest && rms[*i].is_finite();
    if rms[marker].is_nan() || rms[marker] < FAR || !firm(&marker) {
        return None;
    }
    let node = problem.points[marker].node;
    let others = |is_near: &dyn Fn(usize) -> bool| -> Vec<f64> {
        (0..rms.len())
            .filter(|&i| i != marker && is_near(problem.points[i].node))
            .filter(firm)
            .map(|i| rms[i])
            .collect()
    };
    let beside = |n: usize| n == node || problem.tree.parent(n) == Some(node) || problem.tree.parent(node) == Some(n);
    let mut near = others(&|n| n == node);
    if near.len() < NEIGHBOURS {
        near = others(&beside);
    }
    if near.len() < NEIGHBOURS {
        return None;
    }
    near.sort_by(f64::total_cmp);
    let usual_m = near[near.len() / 2];
    (rms[marker] > TIMES * usual_m).then_some(Misplaced { marker, rms_m: rms[marker], usual_m })
}
