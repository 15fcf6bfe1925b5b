//! Frame after frame, each from the posture before; markers that jump or exchange their labels are found on the way.
//!
//! A marker's offset, from the model's marker to the recorded one in the axes of its body, changes slowly: skin slides, it does
//! not leap. A frame whose offsets leap is looked at again: it is fitted to all markers at the offsets they had in the last
//! good frame, those that fit badly counting little (weights 1 / (1 + (r/c)²)², Geman and McClure 1987 (unverified), from the
//! posture that the frames before foretell). What stays off by more than skin can slide is not believed until it comes back; two
//! markers that stand each where the other is expected have exchanged their labels, and are exchanged back.
//!
//! Pinned by: tests/marker_outliers.rs

use super::frames::{FEWEST, Frames};
use super::problem::Problem;
use super::settings::Guard;
use super::solve::Outcome;
use super::start;
use crate::spatial::Vec3;

/// A frame is looked at again when an offset changes by more than this [m] and as fast as skin slides. A jump of 50 mm shows with
/// at least a quarter of its size where the other markers hold the body.
const SUSPICIOUS: f64 = 0.010;
/// Fastest that skin slides over bone [m/s]: 20 mm in a swing phase is 0.1; impacts are faster.
const SKIN_SPEED: f64 = 0.5;
/// A marker further than this from where it is expected is not believed [m].
const JUMP: f64 = 0.025;
/// The most that sliding adds to [`JUMP`], for a marker that is not believed [m].
const MOST_SLIDE: f64 = 0.010;
/// The same for a marker that was not seen for a while [m].
const MOST_SLIDE_UNSEEN: f64 = 0.035;
/// A marker that is not believed is believed again below this share of the limit.
const BACK: f64 = 0.8;
/// Distance at which a marker counts a quarter while a frame is looked at again [m].
const SCALE: f64 = 0.020;
const REWEIGHTINGS: usize = 10;
/// A posture older than this [s] foretells nothing.
const MEMORY: f64 = 0.25;
/// In the first frame an exchange of labels must lower both distances from above this [m] to less than half.
const FIRST_SWAP: f64 = 0.060;

/// What is known when a frame comes.
#[derive(Debug, Clone)]
struct Memory {
    /// The last two fitted frames.
    last: [Option<usize>; 2],
    /// Offsets of the last frame in which each marker was believed, and the time of it [s].
    offsets: Vec<Vec3>,
    times: Vec<f64>,
    /// Offsets of markers that are not believed.
    wild: Vec<Vec3>,
    /// Last time at which each marker was seen [s].
    seen: Vec<f64>,
    believed: Vec<bool>,
    paths: Vec<usize>,
    x: Vec<f64>,
    trial: Vec<f64>,
    weights: Vec<f64>,
    distances: Vec<f64>,
    expected: Vec<Vec3>,
    /// Offsets, zero where none is known.
    usable: Vec<Vec3>,
}

/// Fits every frame that has enough markers.
pub(super) fn run(problem: &mut Problem<'_>, frames: &mut Frames, guard: Guard, default: &[f64]) {
    let markers = frames.markers();
    let mut memory = Memory {
        last: [None; 2],
        offsets: vec![Vec3::repeat(f64::NAN); markers],
        times: vec![f64::NEG_INFINITY; markers],
        wild: vec![Vec3::zeros(); markers],
        seen: vec![f64::NEG_INFINITY; markers],
        believed: vec![true; markers],
        paths: (0..markers).collect(),
        x: default.to_vec(),
        trial: default.to_vec(),
        distances: vec![f64::NAN; markers],
        weights: vec![0.0; markers],
        expected: vec![Vec3::zeros(); markers],
        usable: vec![Vec3::zeros(); markers],
    };
    for frame in 0..frames.count() {
        fit_frame(problem, frames, &mut memory, frame, guard, default);
    }
    believe_majority(frames);
}

/// A marker that is off from some frame to the end, and for longer than it was believed before, was off before: what came first
/// has no right of its own.
fn believe_majority(frames: &mut Frames) {
    for i in 0..frames.markers() {
        let is_seen = |frames: &Frames, f: usize| frames.path(f, i) == i && frames.is_seen(f, i);
        let seen = |f: &usize| is_seen(frames, *f);
        let off = (0..frames.count()).rev().filter(seen).take_while(|&f| !frames.is_used(f, i)).count();
        let believed = (0..frames.count()).filter(seen).filter(|&f| frames.is_used(f, i)).count();
        for frame in 0..frames.count() {
            if off > believed && is_seen(frames, frame) {
                frames.believe(frame, i, !frames.is_used(frame, i));
            }
        }
    }
}

