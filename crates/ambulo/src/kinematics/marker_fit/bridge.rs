//! A curve across a gap.
//!
//! min Σ_known (y - q)² + (ω_c Δt)⁻⁶ Σ (Δ³q)²: the smoothest curve near what is known around the gap, a discrete smoothing
//! spline of half order three whose response is 1 / (1 + (ω/ω_c)⁶). Its distance from the last known and the next known value
//! is taken back along a straight line, so that the curve joins what stands beside the gap.
//!
//! Noise matters more than the model of motion: through the three last values alone, 1 mm of a marker 0.15 m from a joint makes an
//! acceleration error of 0.007 · 100² = 70 rad/s² at 100 Hz, which is 0.2 rad in the middle of 0.15 s.
//!
//! Pinned by: tests/marker_gaps.rs

use crate::numerics::BandMatrix;
use std::f64::consts::TAU;

/// What is known this far on both sides of a gap tells its curve [s].
const REACH: f64 = 0.25;
/// Joints of a walking person move below this [Hz]: the usual low-pass of marker data.
const CUTOFF_HZ: f64 = 6.0;
/// Frames at most that are solved together.
const MOST: usize = 4096;

/// Fills `values[start..end]`, which has known values on both sides; `known` says which of the others are.
pub(super) fn fill(values: &mut [f64], known: &[bool], start: usize, end: usize, step_s: f64) {
    let reach = ((REACH / step_s).ceil() as usize).clamp(3, MOST);
    let (first, last) = (start.saturating_sub(reach), (end + reach).min(values.len()));
    let count = last - first;
    let is_known = |i: usize| known[first + i] && !(start..end).contains(&(first + i));
    let penalty = (TAU * CUTOFF_HZ * step_s).powi(-6);
    let mut matrix = BandMatrix::zeros(count, 3);
    let mut q = vec![0.0; count];
    // Values are counted from the last known one, so that no digits are lost.
    let base = values[start - 1];
    for i in (0..count).filter(|&i| is_known(i)) {
        matrix.add(i, i, 1.0);
        q[i] = values[first + i] - base;
    }
    const THIRD: [f64; 4] = [-1.0, 3.0, -3.0, 1.0];
    for i in 0..count.saturating_sub(3) {
        for a in 0..4 {
            for b in 0..=a {
                matrix.add(i + a, i + b, penalty * THIRD[a] * THIRD[b]);
            }
        }
    }
    let left = values[start - 1];
    let right = values[end];
    match matrix.factor().filter(|_| (0..count).filter(|&i| is_known(i)).count() > 3) {
        Some(factor) => factor.solve(&mut q),
        // Too little is known for a curve.
        None => {
            let span = (end + 1 - start) as f64;
            (0..count).for_each(|i| q[i] = (right - left) * ((first + i + 1) as f64 - start as f64) / span);
        }
    }
    let miss_left = left - base - q[start - 1 - first];
    let miss_right = right - base - q[end - first];
    for i in start..end {
        let share = (i + 1 - start) as f64 / (end + 1 - start) as f64;
        values[i] = base + q[i - first] + miss_left + share * (miss_right - miss_left);
    }
}
