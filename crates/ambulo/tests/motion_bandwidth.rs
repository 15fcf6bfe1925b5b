//! The bandwidth of a recorded motion.

use ambulo::internals::{HIGHEST_HZ, bandwidth};
use ambulo::numerics::Random;
use ambulo::spatial::Vec3;
use std::f64::consts::TAU;

/// A point that moves at 1 and 3 Hz, with noise.
fn places(noise_m: f64, frames: u32) -> Vec<Vec3> {
    let mut random = Random::seeded(3);
    let times = (0..frames).map(|i| 0.01 * f64::from(i));
    times.map(|t| Vec3::new((TAU * t).sin(), 0.1 * (TAU * 3.0 * t).sin(), noise_m * random.normal())).collect()
}

#[test]
fn smooth_motion_ends_where_it_ends_and_noise_reaches_the_highest() {
    let of = |noise_m: f64| bandwidth(&places(noise_m, 300), 100.0).unwrap();
    assert!((3.0..5.0).contains(&of(0.0)), "{}", of(0.0));
    assert!((of(2e-3) - HIGHEST_HZ).abs() < 1e-12, "{}", of(2e-3));
}

#[test]
fn a_short_motion_and_a_point_at_rest_have_none() {
    assert!(bandwidth(&places(0.0, 40), 100.0).is_none());
    assert!(bandwidth(&[Vec3::zeros(); 300], 100.0).is_none());
}
