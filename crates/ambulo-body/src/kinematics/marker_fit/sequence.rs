//! Fits frame after frame, each starting from the one beside it, from a first frame in both directions, and detects
//! markers that jump or swap labels.
//!
//! The offset of a marker, from the marker of the model to the recorded one in the axes of its body, changes slowly,
//! because skin slides but does not jump. A frame whose offsets jump is fitted again: to all markers at the offsets of
//! the last good frame, with small weights for markers that fit badly (1 / (1 + (r/c)²)², Geman and McClure 1987
//! (unverified)), starting from the posture predicted by the frames before. A marker that stays off by more than skin
//! can slide is excluded until it returns. Two markers that are each at the expected position of the other have swapped
//! labels, and are swapped back.
//!
//! Pinned by: tests/marker_outliers.rs

use super::frames::{FEWEST, Frames};
use super::problem::FitProblem;
use super::settings::OutlierDetection;
use super::solve::Outcome;
use super::start;
use crate::numerics::elementary::powi;
use crate::spatial::Vec3;

/// A frame is fitted again if an offset changes by more than this [m] plus the sliding of skin. A jump of 50 mm changes
/// the offset by at least a quarter of its size if other markers determine the posture.
const SUSPICIOUS: f64 = 0.010;
/// Largest speed of skin over bone [m/s]: 20 mm in a swing phase is 0.1; impacts are faster.
const SKIN_SPEED: f64 = 0.5;
/// A marker further than this from its expected position is excluded [m].
const JUMP: f64 = 0.025;
/// Largest contribution of sliding to the limit, in addition to [`JUMP`] [m].
const MOST_SLIDE: f64 = 0.010;
/// Largest contribution of sliding for a marker that was not visible for a while [m].
const MOST_SLIDE_UNSEEN: f64 = 0.035;
/// An excluded marker is used again below this share of the limit.
const BACK: f64 = 0.8;
/// Distance at which the weight of a marker is a quarter while a frame is fitted again [m].
const SCALE: f64 = 0.020;
const REWEIGHTINGS: usize = 10;
/// Steps of a fit with these weights: they change with the posture, so that it need not be exact.
const STEPS_BETWEEN: usize = 2;
/// The weights are settled when a reweighting moves no unknown by more [rad or m].
const SETTLED: f64 = 1e-4;
/// A posture older than this [s] is not used for prediction.
pub(super) const MEMORY: f64 = 0.25;
/// In the first frame a swap of labels must reduce both distances from above this [m] to less than half.
const FIRST_SWAP: f64 = 0.060;

/// State from earlier frames.
#[derive(Debug, Clone)]
pub(super) struct Tracking {
    /// The last two fitted frames.
    pub(super) last: [Option<usize>; 2],
    /// Offset of each marker in the last frame in which it was used, and the time of that frame [s].
    pub(super) offsets: Vec<Vec3>,
    times: Vec<f64>,
    /// Offsets of excluded markers.
    rejected: Vec<Vec3>,
    /// Time at which each marker was last visible [s].
    seen: Vec<f64>,
    used: Vec<bool>,
    paths: Vec<usize>,
    x: Vec<f64>,
    /// The posture of the first frame, if it is not to be searched for.
    given: Option<Vec<f64>>,
    trial: Vec<f64>,
    weights: Vec<f64>,
    distances: Vec<f64>,
    expected: Vec<Vec3>,
    /// Offsets; zero if unknown.
    usable: Vec<Vec3>,
}

impl Tracking {
    /// Before the first frame; `default` is a value per unknown.
    pub(super) fn new(markers: usize, default: &[f64]) -> Tracking {
        Tracking {
            last: [None; 2],
            offsets: vec![Vec3::repeat(f64::NAN); markers],
            times: vec![f64::NEG_INFINITY; markers],
            rejected: vec![Vec3::zeros(); markers],
            seen: vec![f64::NEG_INFINITY; markers],
            used: vec![true; markers],
            paths: (0..markers).collect(),
            x: default.to_vec(),
            given: None,
            trial: default.to_vec(),
            distances: vec![f64::NAN; markers],
            weights: vec![0.0; markers],
            expected: vec![Vec3::zeros(); markers],
            usable: vec![Vec3::zeros(); markers],
        }
    }
}

/// Where a sequence of frames starts.
#[derive(Debug, Clone, Copy)]
pub(super) struct Start<'a> {
    /// The first frame; the others follow towards the end and towards the beginning of the recording.
    pub(super) frame: usize,
    /// Its posture; `None` searches for it.
    pub(super) posture: Option<&'a [f64]>,
    /// A value per unknown, from which the search begins.
    pub(super) default: &'a [f64],
}

