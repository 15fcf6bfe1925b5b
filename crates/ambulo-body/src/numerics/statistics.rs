//! Statistics of numbers: mean, median, extremes, root mean square, standard deviation, correlation.
//!
//! Sums run from the first number to the last, so that equal numbers give equal bits. Pinned by: tests/statistics.rs

use super::order::number_at;

/// Mean; 0 without numbers.
#[must_use]
pub fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

/// Mean of the finite numbers; NaN if there are none.
#[must_use]
pub fn finite_mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let finite = values.into_iter().filter(|x| x.is_finite());
    let (sum, count) = finite.fold((-0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    sum / count
}

/// The median; with an even count the mean of the two middle values. Values that are not finite are ignored; `None` if
/// no value remains.
#[must_use]
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut list: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
    let middle = list.len() / 2;
    let has_two = list.len() == 2 * middle;
    let upper = (!list.is_empty()).then(|| number_at(&mut list, middle))?;
    let lower = if has_two { list[..middle].iter().fold(f64::MIN, |most, x| most.max(*x)) } else { upper };
    Some(0.5 * (lower + upper))
}

/// Smallest and largest number; ∞ and -∞ without numbers.
#[must_use]
pub fn extremes(values: &[f64]) -> (f64, f64) {
    values.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(*x), high.max(*x)))
}

/// Largest minus smallest number; 0 without numbers.
#[must_use]
pub fn range(values: &[f64]) -> f64 {
    let (low, high) = extremes(values);
    if values.is_empty() { 0.0 } else { high - low }
}

/// Root mean square; 0 without numbers.
#[must_use]
pub fn rms(values: &[f64]) -> f64 {
    (values.iter().map(|x| x * x).sum::<f64>() / values.len().max(1) as f64).sqrt()
}

/// Standard deviation of a sample, √(Σ (x - x̄)² / (n - 1)); `None` for fewer than two numbers.
#[must_use]
pub fn sample_deviation(values: &[f64]) -> Option<f64> {
    let mean = mean(values);
    let squares: f64 = values.iter().map(|x| (x - mean).powi(2)).sum();
    (values.len() > 1).then(|| (squares / (values.len() - 1) as f64).sqrt())
}

/// Pearson correlation of two curves of the same length; 0 if one is constant.
#[must_use]
pub fn correlation(a: &[f64], b: &[f64]) -> f64 {
    let (x, y) = (mean(a), mean(b));
    let products = |f: &dyn Fn(f64, f64) -> f64| a.iter().zip(b).map(|(a, b)| f(a - x, b - y)).sum::<f64>();
    let spread = (products(&|a, _| a * a) * products(&|_, b| b * b)).sqrt();
    if spread > 0.0 { products(&|a, b| a * b) / spread } else { 0.0 }
}
