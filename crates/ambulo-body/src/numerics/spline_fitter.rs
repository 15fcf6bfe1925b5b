//! Fits natural splines: interpolation, given smoothing, or smoothing chosen from the data.
//!
//! Minimising  Σ (yᵢ - gᵢ)² + p ∫ (f⁽ᵐ⁾)² dt  with the matrices of `spline_grid` gives
//!
//! (R + p Qᵀ Q) γ = Qᵀ y,   g = y - p Q γ,   I - A = p Q (R + p Qᵀ Q)⁻¹ Qᵀ
//!
//! p is chosen as the minimum over p of one of (Woltring's modes 2 and 3, with SSR = Σ (yᵢ - gᵢ)²)
//!
//! generalised cross-validation  n SSR / tr(I - A)²;   known noise variance σ²:  SSR/n - σ² (2 tr(I - A)/n - 1)
//!
//! | code                 | symbol    | unit         | shape                     |
//! | `p`                  | p h^(1-2m) | 1           | one per fit; h = mean step |
//! | `gamma`              | γ         | value        | n-m per column            |
//! | `residual_freedom`   | tr(I - A) | 1            | one per p                 |
//! | `squared_residuals`  | SSR       | value²       | one per column and p      |
//!
//! In the frequency domain an even grid of step T has gain 1 / (1 + p T ω^(2m)), without phase.
//!
//! Accuracy: forming Qᵀ Q costs digits in proportion to p ‖Qᵀ Q‖; one refinement, which recomputes the residual from Q,
//! brings them back. Quintic, 10,000 samples at 1 kHz, half-gain at 6 Hz: relative errors of value, speed and
//! acceleration 2e-9, 8e-9, 6e-8 without and 1e-12, 5e-11, 2e-8 with it; at 3 Hz 1e-7, 4e-7, 2e-6 and 1e-11, 8e-10,
//! 9e-7. More refinements change nothing.
//!
//! Source: H.J. Woltring 1986, Adv. Eng. Software 8:104-113 (unverified), as in simbody's gcvspl.cpp (SPLC);
//! trace from the central bands of the inverse, M.F. Hutchinson, F.R. de Hoog 1985, Numer. Math. 47:99-106
//! (unverified).
//! Cost: linear in samples. One factorisation per grid and p serves all columns.
//! Not handled: sample weights, one p shared by several columns (Woltring's K data sets).
//! Pinned by: tests/splines.rs

use crate::numerics::elementary::{exp, ln, powi};

use super::banded::BandedLdl;
use super::natural_spline::{NaturalSpline, SmoothingUsed, SplineDegree, SplineError};
use super::spline_grid::SplineGrid;

/// Largest p ‖Qᵀ Q‖: the refinement then still divides errors by 1e3 (1e-16 times this remains), and accelerations keep
/// about 5 digits. For a quintic it is a half-gain frequency of 0.0022 of the sampling rate.
const STRONGEST_SMOOTHING: f64 = 1e13;

/// Smallest p ‖Qᵀ Q‖ tried by a search: the fit then differs from interpolation by at most this part of the noise.
const WEAKEST_SMOOTHING: f64 = 1e-8;

/// Ratio of half-gain frequencies between the values of p that a search tries first.
const SEARCH_RATIO: f64 = 1.5;

/// A search ends when ln p is known to this; the half-gain frequency then to 1e-3 / (2m).
const SEARCH_TOLERANCE: f64 = 1e-3;

/// How closely a spline follows the samples.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smoothing {
    /// Through every sample: p = 0. OpenSim's default for splines of coordinates and forces, which it writes as error
    /// variance 0: its search then lowers p until the residuals vanish (1e-15 at most, as p ‖Qᵀ Q‖).
    Interpolate,
    /// Woltring's smoothing parameter p [s^(2m-1)]: minimises Σ (y - f)² + p ∫ (f⁽ᵐ⁾)² dt.
    Parameter(f64),
    /// p from the data alone, by generalised cross-validation; assumes that the noise of samples is independent.
    GeneralizedCrossValidation,
    /// p that minimises the expected squared error for a known noise variance (value²), as OpenSim's `error_variance`.
    ErrorVariance(f64),
}

/// Fits natural splines of one degree on one time grid.
#[derive(Debug, Clone)]
pub struct SplineFitter {
    degree: SplineDegree,
    grid: SplineGrid,
    interpolation: BandedLdl,
    penalty_norm: f64,
}

/// One smoothing parameter, ready for any column.
struct Candidate {
    p: f64,
    factors: BandedLdl,
    residual_freedom: f64,
}