/// Fits every frame that has enough markers, from the first one on.
pub(super) fn run(problem: &mut FitProblem<'_>, frames: &mut Frames, outliers: OutlierDetection, default: &[f64]) {
    run_from(problem, frames, outliers, Start { frame: 0, posture: None, default });
}

/// Fits every frame that has enough markers, from a frame on in both directions.
pub(super) fn run_from(
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    outliers: OutlierDetection,
    start: Start<'_>,
) {
    let mut memory = Tracking::new(frames.markers(), start.default);
    memory.given = start.posture.map(<[f64]>::to_vec);
    let fit = |problem: &mut FitProblem<'_>, frames: &mut Frames, memory: &mut Tracking, frame: usize| {
        fit_frame(problem, frames, memory, frame, outliers, start.default);
    };
    fit(problem, frames, &mut memory, start.frame);
    let mut backwards = (start.frame > 0).then(|| memory.clone());
    (start.frame + 1..frames.count()).for_each(|frame| fit(problem, frames, &mut memory, frame));
    let all: Vec<usize> = (0..frames.count()).collect();
    if let Some(memory) = &mut backwards {
        (0..start.frame).rev().for_each(|frame| fit(problem, frames, memory, frame));
        use_majority(frames, all.iter().copied());
    }
    use_majority(frames, all.iter().rev().copied());
}

/// If a marker is excluded from some frame to the end of the recording, and for longer than it was used before, its
/// earlier position was the wrong one: uses the later frames instead. `ending` has the frames from the end on.
fn use_majority(frames: &mut Frames, ending: impl Iterator<Item = usize> + Clone) {
    for i in 0..frames.markers() {
        let is_seen = |frames: &Frames, f: usize| frames.path(f, i) == i && frames.is_seen(f, i);
        let seen = |f: &usize| is_seen(frames, *f);
        let off = ending.clone().filter(seen).take_while(|&f| !frames.is_used(f, i)).count();
        let used = (0..frames.count()).filter(seen).filter(|&f| frames.is_used(f, i)).count();
        for frame in 0..frames.count() {
            if off > used && is_seen(frames, frame) {
                frames.set_used(frame, i, !frames.is_used(frame, i));
            }
        }
    }
}

/// Fits a frame; it has no posture afterwards if it lacks too many markers.
pub(super) fn fit_frame(
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    memory: &mut Tracking,
    frame: usize,
    outliers: OutlierDetection,
    default: &[f64],
) {
    problem.solver.budget.grant_frame();
    frames.exchange(frame, &memory.paths);
    for i in 0..frames.markers() {
        frames.set_used(frame, i, memory.used[i]);
    }
    if frames.load(frame, problem) < FEWEST {
        frames.remove_posture(frame);
        return;
    }
    let t = problem.times[frame];
    let is_fresh = predict_posture(problem, frames, memory, frame);
    if !is_fresh {
        if memory.last[0].is_some() && !problem.solver.budget.allows_search() {
            frames.leave_unfitted(frame);
            return;
        }
        // After a gap, the last posture selects one of several sets of angles.
        memory.x = match memory.last[0] {
            Some(last) => start::posture(problem, frames.posture(last)),
            None => memory.given.take().unwrap_or_else(|| start::posture(problem, default)),
        };
        if memory.last[0].is_none() {
            if outliers != OutlierDetection::Off {
                exchange_in_first(problem, frames, memory, frame);
            }
            problem.solver.budget.end_beginning();
        }
    }
    let knows_offsets = memory.last[0].is_some();
    if outliers != OutlierDetection::Off
        && knows_offsets
        && let Some(outcome) = guarded(problem, frames, memory, frame, t)
    {
        let complete = frames.is_complete(frame);
        frames.keep(frame, problem, &memory.x, outcome, complete);
        remember(frames, memory, frame, t);
        return;
    }
    let mut x = std::mem::take(&mut memory.x);
    frames.load(frame, problem);
    let complete = frames.is_complete(frame);
    let outcome = if complete || !knows_offsets {
        problem.fit(&mut x)
    } else {
        drop_unknown(problem, memory);
        problem.fit_with_offsets(&memory.usable, &mut x)
    };
    let plain = complete || !knows_offsets;
    frames.keep(frame, problem, &x, outcome, plain);
    memory.x = x;
    remember(frames, memory, frame, t);
}

