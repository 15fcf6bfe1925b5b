//! A matrix by columns, without its zeros.

use super::factor::Factor;

/// The columns. Each has room for all rows, so that setting one allocates nothing.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    rows: usize,
    count: Vec<usize>,
    row: Vec<usize>,
    value: Vec<f64>,
}

impl Columns {
    pub(super) fn new(rows: usize, columns: usize) -> Columns {
        let room = rows * columns;
        Columns { rows, count: vec![0; columns], row: vec![0; room], value: vec![0.0; room] }
    }

    pub(super) fn set(&mut self, column: usize, entries: impl IntoIterator<Item = (usize, f64)>) {
        let start = column * self.rows;
        let mut count = 0;
        for (row, value) in entries {
            assert!(row < self.rows && count < self.rows, "row {row} of {}", self.rows);
            if value.abs() > 0.0 {
                (self.row[start + count], self.value[start + count]) = (row, value);
                count += 1;
            }
        }
        self.count[column] = count;
    }

    /// Rows and entries of a column.
    #[inline]
    pub(super) fn of(&self, column: usize) -> impl Iterator<Item = (usize, f64)> + '_ {
        let part = column * self.rows..column * self.rows + self.count[column];
        self.row[part.clone()].iter().copied().zip(self.value[part].iter().copied())
    }

    /// Product of a column and a vector.
    #[inline]
    pub(super) fn times(&self, column: usize, vector: &[f64]) -> f64 {
        self.of(column).map(|(row, value)| value * vector[row]).sum()
    }

    /// Adds a multiple of c cᵀ to a symmetric matrix.
    #[inline]
    pub(super) fn add_square(&self, column: usize, factor: f64, matrix: &mut Factor) {
        for (i, (row, value)) in self.of(column).enumerate() {
            for (other, other_value) in self.of(column).take(i + 1) {
                matrix.add(row, other, factor * value * other_value);
            }
        }
    }
}
