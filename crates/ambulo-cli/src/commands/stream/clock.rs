//! Times of frames: from a time to the number of a frame, whatever the unit of the times.
//!
//! Frames come at the stated rate, so that times differ by whole periods, mostly by one. Times that always differ by a
//! thousand periods are in milliseconds, and so on; times that always differ by another number of periods than one have
//! another rate.

use ambulo::numerics::sort_numbers;

/// Units of times by their seconds, and how many of them a second has.
const UNITS: [(&str, f64); 3] = [("milliseconds", 1e3), ("microseconds", 1e6), ("nanoseconds", 1e9)];
/// Intervals that show a unit differ by less than this from one another.
const NEAR: f64 = 0.25;
/// An interval that is longer than the usual one by this factor has a lost frame.
const LOSS: f64 = 1.75;
/// Equal intervals that show a unit; fewer may be two losses.
const ENOUGH_FOR_UNIT: usize = 2;
/// Number of intervals most of which must have another rate; fewer equal intervals are enough.
const ENOUGH_FOR_RATE: usize = 20;
const ENOUGH_EQUAL: usize = 5;
/// Intervals without jitter differ by less.
const EQUAL: f64 = 0.02;
/// A rate that differs by less is jitter of the times; forces change with its square.
const OTHER_RATE: f64 = 0.05;
/// Largest number of a frame.
const LARGEST: f64 = 9e15;

/// Unusual times of frames.
#[derive(Debug, Clone, PartialEq)]
pub enum ClockDoubt {
    /// The times have another unit, which is used from now on.
    Unit(&'static str),
    /// The times have another rate [Hz].
    Rate(f64),
}

/// Reads the times of frames.
#[derive(Debug, Clone)]
pub struct Clock {
    rate_hz: f64,
    /// Times per second.
    per_second: f64,
    last: Option<f64>,
    /// The last intervals, in periods of the stated rate.
    intervals: Vec<f64>,
    is_judged: bool,
}

impl Clock {
    /// For frames of a rate, before the first one.
    #[must_use]
    pub fn new(rate_hz: f64) -> Clock {
        Clock { rate_hz, per_second: 1.0, last: None, intervals: Vec::new(), is_judged: false }
    }

    /// Whether the rate of the times is known, so that losses and another rate can be distinguished.
    #[must_use]
    pub fn is_judged(&self) -> bool {
        self.is_judged
    }

    /// The number of the frame at a time; `None` if no frame has this time.
    #[must_use]
    pub fn number(&self, time: f64) -> Option<u64> {
        let number = (time / self.per_second * self.rate_hz).round();
        (0.0..LARGEST).contains(&number).then_some(number as u64)
    }

    /// Takes the next time; returns what the times show now, each once.
    pub fn doubt(&mut self, time: f64) -> Option<ClockDoubt> {
        let periods = self.last.map(|last| (time - last) / self.per_second * self.rate_hz);
        self.last = Some(time);
        let periods = periods.filter(|periods| *periods > 0.0 && !self.is_judged)?;
        self.intervals.push(periods);
        self.other_unit().or_else(|| self.other_rate())
    }

    fn other_unit(&mut self) -> Option<ClockDoubt> {
        let enough = self.intervals.len() == ENOUGH_FOR_UNIT && self.per_second < UNITS[0].1;
        // Frames that are many periods apart are in another unit, even if the rate is wrong too.
        let is_near = |unit: f64| self.intervals.iter().all(|periods| (0.3..3.2).contains(&(periods / unit)));
        let is_even = |first: f64| self.intervals.iter().all(|periods| (periods / first - 1.0).abs() < NEAR);
        let (name, unit) =
            UNITS.into_iter().find(|(_, unit)| enough && is_near(*unit) && is_even(self.intervals[0]))?;
        self.per_second = unit;
        self.intervals.clear();
        Some(ClockDoubt::Unit(name))
    }

    fn other_rate(&mut self) -> Option<ClockDoubt> {
        let count = self.intervals.len();
        let are_equal = self.intervals.iter().all(|periods| (periods / self.intervals[0] - 1.0).abs() < EQUAL);
        if count < ENOUGH_EQUAL || count < ENOUGH_FOR_RATE && !are_equal {
            return None;
        }
        self.is_judged = true;
        sort_numbers(&mut self.intervals);
        // Lost frames at least double some intervals; late ones lengthen one and shorten the next.
        let middle = self.intervals[count / 2];
        let is_usual = |periods: &&f64| **periods < LOSS * middle;
        let usual: Vec<f64> = self.intervals.iter().filter(is_usual).copied().collect();
        let mean = usual.iter().sum::<f64>() / usual.len() as f64;
        ((mean - 1.0).abs() > OTHER_RATE && 2 * usual.len() > count).then(|| ClockDoubt::Rate(self.rate_hz / mean))
    }
}
