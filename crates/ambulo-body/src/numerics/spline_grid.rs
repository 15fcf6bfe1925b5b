//! The part of a natural spline fit that depends on the time grid and the half order only, not on the values.
//!
//! The m-th derivative of a natural spline is a sum of B-splines of order m, all of them inside the data:
//!
//! f⁽ᵐ⁾ = Σⱼ γⱼ Mⱼ,   ∫ Mⱼ dτ = 1,   j = 0..n-m-1
//!
//! The m-th divided difference is the mean of f⁽ᵐ⁾ weighted by such a B-spline (Peano), so for g = f(t):
//!
//! m! [tⱼ, .., tⱼ₊ₘ] f = ∫ Mⱼ f⁽ᵐ⁾ dτ,   or   Qᵀ g = R γ,   Rᵢⱼ = ∫ Mᵢ Mⱼ dτ
//!
//! | code             | symbol   | unit | shape                                  |
//! | `step`           | h        | s    | mean step; inside, time is τ = t / h   |
//! | `inverse_spans`  | 1/(τᵢ₊ₖ - τᵢ) | 1 | `[k - 1][i]`, k = 1..=m             |
//! | `gram`           | R        | 1    | n-m rows, m-1 bands                    |
//! | `penalty`        | Qᵀ Q     | 1    | n-m rows, m bands                      |
//! | `pieces`         |          | 1    | per step: m powers of τ-τᵢ, m B-splines |
//! | `node_weights`, `piece_weights` | | 1 | per sample, see [`SplineGrid::coefficients`] |
//!
//! Everything is computed from time differences, never from τ itself, so a late start of the clock costs no digits.
//! The mean step as unit keeps all entries near 1 at any sampling rate.
//!
//! Source: derived here; the formulation follows Reinsch 1967, Numer. Math. 10:177-183, and F.R. de Hoog,
//! M.F. Hutchinson 1987, Numer. Math. 50:311-319 (both unverified). The objective is Woltring's, and so is p.
//! Cost: linear in samples, about m³ each, once per grid; then about 3m² per sample and column.
//! Pinned by: tests/splines.rs

use std::sync::Arc;

use crate::numerics::elementary::powi;

use super::banded::SymmetricBand;
use super::natural_spline::{SplineDegree, SplineError};

/// The largest half order, and so the longest polynomial of the m-th derivative.
const MAX_HALF_ORDER: usize = 4;

/// A polynomial in time since a sample, lowest power first.
type Piece = [f64; MAX_HALF_ORDER];

/// Matrices of one half order on one time grid.
#[derive(Debug, Clone)]
pub(super) struct SplineGrid {
    pub(super) half_order: usize,
    pub(super) times: Arc<[f64]>,
    pub(super) step: f64,
    pub(super) gram: SymmetricBand,
    pub(super) penalty: SymmetricBand,
    inverse_spans: Vec<Vec<f64>>,
    pieces: Vec<f64>,
    node_weights: Vec<f64>,
    piece_weights: Vec<f64>,
}

impl SplineGrid {
    /// Checks the times (s) and prepares the matrices.
    pub(super) fn new(degree: SplineDegree, times: &[f64]) -> Result<Self, SplineError> {
        check_times(degree, times)?;
        let (m, n) = (degree.half_order(), times.len());
        let step = (times[n - 1] - times[0]) / (n - 1) as f64;
        let inverse_spans = (1..=m).map(|k| (0..n - k).map(|i| step / (times[i + k] - times[i])).collect()).collect();
        let mut grid = Self {
            half_order: m,
            times: times.into(),
            step,
            gram: SymmetricBand::zeros(n - m, m - 1),
            penalty: SymmetricBand::zeros(n - m, m),
            inverse_spans,
            pieces: Vec::with_capacity((n - 1) * m * m),
            node_weights: Vec::with_capacity(n * (m - 1) * m),
            piece_weights: Vec::with_capacity(n * (m - 1) * (m - 1) * m),
        };
        (0..n - 1).for_each(|i| grid.push_pieces(i));
        grid.add_penalty();
        (0..n).for_each(|i| grid.push_derivative_weights(i));
        Ok(grid)
    }

