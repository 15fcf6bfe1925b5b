//! The largest value that lasts.

use super::judgement::Found;

/// The value that a series keeps or exceeds for a whole time, the largest such, and when. Entries are instants [s] and values;
/// `step_s` lies between neighbours. `None` if nothing lasts so long.
pub(super) fn lasting(series: &[(f64, f64)], step_s: f64, shortest_s: f64) -> Option<Found> {
    let count = ((shortest_s / step_s - 1e-9).ceil() as usize).max(1) + 1;
    let is_whole = |part: &&[(f64, f64)]| part[count - 1].0 - part[0].0 < step_s * (count as f64 - 0.5);
    let least = |part: &[(f64, f64)]| Found {
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
    fn a_peak_counts_by_what_it_keeps_for_the_whole_time() {
        let values = [0.0, 9.0, 2.0, 3.0, 4.0, 3.0, 0.0];
        let series: Vec<(f64, f64)> = values.iter().enumerate().map(|(i, v)| (0.1 * i as f64, *v)).collect();
        let found = lasting(&series, 0.1, 0.2).unwrap();
        assert!((found.value - 3.0).abs() < 1e-12 && (found.time_s[0] - 0.3).abs() < 1e-12);
        assert!((lasting(&series, 0.1, 0.05).unwrap().value - 3.0).abs() < 1e-12);
        assert!(lasting(&series, 0.1, 1.0).is_none());
    }

    #[test]
    fn a_break_ends_a_time() {
        let series = [(0.0, 5.0), (0.1, 5.0), (0.5, 5.0), (0.6, 5.0), (0.7, 1.0)];
        assert!((lasting(&series, 0.1, 0.2).unwrap().value - 1.0).abs() < 1e-12);
    }
}
