//! Cardinal B-splines: those of uniform knots, of any degree up to five.
//!
//! With w_d(j) the cardinal B-splines of degree d that are not zero at position u of a knot interval, ordered by their
//! start,
//!
//!   w_d(j)  = [(u + d - j) w_{d-1}(j - 1) + (1 - u + j) w_{d-1}(j)] / d
//!   w_d'(j) = w_{d-1}(j - 1) - w_{d-1}(j)                                per knot interval
//!
//! A sum of quintic ones has four continuous derivatives. Walks and movements of `optimal` are such sums;
//! [`super::UniformSplines`] are cubic ones over samples.
//!
//! Source: de Boor 1978, "A practical guide to splines", chapters IX and X (unverified).
//! Cost: constant.
//! Pinned by: the tests below; tests/optimal.rs

/// Degree of the splines.
const DEGREE: usize = 5;
/// Number of splines that are not zero at one position.
pub const OVERLAP: usize = DEGREE + 1;

/// Value, first and second derivative of the six cardinal quintic splines that are not zero at position `u` (0 to 1) of
/// a knot interval; derivatives are by a quantity of which `rate` knot intervals make one unit.
#[must_use]
pub fn quintic_splines(u: f64, rate: f64) -> [[f64; OVERLAP]; 3] {
    let cubic = cardinal::<3>(u);
    let quartic = raised::<4>(&cubic, u);
    let quintic = raised::<5>(&quartic, u);
    let below = |w: &[f64; OVERLAP], j: usize, back: usize| if j >= back { w[j - back] } else { 0.0 };
    let mut values = [quintic, [0.0; OVERLAP], [0.0; OVERLAP]];
    for j in 0..OVERLAP {
        values[1][j] = rate * (below(&quartic, j, 1) - quartic[j]);
        values[2][j] = rate * rate * (below(&cubic, j, 2) - 2.0 * below(&cubic, j, 1) + cubic[j]);
    }
    values
}

/// w_d(0), ..., w_d(d), then zeros.
pub(super) fn cardinal<const D: usize>(u: f64) -> [f64; OVERLAP] {
    let mut w = [0.0; OVERLAP];
    w[0] = 1.0;
    for degree in 1..=D {
        w = next(&w, degree, u);
    }
    w
}

fn raised<const D: usize>(lower: &[f64; OVERLAP], u: f64) -> [f64; OVERLAP] {
    next(lower, D, u)
}

fn next(lower: &[f64; OVERLAP], degree: usize, u: f64) -> [f64; OVERLAP] {
    let d = degree as f64;
    let mut w = [0.0; OVERLAP];
    for (j, w) in w.iter_mut().enumerate().take(degree + 1) {
        let before = if j > 0 { lower[j - 1] } else { 0.0 };
        *w = ((u + d - j as f64) * before + (1.0 - u + j as f64) * lower[j]) / d;
    }
    w
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value and derivatives of a sum at a place in knot intervals, with coefficients that repeat.
    fn sum(coefficients: &[f64], place: f64) -> [f64; 3] {
        let first = place.floor();
        let values = quintic_splines(place - first, 1.0);
        let of = |j: usize| coefficients[(first as usize + j) % coefficients.len()];
        values.map(|values| values.iter().enumerate().map(|(j, w)| of(j) * w).sum())
    }

    #[test]
    fn equal_coefficients_make_a_constant() {
        for place in [0.0, 0.123, 0.5, 0.999_999, 1.0, 7.25] {
            let [value, slope, curvature] = sum(&[2.5; 9], place);
            assert!((value - 2.5).abs() < 1e-13 && slope.abs() < 1e-13 && curvature.abs() < 1e-13, "at {place}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_value_also_across_knots() {
        let coefficients: Vec<f64> = (0..11).map(|k| (1.7 * f64::from(k)).sin()).collect();
        let h = 1e-4;
        for k in 1..200 {
            let place = 0.05 * f64::from(k);
            let [before, at, after] = [place - h, place, place + h].map(|place| sum(&coefficients, place));
            // Errors of differences: h² and h² times derivatives of the order of 1, rounding 1e-16 / h and 1e-16 / h².
            assert!(((after[0] - before[0]) / (2.0 * h) - at[1]).abs() < 1e-7, "slope at {place}");
            assert!(((after[1] - before[1]) / (2.0 * h) - at[2]).abs() < 1e-7, "curvature at {place}");
        }
    }
}
