//! From recorded samples to smooth curves with two derivatives on a uniform grid.
//!
//! Butterworth: the series is extended by odd reflection, low-passed forwards and backwards, and a natural quintic
//! spline through the extended series gives the derivatives, so that neither the filter nor the spline has its ends
//! where the data are (OpenSim's inverse dynamics tool does the same).
//! Spline: a natural quintic smoothing spline whose stiffness is found by generalised cross-validation for each
//! coordinate (Woltring 1986); its noise estimate is kept.

use super::filter::{LowPass, low_pass_padded};
use super::recording::{Motion, MotionError};
use super::time_grid::{TimeGrid, Window};
use crate::findings::Findings;
use crate::model::{CoordinateId, Model};
use crate::numerics::{NaturalSpline, Smoothing, SplineDegree, SplineFitter};

/// How a recording is smoothed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smoother {
    /// Not at all: a spline through the samples.
    Off,
    /// Zero-phase low-pass.
    Butterworth(LowPass),
    /// Quintic spline, stiffness by generalised cross-validation.
    Spline,
}

/// Smoothed coordinates with two derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothMotion {
    /// The instants.
    pub grid: TimeGrid,
    /// Per coordinate of the model, where recorded: value, rate, acceleration, one entry a frame.
    pub columns: Vec<Option<[Vec<f64>; 3]>>,
    /// Per coordinate, where the smoother estimates it: standard deviation of the recorded noise [rad or m].
    pub noise: Vec<Option<f64>>,
}

/// Gaps inside a recording up to this long are bridged by a spline [s].
const LONGEST_GAP_S: f64 = 0.2;
/// A quintic spline needs this many samples.
const FEWEST_SAMPLES: usize = 6;

impl SmoothMotion {
    /// Value, rate and acceleration of a coordinate.
    #[must_use]
    pub fn column(&self, id: CoordinateId) -> Option<&[Vec<f64>; 3]> {
        self.columns.get(id.index())?.as_ref()
    }
}

/// Smooths the whole recording, then keeps the frames inside `window`.
///
/// # Errors
/// Gaps that are too long, fewer frames than a quintic spline needs, a cut-off that the sampling rate does not allow.
pub fn smooth(
    model: &Model,
    motion: &Motion,
    smoother: Smoother,
    window: Window,
    findings: &mut Findings,
) -> Result<SmoothMotion, MotionError> {
    let whole = uniform_grid(motion, window, findings)?;
    let resampled = TimeGrid::through(&motion.times).is_none();
    let (first, frames) = whole.inside(window);
    if frames < FEWEST_SAMPLES {
        return Err(too_short(motion, window, frames));
    }
    let grid = TimeGrid { start_s: whole.time(first), frames, ..whole };
    let mut out = SmoothMotion { grid, columns: Vec::new(), noise: Vec::new() };
    let mut fitters = Fitters { whole, smoother, fitter: None };
    for (coordinate, column) in model.coordinates().iter().zip(&motion.columns) {
        let Some(column) = column else {
            out.columns.push(None);
            out.noise.push(None);
            continue;
        };
        let name = &coordinate.name;
        let filled = fill_gaps(name, &motion.times, column, findings)?;
        let samples = if resampled { resample(name, &motion.times, &filled, &whole)? } else { filled };
        let spline = fitters.fit(name, &samples)?;
        let mut series = [Vec::with_capacity(frames), Vec::with_capacity(frames), Vec::with_capacity(frames)];
        for i in 0..frames {
            for (series, value) in series.iter_mut().zip(spline.value_and_two_derivatives(grid.time(i))) {
                series.push(value);
            }
        }
        out.columns.push(Some(series));
        out.noise.push(spline.noise_standard_deviation());
    }
    Ok(out)
}

fn too_short(motion: &Motion, window: Window, found: usize) -> MotionError {
    let first_s = motion.times.first().copied().unwrap_or(f64::NAN);
    let last_s = motion.times.last().copied().unwrap_or(f64::NAN);
    MotionError::TooShort {
        found,
        expected: FEWEST_SAMPLES,
        from_s: window.from_s.unwrap_or(first_s),
        to_s: window.to_s.unwrap_or(last_s),
        first_s,
        last_s,
    }
}

