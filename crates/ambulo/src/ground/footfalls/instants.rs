//! Times of foot strike and foot off of a stance.
//!
//! **Strike.** Of the lowest point of the foot, two times are averaged:
//! - its speed relative to the floor falls below half of its speed of approach: half the walking speed, or half its
//!   fastest descent if that is more. (A speed that drops in an instant passes its half at the right time after any
//!   zero-phase low-pass filter; Ghoussayni et al. 2004 and Bruening, Ridge 2014 use thresholds of speed, the latter
//!   0.78 of walking speed for the heel);
//! - its fastest descent (O'Connor et al. 2007, there of the middle of the foot).
//!
//! **Off.** The last point on the ground is the lowest one at the end; its speed relative to the floor rises above
//!
//!   v = 0.6 √(g L) (V / √(g L))^⅜,
//!
//! 1.3 m/s for an adult who walks at 1.2 m/s, 2 m/s in a run at 3.8 m/s: a compromise between a share of walking speed
//! (Bruening, Ridge 2014: 0.66), which is late in running, and a constant speed for each person. Factor and power
//! ([`OffSpeed`]) are fitted ([module docs](super)). The limit is at most half of the point's highest speed in the
//! following swing.

use super::belt::Belt;
use super::signals::{FootPath, Signals};
use super::stationary::limit;
use std::ops::Range;

use crate::numerics::elementary::powf;

/// A foot has landed when its speed is below this share of its speed of approach.
const LANDED: f64 = 0.5;
/// The fastest descent is searched this far from the strike by speed, in √(L/g): 0.09 s for an adult.
const NEAR_STRIKE: f64 = 0.3;
/// Slower descents than this share of √(g L) are ignored.
const DESCENT: f64 = 0.02;
/// Lower limit of the walking speed in the threshold, as a share of √(g L).
const SLOWEST: f64 = 0.1;
/// The threshold is at most this share of the highest speed of the swing.
const OF_SWING: f64 = 0.5;

/// Speed of the last point of a foot at which it leaves the ground: factor √(g L) (V / √(g L))^power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OffSpeed {
    /// Share of √(g L) at the walking speed √(g L).
    pub factor: f64,
    /// Power of the walking speed.
    pub power: f64,
}

impl Default for OffSpeed {
    fn default() -> OffSpeed {
        OffSpeed { factor: 0.6, power: 0.375 }
    }
}

/// Signals of one foot for the search of its events.
pub(super) struct Search<'a> {
    pub(super) signals: &'a Signals,
    pub(super) belt: &'a Belt,
    pub(super) walking: &'a [f64],
    pub(super) foot: &'a FootPath,
    pub(super) off_speed: OffSpeed,
}

impl Search<'_> {
    /// Time of the strike of a foot that is stationary from `run.start` on and was last stationary until `free`. `None`
    /// if it was on the ground from the beginning.
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

    /// Time of the off of a foot that is stationary until `run.end`, and again from `next` on. `None` if it is on the
    /// ground until the end.
    pub(super) fn off(&self, run: &Range<usize>, next: Option<usize>) -> Option<f64> {
        let frames = self.signals.grid.frames;
        if run.end >= frames {
            return None;
        }
        let (point, _) = self.signals.lowest(self.foot, run.end - 1);
        let until = next.unwrap_or(frames);
        let leg_speed = self.signals.leg_speed;
        let going = (self.walking[run.end - 1] / leg_speed).max(SLOWEST);
        let mut limit = self.off_speed.factor * leg_speed * powf(going, self.off_speed.power);
        // The highest speed of a swing that the recording cuts is not known.
        if next.is_some() || until - run.end > self.signals.frames_in(self.signals.leg_time_s) {
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

    /// Speed of a point relative to the floor [m/s].
    fn speed(&self, point: usize, frame: usize) -> f64 {
        (self.foot.velocities[frame][point] - self.belt.velocity(frame)).norm()
    }

    fn rise(&self, point: usize, frame: usize) -> f64 {
        self.foot.velocities[frame][point].dot(&self.signals.up)
    }

    fn time(&self, frame: f64) -> f64 {
        self.signals.grid.start_s + self.signals.grid.step_s * frame
    }

    /// Frame, with fraction, at which the speed passes a limit before `frame`.
    fn crossing(&self, point: usize, frame: usize, limit: f64) -> f64 {
        let (before, after) = (self.speed(point, frame - 1), self.speed(point, frame));
        let share = (limit - before) / (after - before);
        frame as f64 - 1.0 + if share.is_finite() { share.clamp(0.0, 1.0) } else { 1.0 }
    }

    /// Frame, with fraction, near the start of a run at which the point becomes slower than a limit; `None` if it was
    /// slower from the beginning of the recording.
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

    /// Frame of the local extremum of descent nearest to a frame, and its speed [m/s].
    fn fastest_descent(&self, point: usize, near: f64, first: usize) -> Option<(f64, f64)> {
        let reach = NEAR_STRIKE * self.signals.leg_time_s / self.signals.grid.step_s;
        let from = ((near - reach).max(0.0).ceil() as usize).max(first + 1);
        let to = ((near + reach) as usize).min(self.signals.grid.frames.saturating_sub(2));
        let is_lowest = |&frame: &usize| {
            let [before, here, after] = [frame - 1, frame, frame + 1].map(|i| self.rise(point, i));
            here < before && here <= after && here < -DESCENT * self.signals.leg_speed
        };
        let distance = |frame: &usize| (*frame as f64 - near).abs();
        let lowest = (from..=to).filter(is_lowest).min_by(|a, b| distance(a).total_cmp(&distance(b)))?;
        let [before, here, after] = [lowest - 1, lowest, lowest + 1].map(|i| self.rise(point, i));
        let bend = before - 2.0 * here + after;
        Some((lowest as f64 + 0.5 * (before - after) / bend, -here))
    }
}
