//! Functions of one coordinate in the syntax of OpenSim 4.

use super::write::{element, group, holder, numbers, unknown};
use super::{Knots, OsimFunction};
use crate::error::Error;

/// The deepest nesting that the reader accepts.
const DEEPEST: usize = super::function::DEEPEST;

/// The element of a function, indented by `depth`; without a `name` if its parent has one.
pub(super) fn function(depth: usize, name: &str, function: &OsimFunction) -> Result<String, Error> {
    nested(depth, name, function, 0)
}

fn nested(depth: usize, name: &str, function: &OsimFunction, level: usize) -> Result<String, Error> {
    if level > DEEPEST {
        return Err(unknown(
            format!("functions nested more than {DEEPEST} deep"),
            &format!("at most {DEEPEST} levels"),
        ));
    }
    let inner = depth + 1;
    let number = |tag: &str, value: f64| Ok::<_, Error>(element(inner, tag, &numbers(&[value])?));
    let (tag, content) = match function {
        OsimFunction::Constant(value) => ("Constant", number("value", *value)?),
        OsimFunction::Linear { slope, intercept } => {
            ("LinearFunction", element(inner, "coefficients", &numbers(&[*slope, *intercept])?))
        }
        OsimFunction::Polynomial(coefficients) => {
            ("PolynomialFunction", element(inner, "coefficients", &numbers(coefficients)?))
        }
        OsimFunction::SimmSpline(knots) => ("SimmSpline", points(inner, knots)?),
        OsimFunction::GcvSpline { degree, knots, error_variance } => {
            let half_order = element(inner, "half_order", &degree.div_ceil(2).to_string());
            ("GCVSpline", half_order + &number("error_variance", *error_variance)? + &points(inner, knots)?)
        }
        OsimFunction::PiecewiseLinear(knots) => ("PiecewiseLinearFunction", points(inner, knots)?),
        OsimFunction::PiecewiseConstant(knots) => ("PiecewiseConstantFunction", points(inner, knots)?),
        OsimFunction::Step { start, end } => {
            let from = number("start_time", start.0)? + &number("end_time", end.0)?;
            ("StepFunction", from + &number("start_value", start.1)? + &number("end_value", end.1)?)
        }
        OsimFunction::Sine { amplitude, omega, phase, offset } => {
            let wave = number("amplitude", *amplitude)? + &number("omega", *omega)? + &number("phase", *phase)?;
            ("Sine", wave + &number("offset", *offset)?)
        }
        OsimFunction::Multiplier { scale, function } => {
            let scaled = group(inner, "function", &nested(inner + 1, "", function, level + 1)?);
            ("MultiplierFunction", scaled + &number("scale", *scale)?)
        }
    };
    Ok(if name.is_empty() { group(depth, tag, &content) } else { holder(depth, tag, name, &content) })
}

fn points(depth: usize, knots: &Knots) -> Result<String, Error> {
    Ok(element(depth, "x", &numbers(&knots.x)?) + &element(depth, "y", &numbers(&knots.y)?))
}
