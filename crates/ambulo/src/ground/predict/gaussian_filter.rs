//! Gaussian low-pass filter of the evidence: exp(-t² / 2σ²), half the amplitude at the bandwidth f, σ = √(ln 2 / 2) / (π f).

use crate::motion::TimeGrid;

/// Spacing of the coefficients [s].
const EVERY_S: f64 = 0.0125;
/// Half of its length, in σ.
const REACH: f64 = 3.5;

/// Coefficients of the filter.
#[derive(Debug, Clone)]
pub(super) struct GaussianFilter {
    /// Frames between two coefficients.
    pub(super) stride: usize,
    /// The middle coefficient and those on one side.
    weights: Vec<f64>,
}

impl GaussianFilter {
    pub(super) fn new(bandwidth_hz: f64, grid: TimeGrid) -> GaussianFilter {
        let sigma = (0.5 * std::f64::consts::LN_2).sqrt() / (std::f64::consts::PI * bandwidth_hz);
        let stride = ((EVERY_S / grid.step_s + 1e-6) as usize).max(1);
        let step = stride as f64 * grid.step_s;
        let count = (REACH * sigma / step).ceil() as usize;
        let weights = (0..=count).map(|i| (-0.5 * (i as f64 * step / sigma).powi(2)).exp()).collect();
        GaussianFilter { stride, weights }
    }

    /// Half of its length, plus one frame.
    pub(super) fn reach_frames(&self) -> usize {
        self.stride * (self.weights.len() - 1) + 1
    }

    /// The same [s].
    pub(super) fn reach_s(&self, grid: TimeGrid) -> f64 {
        self.reach_frames() as f64 * grid.step_s
    }

    /// Frames around a frame with their coefficients, which sum to one; fewer at the ends of the recording.
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
        let filter = GaussianFilter::new(7.0, grid);
        let wave = |frame: usize| (std::f64::consts::TAU * 7.0 * grid.time(frame)).sin();
        for frame in 100..200 {
            let passed: f64 = filter.around(frame, 400).map(|(tap, weight)| weight * wave(tap)).sum();
            assert!((passed - 0.5 * wave(frame)).abs() < 5e-3);
        }
    }

    #[test]
    fn at_the_ends_the_coefficients_still_sum_to_one() {
        let grid = TimeGrid { start_s: 0.0, step_s: 0.002, frames: 50 };
        let filter = GaussianFilter::new(7.0, grid);
        assert_eq!(filter.stride, 6);
        for frame in [0, 3, 49] {
            let sum: f64 = filter.around(frame, 50).map(|(_, weight)| weight).sum();
            assert!((sum - 1.0).abs() < 1e-12);
        }
    }
}
