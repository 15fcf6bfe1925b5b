//! Statistics of numbers: mean, median, quantiles, extremes, root mean square, standard deviation, correlation.
//!
//! Sums run from the first number to the last, so that equal numbers give equal bits. Pinned by: tests/statistics.rs

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
    let upper = (!list.is_empty()).then(|| number_at(&mut list, middle))?;
    let has_one = list.len() > 2 * middle;
    // The numbers before the place are not larger than the one at it.
    let lower = if has_one { upper } else { extremes(&list[..middle]).1 };
    Some(0.5 * (lower + upper))
}

/// The finite values that these shares of them are below: of n in order of size the one at place ⌊share n⌋, counted
/// from 0; the largest for a share of 1. `None` if no value is finite.
#[must_use]
pub fn quantiles<const N: usize>(values: impl IntoIterator<Item = f64>, shares: [f64; N]) -> Option<[f64; N]> {
    let mut list: Vec<f64> = values.into_iter().filter(|value| value.is_finite()).collect();
    let last = list.len().checked_sub(1)?;
    let place = |share: f64| ((share * (last + 1) as f64) as usize).min(last);
    Some(shares.map(|share| number_at(&mut list, place(share))))
}

/// The number at this place, counted from 0, of a list in order; the list is put into an order in which the numbers
/// before it are not larger.
fn number_at(list: &mut [f64], place: usize) -> f64 {
    *list.select_nth_unstable_by(place, f64::total_cmp).1
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
