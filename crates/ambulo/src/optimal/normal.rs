//! Normal equations of the least-squares problem, assembled per instant and solved as a band with a border.
//!
//! At one instant all residuals depend on z = (q, q̇, q̈) of all coordinates. Their matrix H = Σ rᵀr in z is summed first; then the splines map it to
//! the unknowns, all coordinates at once, because every coordinate has the same weights:
//!
//!   block(k, l) += Σ_de W_dk W_el H_de          d, e: value, rate, acceleration; k, l: the six blocks of the interval
//!
//! Blocks beyond the last knot are then added to those that they repeat ([`Layout::origin`]).

use super::layout::{Layout, Weights};
use crate::numerics::{OVERLAP, ProfileMatrix};
use pulp::{Arch, Simd, WithSimd};

/// Σ rᵀ r and Σ rᵀ residual of the residuals of one instant, in its positions, rates and accelerations.
#[derive(Debug, Clone)]
pub(super) struct InstantSums {
    /// Three times the number of coordinates.
    width: usize,
    /// Row after row; the whole matrix, although it is symmetric.
    matrix: Vec<f64>,
    right: Vec<f64>,
}

/// Normal equations of all extended blocks.
#[derive(Debug, Clone)]
pub(super) struct NormalEquations {
    /// Size of a block.
    width: usize,
    /// Block (k, k - j) at k * OVERLAP + j, row after row.
    blocks: Vec<f64>,
    right: Vec<f64>,
    /// Scratch of the mapping: H with its second index mapped.
    half: Vec<f64>,
    arch: Arch,
}

impl InstantSums {
    pub(super) fn new(coordinates: usize) -> InstantSums {
        let width = 3 * coordinates;
        InstantSums { width, matrix: vec![0.0; width * width], right: vec![0.0; width] }
    }

    pub(super) fn clear(&mut self) {
        self.matrix.fill(0.0);
        self.right.fill(0.0);
    }

    /// Adds a residual that depends on everything. Only the lower half of the matrix is filled; see [`InstantSums::complete`].
    #[inline(always)]
    fn add_row(&mut self, residual: f64, row: &[f64]) {
        let width = self.width;
        for (i, &a) in row.iter().enumerate() {
            if a == 0.0 {
                continue;
            }
            self.right[i] += a * residual;
            for (sum, b) in self.matrix[i * width..=i * width + i].iter_mut().zip(row) {
                *sum += a * b;
            }
        }
    }

    /// Adds a residual that depends on few entries of z: their numbers and slopes.
    pub(super) fn add_entries(&mut self, residual: f64, entries: &[(usize, f64)]) {
        for &(i, a) in entries {
            self.right[i] += a * residual;
            for &(j, b) in entries.iter().filter(|(j, _)| *j <= i) {
                self.matrix[i * self.width + j] += a * b;
            }
        }
    }

    /// Adds a matrix in z, of which only the lower half counts.
    pub(super) fn add_lower(&mut self, matrix: &[f64]) {
        for (sum, value) in self.matrix.iter_mut().zip(matrix) {
            *sum += value;
        }
    }

    fn complete(&mut self) {
        for i in 0..self.width {
            for j in 0..i {
                self.matrix[j * self.width + i] = self.matrix[i * self.width + j];
            }
        }
    }
}

impl NormalEquations {
    pub(super) fn new(layout: &Layout) -> NormalEquations {
        let (width, blocks) = (layout.width, layout.extended_blocks());
        NormalEquations {
            width,
            blocks: vec![0.0; blocks * OVERLAP * width * width],
            right: vec![0.0; blocks * width],
            half: vec![0.0; 3 * OVERLAP * width * width],
            arch: Arch::new(),
        }
    }

    pub(super) fn clear(&mut self) {
        self.blocks.fill(0.0);
        self.right.fill(0.0);
    }

    pub(super) fn clear_right(&mut self) {
        self.right.fill(0.0);
    }

    /// The right-hand side of the unknowns alone.
    pub(super) fn fold_right(&self, layout: &Layout) -> Vec<f64> {
        let n = self.width;
        let mut right = vec![0.0; layout.blocks() * n];
        for block in 0..layout.extended_blocks() {
            for a in 0..n {
                let (to, to_a, sign) = layout.origin(block, a);
                right[to * n + to_a] += sign * self.right[block * n + a];
            }
        }
        right
    }

    /// Adds residuals with rows in z to the sums of an instant.
    pub(super) fn add_rows(&self, sums: &mut InstantSums, residuals: &[f64], rows: &[f64]) {
        self.arch.dispatch(AddRows { sums, residuals, rows });
    }

    /// Adds the sums of an instant.
    pub(super) fn add_instant(&mut self, weights: &Weights, sums: &mut InstantSums) {
        sums.complete();
        let arch = self.arch;
        arch.dispatch(Map { to: self, rows: weights, columns: weights, from: &sums.matrix, symmetric: true });
        self.add_right(weights, &sums.right);
    }

    pub(super) fn add_right(&mut self, weights: &Weights, right: &[f64]) {
        let n = self.width;
        for (k, place) in self.right[weights.first * n..(weights.first + OVERLAP) * n].chunks_mut(n).enumerate() {
            for (d, values) in right.chunks(n).enumerate() {
                for (sum, value) in place.iter_mut().zip(values) {
                    *sum += weights.values[d][k] * value;
                }
            }
        }
    }

