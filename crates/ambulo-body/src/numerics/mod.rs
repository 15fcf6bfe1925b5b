//! Numerical methods: natural splines and their banded solver, B-splines on uniform knots, band matrices, nonlinear
//! least squares, evolution strategies, random numbers, statistics, harmonics. No mechanics here.
//!
//! [`SplineFitter`] is prepared once for a time grid and then fits any number of columns; each fit is a
//! [`NaturalSpline`], which gives values and derivatives at any time.
//!
//! docs/METHODS.md lists the use of each spline, filter and linear system.

mod band_cholesky;
mod banded;
mod cardinal_spline;
mod cma;
mod counted;
pub(crate) mod dense;
pub mod elementary;
mod harmonics;
mod least_squares;
mod matrix_product;
mod natural_spline;
mod order;
mod profile_cholesky;
mod random;
mod shown;
pub(crate) mod sin_cos;
mod spline_fitter;
mod spline_grid;
mod statistics;
mod uniform_spline;
mod whittaker;

use serde::Deserialize;

pub use band_cholesky::{BandFactor, BandMatrix};
pub use cardinal_spline::{OVERLAP, quintic_splines};
pub use cma::Cma;
pub use counted::{counted, degrees};
#[doc(hidden)]
pub use dense::DenseLu;
pub use harmonics::Harmonics;
#[doc(hidden)]
pub use least_squares::Residuals;
pub use least_squares::{NormalEquations, Progress, minimise};
#[doc(hidden)]
pub use matrix_product::product;
#[doc(hidden)]
pub use natural_spline::SplineError;
pub use natural_spline::{NaturalSpline, SplineDegree};
pub use order::{Order, sampled, sort_numbers};
pub use profile_cholesky::{ProfileFactor, ProfileMatrix};
pub use random::Random;
#[doc(hidden)]
pub use shown::Shown;
pub use spline_fitter::{Smoothing, SplineFitter};
pub use statistics::{correlation, extremes, finite_mean, mean, median, quantiles, range, rms, sample_deviation};
pub use uniform_spline::SPLINES_AT_ONCE;
#[doc(hidden)]
pub use uniform_spline::UniformSplines;
#[doc(hidden)]
pub use whittaker::Whittaker;

/// Reads a number; `null` becomes NaN.
#[doc(hidden)]
pub fn or_nan<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(deserializer)?.unwrap_or(f64::NAN))
}
