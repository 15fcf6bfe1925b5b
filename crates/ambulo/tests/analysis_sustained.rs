//! The largest value that is sustained for some time.

use ambulo::internals::sustained_maximum;

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
