//! Cardinal B-splines: B-splines on uniform knots, of any degree up to five.
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
//! Pinned by: tests/numerics_cardinal_spline.rs, tests/optimal.rs

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
