//! Cubic B-splines on uniform knots over a run of samples.

use ambulo_body::numerics::UniformSplines;

/// Value and derivatives at a sample.
fn sum(splines: UniformSplines, coefficients: &[f64], sample: usize) -> [f64; 3] {
    let (first, values, which) = splines.at(sample);
    std::array::from_fn(|d| which.clone().enumerate().map(|(k, j)| coefficients[first + k] * values[d][j]).sum::<f64>())
}

#[test]
fn equal_coefficients_make_a_constant_at_open_ends() {
    for (samples, stride) in [(11, 1), (12, 3), (13, 3), (2, 1), (41, 5)] {
        let splines = UniformSplines::new(samples, stride, [false; 2]);
        for sample in 0..samples {
            let [value, slope, curvature] = sum(splines, &vec![2.5; splines.count()], sample);
            assert!((value - 2.5).abs() < 1e-13 && slope.abs() < 1e-13 && curvature.abs() < 1e-13);
        }
    }
}

#[test]
fn closed_ends_are_at_rest() {
    let splines = UniformSplines::new(21, 2, [true; 2]);
    let coefficients: Vec<f64> = (0..splines.count()).map(|k| 1.0 + (1.7 * k as f64).sin()).collect();
    for sample in [0, 20] {
        assert!(sum(splines, &coefficients, sample).iter().all(|x| x.abs() < 1e-15), "sample {sample}");
    }
    assert!(sum(splines, &coefficients, 10)[0].abs() > 0.1);
    assert_eq!(splines.count(), 10 + 3 - 6);
}

#[test]
fn derivatives_are_those_of_the_value() {
    // The same curve on knots ten samples apart: differences of samples are near its derivatives.
    let splines = UniformSplines::new(101, 10, [true, false]);
    let coefficients: Vec<f64> = (0..splines.count()).map(|k| (1.3 * k as f64).cos()).collect();
    for sample in 1..100 {
        let [before, at, after] = [sample - 1, sample, sample + 1].map(|s| sum(splines, &coefficients, s));
        // A third derivative of about 6 / 10³ misses the slope by a sixth of it.
        assert!((0.5 * (after[0] - before[0]) - at[1]).abs() < 2e-3, "slope at {sample}");
        assert!((0.5 * (after[1] - before[1]) - at[2]).abs() < 4e-3, "curvature at {sample}");
    }
}