fn uniform_grid(motion: &Motion, window: Window, findings: &mut Findings) -> Result<TimeGrid, MotionError> {
    if motion.times.len() < FEWEST_SAMPLES {
        return Err(too_short(motion, window, motion.times.len()));
    }
    if let Some(grid) = TimeGrid::through(&motion.times) {
        return Ok(grid);
    }
    let mut steps: Vec<f64> = motion.times.windows(2).map(|w| w[1] - w[0]).collect();
    steps.sort_by(f64::total_cmp);
    let (median, longest) = (steps[steps.len() / 2], steps[steps.len() - 1]);
    if longest > LONGEST_GAP_S.max(2.0 * median) {
        let gap = motion.times.windows(2).find(|w| w[1] - w[0] >= longest).unwrap_or(&[0.0, 0.0]);
        let (from_s, to_s) = (gap[0], gap[1]);
        return Err(MotionError::Gap { column: "time".into(), from_s, to_s, longest_s: LONGEST_GAP_S });
    }
    let (start_s, end_s) = (motion.times[0], motion.times[motion.times.len() - 1]);
    let intervals = ((end_s - start_s) / median).round();
    let frames = intervals as usize + 1;
    let message = format!(
        "the recording's clock is uneven (steps of {:.4} to {longest:.4} s); it was resampled at {:.2} Hz",
        steps[0],
        intervals / (end_s - start_s)
    );
    findings.warn("motion.uneven_clock", message);
    Ok(TimeGrid { start_s, step_s: (end_s - start_s) / intervals, frames })
}

/// Bridges runs of missing numbers by a quintic spline through the rest.
fn fill_gaps(name: &str, times: &[f64], column: &[f64], findings: &mut Findings) -> Result<Vec<f64>, MotionError> {
    let known: Vec<usize> = (0..column.len()).filter(|&i| column[i].is_finite()).collect();
    if known.len() == column.len() {
        return Ok(column.to_vec());
    }
    let gap = |from: usize, to: usize| MotionError::Gap {
        column: name.to_owned(),
        from_s: times[from],
        to_s: times[to],
        longest_s: LONGEST_GAP_S,
    };
    let (Some(&first), Some(&last)) = (known.first(), known.last()) else { return Err(gap(0, column.len() - 1)) };
    if first > 0 {
        return Err(gap(0, first - 1));
    }
    if last + 1 < column.len() {
        return Err(gap(last + 1, column.len() - 1));
    }
    for pair in known.windows(2) {
        if pair[1] > pair[0] + 1 && times[pair[1]] - times[pair[0]] > LONGEST_GAP_S {
            return Err(gap(pair[0] + 1, pair[1] - 1));
        }
    }
    let spline = spline_through(name, &pick(times, &known), &pick(column, &known))?;
    let missing = column.len() - known.len();
    findings.warn("motion.gap_filled", format!("`{name}`: {missing} missing samples were bridged by a spline"));
    Ok((0..column.len()).map(|i| if column[i].is_finite() { column[i] } else { spline.value(times[i]) }).collect())
}

fn pick(values: &[f64], indices: &[usize]) -> Vec<f64> {
    indices.iter().map(|&i| values[i]).collect()
}

fn spline_through(name: &str, times: &[f64], values: &[f64]) -> Result<NaturalSpline, MotionError> {
    let error = |source| MotionError::Spline { column: name.to_owned(), source };
    SplineFitter::new(SplineDegree::Quintic, times).map_err(error)?.fit(values, Smoothing::Interpolate).map_err(error)
}

fn resample(name: &str, times: &[f64], values: &[f64], grid: &TimeGrid) -> Result<Vec<f64>, MotionError> {
    let spline = spline_through(name, times, values)?;
    Ok((0..grid.frames).map(|i| spline.value(grid.time(i))).collect())
}

/// Fits the columns of one recording; the factorisation, which depends on the times only, is made once.
struct Fitters {
    whole: TimeGrid,
    smoother: Smoother,
    fitter: Option<SplineFitter>,
}

impl Fitters {
    fn fit(&mut self, name: &str, samples: &[f64]) -> Result<NaturalSpline, MotionError> {
        let error = |source| MotionError::Spline { column: name.to_owned(), source };
        let (padded, pad, smoothing) = match self.smoother {
            Smoother::Off => (samples.to_vec(), 0, Smoothing::Interpolate),
            Smoother::Spline => (samples.to_vec(), 0, Smoothing::GeneralizedCrossValidation),
            Smoother::Butterworth(filter) => {
                let series = low_pass_padded(samples, self.whole.rate_hz(), filter)
                    .map_err(|source| MotionError::Filter { column: name.to_owned(), source })?;
                (series.samples, series.pad, Smoothing::Interpolate)
            }
        };
        let fitter = match self.fitter.take() {
            Some(fitter) => fitter,
            None => {
                let grid = TimeGrid {
                    start_s: self.whole.start_s - self.whole.step_s * pad as f64,
                    frames: padded.len(),
                    ..self.whole
                };
                SplineFitter::new(SplineDegree::Quintic, &grid.times()).map_err(error)?
            }
        };
        self.fitter.insert(fitter).fit(&padded, smoothing).map_err(error)
    }
}
