//! A natural spline of odd degree: values and derivatives at any time.
//!
//! f minimises  Σ (yᵢ - f(tᵢ))² + p ∫ (f⁽ᵐ⁾)² dt,  a piecewise polynomial of degree 2m-1 with 2m-2 continuous
//! derivatives whose derivatives m to 2m-2 vanish at both ends. [`SplineFitter`](super::SplineFitter) computes it;
//! here it is stored and evaluated: f(tᵢ + s) = Σₖ cᵢₖ sᵏ, k = 0..2m-1.
//!
//! | code           | symbol | unit       | shape                     |
//! | `half_order`   | m      | 1          | 1..=4                     |
//! | `times`        | tᵢ     | s          | one per sample            |
//! | `coefficients` | cᵢₖ    | value/sᵏ   | 2m per sample, row by row |
//! | `p`            | p      | s^(2m-1)   | the smoothing parameter   |
//!
//! Before the first and after the last sample, f continues as the polynomial of degree m-1 that a natural spline
//! has at its ends. Woltring's SPLDER does the same, and so does OpenSim 4.6 as released; SimTK's `GCVSPLUtil::splder`
//! asserts in debug builds that no time is outside.
//!
//! Source: H.J. Woltring 1986, Adv. Eng. Software 8:104-113 (unverified), as translated in simbody's
//! `SimTKmath/Geometry/src/gcvspl.cpp` and used by OpenSim's `GCVSpline`. Sample weights are 1, as OpenSim sets them.
//! Cost: constant per evaluation where samples are nearly even, logarithmic in samples elsewhere.
//! Not handled: sample weights; steps so uneven that the system loses definiteness (`SplineError::Uneven`).
//! Pinned by: tests/splines.rs

use std::sync::Arc;

/// Why no spline could be fitted.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SplineError {
    /// Fewer samples than coefficients of one piece.
    #[error(
        "{found} samples are too few for a spline of degree {degree}: at least {allowed} are needed\n\
         hint: choose a lower degree or a longer recording"
    )]
    TooFewSamples {
        /// Samples given.
        found: usize,
        /// Fewest samples allowed, 2m.
        allowed: usize,
        /// Requested degree, 2m-1.
        degree: usize,
    },
    /// A time is not a finite number.
    #[error("time {index} is {found}: finite seconds are needed")]
    NonFiniteTime {
        /// Index of the sample, from 0.
        index: usize,
        /// The time found (s).
        found: f64,
    },
    /// Times do not rise.
    #[error("time {index} is {found} s after {previous} s: times must rise\nhint: remove repeated or unsorted rows")]
    TimeNotIncreasing {
        /// Index of the later sample, from 0.
        index: usize,
        /// Time before it (s).
        previous: f64,
        /// The time found (s).
        found: f64,
    },
    /// A value is not a finite number.
    #[error(
        "value {index} of column {column} is {found}: finite values are needed\n\
         hint: fill gaps before fitting"
    )]
    NonFiniteValue {
        /// Index of the column, from 0.
        column: usize,
        /// Index of the sample, from 0.
        index: usize,
        /// The value found.
        found: f64,
    },
    /// A column is not as long as the time grid.
    #[error("column {column} has {found} values for {allowed} times: one value per time is needed")]
    LengthMismatch {
        /// Index of the column, from 0.
        column: usize,
        /// Values given.
        found: usize,
        /// Times of the grid.
        allowed: usize,
    },
    /// The smoothing parameter, or the error variance, is out of range.
    #[error(
        "{name} is {found}: allowed is 0 to {allowed}\n\
         hint: a larger value asks for a curve smoother than double precision can resolve \
         at this sampling rate; resample to a lower one"
    )]
    SmoothingOutOfRange {
        /// Quantity that is out of range.
        name: &'static str,
        /// The value found.
        found: f64,
        /// The largest value allowed.
        allowed: f64,
    },
    /// Steps differ so much that the band matrix is not positive definite in double precision.
    #[error(
        "steps near time {time} s are too uneven for a spline of degree {degree}\n\
         hint: resample, or remove almost repeated times"
    )]
    Uneven {
        /// Time at which the factorisation failed (s).
        time: f64,
        /// Requested degree.
        degree: usize,
    },
}

/// Degree of a natural spline: twice the half order m, less one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SplineDegree {
    /// Degree 1 (m = 1): straight lines between samples.
    Linear,
    /// Degree 3 (m = 2): continuous acceleration. OpenSim interpolates external forces with it.
    Cubic,
    /// Degree 5 (m = 3): continuous fourth derivative. OpenSim differentiates coordinates with it.
    Quintic,
    /// Degree 7 (m = 4).
    Heptic,
}

