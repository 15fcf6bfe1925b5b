//! The largest value that is sustained for some time.

use super::judgement::TimedValue;

/// The largest value that a series reaches or exceeds without interruption for `shortest_s`, and when. Entries are times [s] and values,
/// `step_s` apart. `None` if the series has no uninterrupted part of this length.
pub(super) fn sustained_maximum(series: &[(f64, f64)], step_s: f64, shortest_s: f64) -> Option<TimedValue> {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_value_kept_for_the_whole_time_counts() {
        let values = [0.0, 9.0, 2.0, 3.0, 4.0, 3.0, 0.0];
        let series: Vec<(f64, f64)> = values.iter().enumerate().map(|(i, v)| (0.1 * i as f64, *v)).collect();
        let found = sustained_maximum(&series, 0.1, 0.2).unwrap();
        assert!((found.value - 3.0).abs() < 1e-12 && (found.time_s[0] - 0.3).abs() < 1e-12);
        assert!((sustained_maximum(&series, 0.1, 0.05).unwrap().value - 3.0).abs() < 1e-12);
        assert!(sustained_maximum(&series, 0.1, 1.0).is_none());
    }

    #[test]
    fn a_gap_interrupts_a_series() {
        let series = [(0.0, 5.0), (0.1, 5.0), (0.5, 5.0), (0.6, 5.0), (0.7, 1.0)];
        assert!((sustained_maximum(&series, 0.1, 0.2).unwrap().value - 1.0).abs() < 1e-12);
    }
}
