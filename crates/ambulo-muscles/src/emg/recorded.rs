//! Which samples of a channel were recorded: the others are missing, or a program filled them with one number.

use ambulo_body::numerics::{rms, sort_numbers};
use std::ops::Range;

/// Equal successive samples for longer than this were not recorded [s].
const HELD_S: f64 = 0.1;
/// Where the smallest step of a signal is larger than this share of its root mean square, quiet parts repeat a number.
const COARSE: f64 = 0.05;
/// Recorded stretches shorter than this are left out: a filter would show their ends only [s].
const SHORTEST_S: f64 = 0.1;

/// Ranges of samples that are numbers.
pub(super) fn numbers(samples: &[f64]) -> Vec<Range<usize>> {
    ranges(samples.len(), |i| samples[i].is_finite())
}

/// Ranges of samples of a raw signal that were recorded: numbers that are not held longer than [`HELD_S`], in stretches
/// of at least [`SHORTEST_S`].
pub(super) fn recorded(samples: &[f64], rate_hz: f64) -> Vec<Range<usize>> {
    let is_coarse = smallest_step(samples) > COARSE * rms(&centred(samples, &numbers(samples)));
    let longest = (HELD_S * rate_hz) as usize;
    let mut is_recorded: Vec<bool> = samples.iter().map(|x| x.is_finite()).collect();
    let mut start = 0;
    for run in samples.chunk_by(|a, b| a.to_bits() == b.to_bits()) {
        let end = start + run.len();
        if run.len() > longest && !is_coarse {
            is_recorded[start..end].fill(false);
        }
        start = end;
    }
    let mut found = ranges(samples.len(), |i| is_recorded[i]);
    found.retain(|range| range.len() as f64 >= SHORTEST_S * rate_hz);
    found
}

/// The samples minus their mean; zero where nothing was recorded.
pub(super) fn centred(samples: &[f64], recorded: &[Range<usize>]) -> Vec<f64> {
    let count = recorded.iter().map(Range::len).sum::<usize>().max(1);
    let mean = recorded.iter().flat_map(|range| &samples[range.clone()]).sum::<f64>() / count as f64;
    let mut centred = vec![0.0; samples.len()];
    for range in recorded {
        for i in range.clone() {
            centred[i] = samples[i] - mean;
        }
    }
    centred
}

/// The samples in these ranges.
pub(super) fn inside(samples: &[f64], recorded: &[Range<usize>]) -> Vec<f64> {
    recorded.iter().flat_map(|range| samples[range.clone()].iter().copied()).collect()
}

/// A percentile with linear interpolation between the sorted values, `share` from 0 to 1; 0 without values.
pub(super) fn percentile(mut values: Vec<f64>, share: f64) -> f64 {
    sort_numbers(&mut values);
    let Some(last) = values.len().checked_sub(1) else { return 0.0 };
    let place = share * last as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    values[below] + (values[above] - values[below]) * (place - below as f64)
}

fn smallest_step(samples: &[f64]) -> f64 {
    let steps = samples.windows(2).map(|pair| (pair[1] - pair[0]).abs()).filter(|step| *step > 0.0);
    steps.fold(f64::INFINITY, f64::min)
}

fn ranges(count: usize, is_inside: impl Fn(usize) -> bool) -> Vec<Range<usize>> {
    let mut ranges: Vec<Range<usize>> = Vec::new();
    for i in (0..count).filter(|&i| is_inside(i)) {
        match ranges.last_mut() {
            Some(range) if range.end == i => range.end = i + 1,
            _ => ranges.push(i..i + 1),
        }
    }
    ranges
}
