//! Statistics of numbers, against numbers worked out by hand.

use ambulo::numerics::{correlation, extremes, finite_mean, mean, median, range, rms, sample_deviation};

#[test]
fn statistics_are_those_worked_out_by_hand() {
    let values = [2.0, 4.0, 4.0, 6.0];
    assert_eq!((mean(&values), extremes(&values), range(&values)), (4.0, (2.0, 6.0), 4.0));
    assert_eq!(sample_deviation(&[1.0, 3.0, 5.0]), Some(2.0));
    assert_eq!((rms(&[3.0, -4.0, 0.0, 0.0]), correlation(&values, &[1.0, 0.0, 0.0, -1.0])), (2.5, -1.0));
}

#[test]
fn few_numbers_and_numbers_that_are_not_finite_have_defined_statistics() {
    assert_eq!((mean(&[]), rms(&[])), (0.0, 0.0));
    assert!(finite_mean([]).is_nan() && mean(&[1.0, f64::NAN]).is_nan());
    assert_eq!(sample_deviation(&[1.0]), None);
    let finite = finite_mean([1.0, f64::NAN, 3.0, f64::INFINITY]);
    assert_eq!((finite, correlation(&[1.0, 2.0], &[3.0, 3.0])), (2.0, 0.0));
}

#[test]
fn medians_ignore_values_that_are_not_finite() {
    assert_eq!(median([3.0, f64::NAN, 1.0, 2.0]), Some(2.0));
    assert_eq!(median([3.0, 1.0]), Some(2.0));
    assert_eq!(median([f64::NAN]), None);
}
