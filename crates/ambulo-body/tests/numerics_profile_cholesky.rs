//! Cholesky factors of symmetric positive definite matrices whose rows begin at any column.

use ambulo_body::numerics::ProfileMatrix;
use nalgebra::{DMatrix, DVector};

/// A band of width 5 with two full rows at the end, and the same matrix in full.
fn bordered() -> (ProfileMatrix, DMatrix<f64>) {
    let size = 40;
    let first: Vec<usize> = (0..size).map(|i: usize| if i >= 38 { 0 } else { i.saturating_sub(5) }).collect();
    let mut full = DMatrix::zeros(size, size);
    let mut profile = ProfileMatrix::zeros(first.clone());
    for (row, &begin) in first.iter().enumerate() {
        for column in begin..=row {
            let value = if row == column { 20.0 } else { ((3 * row + 7 * column) % 11) as f64 * 0.3 - 1.0 };
            profile.add(row, column, value);
            full[(row, column)] = value;
            full[(column, row)] = value;
        }
    }
    (profile, full)
}

#[test]
fn a_band_with_a_border_is_solved_as_the_full_matrix() {
    let (profile, full) = bordered();
    let right = DVector::from_fn(40, |i, _| (i as f64).sin());
    let expected = full.lu().solve(&right).unwrap();
    let mut x = right.as_slice().to_vec();
    profile.factor().unwrap().solve(&mut x);
    for (a, b) in x.iter().zip(expected.iter()) {
        assert!((a - b).abs() < 1e-13, "{a}, {b}");
    }
}

/// Blocks of 19 rows next to each other, and a border of full rows: more than the lanes of a panel begin in one column.
#[test]
fn rows_that_begin_alike_are_solved_as_the_full_matrix() {
    let (size, block) = (150, 19);
    let first = |i: usize| if i >= 110 { 0 } else { (i / block).saturating_sub(2) * block };
    let mut profile = ProfileMatrix::zeros((0..size).map(first).collect());
    let mut full = DMatrix::zeros(size, size);
    for row in 0..size {
        for column in first(row)..=row {
            let value = if row == column { 200.0 } else { ((5 * row + 3 * column) % 13) as f64 * 0.2 - 1.2 };
            profile.add(row, column, value);
            full[(row, column)] = value;
            full[(column, row)] = value;
        }
    }
    let right = DVector::from_fn(size, |i, _| (0.7 * i as f64).cos());
    let expected = full.lu().solve(&right).unwrap();
    let mut x = right.as_slice().to_vec();
    profile.clone().factor().unwrap().solve(&mut x);
    for (a, b) in x.iter().zip(expected.iter()) {
        assert!((a - b).abs() < 1e-13, "{a}, {b}");
    }
    profile.add(149, 149, -400.0);
    assert!(profile.factor().is_none());
}

#[test]
fn an_indefinite_matrix_is_refused() {
    let (mut profile, _) = bordered();
    profile.add(20, 20, -100.0);
    assert!(profile.factor().is_none());
}
