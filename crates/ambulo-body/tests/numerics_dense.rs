//! Dense square systems.

use ambulo_body::internals::DenseLu;

#[test]
fn a_system_that_needs_exchanged_rows_is_solved_to_rounding() {
    let matrix = [[0.0, 2.0, -1.0], [4.0, 1.0, 0.5], [1.0, -3.0, 2.0]];
    let x = [1.5, -0.25, 3.0];
    let mut lu = DenseLu::default();
    lu.clear(3);
    let mut b = [0.0; 3];
    for (row, numbers) in matrix.iter().enumerate() {
        lu.row_mut(row).copy_from_slice(numbers);
        b[row] = numbers.iter().zip(x).map(|(a, x)| a * x).sum();
    }
    assert!(lu.factor());
    lu.solve(&mut b);
    for (found, x) in b.iter().zip(x) {
        assert!((found - x).abs() < 1e-14, "{b:?}");
    }
}

#[test]
fn a_singular_matrix_has_no_factors() {
    let mut lu = DenseLu::default();
    lu.clear(2);
    lu.row_mut(0).copy_from_slice(&[1.0, 2.0]);
    lu.row_mut(1).copy_from_slice(&[2.0, 4.0]);
    assert!(!lu.factor());
}
