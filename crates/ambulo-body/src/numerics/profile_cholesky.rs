//! Cholesky factors of symmetric positive definite matrices whose rows begin at any column.
//!
//! A = L Lᵀ, where row i of L begins in the same column as row i of A. Examples are band matrices, and band matrices
//! with a border of full rows.
//!
//!   L_ij = (A_ij - Σ_k L_ik L_jk) / L_jj    L_ii = √(A_ii - Σ_k L_ik²)    k from the later of both beginnings to j - 1
//!
//! Neighbouring rows that begin in the same column are factored side by side, one lane per row, so that every entry is
//! a sum in the order of k. Sums of the solution have eight parts, one per lane, added in a fixed order. So the result
//! has the same bits on every processor.
//!
//! Source: A. George, J. W. Liu, "Computer solution of large sparse positive definite systems", 1981, chapter 4
//! (unverified). Cost: half the sum of the squares of the row lengths.
//! Not handled: pivoting. `factor` returns `None` if the matrix is not positive definite.
//! Pinned by: tests/numerics_profile_cholesky.rs

use pulp::{Arch, Simd, WithSimd};
use std::array;

/// A symmetric matrix. Row i stores the entries from column `first[i]` to the diagonal.
#[derive(Debug, Clone)]
pub struct ProfileMatrix {
    first: Vec<usize>,
    /// Index in `entries` at which each row begins.
    starts: Vec<usize>,
    entries: Vec<f64>,
}

/// Vectors of a column of a panel.
const VECTORS: usize = 4;
/// Columns that are computed together: their sums do not wait for each other.
const TOGETHER: usize = 4;

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
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.entries[self.starts[row] + column - self.first[row]] += value;
    }

    /// Adds to the entries of a row from a column on; the same bounds as for [`ProfileMatrix::add`].
    #[inline]
    pub fn add_row(&mut self, row: usize, column: usize, values: &[f64]) {
        let start = self.starts[row] + column - self.first[row];
        for (entry, value) in self.entries[start..start + values.len()].iter_mut().zip(values) {
            *entry += value;
        }
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
        let mut panel = Panel::new(VECTORS * S::F64_LANES);
        let mut i = 0;
        while i < self.first.len() {
            panel.load(self, i);
            if !panel.factor(simd, self) {
                return false;
            }
            panel.store(self);
            i += panel.rows;
        }
        true
    }
}

/// Neighbouring rows that begin in the same column, side by side: one lane per row.
struct Panel {
    lanes: usize,
    /// Number of the first row, and number of rows.
    row: usize,
    rows: usize,
    /// The column in which the rows begin.
    begin: usize,
    /// Entries of the columns, one after the other; each has one entry per lane.
    entries: Vec<f64>,
}

impl Panel {
    fn new(lanes: usize) -> Panel {
        Panel { lanes, row: 0, rows: 0, begin: 0, entries: Vec::new() }
    }

    /// Takes the rows of a matrix from `row` on, as many as fit.
    fn load(&mut self, matrix: &ProfileMatrix, row: usize) {
        let begin = matrix.first[row];
        let alike = matrix.first[row..].iter().take(self.lanes).take_while(|column| **column == begin);
        (self.row, self.begin, self.rows) = (row, begin, alike.count());
        self.entries.clear();
        self.entries.resize((row + self.rows - begin) * self.lanes, 0.0);
        for lane in 0..self.rows {
            let from = &matrix.entries[matrix.starts[row + lane]..][..=row + lane - begin];
            for (to, value) in self.entries.iter_mut().skip(lane).step_by(self.lanes).zip(from) {
                *to = *value;
            }
        }
    }

    /// Puts the rows back.
    fn store(&self, matrix: &mut ProfileMatrix) {
        for lane in 0..self.rows {
            let to = &mut matrix.entries[matrix.starts[self.row + lane]..][..=self.row + lane - self.begin];
            for (to, value) in to.iter_mut().zip(self.entries.iter().skip(lane).step_by(self.lanes)) {
                *to = *value;
            }
        }
    }

    /// Factors the rows, after all rows above; `false` if a pivot is not positive.
    #[inline(always)]
    fn factor<S: Simd>(&mut self, simd: S, above: &ProfileMatrix) -> bool {
        let (first, end) = (&above.first, self.row + self.rows);
        let mut j = self.begin;
        while j < self.row {
            let alike = j + TOGETHER <= self.row && first[j..j + TOGETHER].iter().all(|column| *column == first[j]);
            if alike {
                self.eliminate::<S, TOGETHER>(simd, j, above);
                j += TOGETHER;
            } else {
                self.eliminate::<S, 1>(simd, j, above);
                j += 1;
            }
        }
        while j < end {
            let together = if j + TOGETHER <= end { TOGETHER } else { 1 };
            let done = if together > 1 { self.pivots::<S, TOGETHER>(simd, j) } else { self.pivots::<S, 1>(simd, j) };
            if !done {
                return false;
            }
            j += together;
        }
        true
    }

