//! Agreement of two curves.
//!
//!   RMSE  = √(mean (a - b)²)
//!   rRMSE = RMSE / ((range a + range b) / 2)          Ren, Jones, Howard 2008 (unverified page)
//!   r     = Pearson's correlation
//!
//! Pinned by: tests/analysis.rs

use crate::motion::interpolate;

/// A curve over time.
#[derive(Debug, Clone, Copy)]
pub struct Curve<'a> {
    /// Times [s], strictly increasing.
    pub times: &'a [f64],
    /// One value per time.
    pub values: &'a [f64],
}

/// Agreement of two curves at the times of the second that the first covers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// Root-mean-square difference, in the curves' unit.
    pub rmse: f64,
    /// RMSE over the mean of the two ranges; not a number if both are flat.
    pub rrmse: f64,
    /// Pearson's correlation; not a number if one curve is flat.
    pub r: f64,
    /// Largest difference, in the curves' unit.
    pub max_difference: f64,
    /// Number of times compared.
    pub samples: usize,
}

/// Why two curves cannot be compared.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// The curves do not overlap in time.
    #[error(
        "no common time: one curve covers {first_from} s to {first_to} s, the other {second_from} s to {second_to} s; \
         expected an overlap"
    )]
    NoOverlap {
        /// Start of the first [s].
        first_from: f64,
        /// End of the first [s].
        first_to: f64,
        /// Start of the second [s].
        second_from: f64,
        /// End of the second [s].
        second_to: f64,
    },
    /// Times that do not increase.
    #[error("time {later} s follows {earlier} s; expected strictly increasing times in both curves")]
    TimeNotRising {
        /// The earlier entry [s].
        earlier: f64,
        /// The entry that follows it [s].
        later: f64,
    },
    /// A value that is not finite.
    #[error(
        "a value is not a finite number at {time_s:.4} s; expected finite curves. hint: choose a time range without \
         this sample"
    )]
    NotFinite {
        /// Time of the value [s].
        time_s: f64,
    },
}

/// Compares `a` with `b` at the times of `b`; `a` is interpolated linearly.
///
/// # Errors
/// Times that do not increase, no common times, values that are not finite.
pub fn compare(a: Curve<'_>, b: Curve<'_>) -> Result<Agreement, ComparisonError> {
    for times in [a.times, b.times] {
        if let Some(pair) = times.windows(2).find(|w| w[0] >= w[1] || w[0].is_nan() || w[1].is_nan()) {
            return Err(ComparisonError::TimeNotRising { earlier: pair[0], later: pair[1] });
        }
    }
    let ends =
        |c: Curve<'_>| (c.times.first().copied().unwrap_or(f64::NAN), c.times.last().copied().unwrap_or(f64::NAN));
    let ((first_from, first_to), (second_from, second_to)) = (ends(a), ends(b));
    let common = (0..b.times.len()).filter(|&i| b.times[i] >= first_from && b.times[i] <= first_to);
    let mut pairs = Vec::new();
    for i in common {
        let pair = (interpolate(a.times, a.values, b.times[i]), b.values[i]);
        if !(pair.0.is_finite() && pair.1.is_finite()) {
            return Err(ComparisonError::NotFinite { time_s: b.times[i] });
        }
        pairs.push(pair);
    }
    if pairs.is_empty() {
        return Err(ComparisonError::NoOverlap { first_from, first_to, second_from, second_to });
    }
    Ok(agreement(&pairs))
}

/// Agreement of pairs of values.
pub(super) fn agreement(pairs: &[(f64, f64)]) -> Agreement {
    let n = pairs.len() as f64;
    let mean = |f: &dyn Fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>() / n;
    let (mean_a, mean_b) = (mean(&|p| p.0), mean(&|p| p.1));
    let covariance = mean(&|p| (p.0 - mean_a) * (p.1 - mean_b));
    let (spread_a, spread_b) = (mean(&|p| (p.0 - mean_a).powi(2)), mean(&|p| (p.1 - mean_b).powi(2)));
    let rmse = mean(&|p| (p.0 - p.1).powi(2)).sqrt();
    let range = |f: &dyn Fn(&(f64, f64)) -> f64| {
        pairs.iter().map(f).fold(f64::NEG_INFINITY, f64::max) - pairs.iter().map(f).fold(f64::INFINITY, f64::min)
    };
    Agreement {
        rmse,
        rrmse: rmse / (0.5 * (range(&|p| p.0) + range(&|p| p.1))),
        r: covariance / (spread_a * spread_b).sqrt(),
        max_difference: pairs.iter().map(|p| (p.0 - p.1).abs()).fold(0.0, f64::max),
        samples: pairs.len(),
    }
}
