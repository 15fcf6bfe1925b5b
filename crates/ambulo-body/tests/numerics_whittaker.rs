//! Smooths an evenly sampled series with a penalty on its third differences.

use ambulo_body::numerics::Whittaker;
use std::f64::consts::TAU;

#[test]
fn a_parabola_stays_and_a_sine_at_the_cut_off_is_halved() {
    let whittaker = Whittaker::new(400);
    let lambda = Whittaker::lambda_at(5.0, 100.0);
    let mut parabola: Vec<f64> = (0..400).map(|i| 1.0 - 0.3 * f64::from(i) + 0.01 * f64::from(i * i)).collect();
    let exact = parabola.clone();
    whittaker.smooth(lambda, &mut parabola);
    let most = parabola.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(most < 1e-4, "{most} of 1500");
    let sine = |i: usize| (TAU * 5.0 * i as f64 / 100.0).sin();
    let mut smooth: Vec<f64> = (0..400).map(sine).collect();
    whittaker.smooth(lambda, &mut smooth);
    for (i, value) in smooth.iter().enumerate().skip(150).take(100) {
        assert!((value - 0.5 * sine(i)).abs() < 1e-3, "{i}: {value}");
    }
}

#[test]
fn the_freedom_falls_from_all_values_to_those_of_a_parabola() {
    let whittaker = Whittaker::new(50);
    assert!((whittaker.freedom(0.0) - 50.0).abs() < 1e-12);
    assert!((whittaker.freedom(1e12) - 3.0).abs() < 1e-3);
}
