//! The unknown curves.

use ambulo::internals::{Curve, UNIT};

#[test]
fn splines_sum_to_one_and_have_unit_deviation_on_average() {
    let curve = Curve { start_s: 1.0, spacing_s: 0.1, numbers: (0..9).collect() };
    let mut square = 0.0;
    for i in 0..1000 {
        let (first, values) = curve.active(1.0 + 0.6 * (f64::from(i) + 0.5) / 1000.0);
        assert!(first + 4 <= curve.numbers.len());
        assert!((values.iter().sum::<f64>() * UNIT - 1.0).abs() < 1e-12);
        square += values.iter().map(|b| b * b).sum::<f64>() / 1000.0;
    }
    assert!((square - 1.0).abs() < 1e-3, "{square}");
}

#[test]
fn outside_the_stance_the_nearest_splines_are_used() {
    let curve = Curve { start_s: 0.0, spacing_s: 0.1, numbers: (0..6).collect() };
    assert_eq!(curve.active(-1.0).0, 0);
    assert_eq!(curve.active(9.0).0, 2);
}
