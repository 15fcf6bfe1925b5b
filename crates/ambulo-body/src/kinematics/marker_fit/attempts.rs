//! Attempts to follow the markers: from the first frame; if the body is lost, from the frame that most markers agree
//! on; and once more where a limb is folded the wrong way.
//!
//! Frame-by-frame fits start from the frame beside them. Bad first frames, a wrong posture in the first frame, or a
//! limb that fell into a local minimum are therefore carried on. An attempt is judged by the mean square distance of
//! all visible markers, in which a marker counts as at most [`CAP`] away, so that neither excluded markers nor single
//! lost ones decide:
//!
//! 1. A body is lost if the number of linear solves ended in more than [`FEW`] frames, or most of the markers are
//!    [`FAR`] from it in more than [`FAR_SHARE`] of the frames. Then a few frames are fitted from nothing, and the
//!    sequence starts again at the one in which the markers agree best with the body. If it is lost again, it starts
//!    there without looking for jumps, each of which takes many solves: noise of 3 mm makes one of a hundred markers
//!    jump.
//! 2. If the markers of a segment are [`FAR`] from it in many frames, each angle of its joint and of the two joints
//!    above is turned by a half and by quarter turns in the worst frame. If that brings the segment to half the
//!    distance at a lower cost, the sequence starts again from this posture.
//! 3. If the number of solves still ends in more than [`FEW`] frames, all frames are fitted together.
//!
//! An attempt replaces the one before only if it is nearer to the markers. Frames that are too far apart to start from
//! each other are no sequence, and are left as they are.
//!
//! Cost: none in recordings that are followed at once but a look at each frame; about one more sequence otherwise.
//! Pinned by: tests/kinematics_attempts.rs

use super::frames::{FEWEST, Frames};
use super::problem::FitProblem;
use super::sequence::{MEMORY, Start, run, run_from};
use super::settings::OutlierDetection;
use super::start;
use std::f64::consts::{FRAC_PI_2, PI};

/// Frames for which no linear solve may be left without another attempt.
const FEW: usize = 3;
/// Distance of markers from a body that is lost, or from a segment that is folded the wrong way (root mean square) [m]:
/// skin slides by at most 20 to 30 mm.
const FAR: f64 = 0.040;
/// Share of the markers, by weight, that must be that far off: exchanged and displaced ones do not make a lost body.
const MOST_MARKERS: f64 = 0.5;
/// Share of the frames in which the markers are that far off.
const FAR_SHARE: f64 = 0.02;
/// A marker counts as at most this far from its place [m]: about the distance between neighbouring joints.
const CAP: f64 = 0.100;
/// Frames that are fitted from nothing.
const CANDIDATES: usize = 4;
/// Joints whose angles are turned: that of the segment, and those above it.
const JOINTS: usize = 3;
const TURNS: [f64; 3] = [PI, FRAC_PI_2, -FRAC_PI_2];
/// A segment that was folded the wrong way comes nearer than this share of its distance.
const NEARER: f64 = 0.5;
/// Segments that are unfolded in a recording.
const MOST_UNFOLDED: usize = 4;

/// How well all frames follow the markers.
#[derive(Debug, Clone, Copy)]
struct Judgement {
    /// Frames with enough markers.
    frames: usize,
    /// Frames for which no linear solve was left.
    unfinished: usize,
    /// Frames with most markers [`FAR`] from the body.
    far: usize,
    /// Mean square distance of the markers, each at most [`CAP`] [m²].
    mean_square: f64,
}

impl Judgement {
    fn of(problem: &mut FitProblem<'_>, frames: &Frames) -> Judgement {
        let mut all = Judgement { frames: 0, unfinished: unfinished(frames), far: 0, mean_square: 0.0 };
        for frame in 0..frames.count() {
            if problem.load(frame, |_| true, |i| frames.path(frame, i)) < FEWEST {
                continue;
            }
            let is_fitted = frames.outcomes[frame].is_some();
            let square = if is_fitted { mean_square(problem, frames.posture(frame)) } else { CAP * CAP };
            all.frames += 1;
            all.far += usize::from(!is_fitted || far_share(problem) > MOST_MARKERS);
            all.mean_square += square;
        }
        all.mean_square /= all.frames.max(1) as f64;
        all
    }

    fn is_lost(&self) -> bool {
        self.unfinished > FEW || self.far > many(self.frames)
    }