    /// Computes the columns j to j + R - 1 from the rows with these numbers, which lie above and begin in the same
    /// column.
    #[inline(always)]
    fn eliminate<S: Simd, const R: usize>(&mut self, simd: S, j: usize, above: &ProfileMatrix) {
        let from = self.begin.max(above.first[j]);
        let factors: [&[f64]; R] = array::from_fn(|r| {
            let row = above.starts[j + r] - above.first[j];
            &above.entries[row + from..=row + j + r]
        });
        let (known, own) = self.entries.split_at_mut((j - self.begin) * self.lanes);
        let mut sums = columns::<S, R>(own);
        let before = factors.map(|row| &row[..j - from]);
        subtract(simd, &mut sums, S::as_simd_f64s(&known[(from - self.begin) * self.lanes..]).0, |r, k| before[r][k]);
        for r in 0..R {
            let (among, pivot) = factors[r][j - from..].split_at(r);
            for (q, factor) in among.iter().enumerate() {
                let other = sums[q];
                subtract(simd, array::from_mut(&mut sums[r]), &other, |_, _| *factor);
            }
            sums[r] = scaled(simd, sums[r], 1.0 / pivot[0]);
        }
        for (entry, sum) in S::as_mut_simd_f64s(own).0.iter_mut().zip(sums.as_flattened()) {
            *entry = *sum;
        }
    }

    /// Computes the columns j to j + R - 1 of the panel's own rows; `false` if a pivot is not positive.
    #[inline(always)]
    fn pivots<S: Simd, const R: usize>(&mut self, simd: S, j: usize) -> bool {
        let (lanes, lane) = (self.lanes, j - self.row);
        let (known, own) = self.entries.split_at_mut((j - self.begin) * lanes);
        let mut sums = columns::<S, R>(own);
        let factors: &[f64] = known;
        subtract(simd, &mut sums, S::as_simd_f64s(known).0, |r, k| factors[k * lanes + lane + r]);
        for r in 0..R {
            for q in 0..r {
                let other = sums[q];
                subtract(simd, array::from_mut(&mut sums[r]), &other, |_, _| own[q * lanes + lane + r]);
            }
            let column = &mut own[r * lanes..(r + 1) * lanes];
            S::as_mut_simd_f64s(column).0.copy_from_slice(&sums[r]);
            let pivot = column[lane + r];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            sums[r] = scaled(simd, sums[r], 1.0 / pivot.sqrt());
            S::as_mut_simd_f64s(column).0.copy_from_slice(&sums[r]);
            column[lane + r] = pivot.sqrt();
        }
        true
    }
}

/// The first R columns of a panel.
#[inline(always)]
fn columns<S: Simd, const R: usize>(entries: &[f64]) -> [[S::f64s; VECTORS]; R] {
    let vectors = S::as_simd_f64s(entries).0;
    array::from_fn(|r| array::from_fn(|v| vectors[r * VECTORS + v]))
}

#[inline(always)]
fn scaled<S: Simd>(simd: S, column: [S::f64s; VECTORS], factor: f64) -> [S::f64s; VECTORS] {
    let factor = simd.splat_f64s(factor);
    column.map(|x| simd.mul_f64s(x, factor))
}

/// Subtracts `factor(r, k)` times column k of some known columns from sum r, for all k in their order.
#[inline(always)]
fn subtract<S: Simd, const R: usize>(
    simd: S,
    sums: &mut [[S::f64s; VECTORS]; R],
    known: &[S::f64s],
    factor: impl Fn(usize, usize) -> f64,
) {
    for (k, column) in known.chunks_exact(VECTORS).enumerate() {
        for (r, sum) in sums.iter_mut().enumerate() {
            let factor = simd.splat_f64s(factor(r, k));
            for (sum, x) in sum.iter_mut().zip(column) {
                *sum = simd.sub_f64s(*sum, simd.mul_f64s(factor, *x));
            }
        }
    }
}

impl ProfileFactor {
    /// Replaces the right-hand side by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        Arch::new().dispatch(Solve(&self.0, x));
    }
}

/// Lanes of a sum of products.
const LANES: usize = 8;

/// Sum of products of two rows of the same length.
#[inline(always)]
fn dot<S: Simd>(simd: S, a: &[f64], b: &[f64]) -> f64 {
    let vectors = LANES / S::F64_LANES;
    let whole = a.len() / LANES * LANES;
    let (x, y) = (S::as_simd_f64s(&a[..whole]).0, S::as_simd_f64s(&b[..whole]).0);
    let mut sums = [simd.splat_f64s(0.0); LANES];
    for (x, y) in x.chunks_exact(vectors).zip(y.chunks_exact(vectors)) {
        for (sum, (x, y)) in sums.iter_mut().zip(x.iter().zip(y)) {
            *sum = simd.add_f64s(*sum, simd.mul_f64s(*x, *y));
        }
    }
    let mut lanes = [0.0; LANES];
    S::as_mut_simd_f64s(&mut lanes).0.copy_from_slice(&sums[..vectors]);
    let pairs: [f64; 4] = array::from_fn(|k| lanes[k] + lanes[k + 4]);
    let rest: f64 = a[whole..].iter().zip(&b[whole..]).map(|(x, y)| x * y).sum();
    (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]) + rest
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
            x[i] = (x[i] - dot(simd, known, &x[first[i]..i])) / pivot[0];
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
