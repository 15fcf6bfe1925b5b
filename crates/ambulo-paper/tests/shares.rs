//! How often claims hold over values that the paper does not give, sampled jointly, and the setting that meets most of
//! them.

use ambulo_paper::internals::OPEN;
use ambulo_paper::{OpenValues, shares_csv, stored_shares};

#[test]
fn stored_results_are_read_as_they_are_written() {
    assert_eq!(shares_csv(stored_shares()), include_str!("../data/shares.csv"));
    assert!(stored_shares().settings >= 500 && stored_shares().best.named().all(|(_, value)| value.is_finite()));
}

#[test]
fn drawn_values_repeat_and_stay_in_their_ranges() {
    assert_eq!(OpenValues::drawn(1, 2), OpenValues::drawn(1, 2));
    assert_ne!(OpenValues::drawn(1, 2), OpenValues::drawn(1, 3));
    let first = OpenValues::drawn(1, 2);
    for values in [&first, &first.near(1, 5)] {
        assert!(OPEN.iter().zip(values.named()).all(|(open, (_, x))| (open.range[0]..=open.range[1]).contains(&x)));
    }
}
