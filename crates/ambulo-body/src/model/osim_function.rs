//! Functions of documents as functions of the model, and back.

use super::{Function, Knots, SimmSpline};
use crate::numerics::{Smoothing, SplineDegree, SplineFitter};
use ambulo_formats::osim::OsimFunction;

/// The function of a document, or why it is not valid.
///
/// # Errors
/// Knots that do not increase, or too few of them.
pub fn read(function: &OsimFunction) -> Result<Function, String> {
    let points = |knots: &ambulo_formats::osim::Knots| {
        Knots::new(knots.x.clone(), knots.y.clone())
            .ok_or_else(|| "the abscissae of its knots do not increase".to_owned())
    };
    Ok(match function {
        OsimFunction::Constant(value) => Function::Constant(*value),
        OsimFunction::Linear { slope, intercept } => Function::Linear { slope: *slope, intercept: *intercept },
        OsimFunction::Polynomial(coefficients) => Function::Polynomial(coefficients.clone()),
        OsimFunction::SimmSpline(knots) => {
            Function::SimmSpline(SimmSpline::new(points(knots)?).ok_or_else(|| "a spline needs two points".to_owned())?)
        }
        OsimFunction::PiecewiseLinear(knots) => Function::PiecewiseLinear(points(knots)?),
        OsimFunction::PiecewiseConstant(knots) => Function::PiecewiseConstant(points(knots)?),
        OsimFunction::Step { start, end } => Function::Step { start: *start, end: *end },
        OsimFunction::Sine { amplitude, omega, phase, offset } => {
            Function::Sine { amplitude: *amplitude, omega: *omega, phase: *phase, offset: *offset }
        }
        OsimFunction::Multiplier { scale, function } => Function::Scaled(*scale, Box::new(read(function)?)),
        OsimFunction::GcvSpline { degree, knots, error_variance } => {
            let smoothing =
                if *error_variance > 0.0 { Smoothing::ErrorVariance(*error_variance) } else { Smoothing::Interpolate };
            let degree = match degree {
                1 => SplineDegree::Linear,
                3 => SplineDegree::Cubic,
                7 => SplineDegree::Heptic,
                _ => SplineDegree::Quintic,
            };
            let fitter = SplineFitter::new(degree, &knots.x).map_err(|e| e.to_string())?;
            Function::NaturalSpline(fitter.fit(&knots.y, smoothing).map_err(|e| e.to_string())?)
        }
    })
}

/// The function of a document that reads back to this one.
#[must_use]
pub fn write(curve: &Function) -> OsimFunction {
    match curve {
        Function::Constant(value) => OsimFunction::Constant(*value),
        Function::Linear { slope, intercept } => OsimFunction::Linear { slope: *slope, intercept: *intercept },
        Function::Polynomial(coefficients) => OsimFunction::Polynomial(coefficients.clone()),
        Function::SimmSpline(spline) => OsimFunction::SimmSpline(points(spline.knots())),
        // A smoothing spline is the interpolating spline of its degree through its fitted values.
        Function::NaturalSpline(spline) => OsimFunction::GcvSpline {
            degree: spline.degree(),
            knots: ambulo_formats::osim::Knots { x: spline.times().to_vec(), y: spline.fitted_values().collect() },
            error_variance: 0.0,
        },
        Function::PiecewiseLinear(knots) => OsimFunction::PiecewiseLinear(points(knots)),
        Function::PiecewiseConstant(knots) => OsimFunction::PiecewiseConstant(points(knots)),
        Function::Step { start, end } => OsimFunction::Step { start: *start, end: *end },
        Function::Sine { amplitude, omega, phase, offset } => {
            OsimFunction::Sine { amplitude: *amplitude, omega: *omega, phase: *phase, offset: *offset }
        }
        Function::Scaled(scale, curve) => OsimFunction::Multiplier { scale: *scale, function: Box::new(write(curve)) },
    }
}

fn points(knots: &Knots) -> ambulo_formats::osim::Knots {
    ambulo_formats::osim::Knots { x: knots.x().to_vec(), y: knots.y().to_vec() }
}
