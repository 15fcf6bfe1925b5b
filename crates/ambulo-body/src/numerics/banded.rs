//! Symmetric positive definite band matrices: L D Lᵀ, solution, and the central bands of the inverse.
//!
//! A = L D Lᵀ,  L unit lower triangular with the bandwidth of A, so nothing fills in.
//!
//! | code    | symbol    | shape                                     |
//! | `width` | w         | bands below the diagonal, at most 4       |
//! | `rows`  | Aᵢ,ᵢ₋d    | one array per row, `rows[i][d]`, d = 0..=w |
//! | `lower` | Lᵢ,ᵢ₋d    | `lower[i][d - 1]`, d = 1..=w              |
//!
//! Source: G.H. Golub, C.F. Van Loan, Matrix Computations, section on banded systems (unverified); inverse bands:
//! M.F. Hutchinson, F.R. de Hoog 1985, Numer. Math. 47:99-106 (unverified), derived below.
//! Cost: linear in rows; w² each for the factors and for the inverse.
//! Not handled: pivoting. If the matrix is not positive definite, the row of the first pivot that is not positive is
//! returned. Pinned by: tests/splines.rs

/// Bands below the diagonal that the largest spline (half order 4) needs.
const MAX_WIDTH: usize = 4;

/// A symmetric band matrix, lower half stored.
#[derive(Clone, Debug)]
pub(super) struct SymmetricBand {
    width: usize,
    rows: Vec<[f64; MAX_WIDTH + 1]>,
}

impl SymmetricBand {
    /// A zero matrix of `size` rows with `width` bands below the diagonal.
    pub(super) fn zeros(size: usize, width: usize) -> Self {
        assert!(width <= MAX_WIDTH, "a spline of half order {width} has no place here");
        Self { width, rows: vec![[0.0; MAX_WIDTH + 1]; size] }
    }

    /// Adds to the entry at (`row`, `column`), `row >= column`.
    pub(super) fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][row - column] += value;
    }

    /// `self + factor other`, with the wider of both bands.
    pub(super) fn plus_scaled(&self, factor: f64, other: &Self) -> Self {
        let add = |a: &[f64; MAX_WIDTH + 1], b: &[f64; MAX_WIDTH + 1]| std::array::from_fn(|d| a[d] + factor * b[d]);
        Self {
            width: self.width.max(other.width),
            rows: self.rows.iter().zip(&other.rows).map(|(a, b)| add(a, b)).collect(),
        }
    }

    /// Largest sum of magnitudes in a row: a bound on the largest eigenvalue.
    pub(super) fn norm(&self) -> f64 {
        let mut sums = vec![0.0; self.rows.len()];
        for (i, row) in self.rows.iter().enumerate() {
            sums[i] += row[0].abs();
            for d in 1..=self.width.min(i) {
                sums[i] += row[d].abs();
                sums[i - d] += row[d].abs();
            }
        }
        sums.into_iter().fold(0.0, f64::max)
    }

    /// `out -= self x`.
    pub(super) fn subtract_product(&self, x: &[f64], out: &mut [f64]) {
        for (i, row) in self.rows.iter().enumerate() {
            out[i] -= row[0] * x[i];
            for d in 1..=self.width.min(i) {
                out[i] -= row[d] * x[i - d];
                out[i - d] -= row[d] * x[i];
            }
        }
    }

    /// Trace of the product with a symmetric matrix of which `bands[i][d]` are the entries (i, i-d).
    pub(super) fn trace_of_product(&self, bands: &[[f64; MAX_WIDTH + 1]]) -> f64 {
        let row = |(a, z): (&[f64; MAX_WIDTH + 1], &[f64; MAX_WIDTH + 1])| {
            a[0] * z[0] + 2.0 * (1..=self.width).map(|d| a[d] * z[d]).sum::<f64>()
        };
        self.rows.iter().zip(bands).map(row).sum()
    }

    /// The factors, or the row of the first pivot that is not positive.
    pub(super) fn factor(&self) -> Result<BandedLdl, usize> {
        let w = self.width;
        let mut lower = vec![[0.0; MAX_WIDTH]; self.rows.len()];
        let mut pivots: Vec<f64> = Vec::with_capacity(self.rows.len());
        for (i, row) in self.rows.iter().enumerate() {
            // Lᵢⱼ Dⱼ = Aᵢⱼ - Σₖ Lᵢₖ Dₖ Lⱼₖ (k < j);  Dᵢ = Aᵢᵢ - Σⱼ Lᵢⱼ² Dⱼ. `scaled[d]` is Lᵢⱼ Dⱼ for j = i - d.
            let mut scaled = [0.0; MAX_WIDTH + 1];
            let mut pivot = row[0];
            for d in (1..=w.min(i)).rev() {
                let j = i - d;
                let known: f64 = (d + 1..=w.min(i)).map(|e| scaled[e] * lower[j][e - d - 1]).sum();
                scaled[d] = row[d] - known;
                lower[i][d - 1] = scaled[d] / pivots[j];
                pivot -= scaled[d] * lower[i][d - 1];
            }
            if !(pivot > 0.0 && pivot.is_finite()) {
                return Err(i);
            }
            pivots.push(pivot);
        }
        Ok(BandedLdl { width: w, lower, inverse_pivots: pivots.iter().map(|d| 1.0 / d).collect() })
    }
}

