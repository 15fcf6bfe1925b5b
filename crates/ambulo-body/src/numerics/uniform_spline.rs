//! Cubic B-splines on uniform knots over a run of samples.
//!
//! Knots are at every `stride`-th sample. A sum of the splines has two continuous derivatives. At an open end every
//! spline that overlaps the run takes part, so the sum is free there; at a closed end only those inside take part, so
//! the sum and its two derivatives are zero there.
//!
//! Source: as `cardinal_spline`, of degree three.
//! Cost: constant.
//! Pinned by: tests/numerics_uniform_spline.rs, tests/residual_reduction.rs

use super::cardinal_spline::cardinal;

/// Largest number of splines that are not zero at one sample.
pub const SPLINES_AT_ONCE: usize = 4;

/// Splines over samples 0 to `samples` - 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct UniformSplines {
    stride: usize,
    /// Splines omitted before the first.
    skipped: usize,
    count: usize,
}

impl UniformSplines {
    /// Splines over `samples` samples, with a knot at every `stride`-th of them. `closed` states at which end, first
    /// and last, the sum vanishes; a closed last end needs a number of samples that is one more than a multiple of
    /// `stride`.
    #[must_use]
    pub fn new(samples: usize, stride: usize, closed: [bool; 2]) -> UniformSplines {
        let stride = stride.max(1);
        let last = samples.saturating_sub(1);
        let all = last / stride + 3 + usize::from(!last.is_multiple_of(stride));
        let skipped = if closed[0] { 3 } else { 0 };
        let left_out = if closed[1] { 3 } else { 0 };
        UniformSplines { stride, skipped, count: all.saturating_sub(skipped + left_out) }
    }

    /// Number of splines.
    #[inline]
    #[must_use]
    pub fn count(self) -> usize {
        self.count
    }

    /// Largest number of splines that are not zero at one sample.
    #[inline]
    #[must_use]
    pub fn overlap(self) -> usize {
        if self.stride == 1 { SPLINES_AT_ONCE - 1 } else { SPLINES_AT_ONCE }
    }

    /// The splines that are not zero at a sample: the index of the first, and for each the value and the first and
    /// second derivative with respect to the number of samples.
    #[inline]
    #[must_use]
    pub fn at(self, sample: usize) -> (usize, [[f64; SPLINES_AT_ONCE]; 3], std::ops::Range<usize>) {
        let (interval, within) = (sample / self.stride, sample % self.stride);
        let rate = 1.0 / self.stride as f64;
        let u = within as f64 * rate;
        let [linear, quadratic, cubic] = [cardinal::<1>(u), cardinal::<2>(u), cardinal::<3>(u)];
        let below = |w: &[f64], j: usize, back: usize| if j >= back { w[j - back] } else { 0.0 };
        let mut values = [[0.0; SPLINES_AT_ONCE]; 3];
        for j in 0..SPLINES_AT_ONCE {
            values[0][j] = cubic[j];
            values[1][j] = rate * (below(&quadratic, j, 1) - quadratic[j]);
            values[2][j] = rate * rate * (below(&linear, j, 2) - 2.0 * below(&linear, j, 1) + linear[j]);
        }
        // At a knot the fourth spline only begins.
        let reach = if within == 0 { SPLINES_AT_ONCE - 1 } else { SPLINES_AT_ONCE };
        let from = self.skipped.saturating_sub(interval).min(reach);
        let to = (self.count + self.skipped).saturating_sub(interval).clamp(from, reach);
        ((interval + from).saturating_sub(self.skipped), values, from..to)
    }
}
