//! Velocity of the floor: of the belt of a treadmill, or zero.
//!
//! While the body is supported, the lower foot is usually in stance, and moves with the floor. The velocities of the
//! lowest point of both feet therefore cluster at the velocity of the floor; velocities of swinging feet scatter. The
//! centre of the cluster is found by mean shift from the median (Fukunaga, Hostetler 1975, unverified). In fast running
//! the velocity of a stance foot does not settle in a low-passed motion, so there the cluster may be wider. Pieces of
//! the recording are evaluated separately as well, so that a belt may change its speed slowly.

use super::signals::Signals;
use crate::numerics::median;
use crate::spatial::Vec3;
use std::ops::Range;

/// The body is supported while the vertical force exceeds this share of its weight.
const CARRIED: f64 = 0.5;
/// Vertical speed of a stance foot, at most, as a share of √(g L).
const LEVEL: f64 = 0.05;
/// Radius of a cluster of velocities, as a share of √(g L).
const TOGETHER: f64 = 0.1;
/// The same where the floor moves at the speed of running.
const TOGETHER_IN_RUNNING: f64 = 0.2;
/// Transition from walking to running, as a share of √(g L): Froude number one half (Alexander 1989).
const RUNNING: f64 = 0.7;
/// Speed at which the floor is at rest, as a share of √(g L) (0.09 m/s for an adult): stance feet creep by 0.03 m/s.
const RESTS: f64 = 0.03;
/// A belt whose speed changes by less than this share of √(g L) has a constant speed.
const EVEN: f64 = 0.05;
/// Length of a piece, in √(L/g): about two strides.
const PIECE: f64 = 8.0;
/// Share of the velocities that must lie in the cluster; in walks and runs it is 0.83 to 1.
const MOST_AGREE: f64 = 0.6;
/// Largest number of iterations of the mean shift; it converges after a few.
const ROUNDS: usize = 20;

/// Velocity of the floor over the recording.
pub(super) struct Belt {
    /// Over the whole recording [m/s].
    pub(super) overall: Vec3,
    /// Increasing frames and velocities [m/s], interpolated linearly; empty for a constant speed.
    knots: Vec<(f64, Vec3)>,
}

impl Belt {
    pub(super) fn new(signals: &Signals) -> Belt {
        let samples = samples(signals);
        let is_reliable = |(_, count): &(Vec3, usize)| *count as f64 >= MOST_AGREE * samples.len() as f64;
        let runs = |(velocity, _): &(Vec3, usize)| velocity.norm() > RUNNING * signals.leg_speed;
        let found = mean_shift(signals, &samples, TOGETHER).filter(is_reliable);
        let in_running = || mean_shift(signals, &samples, TOGETHER_IN_RUNNING).filter(is_reliable).filter(runs);
        let Some((overall, _)) = found.or_else(in_running) else {
            return Belt { overall: Vec3::zeros(), knots: Vec::new() };
        };
        let length = signals.frames_in(PIECE * signals.leg_time_s);
        let starts = (0..signals.grid.frames).step_by(length.div_ceil(2));
        let knots: Vec<(f64, Vec3)> =
            starts.filter_map(|start| piece(signals, &samples, start..start + length)).collect();
        let is_even = knots.iter().all(|(_, v)| (v - overall).norm() < EVEN * signals.leg_speed);
        let overall = zero_if_at_rest(signals, overall);
        Belt { overall, knots: if is_even { Vec::new() } else { knots } }
    }

    /// Velocity of the floor [m/s].
    pub(super) fn velocity(&self, frame: usize) -> Vec3 {
        let at = frame as f64;
        let next = self.knots.partition_point(|(knot, _)| *knot <= at);
        match (next.checked_sub(1).and_then(|i| self.knots.get(i)), self.knots.get(next)) {
            (Some((from, a)), Some((to, b))) => a + (b - a) * ((at - from) / (to - from)),
            (Some((_, only)), None) | (None, Some((_, only))) => *only,
            (None, None) => self.overall,
        }
    }
}

/// Frame and horizontal velocity of the lowest point of the feet where it may be in stance.
fn samples(signals: &Signals) -> Vec<(usize, Vec3)> {
    let of_frame = |frame: usize| {
        let lowest = |foot| (signals.lowest(foot, frame), foot);
        let ((point, _), foot) = signals.feet.iter().map(lowest).min_by(|((_, a), _), ((_, b), _)| a.total_cmp(b))?;
        let velocity = foot.velocities[frame][point];
        let stands = signals.carried[frame] > CARRIED && velocity.dot(&signals.up).abs() < LEVEL * signals.leg_speed;
        stands.then(|| (frame, signals.level(velocity)))
    };
    (0..signals.grid.frames).filter_map(of_frame).collect()
}

/// Middle frame and velocity of one piece of the recording.
fn piece(signals: &Signals, samples: &[(usize, Vec3)], frames: Range<usize>) -> Option<(f64, Vec3)> {
    let from = samples.partition_point(|(frame, _)| *frame < frames.start);
    let to = samples.partition_point(|(frame, _)| *frame < frames.end);
    let inside = &samples[from..to];
    let (velocity, count) = mean_shift(signals, inside, TOGETHER)?;
    let is_reliable = count as f64 >= MOST_AGREE * inside.len() as f64 && 4 * inside.len() >= frames.len();
    is_reliable.then(|| (0.5 * (frames.start + frames.end) as f64, zero_if_at_rest(signals, velocity)))
}

/// Centre of the cluster of velocities within a radius [√(g L)], and their number in it.
fn mean_shift(signals: &Signals, samples: &[(usize, Vec3)], radius: f64) -> Option<(Vec3, usize)> {
    let along = |k: usize| median(samples.iter().map(|(_, v)| v[k]));
    let mut center = Vec3::new(along(0)?, along(1)?, along(2)?);
    let mut count = 0;
    for _ in 0..ROUNDS {
        let near = samples.iter().filter(|(_, v)| (v - center).norm() < radius * signals.leg_speed);
        let (sum, found) = near.fold((Vec3::zeros(), 0), |(sum, n), (_, v)| (sum + v, n + 1));
        if found == 0 {
            break;
        }
        let mean = sum / f64::from(found);
        let moved = (mean - center).norm();
        (center, count) = (mean, found as usize);
        if moved < 1e-6 * signals.leg_speed {
            break;
        }
    }
    (count > 0).then_some((center, count))
}

fn zero_if_at_rest(signals: &Signals, velocity: Vec3) -> Vec3 {
    if velocity.norm() < RESTS * signals.leg_speed { Vec3::zeros() } else { velocity }
}
