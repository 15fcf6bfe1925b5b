//! Sine and cosine of many angles at once.

use ambulo_body::internals::sin_cos;

/// Largest difference from the library over `n` angles within ±`range`.
fn worst(range: f64, n: u32) -> f64 {
    let angles: Vec<f64> = (0..=n).map(|i| range * (2.0 * f64::from(i) / f64::from(n) - 1.0)).collect();
    let (mut sin, mut cos) = (vec![0.0; angles.len()], vec![0.0; angles.len()]);
    sin_cos(&angles, &mut sin, &mut cos);
    let error = |i: usize| {
        let (s, c) = angles[i].sin_cos();
        (sin[i] - s).abs().max((cos[i] - c).abs())
    };
    (0..angles.len()).map(error).fold(0.0, f64::max)
}

#[test]
fn agrees_with_the_math_library_to_the_last_place() {
    for range in [0.01, 1.0, 10.0, 1e3, 9.9e4, 1e7] {
        let error = worst(range, 100_003);
        assert!(error <= f64::EPSILON, "range {range}: {error:e}");
    }
}