    /// τⱼ - τᵢ.
    fn span(&self, i: usize, j: usize) -> f64 {
        (self.times[j] - self.times[i]) / self.step
    }

    /// Qᵀ y: m! times the m-th divided differences. Differences are taken level by level, so that the constant part of
    /// y cancels exactly.
    pub(super) fn differences(&self, y: &[f64]) -> Vec<f64> {
        let mut d = y.to_vec();
        for (k, inverse_span) in self.inverse_spans.iter().enumerate() {
            let factor = (k + 1) as f64;
            for i in 0..inverse_span.len() {
                d[i] = (d[i + 1] - d[i]) * inverse_span[i] * factor;
            }
            d.pop();
        }
        d
    }

    /// Q γ, the transpose of [`Self::differences`], level by level in reverse.
    pub(super) fn transposed_differences(&self, gamma: &[f64]) -> Vec<f64> {
        let mut d = gamma.to_vec();
        for (k, inverse_span) in self.inverse_spans.iter().enumerate().rev() {
            let factor = (k + 1) as f64;
            let mut before = 0.0;
            for (value, inverse_span) in d.iter_mut().zip(inverse_span) {
                let scaled = *value * inverse_span * factor;
                *value = before - scaled;
                before = scaled;
            }
            d.push(before);
        }
        d
    }

    /// The B-splines between samples i and i+1, and their contribution to R.
    fn push_pieces(&mut self, i: usize) {
        let (m, rows) = (self.half_order, self.times.len() - self.half_order);
        let live = self.live_splines(i);
        let width = self.span(i, i + 1);
        let first = (i + 1).saturating_sub(m);
        for a in first..=i.min(rows - 1) {
            for b in first..=a {
                let product = integral_of_product(&live[a + m - 1 - i], &live[b + m - 1 - i], width);
                self.gram.add(a, b, product);
            }
        }
        for power in 0..m {
            self.pieces.extend(live[..m].iter().map(|piece| piece[power]));
        }
    }

    /// Entry a is B-spline j = i+a-(m-1) between samples i and i+1, zero where there is no such j.
    ///
    /// Mⱼ,₁ = 1/(τⱼ₊₁ - τⱼ);  Mⱼ,ₖ = k/(k-1) [ (τ - τⱼ) Mⱼ,ₖ₋₁ + (τⱼ₊ₖ - τ) Mⱼ₊₁,ₖ₋₁ ] / (τⱼ₊ₖ - τⱼ)
    fn live_splines(&self, i: usize) -> [Piece; MAX_HALF_ORDER] {
        let (m, n) = (self.half_order, self.times.len());
        let mut live = [[0.0; MAX_HALF_ORDER]; MAX_HALF_ORDER];
        live[m - 1][0] = self.inverse_spans[0][i];
        for k in 2..=m {
            for a in m - k..m {
                let Some(j) = (i + a + 1).checked_sub(m).filter(|j| j + k < n) else {
                    live[a] = [0.0; MAX_HALF_ORDER];
                    continue;
                };
                let next = if a + 1 < m { live[a + 1] } else { [0.0; MAX_HALF_ORDER] };
                let scale = k as f64 / (k - 1) as f64 * self.inverse_spans[k - 1][j];
                let (rise, fall) = (self.span(j, i), self.span(i, j + k));
                let mut sum = [0.0; MAX_HALF_ORDER];
                for power in 0..k {
                    sum[power] = scale * (rise * live[a][power] + fall * next[power]);
                    if power > 0 {
                        sum[power] += scale * (live[a][power - 1] - next[power - 1]);
                    }
                }
                live[a] = sum;
            }
        }
        live
    }

