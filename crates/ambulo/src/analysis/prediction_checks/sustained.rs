//! The largest value that is sustained for some time.

use super::judgement::TimedValue;

/// The largest value that a series reaches or exceeds without interruption for `shortest_s`, and when. Entries are
/// times [s] and values, `step_s` apart. `None` if the series has no uninterrupted part of this length.
pub fn sustained_maximum(series: &[(f64, f64)], step_s: f64, shortest_s: f64) -> Option<TimedValue> {
    let count = ((shortest_s / step_s - 1e-9).ceil() as usize).max(1) + 1;
    let is_whole = |part: &&[(f64, f64)]| part[count - 1].0 - part[0].0 < step_s * (count as f64 - 0.5);
    let least = |part: &[(f64, f64)]| TimedValue {
        value: part.iter().map(|(_, value)| *value).fold(f64::INFINITY, f64::min),
        time_s: [part[0].0, part[count - 1].0],
    };
    series
        .windows(count)
        .filter(is_whole)
        .map(least)
        .reduce(|best, found| if found.value > best.value { found } else { best })
}
