//! Symmetric matrices whose unknowns form a tree.

use ambulo_body::internals::Branches;
use nalgebra::{DMatrix, DVector};

/// Two arms on a trunk, numbered against the order of the tree; unknown 3 drives an axis in both arms.
fn branches() -> Branches {
    let pairs = [
        (6, 5),
        (4, 6),
        (4, 5),
        (2, 4),
        (2, 6),
        (2, 5),
        (1, 5),
        (1, 6),
        (0, 1),
        (0, 5),
        (0, 6),
        (3, 2),
        (3, 1),
        (3, 5),
    ];
    Branches::new(vec![6, 5, 4, 2, 1, 3, 0], pairs.into_iter())
}

/// A positive definite matrix with entries in all places of the tree, dense and in the tree.
fn matrix(branches: &Branches) -> (DMatrix<f64>, Vec<f64>) {
    let n = branches.unknowns();
    let mut dense = DMatrix::zeros(n, n);
    let mut entries = vec![0.0; branches.entries()];
    for (row, column, entry) in branches.each_entry() {
        let value = if row == column { 5.0 + row as f64 } else { (1.7 * entry as f64 + 0.3).sin() };
        (dense[(row, column)], dense[(column, row)]) = (value, value);
        entries[entry] = value;
    }
    (dense, entries)
}

#[test]
fn solutions_and_the_diagonal_of_the_inverse_are_those_of_the_dense_matrix() {
    let branches = branches();
    let (dense, mut entries) = matrix(&branches);
    let right: Vec<f64> = (0..7).map(|i| (0.9 * f64::from(i)).cos()).collect();
    let inverse = dense.try_inverse().unwrap();
    assert!(branches.factor(&mut entries));
    let mut x = right.clone();
    branches.solve(&entries, &mut x);
    let expected = &inverse * DVector::from_vec(right);
    let (mut scratch, mut diagonal) = (vec![0.0; 7], vec![0.0; 7]);
    branches.inverse_diagonal(&entries, &mut scratch, &mut diagonal);
    for i in 0..7 {
        assert!((x[i] - expected[i]).abs() < 1e-14, "unknown {i}: {} for {}", x[i], expected[i]);
        assert!((diagonal[i] - inverse[(i, i)]).abs() < 1e-14, "diagonal {i}");
    }
}

#[test]
fn different_branches_have_no_entries_and_a_shared_unknown_joins_them() {
    let separate = Branches::new(vec![0, 1, 2], [(1, 0), (2, 0)].into_iter());
    assert_eq!(separate.entries(), 5);
    let joined = Branches::new(vec![0, 1, 2], [(1, 0), (2, 0), (2, 1)].into_iter());
    assert_eq!(joined.entries(), 6);
    assert_eq!(
        branches().each_entry().filter(|(row, column, _)| [*row, *column] == [3, 4]).count(),
        1,
        "changed by unknown 2"
    );
}

#[test]
fn held_unknowns_do_not_move_and_others_are_solved_without_them() {
    let branches = branches();
    let (dense, mut entries) = matrix(&branches);
    let held = [false, false, true, false, false, true, false];
    branches.hold(&mut entries, &held);
    assert!(branches.factor(&mut entries));
    let mut x: Vec<f64> = held.iter().map(|held| if *held { 0.0 } else { 1.0 }).collect();
    branches.solve(&entries, &mut x);
    let free: Vec<usize> = (0..7).filter(|&i| !held[i]).collect();
    let reduced = DMatrix::from_fn(5, 5, |a, b| dense[(free[a], free[b])]);
    let expected = reduced.try_inverse().unwrap() * DVector::from_element(5, 1.0);
    for (k, &i) in free.iter().enumerate() {
        assert!((x[i] - expected[k]).abs() < 1e-14, "unknown {i}");
    }
    assert_eq!((x[2], x[5]), (0.0, 0.0));
}

#[test]
fn a_matrix_that_is_not_positive_definite_is_refused() {
    let branches = branches();
    let (_, mut entries) = matrix(&branches);
    entries[branches.diagonal(4)] = -1.0;
    assert!(!branches.factor(&mut entries));
    entries[branches.diagonal(4)] = f64::NAN;
    assert!(!branches.factor(&mut entries));
}
