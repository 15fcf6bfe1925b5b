//! Normal equations of the least-squares problem, assembled per instant and solved as a band with a border.
//!
//! At one instant all residuals depend on z = (q, q̇, q̈) of all coordinates. Their matrix H = Σ rᵀr in z is summed
//! first; then the splines map it to the unknowns, all coordinates at once, because every coordinate has the same
//! weights:
//!
//!   block(k, l) += Σ_de W_dk W_el H_de          d, e: value, rate, acceleration; k, l: the six blocks of the interval
//!
//! Rates of forces, which depend on two instants of one interval and on few coordinates, are mapped first and
//! multiplied then ([`IntervalRows`]). Blocks beyond the last knot are then added to those that they repeat
//! ([`Layout::origin`]).

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

/// Residuals of one knot interval that depend on the same few coordinates.
#[derive(Debug, Clone)]
pub(super) struct IntervalRows {
    /// Numbers of the coordinates, in their order.
    coordinates: Vec<usize>,
    residuals: Vec<f64>,
    /// Slopes by the unknowns of these coordinates in the six blocks of the interval, block after block.
    rows: Vec<f64>,
}

impl IntervalRows {
    pub(super) fn new(coordinates: Vec<usize>) -> IntervalRows {
        IntervalRows { coordinates, residuals: Vec::new(), rows: Vec::new() }
    }

    pub(super) fn coordinates(&self) -> &[usize] {
        &self.coordinates
    }

    pub(super) fn clear(&mut self) {
        self.residuals.clear();
        self.rows.clear();
    }

    /// Adds a residual from its slopes in z of two instants of the interval, with the weights of these.
    pub(super) fn add(&mut self, residual: f64, instants: [(&Weights, &[f64]); 2]) {
        let (few, start) = (self.coordinates.len(), self.rows.len());
        self.residuals.push(residual);
        self.rows.resize(start + OVERLAP * few, 0.0);
        let row = &mut self.rows[start..];
        for (weights, slopes) in instants {
            let n = slopes.len() / 3;
            for (weights, slopes) in weights.values.iter().zip(slopes.chunks(n)) {
                for (place, weight) in row.chunks_mut(few).zip(weights) {
                    for (sum, &c) in place.iter_mut().zip(&self.coordinates) {
                        *sum += weight * slopes[c];
                    }
                }
            }
        }
    }
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

    /// Adds residuals that depend on everything. Only the lower half of the matrix is filled; see
    /// [`InstantSums::complete`].
    #[inline(always)]
    fn add_rows(&mut self, residuals: &[f64], rows: &[f64]) {
        let width = self.width;
        for (i, sums) in self.matrix.chunks_mut(width).enumerate() {
            for (residual, row) in residuals.iter().zip(rows.chunks(width)) {
                let a = row[i];
                if a == 0.0 {
                    continue;
                }
                self.right[i] += a * residual;
                for (sum, b) in sums[..=i].iter_mut().zip(row) {
                    *sum += a * b;
                }
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

    /// Copies the lower half of the matrix to the upper one.
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
        arch.dispatch(Map { to: self, weights, from: &sums.matrix });
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

    /// Adds rows of the interval that begins with block `first`.
    pub(super) fn add_interval(&mut self, first: usize, rows: &IntervalRows) {
        let arch = self.arch;
        arch.dispatch(AddInterval { to: self, first, rows });
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
                    if block < layout.blocks() {
                        let lower = if back == 0 { &from[..=a] } else { from };
                        matrix.add_row(row, (block - back) * n, lower);
                        continue;
                    }
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
        self.sums.add_rows(self.residuals, self.rows);
    }
}

struct AddInterval<'a> {
    to: &'a mut NormalEquations,
    first: usize,
    rows: &'a IntervalRows,
}

impl WithSimd for AddInterval<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let AddInterval { to, first, rows: IntervalRows { coordinates, residuals, rows } } = self;
        let (n, few) = (to.width, coordinates.len());
        let mut products = vec![0.0; OVERLAP * few];
        for i in 0..OVERLAP * few {
            let (k, a) = (i / few, coordinates[i % few]);
            let products = &mut products[..=i];
            products.fill(0.0);
            let right = &mut to.right[(first + k) * n + a];
            for (residual, row) in residuals.iter().zip(rows.chunks(OVERLAP * few)) {
                *right += row[i] * residual;
                for (sum, value) in products.iter_mut().zip(row) {
                    *sum += row[i] * value;
                }
            }
            for (l, products) in products.chunks(few).enumerate() {
                let block = &mut to.blocks[(((first + k) * OVERLAP + k - l) * n + a) * n..][..n];
                for (&b, product) in coordinates.iter().zip(products) {
                    block[b] += product;
                }
            }
        }
    }
}

/// Maps a matrix in z of an instant to the blocks.
struct Map<'a> {
    to: &'a mut NormalEquations,
    weights: &'a Weights,
    /// 3 n by 3 n.
    from: &'a [f64],
}

impl WithSimd for Map<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) {
        let Map { to, weights: Weights { first, values }, from } = self;
        let n = to.width;
        // G_dl = Σ_e H_de W_el.
        for d in 0..3 {
            for l in 0..OVERLAP {
                let half = &mut to.half[(d * OVERLAP + l) * n * n..][..n * n];
                for (a, half) in half.chunks_mut(n).enumerate() {
                    let row = &from[(d * n + a) * 3 * n..][..3 * n];
                    let weights = [0, 1, 2].map(|e| values[e][l]);
                    for b in 0..n {
                        half[b] = weights[0] * row[b] + weights[1] * row[n + b] + weights[2] * row[2 * n + b];
                    }
                }
            }
        }
        for k in 0..OVERLAP {
            let weights = [0, 1, 2].map(|d| values[d][k]);
            for l in 0..=k {
                let parts = [0, 1, 2].map(|d| &to.half[(d * OVERLAP + l) * n * n..][..n * n]);
                let block = &mut to.blocks[((first + k) * OVERLAP + k - l) * n * n..][..n * n];
                for (i, entry) in block.iter_mut().enumerate() {
                    *entry += weights[0] * parts[0][i] + weights[1] * parts[1][i] + weights[2] * parts[2][i];
                }
            }
        }
    }
}
