//! Normal equations with a band and a border.

use ambulo_body::internals::BorderedSystem;
use nalgebra::{DMatrix, DVector};

/// Six unknowns in a band of one, two in the border.
fn equations() -> (BorderedSystem, DMatrix<f64>, DVector<f64>) {
    let mut bordered = BorderedSystem::zeros(6, 1, 2);
    let mut dense = DMatrix::<f64>::zeros(8, 8);
    for i in 0..6 {
        bordered.band.add(i, i, 4.0 + i as f64);
        dense[(i, i)] = 4.0 + i as f64;
        if i > 0 {
            bordered.band.add(i, i - 1, -1.0);
            (dense[(i, i - 1)], dense[(i - 1, i)]) = (-1.0, -1.0);
        }
        for k in 0..2 {
            let b = ((i + 3 * k) as f64).cos();
            bordered.border[k][i] = b;
            (dense[(i, 6 + k)], dense[(6 + k, i)]) = (b, b);
        }
        bordered.right[i] = 1.0 + i as f64;
    }
    for k in 0..2 {
        (bordered.corner[(k, k)], dense[(6 + k, 6 + k)]) = (5.0, 5.0);
        bordered.corner_right[k] = 3.0 - k as f64;
    }
    let right = DVector::from_iterator(8, (0..6).map(|i| 1.0 + f64::from(i)).chain([3.0, 2.0]));
    (bordered, dense, right)
}

#[test]
fn the_solution_is_that_of_the_dense_matrix() {
    let (bordered, dense, right) = equations();
    let (x, y) = bordered.solve(&[[-9.0, 9.0]; 2]).unwrap();
    let found = DVector::from_iterator(8, x.into_iter().chain(y));
    assert!((dense * found - right).amax() < 1e-12);
}

#[test]
fn entries_outside_their_range_are_fixed_at_the_limit_and_the_others_solved_again() {
    let (bordered, dense, right) = equations();
    let (x, y) = bordered.solve(&[[-9.0, 9.0], [-9.0, 0.01]]).unwrap();
    assert!((y[1] - 0.01).abs() < 1e-15, "{y:?}");
    let found = DVector::from_iterator(8, x.into_iter().chain(y));
    let left = dense * found - right;
    assert!(left.rows(0, 7).amax() < 1e-12, "{left}");
}
