//! Cholesky factors of symmetric positive definite band matrices of any width.
//!
//! A = L Lᵀ,  L lower triangular with the bandwidth of A, so nothing fills in.
//!
//! | code    | symbol  | shape                                          |
//! | `width` | w       | bands below the diagonal                        |
//! | `rows`  | Aᵢ,ᵢ₋w₊ₖ | `rows[i * (w + 1) + k]`, k = 0..=w, diagonal last |
//!
//! Eight rows are eliminated side by side, one lane per row, four columns at once; every sum has the order of the
//! columns.
//!
//! Source: G.H. Golub, C.F. Van Loan, Matrix Computations, section on banded systems (unverified).
//! Cost: rows times w² for the factors, rows times 4 w for a solution.
//! Not handled: pivoting. `factor` returns `None` if the matrix is not positive definite.
//! Pinned by: tests/numerics_band_cholesky.rs, tests/marker_gaps.rs

use pulp::{Arch, Simd, WithSimd};
use std::array;

/// Rows that are eliminated side by side, one per lane.
const ROWS: usize = 8;
/// Columns that are eliminated side by side.
const TOGETHER: usize = 4;
/// Parts of a sum that a processor adds at once.
const LANES: usize = 8;

/// A symmetric band matrix, lower half stored by rows.
#[derive(Debug, Clone)]
pub struct BandMatrix {
    size: usize,
    width: usize,
    rows: Vec<f64>,
}

/// The factor L of a [`BandMatrix`].
#[derive(Debug, Clone)]
pub struct BandFactor(BandMatrix);

impl BandMatrix {
    /// A zero matrix of `size` rows with `width` bands below the diagonal.
    #[must_use]
    pub fn zeros(size: usize, width: usize) -> BandMatrix {
        BandMatrix { size, width, rows: vec![0.0; size * (width + 1)] }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.rows.fill(0.0);
    }

    #[inline]
    fn at(&self, row: usize, column: usize) -> usize {
        row * (self.width + 1) + self.width + column - row
    }

    /// The entry at (`row`, `column`); zero outside of the band.
    #[inline]
    #[must_use]
    pub fn value(&self, row: usize, column: usize) -> f64 {
        let (low, high) = (row.min(column), row.max(column));
        if high - low > self.width { 0.0 } else { self.rows[self.at(high, low)] }
    }

    /// Adds to the entry at (`row`, `column`) and its mirror; `column <= row <= column + width`.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        let place = self.at(row, column);
        self.rows[place] += value;
    }

    /// Factors the matrix; `None` if it is not positive definite.
    #[must_use]
    pub fn factor(mut self) -> Option<BandFactor> {
        let is_positive = Arch::new().dispatch(Elimination(&mut self));
        is_positive.then_some(BandFactor(self))
    }

    /// The row from this column to its diagonal.
    #[inline(always)]
    fn until_diagonal(&self, row: usize, from: usize) -> &[f64] {
        &self.rows[self.at(row, from)..=self.at(row, row)]
    }

    /// Eliminates the rows from `top` on, as many as there are lanes; false if the matrix is not positive definite.
    /// `columns` is scratch memory of w + [`ROWS`] columns.
    #[inline(always)]
    fn eliminate_rows<S: Simd>(&mut self, simd: S, top: usize, columns: &mut [[f64; ROWS]]) -> bool {
        let first = top.saturating_sub(self.width);
        let above = top - first;
        let columns = &mut columns[..above + ROWS];
        self.copy_rows(top, first, columns);
        let mut at = 0;
        while at + TOGETHER <= above {
            let rows: [&[f64]; TOGETHER] = array::from_fn(|c| self.until_diagonal(first + at + c, first));
            eliminate_columns(simd, columns, at, rows);
            at += TOGETHER;
        }
        for at in at..above {
            eliminate_columns(simd, columns, at, [self.until_diagonal(first + at, first)]);
        }
        if !eliminate_own(simd, columns, above) {
            return false;
        }
        for row in top..self.size.min(top + ROWS) {
            for column in row.saturating_sub(self.width)..=row {
                let place = self.at(row, column);
                self.rows[place] = columns[column - first][row - top];
            }
        }
        true
    }

    /// Copies the rows from `top` on, one per lane; zero outside of the band, the unit matrix below the last row.
    #[inline(always)]
    fn copy_rows(&self, top: usize, first: usize, columns: &mut [[f64; ROWS]]) {
        columns.fill([0.0; ROWS]);
        for (lane, row) in (top..top + ROWS).enumerate() {
            if row >= self.size {
                columns[row - first][lane] = 1.0;
                continue;
            }
            let start = row.saturating_sub(self.width);
            let own = &mut columns[start - first..=row - first];
            own.iter_mut().zip(self.until_diagonal(row, start)).for_each(|(column, value)| column[lane] = *value);
        }
    }
}

