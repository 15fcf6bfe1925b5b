//! Normal equations with a band and a border: many unknowns coupled only to their neighbours, and a few coupled to all.
//!
//!   [A  B ] [x]   [r]        Z = A⁻¹ B,   (D - Bᵀ Z) y = s - Zᵀ r,   x = A⁻¹ r - Z y
//!   [Bᵀ D ] [y] = [s]
//!
//! Cost: that of [`BandMatrix`], and one solution per column of the border.

use crate::numerics::BandMatrix;
use nalgebra::{Cholesky, DMatrix, DVector};

/// The equations, assembled term by term.
#[derive(Debug, Clone)]
pub(super) struct BorderedSystem {
    pub(super) band: BandMatrix,
    /// B by columns.
    pub(super) border: Vec<Vec<f64>>,
    pub(super) corner: DMatrix<f64>,
    pub(super) right: Vec<f64>,
    pub(super) corner_right: DVector<f64>,
}

impl BorderedSystem {
    pub(super) fn zeros(size: usize, bands: usize, border: usize) -> BorderedSystem {
        BorderedSystem {
            band: BandMatrix::zeros(size, bands),
            border: vec![vec![0.0; size]; border],
            corner: DMatrix::zeros(border, border),
            right: vec![0.0; size],
            corner_right: DVector::zeros(border),
        }
    }

    /// x and y, with each entry of y clamped to its range. Returns `None` if the matrix is not positive definite.
    pub(super) fn solve(self, ranges: &[[f64; 2]]) -> Option<(Vec<f64>, Vec<f64>)> {
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

/// The solution of `inner` y = `rest`. Entries that leave their range are fixed at its limit, and the others are solved again.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Six unknowns in a band of one, two in the border.
    fn equations() -> (BorderedSystem, DMatrix<f64>, DVector<f64>) {
        let mut bordered = BorderedSystem::zeros(6, 1, 2);
        let mut dense = DMatrix::<f64>::zeros(8, 8);
        for i in 0..6 {
            bordered.band.add(i, i, 4.0 + i as f64);
            dense[(i, i)] = 4.0 + i as f64;
            if i > 0 {
                bordered.band.add(i, i - 1, -1.0);
                (dense[(i, i - 1)], dense[(i - 1, i)]) = (-1.0, -1.0);
            }
            for k in 0..2 {
                let b = ((i + 3 * k) as f64).cos();
                bordered.border[k][i] = b;
                (dense[(i, 6 + k)], dense[(6 + k, i)]) = (b, b);
            }
            bordered.right[i] = 1.0 + i as f64;
        }
        for k in 0..2 {
            (bordered.corner[(k, k)], dense[(6 + k, 6 + k)]) = (5.0, 5.0);
            bordered.corner_right[k] = 3.0 - k as f64;
        }
        let right = DVector::from_iterator(8, (0..6).map(|i| 1.0 + f64::from(i)).chain([3.0, 2.0]));
        (bordered, dense, right)
    }

    #[test]
    fn the_solution_is_that_of_the_dense_matrix() {
        let (bordered, dense, right) = equations();
        let (x, y) = bordered.solve(&[[-9.0, 9.0]; 2]).unwrap();
        let found = DVector::from_iterator(8, x.into_iter().chain(y));
        assert!((dense * found - right).amax() < 1e-12);
    }

    #[test]
    fn entries_outside_their_range_are_fixed_at_the_limit_and_the_others_solved_again() {
        let (bordered, dense, right) = equations();
        let (x, y) = bordered.solve(&[[-9.0, 9.0], [-9.0, 0.01]]).unwrap();
        assert!((y[1] - 0.01).abs() < 1e-15, "{y:?}");
        let found = DVector::from_iterator(8, x.into_iter().chain(y));
        let left = dense * found - right;
        assert!(left.rows(0, 7).amax() < 1e-12, "{left}");
    }
}