/// Predicts the posture from the last two frames, before or after it, if they are near in time.
fn predict_posture(problem: &FitProblem<'_>, frames: &Frames, memory: &mut Tracking, frame: usize) -> bool {
    let t = problem.times[frame];
    let [Some(last), before] = memory.last else { return false };
    let age = (t - problem.times[last]).abs();
    if age > MEMORY {
        return false;
    }
    memory.x.copy_from_slice(frames.posture(last));
    if let Some(before) = before
        && age < 2.5 * (problem.times[last] - problem.times[before]).abs()
    {
        let ahead = age / (problem.times[last] - problem.times[before]).abs();
        for ((x, a), b) in memory.x.iter_mut().zip(frames.posture(last)).zip(frames.posture(before)) {
            *x += ahead * (a - b);
        }
    }
    true
}

fn remember(frames: &Frames, memory: &mut Tracking, frame: usize, t: f64) {
    memory.last = [Some(frame), memory.last[0]];
    for i in 0..frames.markers() {
        if frames.is_seen(frame, frames.path(frame, i)) {
            memory.seen[i] = t;
        }
        if frames.is_used(frame, i) {
            memory.offsets[i] = frames.offsets(frame)[i];
            memory.times[i] = t;
        }
    }
}

/// Removes markers with unknown offsets from the loaded ones.
fn drop_unknown(problem: &mut FitProblem<'_>, memory: &mut Tracking) {
    for (i, offset) in memory.offsets.iter().enumerate() {
        let is_known = offset.iter().all(|x| x.is_finite());
        memory.usable[i] = if is_known { *offset } else { Vec3::zeros() };
        if !is_known {
            problem.frame_weights[i] = 0.0;
        }
    }
}

/// Largest distance of a marker from its expected position [m].
fn limit(memory: &Tracking, i: usize, t: f64) -> f64 {
    let was_unseen = (t - memory.seen[i]).abs() > 0.1;
    let most = if was_unseen { MOST_SLIDE_UNSEEN } else { MOST_SLIDE };
    JUMP + (SKIN_SPEED * (t - memory.times[i]).abs()).min(most)
}

/// Decides which markers are used in this frame, and their paths. Returns the fit if all is as before.
fn guarded(
    problem: &mut FitProblem<'_>,
    frames: &mut Frames,
    memory: &mut Tracking,
    frame: usize,
    t: f64,
) -> Option<Outcome> {
    if memory.used.iter().all(|b| *b)
        && let Some(outcome) = quiet_fit(problem, frames, memory, frame, t)
    {
        return Some(outcome);
    }
    for i in 0..frames.markers() {
        frames.set_used(frame, i, true);
    }
    frames.load(frame, problem);
    drop_unknown(problem, memory);
    problem.solver.budget.reserve();
    robust(problem, memory);
    let ran_out = problem.solver.budget.is_spent();
    problem.solver.budget.release();
    if ran_out {
        (0..frames.markers()).for_each(|i| frames.set_used(frame, i, memory.used[i]));
        return None;
    }
    exchange(problem, frames, memory, frame, t);
    for i in 0..frames.markers() {
        if memory.distances[i].is_finite() {
            memory.used[i] = is_acceptable(problem, memory, i, t);
        }
        frames.set_used(frame, i, memory.used[i]);
    }
    None
}

/// Whether a marker is near its expected position; an excluded marker must come nearer, or jump back.
fn is_acceptable(problem: &FitProblem<'_>, memory: &mut Tracking, i: usize, t: f64) -> bool {
    let (r, limit) = (memory.distances[i], limit(memory, i, t));
    let offset = problem.offset(i, &problem.positions[i]);
    let jumped = (offset - memory.rejected[i]).norm() > JUMP;
    memory.rejected[i] = offset;
    if memory.used[i] { r <= limit } else { r <= BACK * limit || (jumped && r <= JUMP + MOST_SLIDE_UNSEEN) }
}