    /// The distance in words, such as `117 mm`.
    fn distance(&self) -> String {
        format!("{:.0} mm", 1e3 * self.mean_square.sqrt())
    }
}

/// More frames than this are many.
fn many(frames: usize) -> usize {
    FEW.max((FAR_SHARE * frames as f64) as usize)
}

fn unfinished(frames: &Frames) -> usize {
    (0..frames.count()).filter(|&frame| frames.is_unfinished(frame)).count()
}

/// Mean square distance of the loaded markers from the body in a posture, each at most [`CAP`], by their weights [m²].
fn mean_square(problem: &mut FitProblem<'_>, posture: &[f64]) -> f64 {
    problem.pose_at(posture);
    let capped = |(i, weight): (usize, &f64)| weight * problem.distance(i).min(CAP).powi(2);
    let loaded = || problem.frame_weights.iter().enumerate().filter(|(_, weight)| **weight > 0.0);
    loaded().map(capped).sum::<f64>() / loaded().map(|(_, weight)| weight).sum::<f64>()
}

/// Share of the loaded markers that are [`FAR`] from the body at the current posture, by their weights.
fn far_share(problem: &FitProblem<'_>) -> f64 {
    let weight = |(i, weight): (usize, &f64)| if problem.distance(i) > FAR { *weight } else { 0.0 };
    problem.frame_weights.iter().enumerate().map(weight).sum::<f64>() / problem.frame_weights.iter().sum::<f64>()
}

/// Whether the fit of too many frames ended for lack of linear solves, so that all are to be fitted together.
pub(super) fn ended_early(problem: &FitProblem<'_>, frames: &Frames) -> bool {
    unfinished(frames) > FEW && is_sequence(problem)
}

/// Whether frames are near enough in time to start from each other.
fn is_sequence(problem: &FitProblem<'_>) -> bool {
    let (first, last) = (problem.times[0], problem.times[problem.frames() - 1]);
    last - first <= MEMORY * (problem.frames().max(2) - 1) as f64
}

/// Fits all frames. Returns what was tried after the first attempt, in sentences.
pub(super) fn follow(
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    outliers: OutlierDetection,
    default: &[f64],
) -> Vec<String> {
    run(problem, frames, outliers, default);
    let mut tried = Vec::new();
    if !is_sequence(problem) {
        return tried;
    }
    let mut judged = Judgement::of(problem, frames);
    if judged.is_lost()
        && let Some(frame) = most_agreed(problem, default)
    {
        let start = Start { frame, posture: None, default };
        let how = "started again where the markers agree best with the body";
        judged = attempt(problem, frames, outliers, (start, how), judged, &mut tried);
        if judged.is_lost() {
            let how = "started again without looking for markers that jump";
            judged = attempt(problem, frames, OutlierDetection::Off, (start, how), judged, &mut tried);
        }
    }
    for _ in 0..MOST_UNFOLDED {
        let Some((frame, node)) = most_folded(problem, frames) else { break };
        let Some(posture) = unfolded(problem, frames, frame, node) else { break };
        let start = Start { frame, posture: Some(&posture), default };
        let before = tried.len();
        let how = "started again with a limb that was folded the wrong way turned over";
        judged = attempt(problem, frames, outliers, (start, how), judged, &mut tried);
        if tried.len() == before {
            break;
        }
    }
    tried
}

