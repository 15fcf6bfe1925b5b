//! Products of dense matrices with the same bits on every processor.

use ambulo_body::numerics::product;
use nalgebra::DMatrix;

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