    /// Adds rows that couple two instants of one interval: `cross` is Σ r_aᵀ r_b in z of both, and its transpose is added too.
    pub(super) fn add_pair(&mut self, a: &Weights, b: &Weights, cross: &[f64]) {
        let arch = self.arch;
        arch.dispatch(Map { to: self, rows: a, columns: b, from: cross, symmetric: false });
    }

    /// Σ aᵀ b of rows of two instants.
    pub(super) fn cross(&self, a: &[f64], b: &[f64], width: usize, sum: &mut [f64]) {
        self.arch.dispatch(Cross { a, b, width, sum });
    }

    /// The matrix and the right-hand side of the unknowns.
    pub(super) fn fold(&self, layout: &Layout, matrix: &mut ProfileMatrix, right: &mut [f64]) {
        let n = self.width;
        matrix.clear();
        right.fill(0.0);
        for block in 0..layout.extended_blocks() {
            for a in 0..n {
                let (to, to_a, sign) = layout.origin(block, a);
                let row = to * n + to_a;
                right[row] += sign * self.right[block * n + a];
                for back in 0..OVERLAP.min(block + 1) {
                    let from = &self.blocks[((block * OVERLAP + back) * n + a) * n..][..n];
                    for (b, &value) in from.iter().enumerate() {
                        // Of a block on the diagonal, the lower half only.
                        if value == 0.0 || back == 0 && b > a {
                            continue;
                        }
                        let (other, other_b, other_sign) = layout.origin(block - back, b);
                        let column = other * n + other_b;
                        let doubled = if row == column && (back > 0 || a != b) { 2.0 } else { 1.0 };
                        matrix.add(row.max(column), row.min(column), doubled * sign * other_sign * value);
                    }
                }
            }
        }
    }
}

/// The empty matrix of the unknowns.
pub(super) fn empty_matrix(layout: &Layout) -> ProfileMatrix {
    let (n, blocks) = (layout.width, layout.blocks());
    let repeated = layout.extended_blocks() - blocks;
    let first = |row: usize| {
        let block = row / n;
        if block + repeated >= blocks { 0 } else { block.saturating_sub(OVERLAP - 1) * n }
    };
    ProfileMatrix::zeros((0..blocks * n).map(|row| first(row).min(row)).collect())
}

struct AddRows<'a> {
    sums: &'a mut InstantSums,
    residuals: &'a [f64],
    rows: &'a [f64],
}

impl WithSimd for AddRows<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        for (residual, row) in self.residuals.iter().zip(self.rows.chunks(self.sums.width)) {
            self.sums.add_row(*residual, row);
        }
    }
}

struct Cross<'a> {
    a: &'a [f64],
    b: &'a [f64],
    width: usize,
    sum: &'a mut [f64],
}

impl WithSimd for Cross<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        self.sum.fill(0.0);
        for (a, b) in self.a.chunks(self.width).zip(self.b.chunks(self.width)) {
            for (value, sums) in a.iter().zip(self.sum.chunks_mut(self.width)) {
                for (sum, b) in sums.iter_mut().zip(b) {
                    *sum += value * b;
                }
            }
        }
    }
}

/// Maps a matrix in z of two instants of one interval to the blocks.
struct Map<'a> {
    to: &'a mut NormalEquations,
    rows: &'a Weights,
    columns: &'a Weights,
    /// 3 n by 3 n.
    from: &'a [f64],
    /// Both instants are the same; otherwise the transpose is added too.
    symmetric: bool,
}

impl WithSimd for Map<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Map { to, rows, columns, from, symmetric } = self;
        let n = to.width;
        // G_dl = Σ_e H_de W_el.
        for d in 0..3 {
            for l in 0..OVERLAP {
                let half = &mut to.half[(d * OVERLAP + l) * n * n..][..n * n];
                for (a, half) in half.chunks_mut(n).enumerate() {
                    let row = &from[(d * n + a) * 3 * n..][..3 * n];
                    let weights = [0, 1, 2].map(|e| columns.values[e][l]);
                    for b in 0..n {
                        half[b] = weights[0] * row[b] + weights[1] * row[n + b] + weights[2] * row[2 * n + b];
                    }
                }
            }
        }
        for k in 0..OVERLAP {
            let weights = [0, 1, 2].map(|d| rows.values[d][k]);
            for l in 0..OVERLAP {
                if symmetric && l > k {
                    continue;
                }
                let parts = [0, 1, 2].map(|d| &to.half[(d * OVERLAP + l) * n * n..][..n * n]);
                let (high, low) = (k.max(l), k.min(l));
                let place = ((rows.first + high) * OVERLAP + high - low) * n * n;
                let block = &mut to.blocks[place..place + n * n];
                let sum = |i: usize| weights[0] * parts[0][i] + weights[1] * parts[1][i] + weights[2] * parts[2][i];
                if l <= k {
                    for (i, entry) in block.iter_mut().enumerate() {
                        *entry += sum(i);
                    }
                }
                if !symmetric && l >= k {
                    for a in 0..n {
                        for b in 0..n {
                            block[b * n + a] += sum(a * n + b);
                        }
                    }
                }
            }
        }
    }
}
