//! Normal equations with a band and a border: many unknowns coupled only to their neighbours, and a few coupled to all.
//!
//!   [A  B ] [x]   [r]        Z = A⁻¹ B,   (D - Bᵀ Z) y = s - Zᵀ r,   x = A⁻¹ r - Z y
//!   [Bᵀ D ] [y] = [s]
//!
//! Cost: the cost of [`BandMatrix`], plus one solution per column of the border.

use crate::numerics::BandMatrix;
use nalgebra::{Cholesky, DMatrix, DVector};

/// The equations, assembled term by term.
#[derive(Debug, Clone)]
pub struct BorderedSystem {
    /// A.
    pub band: BandMatrix,
    /// B by columns.
    pub border: Vec<Vec<f64>>,
    /// D.
    pub corner: DMatrix<f64>,
    /// r.
    pub right: Vec<f64>,
    /// s.
    pub corner_right: DVector<f64>,
}

impl BorderedSystem {
    /// A system without terms. Arguments: number of unknowns in the band, half the width of the band, number of
    /// unknowns in the border.
    pub fn zeros(size: usize, bands: usize, border: usize) -> BorderedSystem {
        BorderedSystem {
            band: BandMatrix::zeros(size, bands),
            border: vec![vec![0.0; size]; border],
            corner: DMatrix::zeros(border, border),
            right: vec![0.0; size],
            corner_right: DVector::zeros(border),
        }
    }

    /// x and y, with each entry of y clamped to its range. Returns `None` if the matrix is not positive definite.
    pub fn solve(self, ranges: &[[f64; 2]]) -> Option<(Vec<f64>, Vec<f64>)> {
        let BorderedSystem { band, border, corner, right, corner_right } = self;
        let factor = band.factor()?;
        let mut x = right;
        factor.solve(&mut x);
        let solved: Vec<Vec<f64>> = border
            .iter()
            .map(|column| {
                let mut z = column.clone();
                factor.solve(&mut z);
                z
            })
            .collect();
        let count = border.len();
        let inner = DMatrix::from_fn(count, count, |i, j| corner[(i, j)] - dot(&border[i], &solved[j]));
        let rest = DVector::from_fn(count, |i, _| corner_right[i] - dot(&border[i], &x));
        let y = within(&inner, &rest, ranges)?;
        for (z, y) in solved.iter().zip(&y) {
            for (x, z) in x.iter_mut().zip(z) {
                *x -= z * y;
            }
        }
        Some((x, y))
    }
}

/// The solution of `inner` y = `rest`. Entries that leave their range are fixed at its limit, and the others are solved
/// again.
fn within(inner: &DMatrix<f64>, rest: &DVector<f64>, ranges: &[[f64; 2]]) -> Option<Vec<f64>> {
    let mut held: Vec<Option<f64>> = vec![None; ranges.len()];
    loop {
        let free: Vec<usize> = (0..held.len()).filter(|&i| held[i].is_none()).collect();
        let matrix = DMatrix::from_fn(free.len(), free.len(), |i, j| inner[(free[i], free[j])]);
        let known =
            |i: usize| -> f64 { held.iter().enumerate().map(|(j, y)| y.map_or(0.0, |y| inner[(i, j)] * y)).sum() };
        let right = DVector::from_fn(free.len(), |i, _| rest[free[i]] - known(free[i]));
        let found = if free.is_empty() { right } else { Cholesky::new(matrix)?.solve(&right) };
        let mut y: Vec<f64> = held.iter().map(|y| y.unwrap_or(0.0)).collect();
        let mut left = false;
        for (&i, &value) in free.iter().zip(found.iter()) {
            let [least, most] = ranges[i];
            y[i] = value.clamp(least, most);
            if !(least..=most).contains(&value) {
                held[i] = Some(y[i]);
                left = true;
            }
        }
        if !left {
            return Some(y);
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
