//! Walking backwards: the stances are those of the walk forwards that it is when it is played back.
//!
//! Who walks backwards lands on the toes and leaves the floor with the heel, at nearly the joint angles of a walk
//! forwards played back (Winter, Pluck, Yang 1989, unverified). A motion is backwards if the mass centre moves against
//! the feet on the mean of all frames:
//!
//!   Σ v · f < [`AGAINST`] Σ |v|,    v the level velocity relative to the floor, f the unit vector from heels to toes.
//!
//! Pinned by: tests/walking_backwards.rs

use super::signals::{FootPath, Signals};
use super::{Footfall, Footfalls, in_order};
use crate::ground::phases::Contact;
use crate::numerics::sampled;
use crate::spatial::Vec3;

/// Share of the speed that is against the feet.
const AGAINST: f64 = -0.7;
/// Who moves slower does not walk [m/s].
const SLOWEST_M_S: f64 = 0.15;
/// Frames that are looked at.
pub(in crate::ground) const FRAMES: usize = 64;

/// Whether a person walks backwards. Of each frame: velocity of the mass centre relative to the floor [m/s], and the
/// sum of the vectors from heel to toes of both feet.
pub(in crate::ground) fn walks_backwards(frames: impl Iterator<Item = [Vec3; 2]>, up: Vec3) -> bool {
    let level = |v: Vec3| v - up * v.dot(&up);
    let (mut along, mut speed, mut count) = (0.0, 0.0, 0.0);
    for [moving, forward] in frames.map(|frame| frame.map(level)) {
        along += forward.try_normalize(f64::MIN_POSITIVE).map_or(0.0, |forward| forward.dot(&moving));
        speed += moving.norm();
        count += 1.0;
    }
    speed > SLOWEST_M_S * count && along < AGAINST * speed
}

impl Signals {
    /// Whether the person walks backwards on a floor of this velocity [m/s].
    pub(super) fn is_backwards(&self, floor_velocity: Vec3) -> bool {
        let along = |frame: usize| self.feet.iter().map(|foot| foot.places[frame][2] - foot.places[frame][0]).sum();
        let frames = sampled(self.center_velocity.len(), FRAMES);
        walks_backwards(frames.map(|frame| [self.center_velocity[frame] - floor_velocity, along(frame)]), self.up)
    }

    /// The signals when time runs from the end to the beginning.
    pub(super) fn played_back(&self) -> Signals {
        let back = |foot: &FootPath| FootPath {
            side: foot.side,
            places: foot.places.iter().rev().copied().collect(),
            velocities: foot.velocities.iter().rev().map(|velocities| velocities.map(|velocity| -velocity)).collect(),
        };
        Signals {
            feet: self.feet.iter().map(back).collect(),
            center_velocity: self.center_velocity.iter().rev().map(|velocity| -velocity).collect(),
            carried: self.carried.iter().rev().copied().collect(),
            pressure_line: self.pressure_line.iter().rev().copied().collect(),
            ..*self
        }
    }
}

impl Footfalls {
    /// The stances when time runs from the end to the beginning; `ends_s` is the sum of its first and last time [s].
    pub(in crate::ground) fn played_back(self, ends_s: f64) -> Footfalls {
        let back = |fall: Footfall| {
            let contact = Contact { strike_s: fall.strike_s, off_s: fall.off_s };
            let Contact { strike_s, off_s } = contact.played_back(ends_s);
            Footfall { strike_s, off_s, floor_velocity: -fall.floor_velocity, ..fall }
        };
        let falls = in_order(self.falls.into_iter().map(back).collect());
        Footfalls { falls, floor_velocity: -self.floor_velocity }
    }
}