    /// Qᵀ Q from the columns of Q: Qⱼ₊ₖ,ⱼ = m! / Πₗ (τⱼ₊ₖ - τⱼ₊ₗ), l ≠ k.
    fn add_penalty(&mut self) {
        let m = self.half_order;
        let factorial: f64 = (1..=m).map(|k| k as f64).product();
        let column = |j: usize, k: usize| {
            (0..=m).filter(|l| *l != k).fold(factorial, |product, l| product / self.span(j + l, j + k))
        };
        let columns: Vec<[f64; MAX_HALF_ORDER + 1]> = (0..self.times.len() - m)
            .map(|j| std::array::from_fn(|k| if k <= m { column(j, k) } else { 0.0 }))
            .collect();
        for a in 0..columns.len() {
            for d in 0..=m.min(a) {
                let overlap: f64 = (d..=m).map(|k| columns[a][k - d] * columns[a - d][k]).sum();
                self.penalty.add(a, a - d, overlap);
            }
        }
    }

    /// First of the m samples from which the lower derivatives at sample i are taken.
    fn window_start(&self, i: usize) -> usize {
        let m = self.half_order;
        i.saturating_sub((m - 1) / 2).min(self.times.len() - m)
    }

    /// Weights for the Taylor coefficients a₁..aₘ₋₁ of f at sample i. By Taylor's formula about τᵢ,
    ///
    /// Σₖ aₖ xⱼᵏ = gⱼ - gᵢ - ∫ (τⱼ - s)ᵐ⁻¹/(m-1)! f⁽ᵐ⁾(s) ds,   xⱼ = τⱼ - τᵢ,   integral from τᵢ to τⱼ,
    ///
    /// for the m-1 other samples j of the window. Solved for aₖ with Lagrange polynomials: `node_weights` multiply
    /// gⱼ - gᵢ, `piece_weights` the powers of f⁽ᵐ⁾ on the steps of the window.
    fn push_derivative_weights(&mut self, i: usize) {
        let (m, start) = (self.half_order, self.window_start(i));
        let mut nodes = [[0.0; MAX_HALF_ORDER]; MAX_HALF_ORDER];
        for j in (start..start + m).filter(|j| *j != i) {
            nodes[j - start] = self.lagrange(i, j, start);
        }
        for k in 1..m {
            self.node_weights.extend(nodes[..m].iter().map(|polynomial| polynomial[k]));
            for l in start..start + m - 1 {
                for power in 0..m {
                    // A step to the right of i counts with plus for the samples to its right; a step to the left with
                    // minus for those to its left.
                    let (seen_by, sign) = if l >= i { (l + 1..start + m, -1.0) } else { (start..l + 1, 1.0) };
                    let weight = |j: usize| nodes[j - start][k] * self.remainder(l, j, power);
                    self.piece_weights.push(sign * seen_by.map(weight).sum::<f64>());
                }
            }
        }
    }

    /// The polynomial in τ - τᵢ that is 1 at sample j and 0 at the other samples of the window and at i.
    fn lagrange(&self, i: usize, j: usize, start: usize) -> Piece {
        let mut polynomial = [0.0; MAX_HALF_ORDER];
        polynomial[1] = 1.0 / self.span(i, j);
        for l in (start..start + self.half_order).filter(|l| *l != i && *l != j) {
            let (root, scale) = (self.span(i, l), 1.0 / self.span(l, j));
            for power in (1..MAX_HALF_ORDER).rev() {
                polynomial[power] = (polynomial[power - 1] - root * polynomial[power]) * scale;
            }
        }
        polynomial
    }

    /// ∫ (τⱼ - s)ᵐ⁻¹/(m-1)! (s - τₗ)^power ds over step l, by the binomial expansion about τₗ.
    fn remainder(&self, l: usize, j: usize, power: usize) -> f64 {
        let (m, reach, width) = (self.half_order, self.span(l, j), self.span(l, l + 1));
        let mut binomial_over_factorial = 1.0 / (1..m).map(|k| k as f64).product::<f64>();
        let mut sum = 0.0;
        for r in 0..m {
            let exponent = power + r + 1;
            sum += binomial_over_factorial * powi(reach, (m - 1 - r) as i32) * powi(width, exponent as i32)
                / exponent as f64;
            binomial_over_factorial *= -((m - 1 - r) as f64) / (r + 1) as f64;
        }
        sum
    }

