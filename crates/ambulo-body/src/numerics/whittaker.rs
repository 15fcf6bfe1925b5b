//! Smooths an evenly sampled series with a penalty on its third differences.
//!
//! min over f   Σ vᵢ (yᵢ - fᵢ)² + λ Σ (Δ³f)²
//!
//! With equal weights v = 1 the gain at ω is 1 / (1 + λ (2 sin(ω h / 2))⁶), h the time between samples.
//!
//! Source: E.T. Whittaker 1923, Proc. Edinburgh Math. Soc. 41:63-75 (unverified).
//! The equations have three bands below the diagonal, A = L D Lᵀ. With equal weights the rows of L tend to a limit,
//! from which on they are copied.
//!
//! Cost: 10 multiplications and a division per sample for the factor, 7 multiplications for a solution.
//! Pinned by: tests/numerics_whittaker.rs

use std::f64::consts::{PI, TAU};
use std::ops::{Mul, Sub};

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

    /// The factored equations for these weights, one per sample, or for equal ones; `None` if λ is not a finite
    /// positive number.
    #[must_use]
    pub(crate) fn factor(&self, weights: Option<&[f64]>, lambda: f64) -> Option<SmoothingFactor> {
        let count = self.eigenvalues.len();
        let mut rows: Vec<Row> = Vec::with_capacity(count + ORDER);
        for i in 0..count {
            let is_inside = (2 * ORDER..count.saturating_sub(ORDER)).contains(&i);
            let next = match rows[..] {
                // A row follows from the three before it.
                [.., a, b, c, d] if weights.is_none() && is_inside && a == b && b == c && c == d => d,
                _ => {
                    let weight = weights.map_or(1.0, |weights| weights[i]) + FLOOR;
                    Row::after(&rows, weight, penalty(i, count).map(|entry| lambda * entry))?
                }
            };
            rows.push(next);
        }
        rows.extend([NO_ROW; ORDER]);
        Some(SmoothingFactor(rows))
    }

    /// Replaces a series by its smooth one, with equal weights. With a λ that is not finite, nothing changes.
    pub fn smooth(&self, lambda: f64, series: &mut [f64]) {
        if let Some(factor) = self.factor(None, lambda) {
            factor.solve(series);
        }
    }
}

/// The entries of row `i` of the penalty's matrix of `count` samples: the diagonal, and one, two and three before it.
fn penalty(i: usize, count: usize) -> [f64; ORDER + 1] {
    let mut entries = [0.0; ORDER + 1];
    for a in (0..=ORDER).filter(|&a| a <= i && i - a + ORDER < count) {
        for before in 0..=a {
            entries[before] += THIRD[a] * THIRD[a - before];
        }
    }
    entries
}

/// A row of the factors.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Row {
    /// 1 / D.
    inverse: f64,
    /// Entries of L one, two and three before the diagonal.
    lower: [f64; ORDER],
}

/// Before the first row and after the last one.
const NO_ROW: Row = Row { inverse: 0.0, lower: [0.0; ORDER] };

impl Row {
    /// The row that follows these; `None` if its pivot is not positive.
    fn after(rows: &[Row], weight: f64, penalty: [f64; ORDER + 1]) -> Option<Row> {
        let before = |k: usize| rows.len().checked_sub(k).map_or(NO_ROW, |place| rows[place]);
        let [first, second, third] = [before(1), before(2), before(3)];
        let c3 = penalty[3];
        let c2 = penalty[2] - c3 * second.lower[0];
        let c1 = penalty[1] - c3 * first.lower[1] - c2 * first.lower[0];
        let lower = [c1 * first.inverse, c2 * second.inverse, c3 * third.inverse];
        let pivot = weight + penalty[0] - c3 * lower[2] - c2 * lower[1] - c1 * lower[0];
        (pivot > 0.0 && pivot.is_finite()).then(|| Row { inverse: 1.0 / pivot, lower })
    }
}

/// The factors of the equations of a series, with [`ORDER`] empty rows after the last one.
#[derive(Debug, Clone)]
pub(crate) struct SmoothingFactor(Vec<Row>);

impl SmoothingFactor {
    /// Replaces the right-hand side, numbers or vectors, by the solution. Entries before the first row and after the
    /// last one are zero, so that any sample may stand for the missing ones.
    pub(crate) fn solve<T: Copy + Sub<Output = T> + Mul<f64, Output = T>>(&self, x: &mut [T]) {
        let last = x.len().saturating_sub(1);
        for i in 0..x.len() {
            let lower = self.0[i].lower;
            for k in (1..=ORDER).rev() {
                x[i] = x[i] - x[i.saturating_sub(k)] * lower[k - 1];
            }
        }
        for i in (0..x.len()).rev() {
            x[i] = x[i] * self.0[i].inverse;
            for k in (1..=ORDER).rev() {
                x[i] = x[i] - x[last.min(i + k)] * self.0[i + k].lower[k - 1];
            }
        }
    }
}