/// The factors L and D⁻¹ of a symmetric positive definite band matrix.
#[derive(Clone, Debug)]
pub(super) struct BandedLdl {
    width: usize,
    lower: Vec<[f64; MAX_WIDTH]>,
    inverse_pivots: Vec<f64>,
}

impl BandedLdl {
    /// Replaces the right-hand side by the solution.
    pub(super) fn solve(&self, x: &mut [f64]) {
        match self.width {
            0 => self.solve_width::<0>(x),
            1 => self.solve_width::<1>(x),
            2 => self.solve_width::<2>(x),
            3 => self.solve_width::<3>(x),
            _ => self.solve_width::<4>(x),
        }
    }

    /// L u = b from the top, then Lᵀ x = D⁻¹ u from the bottom. The last W values are carried in registers:
    /// `recent[d - 1]` is u(i-d), and then `owed[d - 1]` what the solved rows below subtract from row i-d.
    fn solve_width<const W: usize>(&self, x: &mut [f64]) {
        let mut recent = [0.0; W];
        for (value, lower) in x.iter_mut().zip(&self.lower) {
            let known: f64 = recent.iter().zip(lower).map(|(u, l)| u * l).sum();
            *value -= known;
            shift_in(&mut recent, *value);
        }
        let mut owed = [0.0; W];
        for ((value, lower), inverse_pivot) in x.iter_mut().zip(&self.lower).zip(&self.inverse_pivots).rev() {
            *value *= inverse_pivot;
            if W > 0 {
                *value -= owed[0];
                owed.rotate_left(1);
                owed[W - 1] = 0.0;
            }
            for d in 0..W {
                owed[d] += lower[d] * *value;
            }
        }
    }

    /// The entries of Z = A⁻¹ inside the band of A: entry [i][d] is Z(i, i-d).
    ///
    /// From Lᵀ Z = D⁻¹ L⁻¹, whose right side has zeros above its diagonal Dᵢ⁻¹: row i of Z follows from the rows
    /// below it, Zᵢⱼ = [i = j] Dᵢ⁻¹ - Σₖ Lₖᵢ Zₖⱼ for k = i+1..=i+w and j >= i.
    pub(super) fn inverse_bands(&self) -> Vec<[f64; MAX_WIDTH + 1]> {
        let n = self.lower.len();
        let mut z = vec![[0.0; MAX_WIDTH + 1]; n];
        for i in (0..n).rev() {
            let reach = self.width.min(n - 1 - i);
            for e in 1..=reach {
                let entry = |d: usize| if d >= e { z[i + d][d - e] } else { z[i + e][e - d] };
                z[i + e][e] = -(1..=reach).map(|d| self.lower[i + d][d - 1] * entry(d)).sum::<f64>();
            }
            let below: f64 = (1..=reach).map(|d| self.lower[i + d][d - 1] * z[i + d][d]).sum();
            z[i][0] = self.inverse_pivots[i] - below;
        }
        z
    }
}

/// Drops the oldest value and puts the newest first.
fn shift_in<const W: usize>(recent: &mut [f64; W], value: f64) {
    if W > 0 {
        recent.rotate_right(1);
        recent[0] = value;
    }
}
