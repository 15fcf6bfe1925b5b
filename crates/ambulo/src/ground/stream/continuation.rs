//! How a motion probably goes on, so that smoothing does not end where it is needed.
//!
//! A low-pass takes a series for odd about its end, which makes the acceleration there zero. What resembles the motion's last part m
//! frames earlier tells better how it goes on; only the difference d(k) = x(k) - x(k - m) is taken for odd about the end e:
//!
//!   x(e + j) = x(e - m + j) + 2 d(e) - d(e - j)
//!
//! m is the one for which d is nearest to a straight line over the last part: for an even walk a stride.
//! Only the smoothing sees these frames.

use crate::motion::Motion;

/// The last part of the motion [s].
const LAST_PART_S: f64 = 0.2;
/// Nothing repeats faster than this [s].
const SHORTEST_S: f64 = 0.4;
/// How far the motion is continued [s]: beyond it a low-pass at 6 Hz sees nothing.
const AHEAD_S: f64 = 0.3;
/// What differs by more than this share of the last part's own movement, about its mean, is no repetition.
const ALIKE: f64 = 0.5;

/// The motion with a probable continuation; as it was where nothing in it resembles its end. Times are `step_s` apart.
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

/// How many frames earlier the motion was most like its last part.
fn repetition(motion: &Motion, last: usize, shortest: usize) -> Option<usize> {
    let count = motion.times.len();
    let columns: Vec<&Vec<f64>> = motion.columns.iter().flatten().collect();
    let longest = count.checked_sub(last + 1)?;
    let own: f64 = columns.iter().map(|column| movement(&column[count - last..])).sum();
    let differs = |back: usize| columns.iter().map(|column| unlike(column, back, last)).sum::<f64>();
    let best = (shortest..=longest).map(|back| (back, differs(back))).min_by(|a, b| a.1.total_cmp(&b.1))?;
    (best.1 < ALIKE * ALIKE * own).then_some(best.0)
}

/// Sum of squares about the mean.
fn movement(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|x| (x - mean) * (x - mean)).sum()
}

/// Sum of squares that a straight line leaves of the differences between the last part of a series and an earlier one.
fn unlike(column: &[f64], back: usize, last: usize) -> f64 {
    let newer = &column[column.len() - last..];
    let older = &column[column.len() - last - back..column.len() - back];
    let middle = 0.5 * (last as f64 - 1.0);
    let (mut sum, mut squares, mut turned, mut spread) = (0.0, 0.0, 0.0, 0.0);
    for (i, (a, b)) in newer.iter().zip(older).enumerate() {
        let (x, y) = (i as f64 - middle, a - b);
        (sum, squares, turned, spread) = (sum + y, squares + y * y, turned + x * y, spread + x * x);
    }
    let left = squares - sum * sum / last as f64 - turned * turned / spread;
    // Pieces with a gap are like nothing.
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
    fn what_repeats_goes_on_with_its_drift() {
        let of = |t: f64| 0.3 * (std::f64::consts::TAU * t).sin() + 1.2 * t;
        let out = continued(&motion(of, 230), 0.01);
        assert_eq!(out.times.len(), 260);
        let column = out.columns[1].as_ref().unwrap();
        for (t, x) in out.times.iter().zip(column) {
            assert!((x - of(*t)).abs() < 1e-9, "{t} s: {x}");
        }
    }

    #[test]
    fn what_never_was_before_is_not_continued() {
        // Two and a half swings in the last part, after rest: no straight line makes one of the other.
        let of = |t: f64| if t < 2.0 { 0.0 } else { 0.1 * (78.5 * (t - 2.0)).sin() };
        for motion in [motion(of, 230), motion(of, 30)] {
            assert_eq!(continued(&motion, 0.01), motion);
        }
    }
}
