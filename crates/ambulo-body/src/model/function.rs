//! Functions of one variable with two derivatives, which relate the axes of a joint to its coordinates.

use super::knots::Knots;
use super::simm_spline::SimmSpline;
use crate::numerics::NaturalSpline;
use crate::numerics::elementary::sin_cos;

/// y = f(x), with dy/dx and d²y/dx².
#[derive(Debug, Clone, PartialEq)]
pub enum Function {
    /// y = value.
    Constant(f64),
    /// y = slope x + intercept.
    Linear {
        /// Slope.
        slope: f64,
        /// Value at zero.
        intercept: f64,
    },
    /// Polynomial, highest power first.
    Polynomial(Vec<f64>),
    /// Cubic spline of the SIMM program, OpenSim's `SimmSpline`.
    SimmSpline(SimmSpline),
    /// Natural spline of odd degree, interpolating or smoothing.
    NaturalSpline(NaturalSpline),
    /// Straight lines between knots, continued beyond the ends (as OpenSim's
    /// `PiecewiseLinearFunction`).
    PiecewiseLinear(Knots),
    /// The ordinate of the last knot at or before x; before all knots, the ordinate of the first one.
    PiecewiseConstant(Knots),
    /// A smooth step between two levels (quintic, with zero slope and curvature at both ends).
    Step {
        /// Abscissa and ordinate at the beginning of the step.
        start: (f64, f64),
        /// Abscissa and ordinate at the end of the step.
        end: (f64, f64),
    },
    /// y = amplitude sin(omega x + phase) + offset.
    Sine {
        /// Amplitude.
        amplitude: f64,
        /// Angular frequency.
        omega: f64,
        /// Phase [rad].
        phase: f64,
        /// Mean.
        offset: f64,
    },
    /// Another function times a factor.
    Scaled(f64, Box<Function>),
}

impl Function {
    /// y, dy/dx and d²y/dx² at x.
    #[must_use]
    pub fn at(&self, x: f64) -> [f64; 3] {
        match self {
            Function::Constant(value) => [*value, 0.0, 0.0],
            Function::Linear { slope, intercept } => [slope * x + intercept, *slope, 0.0],
            Function::Polynomial(coefficients) => polynomial(coefficients, x),
            Function::SimmSpline(spline) => spline.at(x),
            Function::NaturalSpline(spline) => spline.value_and_two_derivatives(x),
            Function::PiecewiseLinear(knots) => piecewise_linear(knots, x),
            Function::PiecewiseConstant(knots) => [knots.y()[knots.before(x)], 0.0, 0.0],
            Function::Step { start, end } => step(*start, *end, x),
            Function::Sine { amplitude, omega, phase, offset } => {
                let (s, c) = sin_cos(omega * x + phase);
                [amplitude * s + offset, amplitude * omega * c, -amplitude * omega * omega * s]
            }
            Function::Scaled(scale, function) => function.at(x).map(|y| scale * y),
        }
    }

    /// The value of a constant function; `None` if it depends on x.
    #[inline]
    #[must_use]
    pub fn as_constant(&self) -> Option<f64> {
        match self {
            Function::Constant(value) => Some(*value),
            Function::Scaled(scale, function) => function.as_constant().map(|value| scale * value),
            _ => None,
        }
    }

    /// Slope and intercept of a straight line; `None` for a constant or a curve.
    #[inline]
    #[must_use]
    pub fn as_linear(&self) -> Option<(f64, f64)> {
        match self {
            Function::Linear { slope, intercept } => Some((*slope, *intercept)),
            Function::Scaled(scale, function) => function.as_linear().map(|(a, b)| (scale * a, scale * b)),
            _ => None,
        }
    }
}

/// Horner's scheme for a polynomial and its first two derivatives.
fn polynomial(coefficients: &[f64], x: f64) -> [f64; 3] {
    let (mut y, mut dy, mut half_ddy) = (0.0, 0.0, 0.0);
    for c in coefficients {
        half_ddy = half_ddy * x + dy;
        dy = dy * x + y;
        y = y * x + c;
    }
    [y, dy, 2.0 * half_ddy]
}

fn piecewise_linear(knots: &Knots, x: f64) -> [f64; 3] {
    let (xs, ys) = (knots.x(), knots.y());
    if xs.len() == 1 {
        return [ys[0], 0.0, 0.0];
    }
    let i = knots.before(x).min(xs.len() - 2);
    let slope = (ys[i + 1] - ys[i]) / (xs[i + 1] - xs[i]);
    [ys[i] + slope * (x - xs[i]), slope, 0.0]
}

/// 10 u³ - 15 u⁴ + 6 u⁵ between the two levels, u from 0 to 1.
fn step((x0, y0): (f64, f64), (x1, y1): (f64, f64), x: f64) -> [f64; 3] {
    let (width, height) = (x1 - x0, y1 - y0);
    let u = (x - x0) / width;
    if u <= 0.0 {
        return [y0, 0.0, 0.0];
    }
    if u >= 1.0 {
        return [y1, 0.0, 0.0];
    }
    let s = u * u * u * (10.0 + u * (6.0 * u - 15.0));
    let ds = 30.0 * u * u * (1.0 - u) * (1.0 - u);
    let dds = 60.0 * u * (1.0 - u) * (1.0 - 2.0 * u);
    [y0 + height * s, height * ds / width, height * dds / (width * width)]
}
