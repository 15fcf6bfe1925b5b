//! Dense Cholesky factors of small symmetric matrices, in place and without allocation.

/// Replaces the lower half of `a` (rows of `n`) by L of A = L Lᵀ; false if a pivot is not positive.
pub(super) fn factor(a: &mut [f64], n: usize) -> bool {
    for i in 0..n {
        let (above, row) = a.split_at_mut(i * n);
        for j in 0..i {
            let other = &above[j * n..j * n + j + 1];
            let sum: f64 = row[..j].iter().zip(other).map(|(x, y)| x * y).sum();
            row[j] = (row[j] - sum) / other[j];
        }
        let square: f64 = row[..i].iter().map(|x| x * x).sum();
        let pivot = row[i] - square;
        if !(pivot > 0.0 && pivot.is_finite()) {
            return false;
        }
        row[i] = pivot.sqrt();
    }
    true
}

/// Solves L Lᵀ x = b in place.
pub(super) fn solve(l: &[f64], n: usize, x: &mut [f64]) {
    for i in 0..n {
        let known: f64 = l[i * n..i * n + i].iter().zip(x.iter()).map(|(a, b)| a * b).sum();
        x[i] = (x[i] - known) / l[i * n + i];
    }
    for i in (0..n).rev() {
        x[i] /= l[i * n + i];
        let value = x[i];
        for (x, a) in x[..i].iter_mut().zip(&l[i * n..i * n + i]) {
            *x -= a * value;
        }
    }
}

/// The diagonal of (L Lᵀ)⁻¹; `scratch` holds n numbers.
pub(super) fn inverse_diagonal(l: &[f64], n: usize, scratch: &mut [f64], diagonal: &mut [f64]) {
    for k in 0..n {
        // Entry k of A⁻¹ eₖ is |L⁻¹ eₖ|².
        scratch.fill(0.0);
        scratch[k] = 1.0;
        let mut square = 0.0;
        for i in k..n {
            let known: f64 = l[i * n + k..i * n + i].iter().zip(&scratch[k..i]).map(|(a, b)| a * b).sum();
            scratch[i] = (scratch[i] - known) / l[i * n + i];
            square += scratch[i] * scratch[i];
        }
        diagonal[k] = square;
    }
}
