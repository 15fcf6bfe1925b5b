//! Smooth curves from quintic Bézier pieces, each a rounded corner between two straight lines.
//!
//! A piece joins two points with given slopes. The lines through them meet in a corner C. With the curviness c,
//!
//!   m₀ = p₀ + c (C - p₀),   m₁ = p₁ + c (C - p₁),   control points p₀ m₀ m₀ m₁ m₁ p₁
//!
//! so that slope and curvature match the lines at both ends. Written in powers of u the coefficients are p₀,
//! 5 (m₀ - p₀), 10 (p₀ - m₀), 10 (m₁ - p₀), 5 (p₀ + 2 m₀ - 3 m₁) and p₁ + 5 m₁ - 5 m₀ - p₀. x(u) = x is solved by
//! Newton's method from a table; x grows with u, so a root outside the bracket is replaced by its middle. Beyond both
//! ends the curve is straight.
//!
//! Source: Millard, Uchida, Seth, Delp 2013, "Flexing computational muscle" (unverified page), as computed in OpenSim
//! (OpenSim/Common/SegmentedQuinticBezierToolkit.cpp, `calcQuinticBezierCornerControlPoints`).
//! Pinned by: tests/curves.rs

/// Slopes that differ by less than this are parallel: the square root of the machine's precision, as in OpenSim.
const PARALLEL: f64 = 1.490_116_119_384_765_6e-8;
/// Newton's method ends when x is met to this share of the width of the piece.
const CLOSE: f64 = 4e-16;
/// A quintic on a table of `STARTS` needs two or three steps.
const MOST_STEPS: usize = 40;
/// Intervals of the table of starts.
const STARTS: usize = 16;

/// Why parameters give no curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveError {
    /// A parameter outside its range.
    #[error("the curve parameter `{name}` is {found}; expected {expected}")]
    Parameter {
        /// Its name in OpenSim.
        name: &'static str,
        /// Found value.
        found: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// A piece that would bend twice.
    #[error("the {curve} curve bends twice between {from} and {to}; expected parameters that give a single bend")]
    Bend {
        /// The curve.
        curve: &'static str,
        /// Abscissa at which the piece begins.
        from: f64,
        /// Abscissa at which it ends.
        to: f64,
    },
}

/// A point of a curve and its slope there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Knot {
    pub(crate) x: f64,
    pub(crate) y: f64,
    pub(crate) slope: f64,
}

/// A smooth curve, straight beyond its ends.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Curve {
    pieces: Vec<Piece>,
    ends: [Knot; 2],
}

/// One rounded corner, as polynomials of u in 0 to 1.
#[derive(Debug, Clone, PartialEq)]
struct Piece {
    x: [f64; 6],
    y: [f64; 6],
    /// Last abscissa.
    end: f64,
    width: f64,
    /// u at abscissas that divide the piece into equal parts.
    starts: [f64; STARTS + 1],
}

impl Curve {
    /// The curve through knots; between two knots it bends with the curviness (0 to 1) of the first one.
    pub(crate) fn new(name: &'static str, knots: &[Knot], curviness: &[f64]) -> Result<Curve, CurveError> {
        let mut pieces = Vec::with_capacity(knots.len());
        for (pair, curviness) in knots.windows(2).zip(curviness) {
            pieces.push(Piece::new(name, [pair[0], pair[1]], 0.1 + 0.8 * curviness)?);
        }
        Ok(Curve { pieces, ends: [knots[0], knots[knots.len() - 1]] })
    }

    /// First abscissa of the bent part.
    pub(crate) fn start(&self) -> f64 {
        self.ends[0].x
    }

    /// The ordinate at an abscissa.
    #[inline]
    #[must_use]
    pub(crate) fn at(&self, x: f64) -> f64 {
        self.with_slope(x)[0]
    }

