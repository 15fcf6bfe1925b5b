//! Products of dense matrices with the same bits on every processor.
//!
//!   C_ij = Σ_k A_ik B_kj        in the order of k, each product rounded before it is added
//!
//! Rows are computed side by side, one lane per row, so the width of the processor's vectors changes no sum. The
//! product of `nalgebra` without its optional kernels adds column by column too, but not in vectors.
//!
//! Cost: rows x columns x terms.
//! Pinned by: tests/numerics_matrix_product.rs

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