    /// Taylor coefficients of the spline at every sample [value/s^k], 2m per sample, from its values `g` there and
    /// from γ. The last sample, where f⁽ᵐ⁾ ends, has m coefficients and m zeros.
    pub(super) fn coefficients(&self, g: &[f64], gamma: &[f64]) -> Vec<f64> {
        match self.half_order {
            1 => self.coefficients_of::<1>(g, gamma),
            2 => self.coefficients_of::<2>(g, gamma),
            3 => self.coefficients_of::<3>(g, gamma),
            _ => self.coefficients_of::<4>(g, gamma),
        }
    }

    fn coefficients_of<const M: usize>(&self, g: &[f64], gamma: &[f64]) -> Vec<f64> {
        let n = g.len();
        let top: Vec<[f64; M]> = (0..n - 1).map(|i| self.top_derivative(i, gamma)).collect();
        // aₘ₊ₖ = (k-th coefficient of f⁽ᵐ⁾) k!/(m+k)!; all in units of 1/h per order.
        let per_second: Vec<f64> = (0..2 * M).map(|k| powi(self.step, -(k as i32))).collect();
        let integrated: [f64; M] =
            std::array::from_fn(|k| per_second[M + k] / (k + 1..=M + k).map(|factor| factor as f64).product::<f64>());
        let mut out = vec![0.0; n * 2 * M];
        for (i, row) in out.chunks_exact_mut(2 * M).enumerate() {
            let start = self.window_start(i);
            row[0] = g[i];
            for k in 1..M {
                let at = i * (M - 1) + k - 1;
                let nodes = &self.node_weights[at * M..(at + 1) * M];
                let steps = &self.piece_weights[at * (M - 1) * M..(at + 1) * (M - 1) * M];
                let chord: f64 = (0..M).map(|j| nodes[j] * (g[start + j] - g[i])).sum();
                let bow: f64 = steps.iter().zip(top[start..start + M - 1].as_flattened()).map(|(w, d)| w * d).sum();
                row[k] = (chord + bow) * per_second[k];
            }
            if let Some(top) = top.get(i) {
                (0..M).for_each(|k| row[M + k] = top[k] * integrated[k]);
            }
        }
        out
    }

    /// Coefficients of f⁽ᵐ⁾ in τ - τᵢ between samples i and i+1.
    fn top_derivative<const M: usize>(&self, i: usize, gamma: &[f64]) -> [f64; M] {
        let near: [f64; M] =
            std::array::from_fn(|a| (i + a + 1).checked_sub(M).and_then(|j| gamma.get(j)).copied().unwrap_or(0.0));
        let pieces = &self.pieces[i * M * M..(i + 1) * M * M];
        std::array::from_fn(|power| (0..M).map(|a| pieces[power * M + a] * near[a]).sum())
    }
}

fn check_times(degree: SplineDegree, times: &[f64]) -> Result<(), SplineError> {
    let allowed = degree.degree() + 1;
    if times.len() < allowed {
        return Err(SplineError::TooFewSamples { found: times.len(), allowed, degree: degree.degree() });
    }
    if let Some(index) = times.iter().position(|t| !t.is_finite()) {
        return Err(SplineError::NonFiniteTime { index, found: times[index] });
    }
    match times.windows(2).position(|pair| pair[1] <= pair[0]) {
        Some(i) => Err(SplineError::TimeNotIncreasing { index: i + 1, previous: times[i], found: times[i + 1] }),
        None => Ok(()),
    }
}

/// ∫ a b ds for s from 0 to `width`.
fn integral_of_product(a: &Piece, b: &Piece, width: f64) -> f64 {
    let mut sum = 0.0;
    for (p, ap) in a.iter().enumerate() {
        for (q, bq) in b.iter().enumerate() {
            let exponent = p + q + 1;
            sum += ap * bq * powi(width, exponent as i32) / exponent as f64;
        }
    }
    sum
}