impl SplineFitter {
    /// Prepares a grid of rising times (s), at least twice the half order of them. They need not be even.
    pub fn new(degree: SplineDegree, times: &[f64]) -> Result<Self, SplineError> {
        let grid = SplineGrid::new(degree, times)?;
        let uneven = |row: usize| SplineError::Uneven { time: times[row], degree: degree.degree() };
        let interpolation = grid.gram.factor().map_err(uneven)?;
        let penalty_norm = grid.penalty.norm();
        Ok(Self { degree, grid, interpolation, penalty_norm })
    }

    /// Fits one column of values, one per time.
    pub fn fit(&self, values: &[f64], smoothing: Smoothing) -> Result<NaturalSpline, SplineError> {
        Ok(self.fit_many(&[values], smoothing)?.swap_remove(0))
    }

    /// Fits many columns; the parts that depend only on times and p are computed once.
    pub fn fit_many<C: AsRef<[f64]>>(
        &self,
        columns: &[C],
        smoothing: Smoothing,
    ) -> Result<Vec<NaturalSpline>, SplineError> {
        let columns: Vec<&[f64]> = columns.iter().map(AsRef::as_ref).collect();
        for (column, values) in columns.iter().enumerate() {
            self.check_column(column, values)?;
        }
        match smoothing {
            Smoothing::Parameter(p) => {
                let p = in_range("smoothing parameter p", p, STRONGEST_SMOOTHING / self.penalty_norm * self.seconds())?;
                if p > 0.0 {
                    let candidate = self.candidate(p / self.seconds())?;
                    return Ok(columns.iter().map(|y| self.smooth(y, &candidate)).collect());
                }
            }
            Smoothing::ErrorVariance(variance) if in_range("error variance", variance, f64::MAX)? <= 0.0 => {}
            Smoothing::GeneralizedCrossValidation | Smoothing::ErrorVariance(_) => {
                return self.search(&columns, smoothing);
            }
            Smoothing::Interpolate => {}
        }
        Ok(columns.iter().map(|y| self.interpolate(y)).collect())
    }

    fn check_column(&self, column: usize, values: &[f64]) -> Result<(), SplineError> {
        let allowed = self.grid.times.len();
        if values.len() != allowed {
            return Err(SplineError::LengthMismatch { column, found: values.len(), allowed });
        }
        match values.iter().position(|y| !y.is_finite()) {
            Some(index) => Err(SplineError::NonFiniteValue { column, index, found: values[index] }),
            None => Ok(()),
        }
    }

    /// R γ = Qᵀ y, g = y.
    fn interpolate(&self, y: &[f64]) -> NaturalSpline {
        let mut gamma = self.grid.differences(y);
        self.interpolation.solve(&mut gamma);
        let used = SmoothingUsed { parameter: 0.0, residual_freedom: 0.0, squared_residuals: 0.0 };
        self.spline(y, &gamma, used)
    }

    /// g = y - p Q γ.
    fn smooth(&self, y: &[f64], candidate: &Candidate) -> NaturalSpline {
        let (gamma, residuals) = self.solve(y, candidate);
        let g: Vec<f64> = y.iter().zip(&residuals).map(|(y, r)| y - r).collect();
        let used = SmoothingUsed {
            parameter: candidate.p * self.seconds(),
            residual_freedom: candidate.residual_freedom,
            squared_residuals: sum_of_squares(&residuals),
        };
        self.spline(&g, &gamma, used)
    }

    fn spline(&self, g: &[f64], gamma: &[f64], used: SmoothingUsed) -> NaturalSpline {
        let coefficients = self.grid.coefficients(g, gamma);
        NaturalSpline::new(self.grid.half_order, self.grid.times.clone(), coefficients, used)
    }

    /// h^(2m-1): p in seconds for p in steps.
    fn seconds(&self) -> f64 {
        powi(self.grid.step, self.degree.degree() as i32)
    }

    /// γ and the residuals y - g = p Q γ, refined once by a solve for the misfit Qᵀ (y - p Q γ) - R γ.
    fn solve(&self, y: &[f64], candidate: &Candidate) -> (Vec<f64>, Vec<f64>) {
        let mut gamma = self.grid.differences(y);
        candidate.factors.solve(&mut gamma);
        let residuals = self.residuals(&gamma, candidate.p);
        let g: Vec<f64> = y.iter().zip(&residuals).map(|(y, r)| y - r).collect();
        let mut misfit = self.grid.differences(&g);
        self.grid.gram.subtract_product(&gamma, &mut misfit);
        candidate.factors.solve(&mut misfit);
        gamma.iter_mut().zip(&misfit).for_each(|(gamma, correction)| *gamma += correction);
        let residuals = self.residuals(&gamma, candidate.p);
        (gamma, residuals)
    }