/// Fits all frames from another start, and keeps the result if it is nearer to the markers.
fn attempt(
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    outliers: OutlierDetection,
    (start, how): (Start<'_>, &str),
    before: Judgement,
    tried: &mut Vec<String>,
) -> Judgement {
    let mut other = Frames::new(problem);
    let left = problem.solver.budget.begin_again();
    run_from(problem, &mut other, outliers, start);
    let after = Judgement::of(problem, &other);
    if after.mean_square >= before.mean_square {
        problem.solver.budget.go_on_with(left);
        return before;
    }
    *frames = other;
    tried.push(format!(
        "the fit was {how}, at {:.3} s, and went on in both directions: markers {} from the body instead of {} (each \
         counted as at most {:.0} mm)",
        problem.times[start.frame],
        after.distance(),
        before.distance(),
        1e3 * CAP
    ));
    after
}

/// Among some frames, the one whose markers agree best with the body in a posture found from nothing. Markers that are
/// not visible count as far off.
fn most_agreed(problem: &mut FitProblem<'_>, default: &[f64]) -> Option<usize> {
    let left = problem.solver.budget.begin_again();
    let fresh = Frames::new(problem);
    let total: f64 = problem.weights.iter().sum();
    let part = fresh.count().div_ceil(CANDIDATES);
    let fullest = |k: usize| (k * part..((k + 1) * part).min(fresh.count())).max_by_key(|&f| fresh.used_in(f));
    let mut best: Option<(f64, usize)> = None;
    for frame in (0..CANDIDATES).filter_map(fullest) {
        if fresh.load(frame, problem) < FEWEST {
            continue;
        }
        let posture = start::posture(problem, default);
        let seen: f64 = problem.frame_weights.iter().sum();
        let square = (seen * mean_square(problem, &posture) + (total - seen) * CAP * CAP) / total;
        if best.is_none_or(|(least, _)| square < least) {
            best = Some((square, frame));
        }
    }
    problem.solver.budget.go_on_with(left);
    best.map(|(_, frame)| frame)
}

/// The segment that is far from its markers in most frames, if in many, and the frame in which it is farthest.
fn most_folded(problem: &mut FitProblem<'_>, frames: &Frames) -> Option<(usize, usize)> {
    let nodes = problem.tree.node_count();
    // Number of frames, largest distance and its frame, per node.
    let mut far = vec![(0, 0.0, 0); nodes];
    for frame in (0..frames.count()).filter(|&frame| frames.outcomes[frame].is_some()) {
        problem.load(frame, |_| true, |i| frames.path(frame, i));
        problem.pose_at(frames.posture(frame));
        for (node, far) in far.iter_mut().enumerate() {
            let distance = rms_of(problem, node);
            far.0 += usize::from(distance > FAR);
            if distance > far.1 {
                (far.1, far.2) = (distance, frame);
            }
        }
    }
    let (node, (count, _, frame)) = far.into_iter().enumerate().max_by_key(|(_, (count, ..))| *count)?;
    (count > many(frames.count()) && problem.tree.parent(node).is_some()).then_some((frame, node))
}

/// Root mean square distance of the loaded markers of a segment at the current posture [m]; 0 without any.
fn rms_of(problem: &FitProblem<'_>, node: usize) -> f64 {
    let own = (0..problem.points.len()).filter(|&i| problem.points[i].node == node && problem.frame_weights[i] > 0.0);
    let (sum, count) = own.fold((0.0, 0), |(sum, count), i| (sum + problem.distance(i).powi(2), count + 1));
    if count == 0 { 0.0 } else { (sum / f64::from(count)).sqrt() }
}

/// A posture of a frame in which a segment is much nearer to its markers, at a lower cost.
fn unfolded(problem: &mut FitProblem<'_>, frames: &Frames, frame: usize, node: usize) -> Option<Vec<f64>> {
    let left = problem.solver.budget.begin_again();
    problem.load(frame, |_| true, |i| frames.path(frame, i));
    let mut folded = frames.posture(frame).to_vec();
    let mut least = problem.fit(&mut folded).cost;
    let near = NEARER * rms_of(problem, node);
    let above = std::iter::successors(Some(node), |&node| problem.tree.parent(node));
    let joints: Vec<usize> = above.take(JOINTS).filter(|&node| problem.tree.parent(node).is_some()).collect();
    let angles = joints.iter().flat_map(|&node| problem.tree.columns(node));
    let angles: Vec<usize> = angles.filter(|column| column.angular.norm() > 0.5).map(|column| column.unknown).collect();
    let mut best = None;
    for (unknown, turn) in angles.iter().flat_map(|&unknown| TURNS.map(|turn| (unknown, turn))) {
        let mut x = folded.clone();
        x[unknown] += turn;
        fit_only(problem, &angles, &mut x);
        let cost = problem.fit(&mut x).cost;
        if cost < least && rms_of(problem, node) < near {
            least = cost;
            best = Some(x);
        }
    }
    problem.solver.budget.go_on_with(left);
    best
}

/// Fits some unknowns; the others stay as they are.
fn fit_only(problem: &mut FitProblem<'_>, unknowns: &[usize], x: &mut [f64]) {
    let held = problem.bounds.held.clone();
    problem.bounds.held.fill(true);
    unknowns.iter().for_each(|&unknown| problem.bounds.held[unknown] = held[unknown]);
    problem.fit(x);
    problem.bounds.held = held;
}
