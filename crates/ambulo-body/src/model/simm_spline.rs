//! The cubic spline of the SIMM program, OpenSim's `SimmSpline`.
//!
//! Interpolating cubic with continuous curvature. End conditions: the third derivative at each end equals the third
//! derivative of the cubic through the four outermost points (Forsythe, Malcolm, Moler 1977, "Computer Methods for
//! Mathematical Computations" (unverified), as in OpenSim's `SimmSpline.cpp`). Beyond the ends a straight line
//! continues with the end slope. Two points give a straight line, three points a third derivative of zero at the ends.
//!
//! With curvatures M = y'' at the knots and h the spacings, the interior rows are
//! hᵢ₋₁ Mᵢ₋₁ + 2 (hᵢ₋₁ + hᵢ) Mᵢ + hᵢ Mᵢ₊₁ = 6 (sᵢ - sᵢ₋₁), s the secants; the end rows state M₁ - M₀ = h₀ y''' and
//! its mirror.

use super::knots::Knots;

/// Cubic spline through knots, with linear extrapolation.
#[derive(Debug, Clone, PartialEq)]
pub struct SimmSpline {
    knots: Knots,
    /// Second derivative at each knot.
    curvature: Vec<f64>,
}

impl SimmSpline {
    /// Fits the knots; `None` for fewer than two.
    #[must_use]
    pub fn new(knots: Knots) -> Option<SimmSpline> {
        let curvature = match knots.x().len() {
            0 | 1 => return None,
            2 => vec![0.0; 2],
            _ => curvatures(knots.x(), knots.y()),
        };
        Some(SimmSpline { knots, curvature })
    }

    /// The interpolated points.
    #[must_use]
    pub fn knots(&self) -> &Knots {
        &self.knots
    }

    /// y, dy/dx and d²y/dx² at x.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 3] {
        let xs = self.knots.x();
        let last = xs.len() - 1;
        if x < xs[0] || x > xs[last] {
            let end = if x < xs[0] { 0 } else { last };
            let [y, slope, _] = self.inside(xs[end]);
            return [y + slope * (x - xs[end]), slope, 0.0];
        }
        self.inside(x)
    }

    fn inside(&self, x: f64) -> [f64; 3] {
        let (xs, ys, m) = (self.knots.x(), self.knots.y(), &self.curvature);
        let i = self.knots.before(x).min(xs.len() - 2);
        let (h, t) = (xs[i + 1] - xs[i], x - xs[i]);
        let third = (m[i + 1] - m[i]) / h;
        let slope = (ys[i + 1] - ys[i]) / h - h * (2.0 * m[i] + m[i + 1]) / 6.0;
        [
            ys[i] + t * (slope + t * (m[i] / 2.0 + t * third / 6.0)),
            slope + t * (m[i] + t * third / 2.0),
            m[i] + t * third,
        ]
    }
}

/// Curvatures at three or more knots: a tridiagonal system, solved by elimination from both end rows inwards.
fn curvatures(x: &[f64], y: &[f64]) -> Vec<f64> {
    let n = x.len();
    let h: Vec<f64> = x.windows(2).map(|w| w[1] - w[0]).collect();
    let secant: Vec<f64> = (0..n - 1).map(|i| (y[i + 1] - y[i]) / h[i]).collect();
    let (third_first, third_last) =
        if n > 3 { (third_derivative(x, y, 0), third_derivative(x, y, n - 4)) } else { (0.0, 0.0) };
    // Rows: lower Mᵢ₋₁ + diagonal Mᵢ + upper Mᵢ₊₁ = right.
    let (mut diagonal, mut right) = (vec![0.0; n], vec![0.0; n]);
    (diagonal[0], right[0]) = (-h[0], h[0] * h[0] * third_first);
    for i in 1..n - 1 {
        (diagonal[i], right[i]) = (2.0 * (h[i - 1] + h[i]), 6.0 * (secant[i] - secant[i - 1]));
    }
    (diagonal[n - 1], right[n - 1]) = (-h[n - 2], -h[n - 2] * h[n - 2] * third_last);
    for i in 1..n {
        let factor = h[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * h[i - 1];
        right[i] -= factor * right[i - 1];
    }
    let mut m = right;
    m[n - 1] /= diagonal[n - 1];
    for i in (0..n - 1).rev() {
        m[i] = (m[i] - h[i] * m[i + 1]) / diagonal[i];
    }
    m
}

/// Third derivative of the cubic through the four points that begin at `i`: 6 times their third divided difference.
fn third_derivative(x: &[f64], y: &[f64], i: usize) -> f64 {
    let first = |a: usize, b: usize| (y[b] - y[a]) / (x[b] - x[a]);
    let second = |a: usize, b: usize, c: usize| (first(b, c) - first(a, b)) / (x[c] - x[a]);
    6.0 * (second(i + 1, i + 2, i + 3) - second(i, i + 1, i + 2)) / (x[i + 3] - x[i])
}
