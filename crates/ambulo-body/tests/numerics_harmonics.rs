//! Harmonics of a function of the phase.

use ambulo_body::numerics::Harmonics;

#[test]
fn the_harmonics_of_a_sum_of_waves_are_these_waves() {
    let known = Harmonics { mean: 0.3, cosine: vec![1.0, 0.0, -0.5], sine: vec![0.0, 2.0, 0.25] };
    let phases: Vec<f64> = (0..40).map(|k| (f64::from(k) + 0.5) / 20.0).collect();
    let values: Vec<f64> = phases.iter().map(|phase| known.at(*phase)).collect();
    let found = Harmonics::of(&phases, &values, 3);
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-14);
    assert!((found.mean - 0.3).abs() < 1e-14 && apart(&found.cosine, &known.cosine), "{found:?}");
    assert!(apart(&found.sine, &known.sine) && found.r_squared(&phases, &values) > 1.0 - 1e-14, "{found:?}");
    // Without the third harmonic, the variance of that harmonic is missing.
    let [third, all] = [0.25 + 0.0625, 1.0 + 4.0 + 0.25 + 0.0625];
    let two = Harmonics::of(&phases, &values, 2);
    assert!((two.r_squared(&phases, &values) - (1.0 - third / all)).abs() < 1e-14);
    assert!((Harmonics::of(&phases, &[2.0; 40], 2).r_squared(&phases, &[2.0; 40]) - 1.0).abs() < 1e-14);
}
