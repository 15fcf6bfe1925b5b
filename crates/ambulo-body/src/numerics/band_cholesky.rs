//! Cholesky factors of symmetric positive definite band matrices of any width.
//!
//! A = L Lᵀ,  L lower triangular with the bandwidth of A, so nothing fills in.
//!
//! | code    | symbol  | shape                                          |
//! | `width` | w       | bands below the diagonal                        |
//! | `rows`  | Aᵢ,ᵢ₋w₊ₖ | `rows[i * (w + 1) + k]`, k = 0..=w, diagonal last |
//!
//! Source: G.H. Golub, C.F. Van Loan, Matrix Computations, section on banded systems (unverified).
//! Cost: rows times w² for the factors, rows times 4 w for a solution.
//! Not handled: pivoting. `factor` returns `None` if the matrix is not positive definite.
//! Pinned by: tests/numerics_band_cholesky.rs, tests/marker_gaps.rs

/// Entries of a row that are eliminated side by side.
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
        let (w, stride) = (self.width, self.width + 1);
        for i in 0..self.size {
            let (above, rest) = self.rows.split_at_mut(i * stride);
            let row = &mut rest[..stride];
            let first = i.saturating_sub(w);
            let mut j = first;
            while j + TOGETHER <= i {
                eliminate_together(row, above, [i, j, first], w);
                j += TOGETHER;
            }
            for j in j..i {
                // Columns from `first` on are common to rows i and j.
                let other = &above[j * stride..(j + 1) * stride];
                let (a, b) = (&row[w + first - i..w + j - i], &other[w + first - j..w]);
                let known: f64 = a.iter().zip(b).map(|(x, y)| x * y).sum();
                row[w + j - i] = (row[w + j - i] - known) / other[w];
            }
            let square: f64 = row[w - (i - first)..w].iter().map(|x| x * x).sum();
            let pivot = row[w] - square;
            if !(pivot > 0.0 && pivot.is_finite()) {
                return None;
            }
            row[w] = pivot.sqrt();
        }
        Some(BandFactor(self))
    }
}

/// Entries j to j + [`TOGETHER`] of row i of the factor. Their sums run side by side, which a processor does at once,
/// each in the same order as alone.
fn eliminate_together(row: &mut [f64], above: &[f64], [i, j, first]: [usize; 3], w: usize) {
    let stride = w + 1;
    let others: [&[f64]; TOGETHER] = std::array::from_fn(|c| &above[(j + c) * stride..(j + c + 1) * stride]);
    let common = j - first;
    let parts: [&[f64]; TOGETHER] =
        std::array::from_fn(|c| &others[c][w + first - (j + c)..w + first - (j + c) + common]);
    let mut sums = [-0.0; TOGETHER];
    for (k, x) in row[w + first - i..w + j - i].iter().enumerate() {
        for (sum, part) in sums.iter_mut().zip(&parts) {
            *sum += x * part[k];
        }
    }
    for (c, other) in others.iter().enumerate() {
        for before in 0..c {
            sums[c] += row[w + j + before - i] * other[w + before - c];
        }
        let place = w + j + c - i;
        row[place] = (row[place] - sums[c]) / other[w];
    }
}

impl BandFactor {
    /// Replaces the right-hand side by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let BandMatrix { size, width: w, rows } = &self.0;
        let stride = w + 1;
        for i in 0..*size {
            let reach = i.min(*w);
            let row = &rows[i * stride..(i + 1) * stride];
            let known: f64 = row[w - reach..*w].iter().zip(&x[i - reach..i]).map(|(a, b)| a * b).sum();
            x[i] = (x[i] - known) / row[*w];
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
