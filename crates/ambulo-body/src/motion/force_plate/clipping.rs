//! Detects clipped channels.
//!
//! A clipped channel rises steeply to its largest or smallest value and keeps exactly this value. A rounded peak
//! is reached gently, and an unloaded plate stays at its baseline: neither is clipping.
//! Pinned by: tests/force_plate.rs

use std::ops::Range;

/// Smallest number of samples with the same value.
const HELD_SAMPLES: usize = 5;
/// In as many samples before or after, the channel must change by this share of its range.
const STEEP_SHARE: f64 = 0.02;
/// An extreme value this close to the unloaded level, as a share of the range, is not a limit of the amplifier.
const NEAR_BASELINE: f64 = 0.05;

/// Ranges of samples in which a channel is clipped. `unloaded` is its level without load.
pub(super) fn spans(samples: &[f64], unloaded: f64) -> Vec<Range<usize>> {
    let finite = || samples.iter().copied().filter(|x| x.is_finite());
    let (low, high) = (finite().fold(f64::INFINITY, f64::min), finite().fold(f64::NEG_INFINITY, f64::max));
    let range = high - low;
    if range.is_nan() || range <= 0.0 {
        return Vec::new();
    }
    let far = |limit: f64| (limit - unloaded).abs() > NEAR_BASELINE * range;
    let limits = [low, high].into_iter().filter(|&limit| far(limit));
    limits.flat_map(|limit| constant_runs(samples, limit, STEEP_SHARE * range)).collect()
}

fn constant_runs(samples: &[f64], limit: f64, steep: f64) -> Vec<Range<usize>> {
    let mut spans = Vec::new();
    let mut start = 0;
    while start < samples.len() {
        let run = samples[start..].iter().take_while(|x| x.total_cmp(&limit).is_eq()).count();
        if run >= HELD_SAMPLES {
            let moved = |i: Option<usize>| i.and_then(|i| samples.get(i)).is_some_and(|x| (x - limit).abs() >= steep);
            let end = start + run;
            if moved(start.checked_sub(HELD_SAMPLES)) || moved(Some(end + HELD_SAMPLES - 1)) {
                spans.push(start..end);
            }
        }
        start += run.max(1);
    }
    spans
}
