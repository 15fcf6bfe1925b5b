//! Extrapolates a motion, so that smoothing does not end at the newest frame.
//!
//! A low-pass filter extends a series by odd reflection about its end, which makes the acceleration there zero. A better prediction
//! is the part of the motion that resembles the newest part, m frames earlier; only the difference d(k) = x(k) - x(k - m) is
//! reflected about the end e:
//!
//!   x(e + j) = x(e - m + j) + 2 d(e) - d(e - j)
//!
//! m is the shift for which d is nearest to a straight line over the newest part: a stride in steady walking.
//! Only the smoothing uses these frames.

use crate::motion::Motion;

/// Duration of the newest part that is compared [s].
const LAST_PART_S: f64 = 0.2;
/// Shortest period of a repetition [s].
const SHORTEST_S: f64 = 0.4;
/// Duration of the extrapolation [s]: later frames have no effect on a low-pass filter at 6 Hz.
const AHEAD_S: f64 = 0.3;
/// Largest difference of a repetition, as a share of the variation of the newest part about its mean.
const ALIKE: f64 = 0.5;

/// Appends the extrapolation; returns the motion unchanged if no earlier part resembles its end. Times are `step_s` apart.
pub(super) fn continued(motion: &Motion, step_s: f64) -> Motion {
    let frames = |time_s: f64| (time_s / step_s).round() as usize;
    let (last, ahead, count) = (frames(LAST_PART_S).max(2), frames(AHEAD_S), motion.times.len());
    let mut out = motion.clone();
    let Some(back) = repetition(motion, last, frames(SHORTEST_S)) else { return out };
    let ahead = ahead.min(back).min(count - 1 - back);
    let Some(end_s) = motion.times.last() else { return out };
    out.times.extend((1..=ahead).map(|j| end_s + j as f64 * step_s));
    for (column, out) in motion.columns.iter().zip(&mut out.columns) {
        let (Some(column), Some(out)) = (column, out) else { continue };
        let difference = |k: usize| column[k] - column[k - back];
        let end = count - 1;
        out.extend((1..=ahead).map(|j| column[end - back + j] + 2.0 * difference(end) - difference(end - j)));
    }
    out
}

/// Number of frames to the earlier part that resembles the newest part most.
fn repetition(motion: &Motion, last: usize, shortest: usize) -> Option<usize> {
    let count = motion.times.len();
    let columns: Vec<&Vec<f64>> = motion.columns.iter().flatten().collect();
    let longest = count.checked_sub(last + 1)?;
    let own: f64 = columns.iter().map(|column| variation(&column[count - last..])).sum();
    let differs = |back: usize| columns.iter().map(|column| line_residual(column, back, last)).sum::<f64>();
    let best = (shortest..=longest).map(|back| (back, differs(back))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    (best.1 < ALIKE * ALIKE * own).then_some(best.0)
}

/// Sum of squares about the mean.
fn variation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|x| (x - mean) * (x - mean)).sum()
}

/// Sum of squares of the difference between the newest part of a series and an earlier one, after subtraction of a straight line.
fn line_residual(column: &[f64], back: usize, last: usize) -> f64 {
    let newer = &column[column.len() - last..];
    let older = &column[column.len() - last - back..column.len() - back];
    let middle = 0.5 * (last as f64 - 1.0);
    let (mut sum, mut squares, mut slope, mut spread) = (0.0, 0.0, 0.0, 0.0);
    for (i, (a, b)) in newer.iter().zip(older).enumerate() {
        let (x, y) = (i as f64 - middle, a - b);
        (sum, squares, slope, spread) = (sum + y, squares + y * y, slope + x * y, spread + x * x);
    }
    let left = squares - sum * sum / last as f64 - slope * slope / spread;
    // A part with a gap resembles nothing.
    if left.is_nan() { f64::INFINITY } else { left.max(0.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion(of: impl Fn(f64) -> f64, count: usize) -> Motion {
        let times: Vec<f64> = (0..count).map(|i| 0.01 * i as f64).collect();
        let column = times.iter().map(|t| of(*t)).collect();
        Motion { origin: String::new(), columns: vec![None, Some(column)], times }
    }

    #[test]
    fn a_periodic_motion_with_drift_is_continued_exactly() {
        let of = |t: f64| 0.3 * (std::f64::consts::TAU * t).sin() + 1.2 * t;
        let out = continued(&motion(of, 230), 0.01);
        assert_eq!(out.times.len(), 260);
        let column = out.columns[1].as_ref().unwrap();
        for (t, x) in out.times.iter().zip(column) {
            assert!((x - of(*t)).abs() < 1e-9, "{t} s: {x}");
        }
    }

    #[test]
    fn a_motion_without_repetition_is_not_continued() {
        // Two and a half oscillations in the newest part, after rest: the difference is not a straight line.
        let of = |t: f64| if t < 2.0 { 0.0 } else { 0.1 * (78.5 * (t - 2.0)).sin() };
        for motion in [motion(of, 230), motion(of, 30)] {
            assert_eq!(continued(&motion, 0.01), motion);
        }
    }
}
