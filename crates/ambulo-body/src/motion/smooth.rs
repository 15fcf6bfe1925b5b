//! Smooths recorded samples to curves with two derivatives on a uniform time grid.
//!
//! Butterworth: the series is extended by odd reflection, low-pass filtered forwards and backwards, and a natural
//! quintic spline through the extended series gives the derivatives. So the ends of filter and spline are outside the
//! data, as in OpenSim's inverse dynamics tool.
//! Spline: a natural quintic smoothing spline whose smoothing parameter is chosen by generalised cross-validation for
//! each coordinate (Woltring 1986); it also estimates the noise.

use super::filter::{LowPass, low_pass_padded};
use super::gaps::{LONGEST_GAP_S, fill_gaps, rows_around, spline_through};
use super::recording::{Motion, MotionError};
use super::time_grid::{TimeGrid, Window};
use crate::findings::{Code, Findings};
use crate::model::{Coordinate, CoordinateId, Drive, Model};
use crate::numerics::{NaturalSpline, Smoothing, SplineDegree, SplineFitter, sort_numbers};
use std::borrow::Cow;

/// The smoothing method.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Smoother {
    /// No smoothing: a spline through the samples.
    Off,
    /// Zero-phase low-pass filter.
    Butterworth(LowPass),
    /// Quintic smoothing spline with generalised cross-validation.
    Spline,
}

impl Smoother {
    /// The low-pass filter, if it is one.
    #[must_use]
    pub fn low_pass(self) -> Option<LowPass> {
        match self {
            Smoother::Butterworth(low_pass) => Some(low_pass),
            Smoother::Off | Smoother::Spline => None,
        }
    }

    /// Cut-off frequency of a low-pass filter [Hz].
    #[must_use]
    pub fn cutoff_hz(self) -> Option<f64> {
        self.low_pass().map(|low_pass| low_pass.cutoff_hz)
    }
}

/// Settings of [`smooth`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SmoothSettings {
    /// The smoothing method.
    pub smoother: Smoother,
    /// The time range of the result.
    pub window: Window,
    /// Frame rate of the result [Hz], evaluated from the splines; `None` keeps the value of the recording.
    pub rate_hz: Option<f64>,
}

/// Smoothed coordinates with two derivatives.
#[derive(Debug, Clone, PartialEq)]
pub struct SmoothMotion {
    /// The time grid.
    pub grid: TimeGrid,
    /// Value, rate and acceleration of each recorded coordinate of the model, one entry per frame.
    pub columns: Vec<Option<[Vec<f64>; 3]>>,
    /// Standard deviation of the recorded noise of each coordinate, if the smoother estimates it [rad or m].
    pub noise: Vec<Option<f64>>,
}

/// Number of samples that a quintic spline needs.
const FEWEST_SAMPLES: usize = 6;
/// Highest frame rate of the result [Hz].
const HIGHEST_RATE_HZ: f64 = 20_000.0;
/// Largest number of frames, because of memory: ten minutes at the highest rate are 12 million, of 100 columns each.
const MOST_FRAMES: f64 = 2e6;
/// Farthest end of a range from the recording [s]: 11 days. Numbers beyond it are typing errors, and pages could not
/// show them.
const FARTHEST_S: f64 = 1e6;
/// Largest number of resampled frames per sample of a recording with uneven time steps.
const MOST_FRAMES_PER_SAMPLE: f64 = 4.0;

impl SmoothMotion {
    /// Value, rate and acceleration of a coordinate.
    #[must_use]
    pub fn column(&self, id: CoordinateId) -> Option<&[Vec<f64>; 3]> {
        self.columns.get(id.index())?.as_ref()
    }
}