    /// Ordinate and slope at an abscissa.
    #[must_use]
    pub(crate) fn with_slope(&self, x: f64) -> [f64; 2] {
        for (end, is_beyond) in self.ends.iter().zip([x < self.ends[0].x, x > self.ends[1].x]) {
            if is_beyond {
                return [end.y + end.slope * (x - end.x), end.slope];
            }
        }
        let last = &self.pieces[self.pieces.len() - 1];
        self.pieces.iter().find(|piece| x <= piece.end).unwrap_or(last).at(x)
    }
}

impl Piece {
    fn new(curve: &'static str, [p0, p1]: [Knot; 2], c: f64) -> Result<Piece, CurveError> {
        let slopes = p0.slope - p1.slope;
        let x = match slopes.abs() > PARALLEL {
            true => (p1.y - p0.y - p1.x * p1.slope + p0.x * p0.slope) / slopes,
            false => 0.5 * (p0.x + p1.x),
        };
        let y = (x - p1.x) * p1.slope + p1.y;
        let square = |dx: f64, dy: f64| dx * dx + dy * dy;
        let across = square(p1.x - p0.x, p1.y - p0.y);
        if !(across > square(x - p0.x, y - p0.y) && across > square(x - p1.x, y - p1.y) && p1.x > p0.x) {
            return Err(CurveError::Bend { curve, from: p0.x, to: p1.x });
        }
        let mut piece = Piece {
            x: powers([p0.x, p0.x + c * (x - p0.x), p1.x + c * (x - p1.x), p1.x]),
            y: powers([p0.y, p0.y + c * (y - p0.y), p1.y + c * (y - p1.y), p1.y]),
            end: p1.x,
            width: p1.x - p0.x,
            starts: [0.0; STARTS + 1],
        };
        for i in 0..=STARTS {
            let share = i as f64 / STARTS as f64;
            piece.starts[i] = piece.root(p0.x + share * piece.width, share);
        }
        Ok(piece)
    }

    fn at(&self, x: f64) -> [f64; 2] {
        let place = ((x - self.x[0]) / self.width * STARTS as f64).clamp(0.0, STARTS as f64);
        let i = (place as usize).min(STARTS - 1);
        let start = self.starts[i] + (place - i as f64) * (self.starts[i + 1] - self.starts[i]);
        let u = self.root(x, start);
        let [y, dy] = polynomial(&self.y, u);
        let [_, dx] = polynomial(&self.x, u);
        [y, dy / dx]
    }

    /// u at which the piece has an abscissa.
    fn root(&self, x: f64, start: f64) -> f64 {
        let (mut low, mut high, mut u) = (0.0, 1.0, start);
        for _ in 0..MOST_STEPS {
            let [found, slope] = polynomial(&self.x, u);
            let error = found - x;
            if error.abs() <= CLOSE * self.width.max(x.abs()) {
                break;
            }
            if error > 0.0 {
                high = u;
            } else {
                low = u;
            }
            let next = u - error / slope;
            let next = if next > low && next < high { next } else { 0.5 * (low + high) };
            if next.total_cmp(&u).is_eq() {
                break;
            }
            u = next;
        }
        u
    }
}

/// Coefficients of the powers of u for the control points p₀ m₀ m₀ m₁ m₁ p₁.
fn powers([p0, m0, m1, p1]: [f64; 4]) -> [f64; 6] {
    [
        p0,
        5.0 * (m0 - p0),
        10.0 * (p0 - m0),
        10.0 * (m1 - p0),
        5.0 * (p0 + 2.0 * m0 - 3.0 * m1),
        p1 + 5.0 * m1 - 5.0 * m0 - p0,
    ]
}

/// Value and derivative.
#[inline]
fn polynomial(k: &[f64; 6], u: f64) -> [f64; 2] {
    let value = k[0] + u * (k[1] + u * (k[2] + u * (k[3] + u * (k[4] + u * k[5]))));
    let slope = k[1] + u * (2.0 * k[2] + u * (3.0 * k[3] + u * (4.0 * k[4] + u * (5.0 * k[5]))));
    [value, slope]
}
