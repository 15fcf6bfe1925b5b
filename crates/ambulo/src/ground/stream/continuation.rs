//! Extrapolates a motion, so that smoothing does not end at the newest frame.
//!
//! A low-pass filter extends a series by odd reflection about its end, which makes the acceleration there zero. A
//! better prediction is the part of the motion that resembles the newest part, m frames earlier; only the difference
//! d(k) = x(k) - x(k - m) is reflected about the end e:
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

/// The repetition is first searched at this spacing [s], then at every frame near the best place: the difference
/// changes little in less.
const COARSE_S: f64 = 0.02;

/// How a motion repeats itself at its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Continuation {
    /// Frames to the earlier part that resembles the newest part.
    back: usize,
    /// Frames that are extrapolated.
    ahead: usize,
}

impl Continuation {
    /// `None` if no earlier part resembles the end of the motion. Times are `step_s` apart.
    pub fn find(motion: &Motion, step_s: f64) -> Option<Continuation> {
        let frames = |time_s: f64| (time_s / step_s).round() as usize;
        let last = frames(LAST_PART_S).max(2);
        let back = repetition(motion, last, frames(SHORTEST_S), frames(COARSE_S).max(1))?;
        Some(Continuation { back, ahead: frames(AHEAD_S).min(back).min(motion.times.len() - 1 - back) })
    }

    /// The values after the end of a column.
    pub(super) fn of(self, column: &[f64]) -> impl Iterator<Item = f64> {
        let Continuation { back, ahead } = self;
        let end = column.len() - 1;
        let difference = move |k: usize| column[k] - column[k - back];
        (1..=ahead).map(move |j| column[end - back + j] + 2.0 * difference(end) - difference(end - j))
    }

    /// The motion with its extrapolation.
    pub fn appended_to(self, motion: &Motion, step_s: f64) -> Motion {
        let mut out = motion.clone();
        let Some(end_s) = motion.times.last() else { return out };
        out.times.extend((1..=self.ahead).map(|j| end_s + j as f64 * step_s));
        for (column, out) in motion.columns.iter().zip(&mut out.columns) {
            let (Some(column), Some(out)) = (column, out) else { continue };
            out.extend(self.of(column));
        }
        out
    }
}

/// Number of frames to the earlier part that resembles the newest part most.
fn repetition(motion: &Motion, last: usize, shortest: usize, coarse: usize) -> Option<usize> {
    let count = motion.times.len();
    let columns: Vec<&Vec<f64>> = motion.columns.iter().flatten().collect();
    let longest = count.checked_sub(last + 1)?;
    let differs = |back: usize, stride: usize| {
        columns.iter().map(|column| line_residual(column, back, last, stride)).sum::<f64>()
    };
    let least = |a: &(usize, f64), b: &(usize, f64)| a.1.total_cmp(&b.1);
    let coarsely = (shortest..=longest).step_by(coarse).map(|back| (back, differs(back, coarse)));
    let (near, _) = coarsely.min_by(least)?;
    let finely = (near.saturating_sub(coarse).max(shortest)..=(near + coarse).min(longest)).map(|b| (b, differs(b, 1)));
    let best = finely.min_by(least)?;
    let own: f64 = columns.iter().map(|column| variation(&column[count - last..])).sum();
    (best.1 < ALIKE * ALIKE * own).then_some(best.0)
}

/// Sum of squares about the mean.
fn variation(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    values.iter().map(|x| (x - mean) * (x - mean)).sum()
}

/// Sum of squares of the difference between the newest part of a series and an earlier one at every `stride`th frame,
/// after subtraction of a straight line.
fn line_residual(column: &[f64], back: usize, last: usize, stride: usize) -> f64 {
    let newer = column[column.len() - last..].iter().rev().step_by(stride);
    let older = column[column.len() - last - back..column.len() - back].iter().rev().step_by(stride);
    let count = last.div_ceil(stride) as f64;
    let middle = 0.5 * (count - 1.0);
    let (mut sum, mut squares, mut slope, mut x) = (0.0, 0.0, 0.0, -middle);
    for (a, b) in newer.zip(older) {
        let y = a - b;
        (sum, squares, slope, x) = (sum + y, squares + y * y, slope + x * y, x + 1.0);
    }
    // Σ x² over the whole numbers about the middle.
    let spread = count * (count * count - 1.0) / 12.0;
    let left = squares - sum * sum / count - slope * slope / spread;
    // A part with a gap resembles nothing.
    if left.is_nan() { f64::INFINITY } else { left.max(0.0) }
}
