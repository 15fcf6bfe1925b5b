//! When a point of a foot moves with the floor.
//!
//! The slowest of a foot's three points, against the floor, is slow in stance (the foot rolls from point to point) and fast in swing: a
//! foot that swings for the share s of a stride moves at V / s on average, V being the walking speed.

use super::belt::Belt;
use super::signals::{FootPath, Signals};
use crate::ground::phases::SHORTEST_CONTACT_S;
use crate::spatial::Vec3;
use std::ops::Range;

/// A foot is still while a point of it is slower than this share of the walking speed. In swing, which takes 0.4 of a walking stride, the
/// mean is 2.5 times that speed.
const STILL: f64 = 0.4;
/// Below this share of √(g L), 0.09 m/s for an adult, a foot is still however slowly its owner goes.
const CREEP: f64 = 0.03;
/// A break in which the foot never exceeds its limit by this factor is no swing.
const NO_SWING: f64 = 2.0;
/// Nobody stands while the body needs less than this share of its weight.
const FLIGHT: f64 = 0.15;
/// A foot without this share of the force, between the two feet, carries nothing ...
const UNLOADED: f64 = 0.1;
/// ... and is off the floor if it is also higher than the other by this [m]; soles that are estimated may differ by less.
const RAISED_M: f64 = 0.03;

/// Walking speed: the mass centre against the floor, mean over ± √(L/g) [m/s], one entry a frame.
pub(super) fn walking_speed(signals: &Signals, belt: &Belt) -> Vec<f64> {
    let mut sums = vec![Vec3::zeros()];
    let mut sum = Vec3::zeros();
    for (frame, velocity) in signals.center_velocity.iter().enumerate() {
        sum += signals.level(velocity - belt.velocity(frame));
        sums.push(sum);
    }
    let (frames, reach) = (signals.grid.frames, signals.frames_in(signals.swing_s));
    let mean = |frame: usize| {
        let (from, to) = (frame.saturating_sub(reach), (frame + reach + 1).min(frames));
        (sums[to] - sums[from]).norm() / (to - from) as f64
    };
    (0..frames).map(mean).collect()
}

/// Speed below which a foot is still [m/s].
pub(super) fn limit(signals: &Signals, walking: f64) -> f64 {
    (STILL * walking).max(CREEP * signals.pace)
}

/// Frames during which a foot is still long enough to stand, in order.
pub(super) fn still(signals: &Signals, belt: &Belt, walking: &[f64], foot: &FootPath) -> Vec<Range<usize>> {
    // Speed of the slowest point over the limit.
    let haste = |frame: usize| {
        let floor = belt.velocity(frame);
        let slowest = foot.velocities[frame].iter().map(|v| (v - floor).norm()).fold(f64::INFINITY, f64::min);
        slowest / limit(signals, walking[frame])
    };
    let haste: Vec<f64> = (0..signals.grid.frames).map(haste).collect();
    let shortest = signals.frames_in(SHORTEST_CONTACT_S);
    let mut merged: Vec<Range<usize>> = Vec::new();
    for run in below_one(&haste) {
        match merged.last_mut() {
            Some(last) if is_no_swing(&haste[last.end..run.start], shortest) => last.end = run.end,
            _ => merged.push(run),
        }
    }
    let carried = |run: &Range<usize>| signals.carried[run.clone()].iter().sum::<f64>() / run.len() as f64;
    // How long a foot stands that the recording cuts is not known.
    let is_cut = |run: &Range<usize>| run.len() > 1 && (run.start == 0 || run.end == signals.grid.frames);
    merged.retain(|run| (run.len() >= shortest || is_cut(run)) && carried(run) > FLIGHT);
    merged
}

fn is_no_swing(haste: &[f64], shortest: usize) -> bool {
    haste.len() < shortest || haste.iter().all(|h| *h < NO_SWING)
}

fn below_one(haste: &[f64]) -> Vec<Range<usize>> {
    let mut runs: Vec<Range<usize>> = Vec::new();
    for (frame, _) in haste.iter().enumerate().filter(|(_, h)| **h < 1.0) {
        match runs.last_mut() {
            Some(last) if last.end == frame => last.end += 1,
            _ => runs.push(frame..frame + 1),
        }
    }
    runs
}

/// Takes out the times at which a foot is held still in the air, while the other carries all: the force passes by it.
pub(super) fn keep_loaded(signals: &Signals, runs: &mut [Vec<Range<usize>>]) {
    let [first, second] = runs else { return };
    let [a, b] = signals.feet.as_slice() else { return };
    let all = [first.clone(), second.clone()];
    first.retain(|run| is_loaded(signals, [a, b], run, &all[1]));
    second.retain(|run| is_loaded(signals, [b, a], run, &all[0]));
}

/// Whether the first of two feet carries something during a run, the other being still during `others`.
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
    let passes_by = share / count < UNLOADED && above / count > RAISED_M;
    !passes_by
}
