//! Cardinal B-splines.

use ambulo_body::numerics::quintic_splines;

/// Value and derivatives of a sum at a place in knot intervals, with coefficients that repeat.
fn sum(coefficients: &[f64], place: f64) -> [f64; 3] {
    let first = place.floor();
    let values = quintic_splines(place - first, 1.0);
    let of = |j: usize| coefficients[(first as usize + j) % coefficients.len()];
    values.map(|values| values.iter().enumerate().map(|(j, w)| of(j) * w).sum())
}

#[test]
fn equal_coefficients_make_a_constant() {
    for place in [0.0, 0.123, 0.5, 0.999_999, 1.0, 7.25] {
        let [value, slope, curvature] = sum(&[2.5; 9], place);
        assert!((value - 2.5).abs() < 1e-13 && slope.abs() < 1e-13 && curvature.abs() < 1e-13, "at {place}");
    }
}

#[test]
fn derivatives_are_those_of_the_value_also_across_knots() {
    let coefficients: Vec<f64> = (0..11).map(|k| (1.7 * f64::from(k)).sin()).collect();
    let h = 1e-4;
    for k in 1..200 {
        let place = 0.05 * f64::from(k);
        let [before, at, after] = [place - h, place, place + h].map(|place| sum(&coefficients, place));
        // Errors of differences: h² and h² times derivatives of the order of 1, rounding 1e-16 / h and 1e-16 / h².
        assert!(((after[0] - before[0]) / (2.0 * h) - at[1]).abs() < 1e-7, "slope at {place}");
        assert!(((after[1] - before[1]) / (2.0 * h) - at[2]).abs() < 1e-7, "curvature at {place}");
    }
}
