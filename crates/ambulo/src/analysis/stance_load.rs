//! Peaks and impulse of a moment over a stance.
//!
//!   first peak, second peak     largest moment in the first and in the second half of the stance
//!   impulse                     ∫ max(M, 0) dt from foot strike to foot off
//!
//! The peaks follow the usual reading of the external knee adduction moment. Only what loads the medial side counts in
//! the impulse, so that an abduction moment after foot strike does not make it smaller.
//!
//! Source: Kutzner 2013 (first and second half of stance; abstract); the positive part of the impulse: convention
//! (unverified).
//! Pinned by: tests/joint_moments.rs

/// First peak, second peak and impulse of a moment over a stance of this duration [s]. `values` are at even steps from
/// foot strike to foot off; the impulse is in their unit times a second. `None` with fewer than two values, or if one
/// is not finite.
#[must_use]
pub fn stance_load(values: &[f64], duration_s: f64) -> Option<[f64; 3]> {
    let steps = values.len().checked_sub(1).filter(|steps| *steps > 0)?;
    if !values.iter().all(|value| value.is_finite()) {
        return None;
    }
    let largest = |part: &[f64]| part.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let [early, late] = [largest(&values[..=steps / 2]), largest(&values[steps.div_ceil(2)..])];
    let area: f64 = values.windows(2).map(|pair| 0.5 * (pair[0].max(0.0) + pair[1].max(0.0))).sum();
    Some([early, late, area * duration_s / steps as f64])
}
