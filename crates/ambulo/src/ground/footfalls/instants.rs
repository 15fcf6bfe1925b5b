//! The instants at which a stance begins and ends.
//!
//! **Strike.** What lands is the point that is lowest. Two instants are found and their mean is taken:
//! - its speed against the floor falls below half of what it comes down with: half the walking speed, or half its fastest descent if that is
//!   more. (A speed that drops at once passes its half at the right instant after any low-pass without phase; Ghoussayni et al. 2004
//!   and Bruening, Ridge 2014 use thresholds of speed, the latter 0.78 of walking speed for the heel);
//! - its fastest descent (O'Connor et al. 2007, there of the middle of the foot).
//!
//! **Off.** What leaves last is the point that is lowest at the end; its speed against the floor rises above
//!
//!   v = 0.6 √(g L) (V / √(g L))^⅜,
//!
//! 1.3 m/s for an adult who walks at 1.2 m/s, 2 m/s at a run of 3.8 m/s: between a share of walking speed (Bruening, Ridge 2014: 0.66),
//! which is late in running, and a speed that depends on the person only. Factor and power ([`OffSpeed`]) are fitted ([module docs](super)). It is at
//! most half of the point's highest speed in the swing that follows.

use super::belt::Belt;
use super::signals::{FootPath, Signals};
use super::still::limit;
use std::ops::Range;

/// A foot has landed below this share of the speed that it comes with.
const LANDED: f64 = 0.5;
/// Strikes are searched this far from where the speed says, in √(L/g): 0.09 s for an adult.
const NEAR_STRIKE: f64 = 0.3;
/// Slower descents than this share of √(g L) tell nothing of a strike.
const DESCENT: f64 = 0.02;
/// Who goes slower than this share of √(g L) counts as going at it.
const SLOWEST: f64 = 0.1;
/// At most this share of the highest speed of the swing.
const OF_SWING: f64 = 0.5;

/// The speed of a foot's last point at which it has left the ground: factor √(g L) (V / √(g L))^power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffSpeed {
    /// Share of √(g L), at the walking speed √(g L).
    pub factor: f64,
    /// Power of the walking speed.
    pub power: f64,
}

impl Default for OffSpeed {
    fn default() -> OffSpeed {
        OffSpeed { factor: 0.6, power: 0.375 }
    }
}

/// One foot and what its search needs.
pub(super) struct Search<'a> {
    pub(super) signals: &'a Signals,
    pub(super) belt: &'a Belt,
    pub(super) walking: &'a [f64],
    pub(super) foot: &'a FootPath,
    pub(super) left: OffSpeed,
}

impl Search<'_> {
    /// When the foot lands that is still from `run.start` on; it was still before until `free`. `None` if it stood from the beginning.
    pub(super) fn strike(&self, run: &Range<usize>, free: Option<usize>) -> Option<f64> {
        if run.start == 0 {
            return None;
        }
        let (point, _) = self.signals.lowest(self.foot, run.start);
        let walking = self.walking[run.start];
        let slow = (LANDED * walking).max(limit(self.signals, walking));
        let first = free.unwrap_or(0);
        let by_speed = self.falls_below(point, slow, run, first)?;
        let Some((_, descent)) = self.fastest_descent(point, by_speed, first) else { return Some(self.time(by_speed)) };
        let by_speed = self.falls_below(point, slow.max(LANDED * descent), run, first)?;
        let by_descent = self.fastest_descent(point, by_speed, first).map_or(by_speed, |(frame, _)| frame);
        Some(self.time(0.5 * (by_speed + by_descent)))
    }

    /// When the foot leaves that is still until `run.end`; it is still again from `next` on. `None` if it stands until the end.
    pub(super) fn off(&self, run: &Range<usize>, next: Option<usize>) -> Option<f64> {
        let frames = self.signals.grid.frames;
        if run.end >= frames {
            return None;
        }
        let (point, _) = self.signals.lowest(self.foot, run.end - 1);
        let until = next.unwrap_or(frames);
        let pace = self.signals.pace;
        let going = (self.walking[run.end - 1] / pace).max(SLOWEST);
        let mut limit = self.left.factor * pace * going.powf(self.left.power);
        // A swing that the recording cuts does not tell how fast it is.
        if next.is_some() || until - run.end > self.signals.frames_in(self.signals.swing_s) {
            let fastest = (run.end..until).map(|frame| self.speed(point, frame)).fold(0.0, f64::max);
            limit = limit.min(OF_SWING * fastest);
        }
        let mut frame = run.end;
        while frame < until && self.speed(point, frame) < limit {
            frame += 1;
        }
        while frame > run.start + 1 && self.speed(point, frame - 1) >= limit {
            frame -= 1;
        }
        (frame < until).then(|| self.time(self.crossing(point, frame, limit)))
    }

    /// Speed of a point against the floor [m/s].
    fn speed(&self, point: usize, frame: usize) -> f64 {
        (self.foot.velocities[frame][point] - self.belt.velocity(frame)).norm()
    }

    fn rise(&self, point: usize, frame: usize) -> f64 {
        self.foot.velocities[frame][point].dot(&self.signals.up)
    }

    fn time(&self, frame: f64) -> f64 {
        self.signals.grid.start_s + self.signals.grid.step_s * frame
    }

    /// Between which frames, counted with a fraction, the speed passes a limit on its way to `frame`.
    fn crossing(&self, point: usize, frame: usize, limit: f64) -> f64 {
        let (before, after) = (self.speed(point, frame - 1), self.speed(point, frame));
        let share = (limit - before) / (after - before);
        frame as f64 - 1.0 + if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 }
    }

    /// The frame at which the point becomes slower than a limit, next to the start of a run; `None` if it was slower from `first` on and
    /// that is where the recording begins.
    fn falls_below(&self, point: usize, limit: f64, run: &Range<usize>, first: usize) -> Option<f64> {
        let mut frame = run.start;
        while frame + 1 < run.end && self.speed(point, frame) >= limit {
            frame += 1;
        }
        while frame > first && self.speed(point, frame - 1) < limit {
            frame -= 1;
        }
        (frame > 0).then(|| self.crossing(point, frame, limit))
    }

    /// Frame of the fastest descent that is nearest to a frame, with the speed of it [m/s].
    fn fastest_descent(&self, point: usize, near: f64, first: usize) -> Option<(f64, f64)> {
        let reach = NEAR_STRIKE * self.signals.swing_s / self.signals.grid.step_s;
        let from = ((near - reach).max(0.0).ceil() as usize).max(first + 1);
        let to = ((near + reach) as usize).min(self.signals.grid.frames.saturating_sub(2));
        let is_lowest = |&frame: &usize| {
            let [before, here, after] = [frame - 1, frame, frame + 1].map(|i| self.rise(point, i));
            here < before && here <= after && here < -DESCENT * self.signals.pace
        };
        let distance = |frame: &usize| (*frame as f64 - near).abs();
        let lowest = (from..=to).filter(is_lowest).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let [before, here, after] = [lowest - 1, lowest, lowest + 1].map(|i| self.rise(point, i));
        let bend = before - 2.0 * here + after;
        Some((lowest as f64 + 0.5 * (before - after) / bend, -here))
    }
}
