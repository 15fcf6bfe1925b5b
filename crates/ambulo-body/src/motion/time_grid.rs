//! Uniform time grids, time windows, and interpolation between samples.

use serde::Deserialize;

/// Times at a constant step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeGrid {
    /// First time [s].
    pub start_s: f64,
    /// Time step [s].
    pub step_s: f64,
    /// Number of frames.
    pub frames: usize,
}

/// A range of time; `None` is an open end.
#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Window {
    /// Start [s].
    pub from_s: Option<f64>,
    /// End [s].
    pub to_s: Option<f64>,
}

/// Largest distance of a recorded time from the grid, as a share of the step: the rounding of four decimals at 1 kHz.
const GRID_TOLERANCE: f64 = 0.06;

impl TimeGrid {
    /// Time of a frame [s].
    #[inline]
    #[must_use]
    pub fn time(&self, frame: usize) -> f64 {
        self.start_s + self.step_s * frame as f64
    }

    /// All times [s].
    #[must_use]
    pub fn times(&self) -> Vec<f64> {
        (0..self.frames).map(|i| self.time(i)).collect()
    }

    /// Frame rate [Hz].
    #[inline]
    #[must_use]
    pub fn rate_hz(&self) -> f64 {
        1.0 / self.step_s
    }

    /// Last time [s].
    #[inline]
    #[must_use]
    pub fn end_s(&self) -> f64 {
        self.time(self.frames.saturating_sub(1))
    }

    /// The grid of these increasing times, up to rounding; `None` if they are not uniform or fewer than two.
    #[must_use]
    pub fn through(times: &[f64]) -> Option<TimeGrid> {
        let grid = TimeGrid::spanning(times)?;
        let near = |(i, t): (usize, &f64)| (t - grid.time(i)).abs() <= GRID_TOLERANCE * grid.step_s;
        times.iter().enumerate().all(near).then_some(grid)
    }

    /// A uniform grid with the same ends and number of times; `None` for fewer than two.
    #[must_use]
    pub fn spanning(times: &[f64]) -> Option<TimeGrid> {
        let (&first, &last) = (times.first()?, times.last()?);
        let frames = times.len();
        (frames >= 2 && last > first).then(|| TimeGrid {
            start_s: first,
            step_s: (last - first) / (frames - 1) as f64,
            frames,
        })
    }

    /// Frames inside a window, including its ends, as first frame and number of frames.
    #[must_use]
    pub fn inside(&self, window: Window) -> (usize, usize) {
        let slack = 1e-6 * self.step_s;
        let first = match window.from_s {
            Some(from) => (0..self.frames).find(|&i| self.time(i) >= from - slack).unwrap_or(self.frames),
            None => 0,
        };
        let end = match window.to_s {
            Some(to) => (0..self.frames).rev().find(|&i| self.time(i) <= to + slack).map_or(0, |i| i + 1),
            None => self.frames,
        };
        (first, end.saturating_sub(first))
    }
}

impl Window {
    /// The intersection of two windows.
    #[must_use]
    pub fn overlap(self, other: Window) -> Window {
        let later = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(a.max(b)),
            (a, b) => a.or(b),
        };
        let earlier = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => Some(a.min(b)),
            (a, b) => a.or(b),
        };
        Window { from_s: later(self.from_s, other.from_s), to_s: earlier(self.to_s, other.to_s) }
    }
}

/// Linear interpolation at `t`, constant beyond the ends. `times` increase.
#[inline]
#[must_use]
pub fn interpolate(times: &[f64], values: &[f64], t: f64) -> f64 {
    Between::of(times, t).value(values)
}

/// Place of a time between samples: found once for all columns of a recording.
#[derive(Debug, Clone, Copy)]
pub enum Between {
    /// At one sample, or beyond the ends.
    Sample(usize),
    /// Before sample `after`, as this share of the way from the sample in front of it.
    Samples {
        /// Number of the later sample.
        after: usize,
        /// Share of the interval, 0 to 1.
        share: f64,
    },
}

impl Between {
    /// The place of `t` among `times`, which increase.
    #[inline]
    #[must_use]
    pub fn of(times: &[f64], t: f64) -> Between {
        match times.partition_point(|&x| x <= t) {
            0 => Between::Sample(0),
            after if after == times.len() => Between::Sample(after - 1),
            after => {
                let (t0, t1) = (times[after - 1], times[after]);
                Between::Samples { after, share: (t - t0) / (t1 - t0) }
            }
        }
    }

    /// The interpolated value of a column; not-a-number of one without samples.
    #[inline]
    #[must_use]
    pub fn value(self, values: &[f64]) -> f64 {
        match self {
            Between::Sample(at) => values.get(at).copied().unwrap_or(f64::NAN),
            Between::Samples { after, share } => values[after - 1] * (1.0 - share) + values[after] * share,
        }
    }
}
