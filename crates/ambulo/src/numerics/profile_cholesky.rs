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
use std::array;

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
    fn factor_in_place<S: Simd>(&mut self, simd: S) -> bool {
        let mut i = 0;
        while i < self.first.len() {
            let alike = i + 1 < self.first.len() && self.first[i] == self.first[i + 1];
            let rows = if alike { 2 } else { 1 };
            let done = if alike { self.factor_rows::<S, 2>(simd, i) } else { self.factor_rows::<S, 1>(simd, i) };
            if !done {
                return false;
            }
            i += rows;
        }
        true
    }

    /// Factors the rows i to i + P - 1, which begin in the same column; `false` if a pivot is not positive.
    #[inline(always)]
    fn factor_rows<S: Simd, const P: usize>(&mut self, simd: S, i: usize) -> bool {
        let ProfileMatrix { first, starts, entries } = self;
        let (above, rest) = entries.split_at_mut(starts[i]);
        let begin = first[i];
        let mut rest = rest;
        let mut rows: [&mut [f64]; P] = array::from_fn(|p| {
            let (row, after) = std::mem::take(&mut rest).split_at_mut(i + p + 1 - begin);
            rest = after;
            row
        });
        let mut j = begin;
        while j < i {
            let alike = j + TOGETHER <= i && first[j..j + TOGETHER].iter().all(|column| *column == first[j]);
            if alike {
                eliminate::<S, P, TOGETHER>(simd, &mut rows, begin, j, first[j], above, starts);
                j += TOGETHER;
            } else {
                eliminate::<S, P, 1>(simd, &mut rows, begin, j, first[j], above, starts);
                j += 1;
            }
        }
        // The rows themselves: each depends on the one before.
        for p in 0..P {
            let (before, own) = rows.split_at_mut(p);
            let row = &mut *own[0];
            for (q, other) in before.iter().enumerate() {
                let column = i + q - begin;
                let [[sum]] = dots(simd, [&row[..column]], [&other[..column]]);
                row[column] = (row[column] - sum) / other[column];
            }
            let (known, diagonal) = row.split_at_mut(i + p - begin);
            let [[square]] = dots(simd, [known], [known]);
            let pivot = diagonal[0] - square;
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
        Arch::new().dispatch(Solve(&self.0, x));
    }
}

/// Lanes of a sum.
const LANES: usize = 8;
/// Columns that are computed together: their sums do not wait for each other.
const TOGETHER: usize = 4;

/// Entries j to j + R - 1 of `rows` that begin at column `begin`; the rows j to j + R - 1 in `above` begin at column `first`.
#[inline(always)]
fn eliminate<S: Simd, const P: usize, const R: usize>(
    simd: S,
    rows: &mut [&mut [f64]; P],
    begin: usize,
    j: usize,
    first: usize,
    above: &[f64],
    starts: &[usize],
) {
    let common = begin.max(first);
    let others: [&[f64]; R] = array::from_fn(|r| &above[starts[j + r]..=starts[j + r] + j + r - first]);
    let own: [&[f64]; P] = array::from_fn(|p| &rows[p][common - begin..j - begin]);
    let sums = dots(simd, own, others.map(|other| &other[common - first..j - first]));
    for (row, sums) in rows.iter_mut().zip(&sums) {
        for r in 0..R {
            let (known, pivot) = others[r][j - first..].split_at(r);
            let sum: f64 = known.iter().zip(&row[j - begin..]).map(|(a, b)| a * b).sum();
            row[j + r - begin] = (row[j + r - begin] - sums[r] - sum) / pivot[0];
        }
    }
}

/// Sums of products of each of `a` with each of `b`, all of the same length.
#[inline(always)]
fn dots<S: Simd, const P: usize, const R: usize>(simd: S, a: [&[f64]; P], b: [&[f64]; R]) -> [[f64; R]; P] {
    let vectors = LANES / S::F64_LANES;
    let whole = a[0].len() / LANES * LANES;
    let x = a.map(|a| S::as_simd_f64s(&a[..whole]).0);
    let y = b.map(|b| S::as_simd_f64s(&b[..whole]).0);
    let mut sums = [[[simd.splat_f64s(0.0); LANES]; R]; P];
    for start in (0..x[0].len()).step_by(vectors) {
        for v in 0..vectors {
            for r in 0..R {
                let y = y[r][start + v];
                for p in 0..P {
                    sums[p][r][v] = simd.add_f64s(sums[p][r][v], simd.mul_f64s(x[p][start + v], y));
                }
            }
        }
    }
    array::from_fn(|p| {
        array::from_fn(|r| {
            let mut lanes = [0.0; LANES];
            S::as_mut_simd_f64s(&mut lanes).0.copy_from_slice(&sums[p][r][..vectors]);
            let pairs: [f64; 4] = array::from_fn(|k| lanes[k] + lanes[k + 4]);
            let rest: f64 = a[p][whole..].iter().zip(&b[r][whole..]).map(|(x, y)| x * y).sum();
            (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]) + rest
        })
    })
}

struct Factor<'a>(&'a mut ProfileMatrix);

impl WithSimd for Factor<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        self.0.factor_in_place(simd)
    }
}

struct Solve<'a>(&'a ProfileMatrix, &'a mut [f64]);

impl WithSimd for Solve<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Solve(ProfileMatrix { first, starts, entries }, x) = self;
        for i in 0..first.len() {
            let row = &entries[starts[i]..=starts[i] + i - first[i]];
            let (known, pivot) = row.split_at(i - first[i]);
            let [[sum]] = dots(simd, [known], [&x[first[i]..i]]);
            x[i] = (x[i] - sum) / pivot[0];
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
