//! Dense square systems: LU factors with partial pivoting.
//!
//! For small systems without structure, such as the mobilities of a few dozen contacts that all act on each other.
//!
//! Source: Golub, Van Loan, "Matrix Computations", outer product form with row interchanges (unverified page).
//! Cost: n³/3 products for the factors, n² for a solution.

/// A square matrix, row by row, that is replaced by its factors.
#[derive(Debug, Clone, Default)]
pub struct DenseLu {
    size: usize,
    entries: Vec<f64>,
    /// Row that was exchanged with each row.
    exchanged: Vec<usize>,
}

impl DenseLu {
    /// The zero matrix of this size; keeps the allocated memory.
    pub fn clear(&mut self, size: usize) {
        self.size = size;
        self.entries.clear();
        self.entries.resize(size * size, 0.0);
        self.exchanged.clear();
        self.exchanged.resize(size, 0);
    }

    /// A row of the matrix, before it is factored.
    pub fn row_mut(&mut self, row: usize) -> &mut [f64] {
        &mut self.entries[row * self.size..(row + 1) * self.size]
    }

    /// Replaces the matrix by its factors; returns whether it has an inverse.
    pub fn factor(&mut self) -> bool {
        let n = self.size;
        for k in 0..n {
            let pivot = (k..n).fold(k, |best, row| {
                if self.entries[row * n + k].abs() > self.entries[best * n + k].abs() { row } else { best }
            });
            let size = self.entries[pivot * n + k].abs();
            if !(size > 0.0 && size.is_finite()) {
                return false;
            }
            self.exchanged[k] = pivot;
            if pivot != k {
                (0..n).for_each(|column| self.entries.swap(k * n + column, pivot * n + column));
            }
            let (above, below) = self.entries.split_at_mut((k + 1) * n);
            let leading = &above[k * n..];
            for row in below.chunks_exact_mut(n) {
                if row[k] == 0.0 {
                    continue;
                }
                let factor = row[k] / leading[k];
                row[k] = factor;
                row[k + 1..].iter_mut().zip(&leading[k + 1..]).for_each(|(x, y)| *x -= factor * y);
            }
        }
        true
    }

    /// Replaces the right side by the solution.
    pub fn solve(&self, x: &mut [f64]) {
        let n = self.size;
        for k in 0..n {
            x.swap(k, self.exchanged[k]);
        }
        for row in 0..n {
            let (done, rest) = x.split_at_mut(row);
            let sum: f64 = self.entries[row * n..row * n + row].iter().zip(&*done).map(|(a, x)| a * x).sum();
            rest[0] -= sum;
        }
        for row in (0..n).rev() {
            let (rest, done) = x.split_at_mut(row + 1);
            let sum: f64 = self.entries[row * n + row + 1..(row + 1) * n].iter().zip(&*done).map(|(a, x)| a * x).sum();
            rest[row] = (rest[row] - sum) / self.entries[row * n + row];
        }
    }
}