fn fit_frame(
    problem: &mut Problem<'_>,
    frames: &mut Frames,
    memory: &mut Memory,
    frame: usize,
    guard: Guard,
    default: &[f64],
) {
    frames.exchange(frame, &memory.paths);
    for i in 0..frames.markers() {
        frames.believe(frame, i, memory.believed[i]);
    }
    if frames.load(frame, problem) < FEWEST {
        frames.lose(frame);
        return;
    }
    let t = problem.times[frame];
    let is_fresh = foretell(problem, frames, memory, frame);
    if !is_fresh {
        memory.x = start::posture(problem, default);
        if guard == Guard::On && memory.last[0].is_none() {
            exchange_in_first(problem, frames, memory, frame);
        }
    }
    let knows_offsets = memory.last[0].is_some();
    if guard == Guard::On
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

/// Starts from where the last two frames lead, if they are recent.
fn foretell(problem: &Problem<'_>, frames: &Frames, memory: &mut Memory, frame: usize) -> bool {
    let t = problem.times[frame];
    let [Some(last), before] = memory.last else { return false };
    let age = t - problem.times[last];
    if age > MEMORY {
        return false;
    }
    memory.x.copy_from_slice(frames.posture(last));
    if let Some(before) = before
        && age < 2.5 * (problem.times[last] - problem.times[before])
    {
        let ahead = age / (problem.times[last] - problem.times[before]);
        for ((x, a), b) in memory.x.iter_mut().zip(frames.posture(last)).zip(frames.posture(before)) {
            *x += ahead * (a - b);
        }
    }
    true
}

fn remember(frames: &Frames, memory: &mut Memory, frame: usize, t: f64) {
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

/// Leaves markers whose offset is not known out of what is loaded.
fn drop_unknown(problem: &mut Problem<'_>, memory: &mut Memory) {
    for (i, offset) in memory.offsets.iter().enumerate() {
        let is_known = offset.iter().all(|x| x.is_finite());
        memory.usable[i] = if is_known { *offset } else { Vec3::zeros() };
        if !is_known {
            problem.frame_weights[i] = 0.0;
        }
    }
}

/// How far a marker may be from where it is expected [m].
fn limit(memory: &Memory, i: usize, t: f64) -> f64 {
    let was_unseen = t - memory.seen[i] > 0.1;
    let most = if was_unseen { MOST_SLIDE_UNSEEN } else { MOST_SLIDE };
    JUMP + (SKIN_SPEED * (t - memory.times[i])).min(most)
}

/// Decides which markers are believed in this frame, and whose path they took. The fit, if all is as before and nothing
/// leaps.
fn guarded(
    problem: &mut Problem<'_>,
    frames: &mut Frames,
    memory: &mut Memory,
    frame: usize,
    t: f64,
) -> Option<Outcome> {
    if memory.believed.iter().all(|b| *b)
        && let Some(outcome) = quiet_fit(problem, frames, memory, frame, t)
    {
        return Some(outcome);
    }
    for i in 0..frames.markers() {
        frames.believe(frame, i, true);
    }
    frames.load(frame, problem);
    drop_unknown(problem, memory);
    robust(problem, memory);
    exchange(problem, frames, memory, frame, t);
    for i in 0..frames.markers() {
        if memory.distances[i].is_finite() {
            memory.believed[i] = is_believed(problem, memory, i, t);
        }
        frames.believe(frame, i, memory.believed[i]);
    }
    None
}

/// Whether a marker is near enough to where it is expected; one that was not believed must come nearer, or leap back.
fn is_believed(problem: &Problem<'_>, memory: &mut Memory, i: usize, t: f64) -> bool {
    let (r, limit) = (memory.distances[i], limit(memory, i, t));
    let offset = problem.offset(i, &problem.positions[i]);
    let leapt = (offset - memory.wild[i]).norm() > JUMP;
    memory.wild[i] = offset;
    if memory.believed[i] { r <= limit } else { r <= BACK * limit || (leapt && r <= JUMP + MOST_SLIDE_UNSEEN) }
}

/// The fit of this frame, unless an offset changed faster than skin slides.
fn quiet_fit(problem: &mut Problem<'_>, frames: &Frames, memory: &mut Memory, frame: usize, t: f64) -> Option<Outcome> {
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
        problem.frame_weights[i] > 0.0 && change > SUSPICIOUS + SKIN_SPEED * (t - memory.times[i])
    });
    if !changed {
        memory.x.copy_from_slice(&x);
    }
    memory.trial = x;
    (!changed).then_some(outcome)
}

/// Fits what is loaded at the offsets of memory so that a minority of wild markers does not count, and notes each marker's
/// distance from where it is expected.
fn robust(problem: &mut Problem<'_>, memory: &mut Memory) {
    let mut x = std::mem::take(&mut memory.x);
    memory.weights.copy_from_slice(&problem.frame_weights);
    problem.pose_at(&x);
    for k in 0..REWEIGHTINGS {
        note_distances(problem, memory);
        // From wide to narrow, so that a posture that was foretold badly loses no marker.
        let scale = SCALE * (4.0 * 0.5_f64.powi(k as i32)).max(1.0);
        for (i, r) in memory.distances.iter().enumerate() {
            let share = 1.0 + (r / scale).powi(2);
            problem.frame_weights[i] = if r.is_finite() { memory.weights[i] / (share * share) } else { 0.0 };
        }
        problem.fit_with_offsets(&memory.usable, &mut x);
    }
    note_distances(problem, memory);
    memory.x = x;
}

fn note_distances(problem: &Problem<'_>, memory: &mut Memory) {
    for i in 0..memory.distances.len() {
        let is_loaded = memory.weights[i] > 0.0;
        memory.expected[i] = problem.place(i, &memory.usable[i]);
        memory.distances[i] = if is_loaded { (problem.positions[i] - memory.expected[i]).norm() } else { f64::NAN };
    }
}

/// Exchanges back the labels of markers that stand each where the other is expected.
fn exchange(problem: &Problem<'_>, frames: &mut Frames, memory: &mut Memory, frame: usize, t: f64) {
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

/// In the first frame nothing is expected; an exchange of labels shows as two markers that are far off and come near when
/// exchanged. `x` is the fitted posture before and after.
fn exchange_in_first(problem: &mut Problem<'_>, frames: &mut Frames, memory: &mut Memory, frame: usize) {
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

fn loaded_distance(problem: &Problem<'_>, i: usize) -> f64 {
    if problem.frame_weights[i] > 0.0 { problem.distance(i) } else { f64::NAN }
}
