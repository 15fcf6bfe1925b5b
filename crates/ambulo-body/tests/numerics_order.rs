//! Lists in order by numbers, against the sort of the standard library.

use ambulo_body::numerics::{Order, Random, sort_numbers};

/// Elements with few different numbers, so that many are equal, and with their first places.
fn elements(count: usize, seed: u64) -> Vec<(f64, f64, usize)> {
    let mut random = Random::seeded(seed);
    let mut few = || random.below(8) as f64 - 4.0;
    (0..count).map(|place| (few(), few(), place)).collect()
}

#[test]
fn lists_are_in_the_order_of_a_stable_sort() {
    for count in [0, 1, 2, 3, 7, 50, 300] {
        let all = elements(count, count as u64);
        let (mut own, mut other) = (all.clone(), all.clone());
        own.sort_by_number(|element| -element.0);
        other.sort_by(|a, b| b.0.total_cmp(&a.0));
        assert_eq!(own, other, "{count}");
        let (mut own, mut other) = (all.clone(), all);
        own.sort_by_numbers(|element| [element.0, element.1]);
        other.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        assert_eq!(own, other, "{count}");
    }
}

#[test]
fn what_is_no_number_is_last() {
    let mut numbers = [f64::NAN, 3.0, f64::NEG_INFINITY, -0.0, 0.0, f64::INFINITY];
    let mut pairs = numbers.map(|number| (number, ()));
    sort_numbers(&mut numbers);
    assert!(numbers[5].is_nan());
    assert_eq!(numbers[..5], [f64::NEG_INFINITY, -0.0, 0.0, 3.0, f64::INFINITY]);
    pairs.sort_by_number(|pair| pair.0);
    assert_eq!(pairs.map(|pair| pair.0.to_bits()), numbers.map(f64::to_bits));
}
