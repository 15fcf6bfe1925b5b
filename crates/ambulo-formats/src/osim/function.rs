//! Functions of one coordinate, in `TransformAxis`, coupler and prescribed-motion elements.

use crate::error::Error;
use crate::xml;
use roxmltree::Node;

/// A function of one variable, as in the document.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimFunction {
    /// `y = value`.
    Constant(f64),
    /// `y = slope x + intercept`.
    Linear {
        /// Slope.
        slope: f64,
        /// Value at zero.
        intercept: f64,
    },
    /// Polynomial, highest power first.
    Polynomial(Vec<f64>),
    /// Cubic spline of the SIMM program (also under its old name `NaturalCubicSpline`).
    SimmSpline(Knots),
    /// Woltring's natural spline of odd degree through (or, with an error variance, near) the points.
    GcvSpline {
        /// Degree 1, 3, 5 or 7.
        degree: usize,
        /// Points.
        knots: Knots,
        /// Error variance of the points; zero or less means interpolation.
        error_variance: f64,
    },
    /// Linear interpolation between the points.
    PiecewiseLinear(Knots),
    /// Piecewise constant, with steps at the points.
    PiecewiseConstant(Knots),
    /// A smooth step from `start.1` at `start.0` to `end.1` at `end.0`.
    Step {
        /// Abscissa and value where the step begins.
        start: (f64, f64),
        /// Abscissa and value where the step ends.
        end: (f64, f64),
    },
    /// `y = amplitude sin(omega x + phase) + offset`.
    Sine {
        /// Amplitude.
        amplitude: f64,
        /// Angular frequency.
        omega: f64,
        /// Phase [rad].
        phase: f64,
        /// Mean value.
        offset: f64,
    },
    /// A function multiplied by a factor.
    Multiplier {
        /// Factor.
        scale: f64,
        /// The function that is scaled.
        function: Box<OsimFunction>,
    },
}

/// Points of a function: rising abscissae and as many ordinates.
#[derive(Debug, Clone, PartialEq)]
pub struct Knots {
    /// Abscissae, strictly rising.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
}

const KNOWN: &str = "Constant, LinearFunction, PolynomialFunction, SimmSpline, NaturalCubicSpline, GCVSpline, \
                     PiecewiseLinearFunction, PiecewiseConstantFunction, StepFunction, Sine or MultiplierFunction";

/// Deepest nesting of functions that scale functions.
pub(super) const DEEPEST: usize = 32;

/// The function of a component: a direct child, under `<function>`, or as `<... name="function">`. `None` if there is
/// none.
pub(super) fn held_by(node: Node<'_, '_>) -> Result<Option<OsimFunction>, Error> {
    held_at_depth(node, 0)
}

fn held_at_depth(node: Node<'_, '_>, depth: usize) -> Result<Option<OsimFunction>, Error> {
    if depth > DEEPEST {
        let found = format!("functions nested more than {DEEPEST} deep");
        return Err(xml::error_at(node, found, format!("at most {DEEPEST} levels")));
    }
    let holder = xml::child(node, "function").unwrap_or(node);
    let known = |n: &Node<'_, '_>| is_function_tag(n.tag_name().name());
    if let Some(function) = xml::elements(holder).find(known) {
        return read(function, depth).map(Some);
    }
    match xml::elements(holder).find(|n| !matches!(n.tag_name().name(), "coordinates" | "axis")) {
        Some(unknown) => Err(unknown_function(unknown)),
        None => Ok(None),
    }
}

/// The tag of the function of a component.
pub(super) fn tag_held_by<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    let holder = xml::child(node, "function").unwrap_or(node);
    xml::elements(holder).map(|n| n.tag_name().name()).find(|tag| is_function_tag(tag))
}

fn is_function_tag(tag: &str) -> bool {
    matches!(tag, "Constant" | "Sine" | "GCVSpline" | "SimmSpline" | "NaturalCubicSpline") || tag.ends_with("Function")
}

fn unknown_function(node: Node<'_, '_>) -> Error {
    xml::error_at(node, format!("the function type `{}`", node.tag_name().name()), KNOWN)
}

