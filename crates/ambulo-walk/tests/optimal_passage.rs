//! A part of a walk that does not repeat.

use ambulo_walk::internals::coefficient;
use ambulo_walk::numerics::quintic_splines;

#[test]
fn five_coefficients_give_a_spline_its_value_and_derivatives_at_a_knot() {
    let jet = [0.3, -0.7, 1.1, 0.4, -2.3];
    let x: Vec<f64> = (0..6).map(|k| coefficient(jet, f64::from(k) - 2.0)).collect();
    let values = quintic_splines(0.0, 1.0);
    for (d, weights) in values.iter().enumerate() {
        let sum: f64 = weights.iter().zip(&x).map(|(w, x)| w * x).sum();
        assert!((sum - jet[d]).abs() < 1e-12, "derivative {d}: {sum} and {}", jet[d]);
    }
    let wrong: f64 = values[0].iter().zip(&x[1..]).map(|(w, x)| w * x).sum();
    assert!((wrong - jet[0]).abs() > 0.1, "one knot further on");
}
