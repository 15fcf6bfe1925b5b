//! Cholesky factors of symmetric positive definite matrices whose rows begin at any column.
//!
//! A = L Lᵀ, where row i of L begins in the same column as row i of A. Examples are band matrices, and band matrices with a border of full
//! rows.
//!
//!   L_ij = (A_ij - Σ_k L_ik L_jk) / L_jj        L_ii = √(A_ii - Σ_k L_ik²)        k from the later of both beginnings to j - 1
//!
//! Sums have eight parts, one per lane, added in a fixed order: the result has the same bits on every processor.
//!
//! Source: A. George, J. W. Liu, "Computer solution of large sparse positive definite systems", 1981, chapter 4 (unverified).
//! Cost: half the sum of the squares of the row lengths.
//! Not handled: pivoting. `factor` returns `None` if the matrix is not positive definite.
//! Pinned by: the tests below

use pulp::{Arch, Simd, WithSimd};

/// A symmetric matrix. Row i stores the entries from column `first[i]` to the diagonal.
#[derive(Debug, Clone)]
pub struct ProfileMatrix {
    first: Vec<usize>,
    /// Where each row begins in `entries`.
    starts: Vec<usize>,
    entries: Vec<f64>,
}

/// The factor L of a [`ProfileMatrix`].
#[derive(Debug, Clone)]
pub struct ProfileFactor(ProfileMatrix);

impl ProfileMatrix {
    /// A zero matrix whose rows begin at these columns.
    ///
    /// # Panics
    /// If a row begins after its diagonal.
    #[must_use]
    pub fn zeros(first: Vec<usize>) -> ProfileMatrix {
        let mut starts = Vec::with_capacity(first.len());
        let mut next = 0;
        for (row, &column) in first.iter().enumerate() {
            assert!(column <= row, "row {row} begins at column {column}");
            starts.push(next);
            next += row + 1 - column;
        }
        ProfileMatrix { first, starts, entries: vec![0.0; next] }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to an entry of the lower half; `column <= row`, at or after the beginning of the row.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[self.starts[row] + column - self.first[row]] += value;
    }

    /// Adds `factor` times the diagonal, plus `offset`, to the diagonal.
    pub fn raise_diagonal(&mut self, factor: f64, offset: f64) {
        for row in 0..self.first.len() {
            let place = self.starts[row] + row - self.first[row];
            self.entries[place] += factor * self.entries[place] + offset;
        }
    }

    /// The diagonal.
    #[must_use]
    pub fn diagonal(&self) -> Vec<f64> {
        (0..self.first.len()).map(|row| self.entries[self.starts[row] + row - self.first[row]]).collect()
    }

    /// Factors the matrix; `None` if it is not positive definite.
    #[must_use]
    pub fn factor(mut self) -> Option<ProfileFactor> {
        Arch::new().dispatch(Factor(&mut self)).then_some(ProfileFactor(self))
    }

    #[inline(always)]
    fn factor_in_place(&mut self) -> bool {
        for i in 0..self.first.len() {
            let (above, rest) = self.entries.split_at_mut(self.starts[i]);
            let begin = self.first[i];
            let row = &mut rest[..=i - begin];
            for j in begin..i {
                let other = &above[self.starts[j]..=self.starts[j] + j - self.first[j]];
                let common = begin.max(self.first[j]);
                let (known, pivot) = (&other[common - self.first[j]..j - self.first[j]], other[j - self.first[j]]);
                let sum = dot(&row[common - begin..j - begin], known);
                row[j - begin] = (row[j - begin] - sum) / pivot;
            }
            let (known, diagonal) = row.split_at_mut(i - begin);
            let pivot = diagonal[0] - dot(known, known);
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            diagonal[0] = pivot.sqrt();
        }
        true
    }
}

impl ProfileFactor {
    /// Replaces the right-hand side by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let ProfileMatrix { first, starts, entries } = &self.0;
        for i in 0..first.len() {
            let row = &entries[starts[i]..=starts[i] + i - first[i]];
            let (known, pivot) = row.split_at(i - first[i]);
            x[i] = (x[i] - dot(known, &x[first[i]..i])) / pivot[0];
        }
        for i in (0..first.len()).rev() {
            let row = &entries[starts[i]..=starts[i] + i - first[i]];
            let (known, pivot) = row.split_at(i - first[i]);
            x[i] /= pivot[0];
            let value = x[i];
            for (x, a) in x[first[i]..i].iter_mut().zip(known) {
                *x -= a * value;
            }
        }
    }
}

/// Lanes of a sum.
const LANES: usize = 8;

#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut lanes = [0.0; LANES];
    let (mut left, mut right) = (a.chunks_exact(LANES), b.chunks_exact(LANES));
    for (x, y) in left.by_ref().zip(right.by_ref()) {
        for k in 0..LANES {
            lanes[k] += x[k] * y[k];
        }
    }
    let rest: f64 = left.remainder().iter().zip(right.remainder()).map(|(x, y)| x * y).sum();
    let pairs = [lanes[0] + lanes[4], lanes[1] + lanes[5], lanes[2] + lanes[6], lanes[3] + lanes[7]];
    (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]) + rest
}

struct Factor<'a>(&'a mut ProfileMatrix);

impl WithSimd for Factor<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> bool {
        self.0.factor_in_place()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, DVector};

    /// A band of width 5 with two full rows at the end, and the same matrix in full.
    fn bordered() -> (ProfileMatrix, DMatrix<f64>) {
        let size = 40;
        let first: Vec<usize> = (0..size).map(|i: usize| if i >= 38 { 0 } else { i.saturating_sub(5) }).collect();
        let mut full = DMatrix::zeros(size, size);
        let mut profile = ProfileMatrix::zeros(first.clone());
        for (row, &begin) in first.iter().enumerate() {
            for column in begin..=row {
                let value = if row == column { 20.0 } else { ((3 * row + 7 * column) % 11) as f64 * 0.3 - 1.0 };
                profile.add(row, column, value);
                full[(row, column)] = value;
                full[(column, row)] = value;
            }
        }
        (profile, full)
    }

    #[test]
    fn a_band_with_a_border_is_solved_as_the_full_matrix() {
        let (profile, full) = bordered();
        let right = DVector::from_fn(40, |i, _| (i as f64).sin());
        let expected = full.lu().solve(&right).unwrap();
        let mut x = right.as_slice().to_vec();
        profile.factor().unwrap().solve(&mut x);
        for (a, b) in x.iter().zip(expected.iter()) {
            assert!((a - b).abs() < 1e-13, "{a}, {b}");
        }
    }

    #[test]
    fn an_indefinite_matrix_is_refused() {
        let (mut profile, _) = bordered();
        profile.add(20, 20, -100.0);
        assert!(profile.factor().is_none());
    }
}