impl SplineDegree {
    /// m: the derivative whose mean square is kept small.
    pub fn half_order(self) -> usize {
        match self {
            Self::Linear => 1,
            Self::Cubic => 2,
            Self::Quintic => 3,
            Self::Heptic => 4,
        }
    }

    /// Degree of the pieces, 2m-1.
    #[inline]
    pub fn degree(self) -> usize {
        2 * self.half_order() - 1
    }
}

/// How a fit was smoothed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SmoothingUsed {
    /// p [s^(2m-1)]; 0 for interpolation.
    pub(super) parameter: f64,
    /// tr(I - A), where A gives the fitted from the measured values.
    pub(super) residual_freedom: f64,
    /// Σ (yᵢ - f(tᵢ))².
    pub(super) squared_residuals: f64,
}

/// A natural spline through, or near, samples.
#[derive(Debug, Clone, PartialEq)]
pub struct NaturalSpline {
    half_order: usize,
    times: Arc<[f64]>,
    samples_per_second: f64,
    coefficients: Vec<f64>,
    used: SmoothingUsed,
}

impl NaturalSpline {
    pub(super) fn new(half_order: usize, times: Arc<[f64]>, coefficients: Vec<f64>, used: SmoothingUsed) -> Self {
        let samples_per_second = (times.len() - 1) as f64 / (times[times.len() - 1] - times[0]);
        Self { half_order, times, samples_per_second, coefficients, used }
    }

    /// Value at time `t` (s).
    #[inline]
    pub fn value(&self, t: f64) -> f64 {
        let (s, c) = self.piece(t);
        c.iter().rev().fold(0.0, |sum, ck| sum * s + ck)
    }

    /// Derivative of the given order [value/s^order] at time `t` (s); order 0 is the value.
    #[inline]
    pub fn derivative(&self, order: usize, t: f64) -> f64 {
        let (s, c) = self.piece(t);
        let falling = |k: usize| (k + 1 - order..=k).fold(1.0, |product, factor| product * factor as f64);
        (order..c.len()).rev().fold(0.0, |sum, k| sum * s + falling(k) * c[k])
    }

    /// Value, first and second derivative [value, value/s, value/s²] at time `t` (s).
    #[inline]
    pub fn value_and_two_derivatives(&self, t: f64) -> [f64; 3] {
        let (s, c) = self.piece(t);
        let [mut value, mut slope, mut half_curvature] = [0.0; 3];
        for ck in c.iter().rev() {
            half_curvature = half_curvature * s + slope;
            slope = slope * s + value;
            value = value * s + ck;
        }
        [value, slope, 2.0 * half_curvature]
    }

    /// Degree of the pieces, 2m-1.
    #[inline]
    pub fn degree(&self) -> usize {
        2 * self.half_order - 1
    }

    /// Sample times (s).
    #[inline]
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Fitted values at the sample times.
    pub fn fitted_values(&self) -> impl Iterator<Item = f64> + '_ {
        self.coefficients.iter().step_by(2 * self.half_order).copied()
    }

    /// The smoothing parameter p [s^(2m-1)] that was used; 0 for interpolation.
    pub fn smoothing_parameter(&self) -> f64 {
        self.used.parameter
    }

    /// tr(A), from m (a polynomial of degree m-1) to the number of samples (interpolation).
    pub fn effective_degrees_of_freedom(&self) -> f64 {
        self.times.len() as f64 - self.used.residual_freedom
    }

    /// Estimated standard deviation of the noise in one sample, in the unit of the values:
    /// the square root of Σ (yᵢ - f(tᵢ))² / tr(I - A). `None` for interpolation, which leaves no residual.
    pub fn noise_standard_deviation(&self) -> Option<f64> {
        let SmoothingUsed { squared_residuals, residual_freedom, .. } = self.used;
        (residual_freedom > 0.0).then(|| (squared_residuals / residual_freedom).sqrt())
    }

    /// Time since the sample at or before `t`, and the polynomial of this interval.
    #[inline]
    fn piece(&self, t: f64) -> (f64, &[f64]) {
        let m = self.half_order;
        if t < self.times[0] {
            return (t - self.times[0], &self.coefficients[..m]);
        }
        let i = self.sample_at_or_before(t);
        (t - self.times[i], &self.coefficients[2 * m * i..2 * m * (i + 1)])
    }

    /// Even spacing is tried first, and one sample to each side for its rounding; then bisection.
    #[inline]
    fn sample_at_or_before(&self, t: f64) -> usize {
        let last = self.times.len() - 1;
        let guess = (((t - self.times[0]) * self.samples_per_second) as usize).min(last);
        let holds = |&i: &usize| i <= last && self.times[i] <= t && (i == last || t < self.times[i + 1]);
        [guess, guess + 1, guess.saturating_sub(1)]
            .into_iter()
            .find(holds)
            .unwrap_or_else(|| self.times.partition_point(|time| *time <= t).saturating_sub(1))
    }
}