/// Smooths the part of the recording around `window` that has no gaps, then keeps the frames inside the window.
/// Recorded values of coordinates that are not free in the model are smoothed only if they are complete.
///
/// # Errors
/// Gaps that are too long, fewer frames than a quintic spline needs, a cut-off that the sampling rate does not allow.
pub fn smooth(
    model: &Model,
    motion: &Motion,
    settings: SmoothSettings,
    findings: &mut Findings,
) -> Result<SmoothMotion, MotionError> {
    let SmoothSettings { smoother, window, rate_hz } = settings;
    check_range(motion, window)?;
    let recorded = motion;
    let motion = &*usable(model, motion, window);
    let whole = uniform_grid(motion, window, findings)?;
    let resampled = TimeGrid::through(&motion.times).is_none();
    let (first, frames) = whole.inside(window);
    if frames < FEWEST_SAMPLES {
        return Err(too_short(recorded, window, frames));
    }
    let grid = at_rate(TimeGrid { start_s: whole.time(first), frames, ..whole }, rate_hz)?;
    let frames = grid.frames;
    let mut out = SmoothMotion { grid, columns: Vec::new(), noise: Vec::new() };
    let mut fitters = Fitters { whole, smoother, fitter: None };
    for (coordinate, column) in model.coordinates().iter().zip(&motion.columns) {
        let is_used =
            |column: &&Vec<f64>| matches!(coordinate.drive, Drive::Free) || column.iter().all(|x| x.is_finite());
        let Some(column) = column.as_ref().filter(is_used) else {
            report_unused(coordinate, column.as_ref(), findings);
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

/// Rejects a range that ends far away from the recording.
pub fn check_range(motion: &Motion, window: Window) -> Result<(), MotionError> {
    let (Some(&first_s), Some(&last_s)) = (motion.times.first(), motion.times.last()) else { return Ok(()) };
    let near = first_s - FARTHEST_S..=last_s + FARTHEST_S;
    match window.from_s.into_iter().chain(window.to_s).find(|end| !near.contains(end)) {
        Some(found_s) => Err(MotionError::FarRange { found_s, first_s, last_s, farthest_s: FARTHEST_S }),
        None => Ok(()),
    }
}

/// The part of the recording around the window that has all the numbers in use.
fn usable<'m>(model: &Model, motion: &'m Motion, window: Window) -> Cow<'m, Motion> {
    let free = |(c, _): &(&Coordinate, &Option<Vec<f64>>)| matches!(c.drive, Drive::Free);
    let used: Vec<&Vec<f64>> =
        model.coordinates().iter().zip(&motion.columns).filter(free).filter_map(|(_, c)| c.as_ref()).collect();
    let rows = rows_around(&motion.times, window, |row| used.iter().all(|c| c[row].is_finite()));
    if rows == (0..motion.times.len()) {
        return Cow::Borrowed(motion);
    }
    Cow::Owned(Motion {
        origin: motion.origin.clone(),
        times: motion.times[rows.clone()].to_vec(),
        columns: motion.columns.iter().map(|c| c.as_ref().map(|c| c[rows.clone()].to_vec())).collect(),
    })
}

/// The grid with the same start at another rate.
fn at_rate(grid: TimeGrid, rate_hz: Option<f64>) -> Result<TimeGrid, MotionError> {
    let Some(rate_hz) = rate_hz else { return Ok(grid) };
    let intervals = ((grid.end_s() - grid.start_s) * rate_hz + 1e-6).floor();
    if !(rate_hz > 0.0 && rate_hz <= HIGHEST_RATE_HZ && (1.0..MOST_FRAMES).contains(&intervals)) {
        let highest_hz = HIGHEST_RATE_HZ.min(MOST_FRAMES / (grid.end_s() - grid.start_s));
        return Err(MotionError::Rate { found_hz: rate_hz, highest_hz });
    }
    Ok(TimeGrid { step_s: 1.0 / rate_hz, frames: intervals as usize + 1, ..grid })
}

/// Why a range has too few frames: the whole recording has, it lies outside, or it is short.
fn too_short(motion: &Motion, window: Window, found: usize) -> MotionError {
    let expected = FEWEST_SAMPLES;
    if motion.times.len() < FEWEST_SAMPLES {
        return MotionError::TooFewFrames { found: motion.times.len(), expected };
    }
    let first_s = motion.times.first().copied().unwrap_or(f64::NAN);
    let last_s = motion.times.last().copied().unwrap_or(f64::NAN);
    let (from_s, to_s) = (window.from_s.unwrap_or(first_s), window.to_s.unwrap_or(last_s));
    MotionError::TooShort { found, expected, from_s, to_s, first_s, last_s }.or_outside()
}

/// Reports a recorded column that is not used because of its gaps, although the model determines the coordinate.
fn report_unused(coordinate: &Coordinate, column: Option<&Vec<f64>>, findings: &mut Findings) {
    if column.is_some_and(|column| column.iter().any(|x| x.is_finite())) {
        let message = format!(
            "the recorded values of `{}` have gaps; the model locks, prescribes or couples this coordinate, and its \
             values were used",
            coordinate.name
        );
        findings.report(Code::MotionCoupledMismatch, message);
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
    sort_numbers(&mut steps);
    let (median, longest) = (steps[steps.len() / 2], steps[steps.len() - 1]);
    if longest > LONGEST_GAP_S.max(2.0 * median) {
        let gap = motion.times.windows(2).find(|w| w[1] - w[0] >= longest).unwrap_or(&[0.0, 0.0]);
        let (from_s, to_s) = (gap[0], gap[1]);
        return Err(MotionError::NoRows { from_s, to_s, longest_s: LONGEST_GAP_S });
    }
    let (start_s, end_s) = (motion.times[0], motion.times[motion.times.len() - 1]);
    let intervals = ((end_s - start_s) / median).round();
    let most = MOST_FRAMES_PER_SAMPLE * motion.times.len() as f64;
    if intervals > most {
        let (shortest_s, samples) = (steps[0], motion.times.len());
        return Err(MotionError::UnevenClock { shortest_s, longest_s: longest, samples });
    }
    let frames = intervals as usize + 1;
    let message = format!(
        "the time steps of the recording are uneven ({:.4} to {longest:.4} s); it was resampled at {:.2} Hz",
        steps[0],
        intervals / (end_s - start_s)
    );
    findings.report(Code::MotionUnevenClock, message);
    Ok(TimeGrid { start_s, step_s: (end_s - start_s) / intervals, frames })
}

fn resample(name: &str, times: &[f64], values: &[f64], grid: &TimeGrid) -> Result<Vec<f64>, MotionError> {
    let spline = spline_through(name, times, values)?;
    Ok((0..grid.frames).map(|i| spline.value(grid.time(i))).collect())
}

/// Fits the columns of one recording; the factorisation depends only on the times and is computed once.
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
                let (padded, pad) = low_pass_padded(samples, self.whole.rate_hz(), filter)
                    .map_err(|source| MotionError::Filter { column: name.to_owned(), source })?;
                (padded, pad, Smoothing::Interpolate)
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
