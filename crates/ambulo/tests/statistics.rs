//! Statistics of numbers, against numbers worked out by hand.

use ambulo::numerics::{
    Random, correlation, extremes, finite_mean, mean, median, quantiles, range, rms, sample_deviation, sort_numbers,
};

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

#[test]
fn quantiles_are_the_numbers_at_their_shares_of_the_list_in_order() {
    let twenty = (0..20).rev().map(f64::from);
    assert_eq!(quantiles(twenty, [0.0, 0.05, 0.5, 0.95, 1.0]), Some([0.0, 1.0, 10.0, 19.0, 19.0]));
    let with_others = [f64::NAN, 3.0, f64::INFINITY, 1.0, f64::NEG_INFINITY, 2.0];
    assert_eq!(quantiles(with_others, [0.4]), Some([2.0]));
    assert_eq!(quantiles([f64::NAN], [0.5]), None);
}

#[test]
fn medians_and_quantiles_have_the_bits_of_a_sorted_list() {
    let mut random = Random::seeded(5);
    for count in [1, 2, 3, 8, 51, 300] {
        // Many are equal, and some are -0.
        let mut number = || if random.below(2) == 0 { random.below(4) as f64 } else { -(random.below(4) as f64) };
        let numbers: Vec<f64> = (0..count).map(|_| number()).collect();
        let mut sorted = numbers.clone();
        sort_numbers(&mut sorted);
        let middle = 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
        assert_eq!(median(numbers.iter().copied()).map(f64::to_bits), Some(middle.to_bits()), "{count}");
        for share in [0.05, 0.25, 0.995] {
            let of_sorted = sorted[(share * count as f64) as usize];
            let found = quantiles(numbers.iter().copied(), [share]).map(|[found]| found.to_bits());
            assert_eq!(found, Some(of_sorted.to_bits()), "{count}, {share}");
        }
    }
}
