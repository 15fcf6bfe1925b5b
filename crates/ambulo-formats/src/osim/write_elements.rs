//! Elements that parts of an OpenSim document share: numbers, frames, functions, groups.

use super::function::DEEPEST;
use super::{Knots, OsimFrame, OsimFunction};
use crate::error::Error;
use crate::xml::escaped;

pub(super) fn unknown(found: String, expected: &str) -> Error {
    Error::Record { found, expected: expected.to_owned() }
}

pub(super) fn numbers(values: &[f64]) -> Result<String, Error> {
    if let Some(odd) = values.iter().find(|value| !value.is_finite()) {
        return Err(unknown(odd.to_string(), "finite numbers"));
    }
    Ok(values.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "))
}

pub(super) fn element(depth: usize, tag: &str, text: &str) -> String {
    format!("{}<{tag}>{}</{tag}>\n", "\t".repeat(depth), escaped(text))
}

/// Writes a named element around others.
pub(super) fn holder(depth: usize, tag: &str, name: &str, content: &str) -> String {
    let indent = "\t".repeat(depth);
    format!("{indent}<{tag} name=\"{}\">\n{content}{indent}</{tag}>\n", escaped(name))
}

pub(super) fn group(depth: usize, tag: &str, content: &str) -> String {
    let indent = "\t".repeat(depth);
    format!("{indent}<{tag}>\n{content}{indent}</{tag}>\n")
}

pub(super) fn path(body: &str) -> String {
    if super::is_ground(body) { "/ground".to_owned() } else { format!("/bodyset/{body}") }
}

pub(super) fn frame(name: &str, frame: &OsimFrame) -> Result<String, Error> {
    let content = element(7, "socket_parent", &path(&frame.body))
        + &element(7, "translation", &numbers(&frame.translation_m)?)
        + &element(7, "orientation", &numbers(&angles(&frame.rotation))?);
    Ok(holder(6, "PhysicalOffsetFrame", name, &content))
}

/// Body-fixed X-Y-Z angles of a rotation, R = Rx(a) Ry(b) Rz(c) [rad].
pub(super) fn angles(r: &[[f64; 3]; 3]) -> [f64; 3] {
    // Turns -0 into 0, which is different as text.
    let plain = |angle: f64| angle + 0.0;
    let b = libm::asin(r[0][2].clamp(-1.0, 1.0));
    [plain(libm::atan2(-r[1][2], r[2][2])), plain(b), plain(libm::atan2(-r[0][1], r[0][0]))]
}

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
            let from = number("transition_start_time", start.0)? + &number("transition_end_time", end.0)?;
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
