//! Outcome and cost of trials.

use ambulo_walk::internals::Sums;
use ambulo_walk::tuning::TrialOutcome;

#[test]
fn the_cost_is_that_of_the_formula() {
    let mut sums = Sums::default();
    sums.sample([0.01, 0.04]);
    let mut own = Sums::default();
    own.sample([0.03, 0.12]);
    own.speed(0.9);
    sums.speed(1.0);
    sums.survived(&own);
    sums.fell(0.25);
    let found = sums.outcome();
    assert_eq!((found.pushes, found.survived), (2, 1));
    let expected = 0.5 * 1.75 + 10.0 * 0.02 + 0.5 * 0.08 + 0.5 * 0.05;
    assert!((found.cost - expected).abs() < 1e-12, "{found:?}");
    assert!((found.deviation - 0.02_f64.sqrt()).abs() < 1e-12 && (found.speed_error - 0.05).abs() < 1e-12);
    assert!(TrialOutcome::without_gains(3).cost.is_nan());
}
