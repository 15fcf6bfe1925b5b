//! Times during which a point of a foot moves with the floor.
//!
//! The slowest of the three points of a foot, relative to the floor, is slow in stance (the foot rolls from point to
//! point) and fast in swing: a foot that swings for the share s of a stride moves at V / s on average, V being the
//! walking speed.

use super::belt::Belt;
use super::signals::{FootPath, Signals};
use crate::ground::phases::SHORTEST_CONTACT_S;
use crate::spatial::Vec3;
use std::ops::Range;

/// A foot is stationary while a point of it is slower than this share of the walking speed. In swing, 0.4 of a walking
/// stride, the mean is 2.5 times the walking speed.
const STATIONARY: f64 = 0.4;
/// Below this share of √(g L), 0.09 m/s for an adult, a foot is stationary at any walking speed.
const LEAST_LIMIT: f64 = 0.03;
/// In a swing the foot exceeds its limit by this factor.
const LEAST_SWING_SPEED: f64 = 2.0;
/// The body is in flight while the vertical ground force is less than this share of its weight.
const FLIGHT: f64 = 0.15;
/// A foot with less than this share of the total force carries nothing ...
const UNLOADED: f64 = 0.1;
/// ... and is off the floor if it is also higher than the other foot by this [m]; estimated soles differ by less.
const RAISED_M: f64 = 0.03;

/// Walking speed: speed of the mass centre relative to the floor, mean over ± √(L/g) [m/s], one entry per frame.
pub(super) fn walking_speed(signals: &Signals, belt: &Belt) -> Vec<f64> {
    let mut sums = vec![Vec3::zeros()];
    let mut sum = Vec3::zeros();
    for (frame, velocity) in signals.center_velocity.iter().enumerate() {
        sum += signals.level(velocity - belt.velocity(frame));
        sums.push(sum);
    }
    let (frames, reach) = (signals.grid.frames, signals.frames_in(signals.leg_time_s));
    let mean = |frame: usize| {
        let (from, to) = (frame.saturating_sub(reach), (frame + reach + 1).min(frames));
        (sums[to] - sums[from]).norm() / (to - from) as f64
    };
    (0..frames).map(mean).collect()
}

/// Speed below which a foot is stationary [m/s].
pub(super) fn limit(signals: &Signals, walking: f64) -> f64 {
    (STATIONARY * walking).max(LEAST_LIMIT * signals.leg_speed)
}

/// Ranges of frames during which a foot is stationary long enough for a stance, in order of time.
pub(super) fn stationary(signals: &Signals, belt: &Belt, walking: &[f64], foot: &FootPath) -> Vec<Range<usize>> {
    // Speed of the slowest point divided by the limit.
    let relative_speed = |frame: usize| {
        let floor = belt.velocity(frame);
        let slowest = foot.velocities[frame].iter().map(|v| (v - floor).norm()).fold(f64::INFINITY, f64::min);
        slowest / limit(signals, walking[frame])
    };
    let relative_speed: Vec<f64> = (0..signals.grid.frames).map(relative_speed).collect();
    let shortest = signals.frames_in(SHORTEST_CONTACT_S);
    let mut merged: Vec<Range<usize>> = Vec::new();
    for run in below_one(&relative_speed) {
        match merged.last_mut() {
            Some(last) if is_not_a_swing(&relative_speed[last.end..run.start], shortest) => last.end = run.end,
            _ => merged.push(run),
        }
    }
    let carried = |run: &Range<usize>| signals.carried[run.clone()].iter().sum::<f64>() / run.len() as f64;
    // The duration of a stance that the recording cuts is not known.
    let is_cut = |run: &Range<usize>| run.len() > 1 && (run.start == 0 || run.end == signals.grid.frames);
    merged.retain(|run| (run.len() >= shortest || is_cut(run)) && carried(run) > FLIGHT);
    merged
}

fn is_not_a_swing(relative_speed: &[f64], shortest: usize) -> bool {
    relative_speed.len() < shortest || relative_speed.iter().all(|h| *h < LEAST_SWING_SPEED)
}

fn below_one(relative_speed: &[f64]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (frame, _) in relative_speed.iter().enumerate().filter(|(_, h)| **h < 1.0) {
        match runs.last_mut() {
            Some(last) if last.end == frame => last.end += 1,
            _ => runs.push(frame..frame + 1),
        }
    }
    runs
}

/// Removes the times at which a foot is held still in the air while the other one carries the body.
pub(super) fn keep_loaded(signals: &Signals, runs: &mut [Vec<Range<usize>>]) {
    let [first, second] = runs else { return };
    let [a, b] = signals.feet.as_slice() else { return };
    let all = [first.clone(), second.clone()];
    first.retain(|run| is_loaded(signals, [a, b], run, &all[1]));
    second.retain(|run| is_loaded(signals, [b, a], run, &all[0]));
}

/// Whether the first of two feet is loaded during a run; the other one is stationary during `others`.
fn is_loaded(signals: &Signals, [foot, other]: [&FootPath; 2], run: &Range<usize>, others: &[Range<usize>]) -> bool {
    let shared = others.iter().map(|o| o.start.max(run.start)..o.end.min(run.end)).filter(|o| !o.is_empty());
    let shared: Vec<usize> = shared.flatten().collect();
    if run.len() - shared.len() >= signals.frames_in(SHORTEST_CONTACT_S) {
        return true;
    }
    let middle = |foot: &FootPath, frame: usize| signals.level(foot.places[frame].iter().sum::<Vec3>() / 3.0);
    let (mut share, mut above) = (0.0, 0.0);
    for &frame in &shared {
        let (height, floor) = (signals.lowest(foot, frame).1, signals.lowest(other, frame).1);
        let from = middle(other, frame);
        let apart = middle(foot, frame) - from;
        let lever = signals.level(signals.pressure(frame, floor)) - from;
        share += lever.dot(&apart) / apart.norm_squared();
        above += height - floor;
    }
    let count = shared.len().max(1) as f64;
    let is_raised = share / count < UNLOADED && above / count > RAISED_M;
    !is_raised
}