/// Replaces a matrix by its factor; false if it is not positive definite.
struct Elimination<'a>(&'a mut BandMatrix);

impl WithSimd for Elimination<'_> {
    type Output = bool;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> bool {
        let mut columns = vec![[0.0; ROWS]; self.0.width + ROWS];
        (0..self.0.size).step_by(ROWS).all(|top| self.0.eliminate_rows(simd, top, &mut columns))
    }
}

/// Computes N columns of the factor in rows that lie below the diagonal of these columns, of which `rows` has the rows.
/// Every sum has the order of the columns, so that neither N nor the lanes change it.
#[inline(always)]
fn eliminate_columns<S: Simd, const N: usize>(simd: S, columns: &mut [[f64; ROWS]], at: usize, rows: [&[f64]; N]) {
    let (known, own) = columns.split_at_mut(at);
    let heads = rows.map(|row| &row[..known.len()]);
    let mut sums = products(simd, known, |k| heads.map(|head| head[k]));
    for c in 0..N {
        let divisor = rows[c][at + c];
        own[c] = array::from_fn(|lane| (own[c][lane] - sums[c][lane]) / divisor);
        for later in c + 1..N {
            add(&mut sums[later], &own[c], rows[later][at + c]);
        }
    }
}

/// Computes the columns from `above` on, whose diagonals are in these rows; false if the matrix is not positive
/// definite.
#[inline(always)]
fn eliminate_own<S: Simd>(simd: S, columns: &mut [[f64; ROWS]], above: usize) -> bool {
    for at in (above..above + ROWS).step_by(TOGETHER) {
        let lane = at - above;
        let (known, own) = columns.split_at_mut(at);
        let mut sums = products(simd, known, |k| array::from_fn::<_, TOGETHER, _>(|c| known[k][lane + c]));
        for c in 0..TOGETHER {
            let pivot = own[c][lane + c] - sums[c][lane + c];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return false;
            }
            let root = pivot.sqrt();
            own[c] = array::from_fn(|row| (own[c][row] - sums[c][row]) / root);
            own[c][lane + c] = root;
            for later in c + 1..TOGETHER {
                add(&mut sums[later], &own[c], own[c][lane + later]);
            }
        }
    }
    true
}

/// For each of N columns the sum over the known columns, with their factors for this one; one lane per row.
#[inline(always)]
fn products<S: Simd, const N: usize>(
    simd: S,
    known: &[[f64; ROWS]],
    factors: impl Fn(usize) -> [f64; N],
) -> [[f64; ROWS]; N] {
    // As many vectors as the lanes take on this processor are used.
    let mut sums = [[simd.splat_f64s(-0.0); ROWS]; N];
    for (k, column) in known.iter().enumerate() {
        let values = S::as_simd_f64s(column).0;
        for (sums, factor) in sums.iter_mut().zip(factors(k)) {
            let factor = simd.splat_f64s(factor);
            for (sum, value) in sums.iter_mut().zip(values) {
                *sum = simd.add_f64s(*sum, simd.mul_f64s(*value, factor));
            }
        }
    }
    let mut lanes = [[0.0; ROWS]; N];
    for (lanes, sums) in lanes.iter_mut().zip(&sums) {
        S::as_mut_simd_f64s(lanes).0.iter_mut().zip(sums).for_each(|(lanes, sum)| *lanes = *sum);
    }
    lanes
}

#[inline(always)]
fn add(sums: &mut [f64; ROWS], column: &[f64; ROWS], factor: f64) {
    for (sum, value) in sums.iter_mut().zip(column) {
        *sum += value * factor;
    }
}

impl BandFactor {
    /// Replaces the right-hand side by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let BandMatrix { size, width: w, rows } = &self.0;
        let stride = w + 1;
        for top in (0..*size).step_by(TOGETHER) {
            self.substitute(top, x);
        }
        for i in (0..*size).rev() {
            let reach = i.min(*w);
            let row = &rows[i * stride..(i + 1) * stride];
            x[i] /= row[*w];
            let value = x[i];
            for (x, a) in x[i - reach..i].iter_mut().zip(&row[w - reach..*w]) {
                *x -= a * value;
            }
        }
    }
}

