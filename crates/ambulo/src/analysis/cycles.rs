//! Gait cycles: from a foot strike to the next one of the same foot, time-normalised to 101 samples (0 to 100 %).

use super::events::{Event, EventKind};
use crate::model::Side;
use crate::motion::{TimeGrid, interpolate};

/// Samples of a time-normalised cycle: one per per cent from 0 to 100.
pub const CYCLE_SAMPLES: usize = 101;

/// One gait cycle of one foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cycle {
    /// The foot.
    pub side: Side,
    /// Number of the cycle among the cycles of this foot, from 1.
    pub number: usize,
    /// Foot strike [s].
    pub start_s: f64,
    /// Next foot strike of the same foot [s].
    pub end_s: f64,
    /// Foot off in between [s], if detected.
    pub foot_off_s: Option<f64>,
}

/// The cycles that lie entirely within the grid, right foot first.
#[must_use]
pub fn cycles(events: &[Event], grid: TimeGrid) -> Vec<Cycle> {
    let slack = 1e-6 * grid.step_s;
    let mut list = Vec::new();
    for side in Side::BOTH {
        let times = |kind: EventKind| events.iter().filter(move |e| e.side == side && e.kind == kind).map(|e| e.time_s);
        let strikes: Vec<f64> = times(EventKind::Strike).collect();
        let whole = strikes.windows(2).filter(|w| w[0] >= grid.start_s - slack && w[1] <= grid.end_s() + slack);
        for (i, pair) in whole.enumerate() {
            let foot_off_s = times(EventKind::Off).find(|&t| t > pair[0] && t < pair[1]);
            list.push(Cycle { side, number: i + 1, start_s: pair[0], end_s: pair[1], foot_off_s });
        }
    }
    list
}

/// Time-normalises a series: values at 0, 1, ... 100 % of a cycle by linear interpolation.
#[must_use]
pub fn over_cycle(grid: TimeGrid, series: &[f64], cycle: &Cycle) -> Vec<f64> {
    over_cycle_of(grid, |frame| series[frame], cycle)
}

/// As [`over_cycle`], for a series of which only the frames of the cycle are computed.
#[must_use]
pub fn over_cycle_of(grid: TimeGrid, value: impl Fn(usize) -> f64, cycle: &Cycle) -> Vec<f64> {
    // One frame more on each side than the interpolation needs.
    let first = (((cycle.start_s - grid.start_s) / grid.step_s).floor() as usize).saturating_sub(1);
    let last = (((cycle.end_s - grid.start_s) / grid.step_s).ceil() as usize + 2).min(grid.frames);
    let frames = first.min(last.saturating_sub(1))..last;
    let times: Vec<f64> = frames.clone().map(|frame| grid.time(frame)).collect();
    let series: Vec<f64> = frames.map(value).collect();
    (0..CYCLE_SAMPLES)
        .map(|percent| {
            let share = percent as f64 / (CYCLE_SAMPLES - 1) as f64;
            interpolate(&times, &series, cycle.start_s + share * (cycle.end_s - cycle.start_s))
        })
        .collect()
}
