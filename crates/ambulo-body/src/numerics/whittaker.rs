//! Smooths an evenly sampled series with a penalty on its third differences.
//!
//! min over f   Σ vᵢ (yᵢ - fᵢ)² + λ Σ (Δ³f)²
//!
//! With equal weights v = 1 the gain at ω is 1 / (1 + λ (2 sin(ω h / 2))⁶), h the time between samples.
//!
//! Source: E.T. Whittaker 1923, Proc. Edinburgh Math. Soc. 41:63-75 (unverified).
//! Cost: 16 multiplications per sample for the factor, 14 for a solution.
//! Pinned by: tests/numerics_whittaker.rs

use super::{BandFactor, BandMatrix};
use std::f64::consts::{PI, TAU};

use crate::numerics::elementary::{cos, powi, sin};

const ORDER: usize = 3;
const THIRD: [f64; ORDER + 1] = [-1.0, 3.0, -3.0, 1.0];
/// Keeps the matrix positive definite where fewer than three samples have weight.
const FLOOR: f64 = 1e-9;

/// The smoother for series of one length.
#[derive(Debug, Clone)]
pub struct Whittaker {
    /// Eigenvalues of the penalty of a series with equal weights.
    eigenvalues: Vec<f64>,
}

impl Whittaker {
    /// For series of `count` samples.
    #[must_use]
    pub fn new(count: usize) -> Whittaker {
        let one = |i: usize| {
            if i < ORDER { 0.0 } else { powi(2.0 - 2.0 * cos(PI * i as f64 / count as f64), ORDER as i32) }
        };
        Whittaker { eigenvalues: (0..count).map(one).collect() }
    }

    /// The λ that halves a sine of this frequency [Hz] in samples at `rate_hz`.
    #[must_use]
    pub fn lambda_at(cutoff_hz: f64, rate_hz: f64) -> f64 {
        powi(2.0 * sin(0.5 * TAU * cutoff_hz / rate_hz), -2 * ORDER as i32)
    }

    /// Number of values that a smoothed series follows with equal weights: the trace of the matrix that gives f from y.
    #[must_use]
    pub fn freedom(&self, lambda: f64) -> f64 {
        self.eigenvalues.iter().map(|e| 1.0 / (1.0 + lambda * e)).sum()
    }

    /// The factored equations for these weights, one per sample; `None` if λ is not a finite positive number.
    #[must_use]
    pub fn factor(&self, weights: &[f64], lambda: f64) -> Option<BandFactor> {
        let mut matrix = BandMatrix::zeros(self.eigenvalues.len(), ORDER);
        for (i, weight) in weights.iter().enumerate() {
            matrix.add(i, i, weight + FLOOR);
        }
        for first in 0..weights.len().saturating_sub(ORDER) {
            for a in 0..=ORDER {
                for b in 0..=a {
                    matrix.add(first + a, first + b, lambda * THIRD[a] * THIRD[b]);
                }
            }
        }
        matrix.factor()
    }

    /// Replaces a series by its smooth one, with equal weights. With a λ that is not finite, nothing changes.
    pub fn smooth(&self, lambda: f64, series: &mut [f64]) {
        if let Some(factor) = self.factor(&vec![1.0; series.len()], lambda) {
            factor.solve(series);
        }
    }
}
