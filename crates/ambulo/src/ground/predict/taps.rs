//! The low-pass through which a motion shows forces: exp(-t² / 2σ²), half the amplitude at the bandwidth, σ = √(ln 2 / 2) / (π f).

use crate::motion::TimeGrid;

/// The low-pass is sampled this often [s].
const EVERY_S: f64 = 0.0125;
/// It reaches this many deviations of the Gauss curve.
const REACH: f64 = 3.5;

/// Weights of frames around a frame.
#[derive(Debug, Clone)]
pub(super) struct Taps {
    /// Frames from one tap to the next.
    pub(super) stride: usize,
    /// Of the middle one and those on one side.
    weights: Vec<f64>,
}

impl Taps {
    pub(super) fn new(bandwidth_hz: f64, grid: TimeGrid) -> Taps {
        let sigma = (0.5 * std::f64::consts::LN_2).sqrt() / (std::f64::consts::PI * bandwidth_hz);
        let stride = ((EVERY_S / grid.step_s + 1e-6) as usize).max(1);
        let step = stride as f64 * grid.step_s;
        let count = (REACH * sigma / step).ceil() as usize;
        let weights = (0..=count).map(|i| (-0.5 * (i as f64 * step / sigma).powi(2)).exp()).collect();
        Taps { stride, weights }
    }

    /// Time from the middle to the last tap, and a frame more [s].
    pub(super) fn reach_s(&self, grid: TimeGrid) -> f64 {
        (self.stride * (self.weights.len() - 1) + 1) as f64 * grid.step_s
    }

    /// Frames around a frame with their weights, which sum to one; fewer at the ends of the recording.
    pub(super) fn around(&self, frame: usize, frames: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let side = self.weights.len() as isize - 1;
        let inside = move |i: isize| {
            let tap = frame.checked_add_signed(i * self.stride as isize).filter(|tap| *tap < frames)?;
            Some((tap, self.weights[i.unsigned_abs()]))
        };
        let whole: f64 = (-side..=side).filter_map(inside).map(|(_, weight)| weight).sum();
        (-side..=side).filter_map(inside).map(move |(tap, weight)| (tap, weight / whole))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_wave_at_the_bandwidth_keeps_half_of_its_amplitude() {
        let grid = TimeGrid { start_s: 0.0, step_s: 0.01, frames: 400 };
        let taps = Taps::new(7.0, grid);
        let wave = |frame: usize| (std::f64::consts::TAU * 7.0 * grid.time(frame)).sin();
        for frame in 100..200 {
            let passed: f64 = taps.around(frame, 400).map(|(tap, weight)| weight * wave(tap)).sum();
            assert!((passed - 0.5 * wave(frame)).abs() < 5e-3);
        }
    }

    #[test]
    fn at_the_ends_the_weights_still_sum_to_one() {
        let grid = TimeGrid { start_s: 0.0, step_s: 0.002, frames: 50 };
        let taps = Taps::new(7.0, grid);
        assert_eq!(taps.stride, 6);
        for frame in [0, 3, 49] {
            let sum: f64 = taps.around(frame, 50).map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-12);
        }
    }
}