/// The fit of this frame; `None` if an offset changed faster than skin slides.
fn quiet_fit(
    problem: &mut FitProblem<'_>,
    frames: &Frames,
    memory: &mut Tracking,
    frame: usize,
    t: f64,
) -> Option<Outcome> {
    let mut x = std::mem::take(&mut memory.trial);
    x.copy_from_slice(&memory.x);
    let outcome = if frames.is_complete(frame) {
        problem.fit(&mut x)
    } else {
        drop_unknown(problem, memory);
        problem.fit_with_offsets(&memory.usable, &mut x)
    };
    let changed = (0..frames.markers()).any(|i| {
        let change = (problem.offset(i, &problem.positions[i]) - memory.offsets[i]).norm();
        problem.frame_weights[i] > 0.0 && change > SUSPICIOUS + SKIN_SPEED * (t - memory.times[i]).abs()
    });
    if !changed {
        memory.x.copy_from_slice(&x);
    }
    memory.trial = x;
    (!changed).then_some(outcome)
}

/// Fits the loaded markers at their last offsets with a robust weighting, and stores the distance of each marker from
/// its expected position.
fn robust(problem: &mut FitProblem<'_>, memory: &mut Tracking) {
    let mut x = std::mem::take(&mut memory.x);
    memory.weights.copy_from_slice(&problem.frame_weights);
    problem.pose_at(&x);
    for k in 0..REWEIGHTINGS {
        note_distances(problem, memory);
        // From wide to narrow, so that a badly predicted posture excludes no marker.
        let scale = SCALE * (4.0 * powi(0.5_f64, k as i32)).max(1.0);
        for (i, r) in memory.distances.iter().enumerate() {
            let share = 1.0 + (r / scale).powi(2);
            problem.frame_weights[i] = if r.is_finite() { memory.weights[i] / (share * share) } else { 0.0 };
        }
        memory.trial.copy_from_slice(&x);
        problem.approach_offsets(&memory.usable, &mut x, STEPS_BETWEEN);
        let moved = x.iter().zip(&memory.trial).any(|(now, before)| (now - before).abs() > SETTLED);
        if !moved && scale <= SCALE {
            break;
        }
    }
    note_distances(problem, memory);
    memory.x = x;
}

fn note_distances(problem: &FitProblem<'_>, memory: &mut Tracking) {
    for i in 0..memory.distances.len() {
        let is_loaded = memory.weights[i] > 0.0;
        memory.expected[i] = problem.place(i, &memory.usable[i]);
        memory.distances[i] = if is_loaded { (problem.positions[i] - memory.expected[i]).norm() } else { f64::NAN };
    }
}

/// Swaps back the labels of two markers that are each at the expected position of the other.
fn exchange(problem: &FitProblem<'_>, frames: &mut Frames, memory: &mut Tracking, frame: usize, t: f64) {
    let count = frames.markers();
    for i in 0..count {
        for j in i + 1..count {
            let (limit_i, limit_j) = (limit(memory, i, t), limit(memory, j, t));
            let both_off = memory.distances[i] > limit_i && memory.distances[j] > limit_j;
            let r_i = (problem.positions[j] - memory.expected[i]).norm();
            let r_j = (problem.positions[i] - memory.expected[j]).norm();
            if both_off && r_i < limit_i && r_j < limit_j {
                memory.paths.swap(i, j);
                (memory.distances[i], memory.distances[j]) = (r_i, r_j);
                frames.exchange(frame, &memory.paths);
            }
        }
    }
}

/// In the first frame there are no expected positions. Two markers with swapped labels are both far off, and near when
/// they are swapped back.
fn exchange_in_first(problem: &mut FitProblem<'_>, frames: &mut Frames, memory: &mut Tracking, frame: usize) {
    let count = frames.markers();
    let mut x = memory.x.clone();
    problem.fit(&mut x);
    let mut distances: Vec<f64> = (0..count).map(|i| loaded_distance(problem, i)).collect();
    for i in 0..count {
        for j in i + 1..count {
            if !(distances[i] > FIRST_SWAP && distances[j] > FIRST_SWAP) {
                continue;
            }
            memory.paths.swap(i, j);
            frames.exchange(frame, &memory.paths);
            frames.load(frame, problem);
            let mut trial = x.clone();
            problem.fit(&mut trial);
            let (r_i, r_j) = (loaded_distance(problem, i), loaded_distance(problem, j));
            if r_i < 0.5 * distances[i] && r_j < 0.5 * distances[j] {
                x = trial;
                distances = (0..count).map(|k| loaded_distance(problem, k)).collect();
            } else {
                memory.paths.swap(i, j);
                frames.exchange(frame, &memory.paths);
            }
        }
    }
    frames.load(frame, problem);
    memory.x = x;
}

fn loaded_distance(problem: &FitProblem<'_>, i: usize) -> f64 {
    if problem.frame_weights[i] > 0.0 { problem.distance(i) } else { f64::NAN }
}
