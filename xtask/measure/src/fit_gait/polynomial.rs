//! Least squares for polynomials of a low degree, by the normal equations.

/// Coefficients c0, c1, .. of the polynomial of `degree` nearest to the points.
pub(crate) fn fit(x: &[f64], y: &[f64], degree: usize) -> Vec<f64> {
    let n = degree + 1;
    let mut rows: Vec<Vec<f64>> = (0..n)
        .map(|i| {
            let moment = |power: usize| x.iter().map(|x| x.powi(power as i32)).sum::<f64>();
            let right = x.iter().zip(y).map(|(x, y)| x.powi(i as i32) * y).sum::<f64>();
            (0..n).map(|j| moment(i + j)).chain([right]).collect()
        })
        .collect();
    for pivot in 0..n {
        let best = (pivot..n).max_by(|a, b| rows[*a][pivot].abs().total_cmp(&rows[*b][pivot].abs()));
        rows.swap(pivot, best.unwrap_or(pivot));
        for row in 0..n {
            if row != pivot {
                let factor = rows[row][pivot] / rows[pivot][pivot];
                for column in pivot..=n {
                    rows[row][column] -= factor * rows[pivot][column];
                }
            }
        }
    }
    (0..n).map(|i| rows[i][n] / rows[i][i]).collect()
}

/// The polynomial at a point.
pub(crate) fn at(coefficients: &[f64], x: f64) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * x + c)
}