impl BandFactor {
    /// Solves L y = b for [`TOGETHER`] rows from `top` on. Their sums run side by side, each in the order of the
    /// columns.
    fn substitute(&self, top: usize, x: &mut [f64]) {
        let BandMatrix { size, width: w, .. } = self.0;
        let end = size.min(top + TOGETHER);
        let start = (end - 1).saturating_sub(w).min(top);
        let mut known = [-0.0; TOGETHER];
        let rows: [&[f64]; TOGETHER] = array::from_fn(|c| {
            let row = (top + c).min(end - 1);
            let first = row.saturating_sub(w);
            let own = self.0.until_diagonal(row, first);
            let (head, rest) = own.split_at(start.max(first) - first);
            head.iter().zip(&x[first..]).for_each(|(a, b)| known[c] += a * b);
            rest
        });
        for (k, value) in x[start..top].iter().enumerate() {
            for c in 0..TOGETHER {
                known[c] += rows[c][k] * value;
            }
        }
        for i in top..end {
            let (c, own) = (i - top, rows[i - top]);
            let first = i + 1 - own.len();
            let sum = own[top.max(first) - first..i - first].iter().zip(&x[top.max(first)..i]);
            let known = sum.fold(known[c], |sum, (a, b)| sum + a * b);
            x[i] = (x[i] - known) / own[i - first];
        }
    }

    /// aᵀ A⁻¹ a = |L⁻¹ a|² of a vector with few entries, each with its row: the variance of a sum whose parts have the
    /// covariance A⁻¹. Cost: rows after the first entry times w.
    #[must_use]
    pub fn variance_of(&self, entries: &[(usize, f64)]) -> f64 {
        let BandMatrix { size, width: w, rows } = &self.0;
        let Some(first) = entries.iter().map(|(row, _)| *row).min() else { return 0.0 };
        let mut x = vec![0.0; size - first];
        for (row, value) in entries {
            x[row - first] += value;
        }
        for i in 0..x.len() {
            let reach = i.min(*w);
            let row = &rows[(first + i) * (w + 1)..(first + i + 1) * (w + 1)];
            let known: f64 = row[w - reach..*w].iter().zip(&x[i - reach..i]).map(|(a, b)| a * b).sum();
            x[i] = (x[i] - known) / row[*w];
        }
        x.iter().map(|x| x * x).sum()
    }

    /// The entries of A⁻¹ inside the band of A, in the memory of L.
    ///
    /// From Z L = L⁻ᵀ, row by row from the last: Z_ij = (δ_ij / L_jj - Σ_k Z_ik L_kj) / L_jj for j <= i, k = j+1 .. j+w
    /// (Takahashi, Fagan, Chen 1973; unverified). Column j of Z needs column j of L and later columns of Z. Cost: rows
    /// times w².
    #[must_use]
    pub fn inverse_in_band(self) -> BandMatrix {
        let BandFactor(mut matrix) = self;
        let (size, w) = (matrix.size, matrix.width);
        let (mut column, mut product) = (vec![0.0; w], vec![0.0; w]);
        // Column j of Z from row j to j + w, by columns of L from the last to the first.
        for j in (0..size).rev() {
            let reach = (size - 1 - j).min(w);
            let (column, product) = (&mut column[..reach], &mut product[..reach]);
            for (k, l) in column.iter_mut().enumerate() {
                *l = matrix.rows[matrix.at(j + 1 + k, j)];
            }
            matrix.multiply(j + 1, column, product);
            let diagonal = matrix.at(j, j);
            let pivot = matrix.rows[diagonal];
            let mut sum = 0.0;
            for (k, (l, product)) in column.iter().zip(product).enumerate() {
                let place = matrix.at(j + 1 + k, j);
                matrix.rows[place] = -*product / pivot;
                sum += matrix.rows[place] * l;
            }
            matrix.rows[diagonal] = (1.0 / pivot - sum) / pivot;
        }
        matrix
    }
}

impl BandMatrix {
    /// The product y = A x of the block of rows and columns from `first` on, as many as x has, which is no more than
    /// w + 1. Each row is read once, for its own entry of y and for the entries of the columns.
    fn multiply(&self, first: usize, x: &[f64], y: &mut [f64]) {
        for (i, own) in x.iter().enumerate() {
            let start = self.at(first + i, first);
            let (row, diagonal) = (&self.rows[start..start + i], self.rows[start + i]);
            let (above, at) = y.split_at_mut(i);
            at[0] = add_and_multiply(row, *own, &x[..i], above) + diagonal * own;
        }
    }
}

/// Adds `factor` times the row to `sums` and returns the product of the row with x, whose sum has [`LANES`] parts in a
/// fixed order.
fn add_and_multiply(row: &[f64], factor: f64, x: &[f64], sums: &mut [f64]) -> f64 {
    let mut parts = [0.0; LANES];
    let (rows, row_rest) = row.as_chunks::<LANES>();
    let (xs, x_rest) = x.as_chunks::<LANES>();
    let (sums, sums_rest) = sums.as_chunks_mut::<LANES>();
    for ((row, x), sums) in rows.iter().zip(xs).zip(sums) {
        for k in 0..LANES {
            parts[k] += row[k] * x[k];
            sums[k] += row[k] * factor;
        }
    }
    let mut rest = 0.0;
    for ((row, x), sum) in row_rest.iter().zip(x_rest).zip(sums_rest) {
        rest += row * x;
        *sum += row * factor;
    }
    parts.iter().sum::<f64>() + rest
}