    fn residuals(&self, gamma: &[f64], p: f64) -> Vec<f64> {
        let mut residuals = self.grid.transposed_differences(gamma);
        residuals.iter_mut().for_each(|r| *r *= p);
        residuals
    }

    /// Factors and tr(I - A) for p in steps. With Z = (R + p Qᵀ Q)⁻¹ both p tr(Qᵀ Q Z) and n - m - tr(R Z) are this
    /// trace; it is computed from the smaller product, which has all its digits.
    fn candidate(&self, p: f64) -> Result<Candidate, SplineError> {
        let grid = &self.grid;
        let uneven = |row: usize| SplineError::Uneven { time: grid.times[row], degree: self.degree.degree() };
        let factors = grid.gram.plus_scaled(p, &grid.penalty).factor().map_err(uneven)?;
        let bands = factors.inverse_bands();
        let rows = (grid.times.len() - grid.half_order) as f64;
        let followed = grid.gram.trace_of_product(&bands);
        let residual_freedom =
            if followed < 0.5 * rows { rows - followed } else { p * grid.penalty.trace_of_product(&bands) };
        Ok(Candidate { p, factors, residual_freedom })
    }

    /// For each column the p of least score: first over a coarse range shared by all columns, then by golden section.
    fn search(&self, columns: &[&[f64]], smoothing: Smoothing) -> Result<Vec<NaturalSpline>, SplineError> {
        let ratio = powi(SEARCH_RATIO, 2 * self.grid.half_order as i32);
        let mut best = vec![(f64::INFINITY, WEAKEST_SMOOTHING / self.penalty_norm); columns.len()];
        let mut p = WEAKEST_SMOOTHING / self.penalty_norm;
        while p * self.penalty_norm <= STRONGEST_SMOOTHING {
            // Long gaps may lose definiteness before the end of the range; stronger smoothing is then impossible.
            let Ok(candidate) = self.candidate(p) else { break };
            for (best, y) in best.iter_mut().zip(columns) {
                let score = self.score(y, &candidate, smoothing);
                if score < best.0 {
                    *best = (score, p);
                }
            }
            p *= ratio;
        }
        columns.iter().zip(best).map(|(y, (_, p))| self.search_near(y, p, ratio, smoothing)).collect()
    }

    /// Golden section in ln p between the neighbours of the best coarse value.
    fn search_near(&self, y: &[f64], p: f64, ratio: f64, smoothing: Smoothing) -> Result<NaturalSpline, SplineError> {
        const GOLDEN: f64 = 0.618_033_988_749_894_9;
        let score = |ln_p: f64| {
            self.candidate(exp(ln_p)).map_or(f64::INFINITY, |candidate| self.score(y, &candidate, smoothing))
        };
        let (mut low, mut high) = (ln(p) - ln(ratio), ln(p) + ln(ratio));
        let (mut left, mut right) = (high - GOLDEN * (high - low), low + GOLDEN * (high - low));
        let (mut left_score, mut right_score) = (score(left), score(right));
        while high - low > SEARCH_TOLERANCE {
            if left_score <= right_score {
                (high, right, right_score) = (right, left, left_score);
                left = high - GOLDEN * (high - low);
                left_score = score(left);
            } else {
                (low, left, left_score) = (left, right, right_score);
                right = low + GOLDEN * (high - low);
                right_score = score(right);
            }
        }
        Ok(self.smooth(y, &self.candidate(exp(0.5 * (low + high)))?))
    }

    /// The objective of a search.
    fn score(&self, y: &[f64], candidate: &Candidate, smoothing: Smoothing) -> f64 {
        let n = y.len() as f64;
        let squared_residuals = sum_of_squares(&self.solve(y, candidate).1);
        let freedom = candidate.residual_freedom;
        match smoothing {
            Smoothing::ErrorVariance(variance) => squared_residuals / n - variance * (2.0 * freedom / n - 1.0),
            _ => n * squared_residuals / (freedom * freedom),
        }
    }
}

/// The value, if it lies between 0 and `allowed`.
fn in_range(name: &'static str, found: f64, allowed: f64) -> Result<f64, SplineError> {
    if (0.0..=allowed).contains(&found) {
        Ok(found)
    } else {
        Err(SplineError::SmoothingOutOfRange { name, found, allowed })
    }
}

fn sum_of_squares(values: &[f64]) -> f64 {
    values.iter().map(|v| v * v).sum()
}