fn read(node: Node<'_, '_>, depth: usize) -> Result<OsimFunction, Error> {
    let number = |tag: &str, default: f64| Ok::<f64, Error>(xml::number(node, tag)?.unwrap_or(default));
    Ok(match node.tag_name().name() {
        "Constant" => OsimFunction::Constant(number("value", 0.0)?),
        "LinearFunction" => read_linear(node)?,
        "PolynomialFunction" => OsimFunction::Polynomial(some_numbers(node, "coefficients")?),
        "SimmSpline" | "NaturalCubicSpline" => OsimFunction::SimmSpline(knots(node, 2)?),
        "PiecewiseLinearFunction" => OsimFunction::PiecewiseLinear(knots(node, 2)?),
        "PiecewiseConstantFunction" => OsimFunction::PiecewiseConstant(knots(node, 1)?),
        "GCVSpline" => read_gcv(node)?,
        "StepFunction" => read_step(node)?,
        "Sine" => OsimFunction::Sine {
            amplitude: number("amplitude", 1.0)?,
            omega: number("omega", 1.0)?,
            phase: number("phase", 0.0)?,
            offset: number("offset", 0.0)?,
        },
        "MultiplierFunction" => {
            let function =
                held_at_depth(node, depth + 1)?.ok_or_else(|| xml::error_at(node, "no function".into(), KNOWN))?;
            OsimFunction::Multiplier { scale: number("scale", 1.0)?, function: Box::new(function) }
        }
        _ => return Err(unknown_function(node)),
    })
}

fn read_linear(node: Node<'_, '_>) -> Result<OsimFunction, Error> {
    match some_numbers(node, "coefficients")?[..] {
        [slope, intercept] => Ok(OsimFunction::Linear { slope, intercept }),
        ref other => {
            let found = format!("{} coefficients", other.len());
            Err(xml::error_at(node, found, "two coefficients: slope and intercept of one coordinate"))
        }
    }
}

fn read_step(node: Node<'_, '_>) -> Result<OsimFunction, Error> {
    let number = |tag: &str, default: f64| Ok::<f64, Error>(xml::number(node, tag)?.unwrap_or(default));
    // Documents of older versions have the second names; the defaults follow OpenSim 4.6.
    let time = |tag: &str, older: &str, default: f64| {
        Ok::<f64, Error>(xml::number(node, tag)?.unwrap_or(number(older, default)?))
    };
    let start = (time("transition_start_time", "start_time", 0.99)?, number("start_value", 0.0)?);
    let end = (time("transition_end_time", "end_time", 1.01)?, number("end_value", 1.0)?);
    if start.0 >= end.0 {
        let found = format!("a step from {} to {}", start.0, end.0);
        return Err(xml::error_at(node, found, "an end of the transition after its start"));
    }
    Ok(OsimFunction::Step { start, end })
}

fn read_gcv(node: Node<'_, '_>) -> Result<OsimFunction, Error> {
    let stated = xml::number(node, "half_order")?;
    let degree = match stated {
        Some(half_order) => 2.0 * half_order - 1.0,
        None => xml::number(node, "degree")?.unwrap_or(5.0),
    };
    let Some(&degree) = [1, 3, 5, 7].iter().find(|d| (f64::from(**d) - degree).abs() < 0.5) else {
        return Err(xml::error_at(node, format!("degree {degree}"), "degree 1, 3, 5 or 7 (half order 1 to 4)"));
    };
    let degree = usize::try_from(degree).unwrap_or(5);
    let error_variance = xml::number(node, "error_variance")?.unwrap_or(0.0);
    Ok(OsimFunction::GcvSpline { degree, knots: knots(node, degree + 1)?, error_variance })
}

fn some_numbers(node: Node<'_, '_>, tag: &str) -> Result<Vec<f64>, Error> {
    let values = xml::numbers(node, tag)?.unwrap_or_default();
    if values.is_empty() {
        return Err(xml::error_at(node, format!("no numbers in <{tag}>"), "at least one number"));
    }
    Ok(values)
}

fn knots(node: Node<'_, '_>, at_least: usize) -> Result<Knots, Error> {
    let (x, y) = (some_numbers(node, "x")?, some_numbers(node, "y")?);
    if x.len() != y.len() || x.len() < at_least {
        let found = format!("{} numbers in <x> and {} in <y>", x.len(), y.len());
        return Err(xml::error_at(node, found, format!("as many in both, at least {at_least}")));
    }
    if let Some(i) = x.windows(2).position(|w| w[0] >= w[1]) {
        let found = format!("x = {} followed by {}", x[i], x[i + 1]);
        return Err(xml::error_at(node, found, "strictly rising <x>"));
    }
    Ok(Knots { x, y })
}
