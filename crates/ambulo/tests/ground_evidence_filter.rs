//! Low-pass filters of the evidence, symmetric in time.

use ambulo::internals::EvidenceFilter;
use ambulo::motion::TimeGrid;
use ambulo::motion::filter::LowPass;
use std::f64::consts::{LN_2, TAU};

#[test]
fn a_wave_at_the_bandwidth_keeps_half_of_its_amplitude() {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 400 };
    let filter = EvidenceFilter::gaussian(7.0, grid);
    let wave = |frame: usize| (TAU * 7.0 * grid.time(frame)).sin();
    for frame in 100..200 {
        let passed: f64 = filter.around(frame, 400).map(|(tap, weight)| weight * wave(tap)).sum();
        assert!((passed - 0.5 * wave(frame)).abs() < 5e-3);
    }
}

#[test]
fn estimated_forces_lose_what_the_motion_has_lost() {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.005, frames: 800 };
    let filter = EvidenceFilter::of_motion(7.0, LowPass::MOTION, grid);
    for frequency in [1.0, 3.0, 6.0, 9.0] {
        let wave = |frame: usize| (TAU * frequency * grid.time(frame)).cos();
        let gaussian = (-LN_2 * (frequency / 7.0_f64).powi(2)).exp();
        let gain = gaussian / (1.0 + (frequency / 6.0_f64).powi(6));
        for frame in [300, 307, 411] {
            let passed: f64 = filter.around(frame, 800).map(|(tap, weight)| weight * wave(tap)).sum();
            assert!((passed - gain * wave(frame)).abs() < 0.015, "{frequency} Hz: {passed}, {}", gain * wave(frame));
        }
    }
}

#[test]
fn at_the_ends_the_coefficients_still_sum_to_one() {
    let grid = TimeGrid { start_s: 0.0, step_s: 0.002, frames: 50 };
    let filter = EvidenceFilter::gaussian(7.0, grid);
    assert_eq!(filter.stride, 6);
    for frame in [0, 3, 49] {
        let sum: f64 = filter.around(frame, 50).map(|(_, weight)| weight).sum();
        assert!((sum - 1.0).abs() < 1e-12);
    }
}
