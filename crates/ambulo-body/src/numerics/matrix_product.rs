//! Products of dense matrices with the same bits on every processor.
//!
//!   C_ij = Σ_k A_ik B_kj        in the order of k, each product rounded before it is added
//!
//! Rows are computed side by side, one lane per row, so the width of the processor's vectors changes no sum. The product of `nalgebra` without its
//! optional kernels adds column by column too, but not in vectors.
//!
//! Cost: rows x columns x terms.
//! Pinned by: the tests below

use nalgebra::DMatrix;
use pulp::{Arch, Simd, WithSimd};
use std::array;

/// Terms that are added before a sum is stored.
const TERMS: usize = 4;

/// A B.
///
/// # Panics
/// If A has another number of columns than B has rows.
pub fn product(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    assert_eq!(a.ncols(), b.nrows(), "columns of the first matrix, rows of the second");
    let mut c = DMatrix::zeros(a.nrows(), b.ncols());
    if a.nrows() > 0 {
        Arch::new().dispatch(Product { a: a.as_slice(), b, c: c.as_mut_slice(), rows: a.nrows() });
    }
    c
}

/// Matrices column by column.
struct Product<'a> {
    a: &'a [f64],
    b: &'a DMatrix<f64>,
    c: &'a mut [f64],
    rows: usize,
}

impl WithSimd for Product<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Product { a, b, c, rows } = self;
        for (j, sums) in c.chunks_exact_mut(rows).enumerate() {
            let factors = &b.as_slice()[j * b.nrows()..(j + 1) * b.nrows()];
            let mut columns = a.chunks_exact(TERMS * rows);
            let mut terms = factors.chunks_exact(TERMS);
            for (columns, terms) in columns.by_ref().zip(terms.by_ref()) {
                let columns: [&[f64]; TERMS] = array::from_fn(|k| &columns[k * rows..(k + 1) * rows]);
                add_columns(simd, sums, columns, array::from_fn(|k| terms[k]));
            }
            for (column, factor) in columns.remainder().chunks_exact(rows).zip(terms.remainder()) {
                add_columns(simd, sums, [column], [*factor]);
            }
        }
    }
}

/// Adds multiples of columns, one after the other.
#[inline(always)]
fn add_columns<S: Simd, const K: usize>(simd: S, sums: &mut [f64], columns: [&[f64]; K], factors: [f64; K]) {
    let (wide, rest) = S::as_mut_simd_f64s(sums);
    let parts = columns.map(|column| S::as_simd_f64s(column));
    let splats = factors.map(|factor| simd.splat_f64s(factor));
    for (i, sum) in wide.iter_mut().enumerate() {
        let mut value = *sum;
        for k in 0..K {
            value = simd.add_f64s(value, simd.mul_f64s(parts[k].0[i], splats[k]));
        }
        *sum = value;
    }
    for (i, sum) in rest.iter_mut().enumerate() {
        for k in 0..K {
            *sum += parts[k].1[i] * factors[k];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Numbers whose sums round.
    fn matrix(rows: usize, columns: usize, seed: f64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| 1.0 / (seed + 3.0 * i as f64 + 0.7 * j as f64))
    }

    #[test]
    fn products_are_sums_in_the_order_of_their_terms_to_the_last_bit() {
        for (rows, terms, columns) in [(1, 1, 1), (3, 5, 2), (17, 23, 9), (64, 64, 64), (5, 0, 4), (0, 3, 2)] {
            let (a, b) = (matrix(rows, terms, 0.3), matrix(terms, columns, -7.1));
            let found = product(&a, &b);
            assert_eq!(found.shape(), (rows, columns));
            for (i, j) in (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j))) {
                let expected = (0..terms).fold(0.0, |sum, k| sum + a[(i, k)] * b[(k, j)]);
                assert_eq!(found[(i, j)].to_bits(), f64::to_bits(expected), "{rows} x {terms} x {columns} at {i}, {j}");
            }
        }
    }
}
