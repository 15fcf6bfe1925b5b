//! Extremes of a series.

use crate::motion::TimeGrid;

/// Extremes of a series and when they occur.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// Largest value, in the series' unit.
    pub max: f64,
    /// Instant of the largest value [s].
    pub max_at_s: f64,
    /// Smallest value, in the series' unit.
    pub min: f64,
    /// Instant of the smallest value [s].
    pub min_at_s: f64,
}

/// Extremes of a series on a grid; `None` if it is empty.
#[must_use]
pub fn peak(grid: TimeGrid, series: &[f64]) -> Option<Peak> {
    let (first, rest) = series.split_first()?;
    let start = grid.time(0);
    let mut peak = Peak { max: *first, max_at_s: start, min: *first, min_at_s: start };
    for (i, &x) in rest.iter().enumerate() {
        if x > peak.max {
            (peak.max, peak.max_at_s) = (x, grid.time(i + 1));
        }
        if x < peak.min {
            (peak.min, peak.min_at_s) = (x, grid.time(i + 1));
        }
    }
    Some(peak)
}
