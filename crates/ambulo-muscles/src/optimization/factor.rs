//! A symmetric positive definite matrix and its factors L D Lᵀ; zeros at the beginning of a row are left out.

/// A pivot below this share of its row's scale is replaced.
const LEAST_PIVOT: f64 = 1e-13;
/// What replaces it, as a share of the scale.
const REPLACED: f64 = 1e-6;

/// Lower half of the matrix, row by row, replaced by its factors.
#[derive(Debug, Clone)]
pub(super) struct Factor {
    size: usize,
    entries: Vec<f64>,
    /// First column of each row that is not zero.
    first: Vec<usize>,
}

impl Factor {
    pub(super) fn new(size: usize) -> Factor {
        Factor { size, entries: vec![0.0; size * size], first: (0..size).collect() }
    }

    pub(super) fn clear(&mut self) {
        self.entries.fill(0.0);
        self.first.iter_mut().enumerate().for_each(|(row, first)| *first = row);
    }

    /// Adds to an entry and its mirror image.
    #[inline]
    pub(super) fn add(&mut self, a: usize, b: usize, value: f64) {
        let (row, column) = (a.max(b), a.min(b));
        self.entries[row * self.size + column] += value;
        self.first[row] = self.first[row].min(column);
    }

    /// Replaces the matrix by its factors. A pivot that is too small for the scale of its row is replaced, so that the
    /// product stays positive definite.
    pub(super) fn factor(&mut self, scale: &[f64]) {
        let n = self.size;
        for row in 0..n {
            let (done, rest) = self.entries.split_at_mut(row * n);
            let own = &mut rest[..=row];
            let first = self.first[row];
            for column in first..row {
                let from = first.max(self.first[column]);
                let other = &done[column * n..column * n + column];
                // own[k] still holds L_k D_k here.
                let sum: f64 = own[from..column].iter().zip(&other[from..]).map(|(a, b)| a * b).sum();
                own[column] -= sum;
            }
            let mut pivot = own[row];
            for column in first..row {
                let scaled = own[column];
                own[column] = scaled / done[column * n + column];
                pivot -= scaled * own[column];
            }
            let scale = scale[row].max(f64::MIN_POSITIVE);
            own[row] = if pivot > LEAST_PIVOT * scale { pivot } else { REPLACED * scale };
        }
    }

    /// Replaces the right side by the solution.
    pub(super) fn solve(&self, x: &mut [f64]) {
        let n = self.size;
        for row in 0..n {
            let first = self.first[row];
            let own = &self.entries[row * n + first..row * n + row];
            let sum: f64 = own.iter().zip(&x[first..row]).map(|(a, b)| a * b).sum();
            x[row] -= sum;
        }
        for row in 0..n {
            x[row] /= self.entries[row * n + row];
        }
        for row in (0..n).rev() {
            let first = self.first[row];
            let value = x[row];
            let own = &self.entries[row * n + first..row * n + row];
            own.iter().zip(&mut x[first..row]).for_each(|(a, b)| *b -= a * value);
        }
    }
}
