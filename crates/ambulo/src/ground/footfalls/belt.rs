//! How fast the floor goes by: the belt of a treadmill, or a floor that rests.
//!
//! While the body is carried, the lower foot stands most of the time, and what stands moves with the floor. So the velocities of the
//! lowest point of both feet gather at the floor's velocity, and those of swinging feet scatter: from their median a mean over the
//! neighbourhood is taken until it rests (mean shift, Fukunaga, Hostetler 1975, unverified). Pieces of the recording are looked at on
//! their own as well, so that a belt may change its speed slowly.

use super::signals::Signals;
use crate::numerics::median;
use crate::spatial::Vec3;
use std::ops::Range;

/// The body is carried above this share of its weight.
const CARRIED: f64 = 0.5;
/// What stands neither rises nor sinks faster than this share of √(g L).
const LEVEL: f64 = 0.05;
/// Velocities this near belong together, share of √(g L).
const TOGETHER: f64 = 0.1;
/// Below this share of √(g L), 0.09 m/s for an adult, the floor rests: stance feet of people on a floor are seen to creep by 0.03 m/s.
const RESTS: f64 = 0.03;
/// A belt whose speed changes by less than this share of √(g L) runs evenly.
const EVEN: f64 = 0.05;
/// Length of a piece, in √(L/g): about two strides.
const PIECE: f64 = 8.0;
/// Share of the velocities that have to lie together to be believed; 0.83 to 1 of those of walks and runs do.
const BELIEVED: f64 = 0.6;
/// Rounds of the mean; it rests after a few.
const ROUNDS: usize = 20;

/// The velocity of the floor over the recording.
pub(super) struct Belt {
    /// Over everything [m/s].
    pub(super) overall: Vec3,
    /// Frame and velocity [m/s], rising; straight lines between them.
    knots: Vec<(f64, Vec3)>,
}

impl Belt {
    /// Found from the feet.
    pub(super) fn new(signals: &Signals) -> Belt {
        let samples = samples(signals);
        let believed = |(_, count): &(Vec3, usize)| *count as f64 >= BELIEVED * samples.len() as f64;
        let Some((overall, _)) = gathered(signals, &samples).filter(believed) else {
            return Belt { overall: Vec3::zeros(), knots: Vec::new() };
        };
        let length = signals.frames_in(PIECE * signals.swing_s);
        let starts = (0..signals.grid.frames).step_by(length.div_ceil(2));
        let knots: Vec<(f64, Vec3)> =
            starts.filter_map(|start| piece(signals, &samples, start..start + length)).collect();
        let is_even = knots.iter().all(|(_, v)| (v - overall).norm() < EVEN * signals.pace);
        let overall = resting(signals, overall);
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

/// Frame and velocity along the floor of the lowest point, where it may stand.
fn samples(signals: &Signals) -> Vec<(usize, Vec3)> {
    let of_frame = |frame: usize| {
        let lowest = |foot| (signals.lowest(foot, frame), foot);
        let ((point, _), foot) = signals.feet.iter().map(lowest).min_by(|((_, a), _), ((_, b), _)| a.total_cmp(b))?;
        let velocity = foot.velocities[frame][point];
        let stands = signals.carried[frame] > CARRIED && velocity.dot(&signals.up).abs() < LEVEL * signals.pace;
        stands.then(|| (frame, signals.level(velocity)))
    };
    (0..signals.grid.frames).filter_map(of_frame).collect()
}

/// The velocity of a piece at the middle of its frames.
fn piece(signals: &Signals, samples: &[(usize, Vec3)], frames: Range<usize>) -> Option<(f64, Vec3)> {
    let from = samples.partition_point(|(frame, _)| *frame < frames.start);
    let to = samples.partition_point(|(frame, _)| *frame < frames.end);
    let inside = &samples[from..to];
    let (velocity, count) = gathered(signals, inside)?;
    let believed = count as f64 >= BELIEVED * inside.len() as f64 && 4 * inside.len() >= frames.len();
    believed.then(|| (0.5 * (frames.start + frames.end) as f64, resting(signals, velocity)))
}

/// Where the velocities gather, and how many do.
fn gathered(signals: &Signals, samples: &[(usize, Vec3)]) -> Option<(Vec3, usize)> {
    let along = |k: usize| median(samples.iter().map(|(_, v)| v[k]));
    let mut center = Vec3::new(along(0)?, along(1)?, along(2)?);
    let mut count = 0;
    for _ in 0..ROUNDS {
        let near = samples.iter().filter(|(_, v)| (v - center).norm() < TOGETHER * signals.pace);
        let (sum, found) = near.fold((Vec3::zeros(), 0), |(sum, n), (_, v)| (sum + v, n + 1));
        if found == 0 {
            break;
        }
        let mean = sum / f64::from(found);
        let moved = (mean - center).norm();
        (center, count) = (mean, found as usize);
        if moved < 1e-6 * signals.pace {
            break;
        }
    }
    (count > 0).then_some((center, count))
}

fn resting(signals: &Signals, velocity: Vec3) -> Vec3 {
    if velocity.norm() < RESTS * signals.pace { Vec3::zeros() } else { velocity }
}
