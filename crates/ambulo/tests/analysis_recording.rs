//! Analysis of one recording with measured forces.

use ambulo::analysis::Cycle;
use ambulo::internals::cycle_mean;
use ambulo::model::Side;

#[test]
fn the_mean_over_a_cycle_that_begins_and_ends_between_samples_is_exact_for_a_ramp() {
    let times: Vec<f64> = (0..8).map(|i| 2.0 + 0.1 * f64::from(i)).collect();
    let ramp = |slope: f64| times.iter().map(|t| 300.0 + slope * (t - 2.0)).collect::<Vec<f64>>();
    let vertical = [(Side::Right, (times.clone(), ramp(50.0))), (Side::Left, (times.clone(), ramp(-20.0)))];
    let cycle = Cycle { side: Side::Right, number: 1, start_s: 2.13, end_s: 2.59, foot_off_s: None };
    let mean = cycle_mean(&vertical, &cycle).unwrap();
    assert!((mean - (600.0 + 30.0 * 0.36)).abs() < 1e-9, "{mean}");
    assert!(cycle_mean(&[], &cycle).is_none());
}
