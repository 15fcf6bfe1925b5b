//! Cholesky factors of symmetric positive definite band matrices of any width.

use ambulo_body::numerics::BandMatrix;
use nalgebra::{DMatrix, DVector};

#[test]
fn the_solution_is_that_of_the_dense_matrix() {
    for (size, width) in [(1, 0), (5, 2), (12, 4), (7, 6), (9, 20), (40, 13)] {
        let mut band = BandMatrix::zeros(size, width);
        let mut dense = DMatrix::<f64>::zeros(size, size);
        for i in 0..size {
            for j in i.saturating_sub(width)..=i {
                let value = if i == j { 9.0 + i as f64 } else { ((3 * i + 7 * j) % 5) as f64 / 5.0 - 0.4 };
                band.add(i, j, value);
                (dense[(i, j)], dense[(j, i)]) = (value, value);
            }
        }
        let right: Vec<f64> = (0..size).map(|i| (i as f64).sin() + 0.5).collect();
        let mut x = right.clone();
        band.factor().unwrap().solve(&mut x);
        let back = dense * DVector::from_vec(x);
        for (found, expected) in back.iter().zip(&right) {
            assert!((found - expected).abs() < 1e-12, "size {size}, width {width}: {found} for {expected}");
        }
    }
}

#[test]
fn the_inverse_inside_the_band_is_that_of_the_dense_matrix() {
    for (size, width) in [(1, 0), (6, 2), (12, 4), (7, 9)] {
        let mut band = BandMatrix::zeros(size, width);
        let mut dense = DMatrix::<f64>::zeros(size, size);
        for i in 0..size {
            for j in i.saturating_sub(width)..=i {
                let value = if i == j { 9.0 + i as f64 } else { ((3 * i + 7 * j) % 5) as f64 / 5.0 - 0.4 };
                band.add(i, j, value);
                (dense[(i, j)], dense[(j, i)]) = (value, value);
            }
        }
        let factor = band.factor().unwrap();
        let sum = [(size / 2, 0.7), (size - 1, -1.3)];
        let variance = factor.variance_of(&sum);
        let inverse = factor.inverse_in_band();
        let expected = dense.try_inverse().unwrap();
        let pairs = sum.iter().flat_map(|a| sum.iter().map(move |b| (a, b)));
        let known: f64 = pairs.map(|((i, a), (j, b))| a * b * expected[(*i, *j)]).sum();
        assert!((variance - known).abs() < 1e-12, "{variance} for {known}");
        for i in 0..size {
            for j in i.saturating_sub(width)..=i {
                let (found, expected) = (inverse.value(i, j), expected[(i, j)]);
                assert!((found - expected).abs() < 1e-12, "({i}, {j}) of {size}: {found} for {expected}");
            }
        }
    }
}

#[test]
fn a_matrix_that_is_not_positive_has_no_factor() {
    let mut band = BandMatrix::zeros(2, 1);
    band.add(0, 0, 1.0);
    band.add(1, 0, 2.0);
    band.add(1, 1, 1.0);
    assert!(band.factor().is_none());
}
