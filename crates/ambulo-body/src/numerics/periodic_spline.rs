//! Periodic quintic B-splines on uniform knots.
//!
//! With w_d(j) the cardinal B-splines of degree d that are not zero at position u of a knot interval, ordered by their start,
//!
//!   w_d(j)  = [(u + d - j) w_{d-1}(j - 1) + (1 - u + j) w_{d-1}(j)] / d
//!   w_d'(j) = w_{d-1}(j - 1) - w_{d-1}(j)                                per knot interval
//!
//! A sum of them has four continuous derivatives; it is periodic because the knots form a ring.
//!
//! Source: de Boor 1978, "A practical guide to splines", chapters IX and X (unverified).
//! Cost: constant.

/// Degree of the splines.
const DEGREE: usize = 5;
/// Number of splines that are not zero at one position.
pub const OVERLAP: usize = DEGREE + 1;

/// Splines over one period, numbered 0 to `count` - 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PeriodicSplines {
    count: usize,
}

/// The splines that are not zero at one position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SplineValues {
    /// Indices of the splines.
    pub numbers: [usize; OVERLAP],
    /// Value, first and second derivative with respect to the phase (0 to 1 per period).
    pub values: [[f64; OVERLAP]; 3],
}

impl PeriodicSplines {
    /// `count` splines per period, at least one more than overlap at one position, so that each index occurs once.
    #[must_use]
    pub fn new(count: usize) -> PeriodicSplines {
        PeriodicSplines { count: count.max(OVERLAP) }
    }

    /// Number of splines.
    #[inline]
    #[must_use]
    pub fn count(self) -> usize {
        self.count
    }

    /// The splines at a phase, whose integer part is ignored.
    #[inline]
    #[must_use]
    pub fn at(self, phase: f64) -> SplineValues {
        let rate = self.count as f64;
        let place = (phase - phase.floor()) * rate;
        let interval = place.floor();
        let values = quintic_splines(place - interval, rate);
        // A phase just below a whole number may round up to the end of the ring.
        let first = interval as usize + self.count - DEGREE;
        SplineValues { numbers: std::array::from_fn(|j| (first + j) % self.count), values }
    }
}

/// Value, first and second derivative of the six cardinal quintic splines that are not zero at position `u` (0 to 1) of a knot
/// interval; derivatives are by a quantity of which `rate` knot intervals make one unit.
#[inline]
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

#[inline]
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

    fn sum(coefficients: &[f64], phase: f64) -> [f64; 3] {
        let at = PeriodicSplines::new(coefficients.len()).at(phase);
        std::array::from_fn(|d| at.numbers.iter().zip(at.values[d]).map(|(&n, w)| coefficients[n] * w).sum())
    }

    #[test]
    fn equal_coefficients_make_a_constant() {
        for phase in [0.0, 0.123, 0.5, 0.999_999, 1.0, -0.3, 7.25] {
            let [value, slope, curvature] = sum(&[2.5; 9], phase);
            assert!((value - 2.5).abs() < 1e-13 && slope.abs() < 1e-12 && curvature.abs() < 1e-10, "at {phase}");
        }
    }

    #[test]
    fn derivatives_are_those_of_the_value() {
        let coefficients: Vec<f64> = (0..11).map(|k| (1.7 * f64::from(k)).sin()).collect();
        let h = 1e-5;
        for k in 0..200 {
            let phase = 0.005 * f64::from(k) + 0.0013;
            let [before, at, after] = [phase - h, phase, phase + h].map(|p| sum(&coefficients, p));
            assert!(((after[0] - before[0]) / (2.0 * h) - at[1]).abs() < 1e-5, "slope at {phase}");
            assert!(((after[1] - before[1]) / (2.0 * h) - at[2]).abs() < 1e-3, "curvature at {phase}");
        }
    }

    #[test]
    fn the_ring_closes() {
        let coefficients: Vec<f64> = (0..8).map(|k| f64::from(k * k % 5)).collect();
        let (end, start) = (sum(&coefficients, 1.0 - 1e-12), sum(&coefficients, 0.0));
        for d in 0..3 {
            assert!((end[d] - start[d]).abs() < 1e-6, "derivative {d}: {} and {}", end[d], start[d]);
        }
    }
}
