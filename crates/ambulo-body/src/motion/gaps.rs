//! Gaps: selects the usable part of a recording, and interpolates short gaps.

use super::recording::MotionError;
use super::time_grid::Window;
use crate::findings::{Code, Findings};
use crate::numerics::{NaturalSpline, Smoothing, SplineDegree, SplineFitter};
use std::ops::Range;

/// Longest gap inside a recording that is interpolated by a spline [s].
pub const LONGEST_GAP_S: f64 = 0.2;

/// The rows inside a window, and those before and after it without a gap in between, which filters need at
/// their ends. `complete` returns whether a row has all its numbers.
pub fn rows_around(times: &[f64], window: Window, complete: impl Fn(usize) -> bool) -> Range<usize> {
    let mut start = window.from_s.map_or(0, |from| times.partition_point(|&t| t < from));
    let mut end = window.to_s.map_or(times.len(), |to| times.partition_point(|&t| t <= to));
    if start >= end {
        return 0..times.len();
    }
    let near = |a: usize, b: usize| times[b] - times[a] <= LONGEST_GAP_S;
    while start > 0 && complete(start - 1) && near(start - 1, start) {
        start -= 1;
    }
    while end < times.len() && complete(end) && near(end - 1, end) {
        end += 1;
    }
    start..end
}

/// Interpolates gaps by a quintic spline through the other samples.
pub fn fill_gaps(name: &str, times: &[f64], column: &[f64], findings: &mut Findings) -> Result<Vec<f64>, MotionError> {
    let known: Vec<usize> = (0..column.len()).filter(|&i| column[i].is_finite()).collect();
    if known.len() == column.len() {
        return Ok(column.to_vec());
    }
    let gap = |from: usize, to: usize| MotionError::Gap {
        column: name.to_owned(),
        from_s: times[from],
        to_s: times[to],
        longest_s: LONGEST_GAP_S,
    };
    let (Some(&first), Some(&last)) = (known.first(), known.last()) else {
        return Err(MotionError::Empty { column: name.to_owned() });
    };
    if first > 0 {
        return Err(gap(0, first - 1));
    }
    if last + 1 < column.len() {
        return Err(gap(last + 1, column.len() - 1));
    }
    for pair in known.windows(2) {
        if pair[1] > pair[0] + 1 && times[pair[1]] - times[pair[0]] > LONGEST_GAP_S {
            return Err(gap(pair[0] + 1, pair[1] - 1));
        }
    }
    let spline = spline_through(name, &pick(times, &known), &pick(column, &known))?;
    let missing = column.len() - known.len();
    findings.report(Code::MotionGapFilled, format!("`{name}`: {missing} missing samples were bridged by a spline"));
    Ok((0..column.len()).map(|i| if column[i].is_finite() { column[i] } else { spline.value(times[i]) }).collect())
}

/// Bridges the gaps of up to `longest_s` between known samples by a quintic spline through all of them. Returns which
/// samples were bridged.
pub(crate) fn bridge_gaps(times: &[f64], column: &mut [f64], longest_s: f64) -> Vec<usize> {
    let known: Vec<usize> = (0..column.len()).filter(|&i| column[i].is_finite()).collect();
    let is_short = |pair: &[usize]| pair[1] > pair[0] + 1 && times[pair[1]] - times[pair[0]] <= longest_s;
    let gaps: Vec<usize> =
        known.windows(2).filter(|pair| is_short(pair)).flat_map(|pair| pair[0] + 1..pair[1]).collect();
    if gaps.is_empty() {
        return gaps;
    }
    let Ok(spline) = spline_through("", &pick(times, &known), &pick(column, &known)) else { return Vec::new() };
    for &i in &gaps {
        column[i] = spline.value(times[i]);
    }
    gaps
}

fn pick(values: &[f64], indices: &[usize]) -> Vec<f64> {
    indices.iter().map(|&i| values[i]).collect()
}

/// A natural quintic spline through every sample.
pub(super) fn spline_through(name: &str, times: &[f64], values: &[f64]) -> Result<NaturalSpline, MotionError> {
    let error = |source| MotionError::Spline { column: name.to_owned(), source };
    SplineFitter::new(SplineDegree::Quintic, times).map_err(error)?.fit(values, Smoothing::Interpolate).map_err(error)
}
