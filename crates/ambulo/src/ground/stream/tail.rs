//! Smooths the newest part of a stream; later frames do not change the older part.
//!
//! A zero-phase filter needs the frames that follow. What they change in an earlier frame decays with the slowest pole
//! of the filter, so that after
//!
//!   T = ln(1 / ε) / (2π f_c sin(π / (2 n)))
//!
//! a frame is settled: 0.49 s at 6 Hz and order 3. Only the frames after it are filtered again, from 2 T before the
//! newest frame on; derivatives belong to a quintic spline through the filtered frames, as in
//! [`crate::motion::smooth`], by the weights of its neighbours, which decay by 0.43 a frame.
//!
//! | code      | symbol | meaning                                     |
//! | `settles` | T      | in frames                                   |
//! | `SETTLED` | ε      | remaining share of a change in later frames |
//!
//! Not handled here: smoothing splines, whose smoothness depends on the whole window, and the first second of a stream.
//! Both are smoothed as whole recordings.

use super::StreamError;
use super::continuation::Continuation;
use super::frame_buffer::FrameBuffer;
use crate::findings::Findings;
use crate::model::{CoordinateId, Model};
use crate::motion::filter::{LowPass, extend_by_reflection, low_pass_unpadded};
use crate::motion::gaps::fill_gaps;
use crate::motion::{MotionError, SmoothMotion, SmoothSettings, Smoother, TimeGrid, Window, smooth};
use crate::numerics::elementary::{ln, sin};
use crate::numerics::{Smoothing, SplineDegree, SplineFitter};
use std::f64::consts::{PI, TAU};

/// Share of a change in later frames that remains in a settled frame.
const SETTLED: f64 = 1e-4;
/// Neighbours on each side on which the derivatives of a spline depend; the next one has 2e-8 of the weight of the
/// first.
pub const NEIGHBOURS: usize = 20;

/// Smooths the newest part of a stream.
#[derive(Debug, Clone)]
pub struct TailSmoother {
    smoother: Smoother,
    rate_hz: f64,
    /// `None` if no frame of the window settles.
    pub settles: Option<usize>,
    /// First and second derivative of a spline from the values of a frame and its neighbours.
    derivatives: [Vec<f64>; 2],
}

/// The newest part, smoothed.
pub enum Tail {
    /// Filtered columns, with the number of their first frame, which may lie before the stream.
    Filtered {
        /// Number of the first frame.
        first: isize,
        /// Columns, one per coordinate.
        columns: Vec<Option<Vec<f64>>>,
    },
    /// All frames of the window, with the number of the first one.
    Whole {
        /// Number of the first frame.
        first: usize,
        /// All frames.
        motion: SmoothMotion,
    },
}

/// Frames of a stream at a uniform step.
#[derive(Debug, Clone, Copy)]
pub struct FrameRange {
    /// Number of the first one.
    pub first: usize,
    /// Step from one frame to the next, in frames of the stream.
    pub stride: usize,
    /// Number of frames.
    pub count: usize,
}

impl TailSmoother {
    /// For windows of a number of frames.
    pub fn new(smoother: Smoother, rate_hz: f64, window: usize) -> Result<TailSmoother, MotionError> {
        let frames = |time_s: f64| (time_s * rate_hz).ceil() as usize;
        let settles = match smoother {
            Smoother::Off => Some(NEIGHBOURS),
            Smoother::Butterworth(filter) => Some(frames(settling_s(filter)) + NEIGHBOURS),
            Smoother::Spline => None,
        };
        let derivatives = derivatives(rate_hz)?;
        Ok(TailSmoother { smoother, rate_hz, settles: settles.filter(|frames| *frames < window), derivatives })
    }

    /// After how many later frames a frame is settled, more than `delay`; `None` if it never is.
    pub fn settles(&self, delay: usize) -> Option<usize> {
        self.settles.map(|frames| frames.max(delay + 1))
    }

    /// Smooths the frames from number `first` on.
    pub fn smooth(
        &self,
        model: &Model,
        buffer: &FrameBuffer,
        first: usize,
        findings: &mut Findings,
    ) -> Result<Tail, StreamError> {
        let oldest = buffer.next - buffer.len();
        let continuation = Continuation::find(buffer.motion(), buffer.time(1));
        match self.settles {
            Some(settles) if buffer.len() > settles => {
                let from = first.saturating_sub(settles).max(oldest);
                let columns = self.filtered(model, buffer, (from - oldest, settles), continuation, findings)?;
                let reflected = if from == oldest { settles } else { 0 };
                Ok(Tail::Filtered { first: from as isize - reflected as isize, columns })
            }
            _ => {
                let all = Window { from_s: None, to_s: buffer.motion().times.last().copied() };
                let settings = SmoothSettings { smoother: self.smoother, window: all, rate_hz: None };
                let motion = match continuation {
                    Some(continuation) => &continuation.appended_to(buffer.motion(), buffer.time(1)),
                    None => buffer.motion(),
                };
                Ok(Tail::Whole { first: oldest, motion: smooth(model, motion, settings, findings)? })
            }
        }
    }

    /// The columns from a row of the buffer on, filtered.
    fn filtered(
        &self,
        model: &Model,
        buffer: &FrameBuffer,
        (row, settles): (usize, usize),
        continuation: Option<Continuation>,
        findings: &mut Findings,
    ) -> Result<Vec<Option<Vec<f64>>>, StreamError> {
        let motion = buffer.motion();
        let name = |id: CoordinateId| &model.coordinates()[id.index()].name;
        let mut extend = |id: CoordinateId, column: &[f64]| -> Result<Vec<f64>, StreamError> {
            let ahead: Vec<f64> = continuation.into_iter().flat_map(|continuation| continuation.of(column)).collect();
            // The frame before a gap that contains the first row.
            let known = (0..=row).rev().find(|row| column[*row].is_finite()).unwrap_or(row);
            let mut samples = fill_gaps(name(id), &motion.times[known..], &column[known..], findings)?;
            samples.drain(..row - known);
            if ahead.iter().all(|x| x.is_finite()) {
                samples.extend(ahead);
            }
            let both_ends = extend_by_reflection(&samples, settles);
            Ok(if row == 0 { both_ends } else { both_ends[settles..].to_vec() })
        };
        let read = model.coordinate_ids().zip(&motion.columns).filter_map(|(id, column)| Some((id, column.as_ref()?)));
        let read: Vec<(CoordinateId, &Vec<f64>)> = read.collect();
        let extended = read.iter().map(|(id, column)| extend(*id, column)).collect::<Result<Vec<Vec<f64>>, _>>()?;
        let filtered = match self.smoother {
            Smoother::Butterworth(filter) => {
                low_pass_unpadded(&extended, self.rate_hz, filter).map_err(|(number, source)| {
                    let column = name(read[number].0).clone();
                    MotionError::Filter { column, source }
                })?
            }
            Smoother::Off | Smoother::Spline => extended,
        };
        let mut columns = vec![None; motion.columns.len()];
        for ((id, _), column) in read.into_iter().zip(filtered) {
            columns[id.index()] = Some(column);
        }
        Ok(columns)
    }

    /// Values and derivatives in some frames of the tail.
    pub fn motion(&self, tail: &Tail, frames: FrameRange) -> SmoothMotion {
        let FrameRange { first, stride, count } = frames;
        let step_s = 1.0 / self.rate_hz;
        let grid = TimeGrid { start_s: first as f64 * step_s, step_s: stride as f64 * step_s, frames: count };
        let places = |origin: isize| (0..count).map(move |i| ((first + i * stride) as isize - origin) as usize);
        let columns: Vec<Option<[Vec<f64>; 3]>> = match tail {
            Tail::Whole { first: origin, motion } => {
                let pick = |series: &Vec<f64>| places(*origin as isize).map(|row| series[row]).collect();
                motion.columns.iter().map(|column| column.as_ref().map(|series| series.each_ref().map(pick))).collect()
            }
            Tail::Filtered { first: origin, columns } => {
                let [first_weights, second_weights] = &self.derivatives;
                let oldest = (first as isize - origin) as usize - NEIGHBOURS;
                let of_column = |column: &Vec<f64>| {
                    // Samples a stride apart side by side, so that the sums of several frames are computed at once.
                    let spread = |offset: usize| column[oldest + offset..].iter().step_by(stride).copied().collect();
                    let apart: Vec<Vec<f64>> = (0..stride).map(spread).collect();
                    let sums = |weights: &[f64]| {
                        let mut sums = vec![0.0; count];
                        for (neighbour, weight) in weights.iter().enumerate() {
                            let near = &apart[neighbour % stride][neighbour / stride..];
                            sums.iter_mut().zip(near).for_each(|(sum, x)| *sum += x * weight);
                        }
                        sums
                    };
                    let values = places(*origin).map(|row| column[row]).collect();
                    [values, sums(first_weights), sums(second_weights)]
                };
                columns.iter().map(|column| column.as_ref().map(of_column)).collect()
            }
        };
        let noise = vec![None; columns.len()];
        SmoothMotion { grid, columns, noise }
    }
}

/// Time after which a filter has forgotten all but [`SETTLED`] of a sample [s].
fn settling_s(filter: LowPass) -> f64 {
    let slowest = TAU * filter.cutoff_hz * sin(PI / (2.0 * filter.order as f64));
    -ln(SETTLED) / slowest
}

/// Weights of the neighbours in the derivatives of a quintic spline: the derivatives of the spline through a single 1.
fn derivatives(rate_hz: f64) -> Result<[Vec<f64>; 2], MotionError> {
    let error = |source| MotionError::Spline { column: "time".to_owned(), source };
    let middle = 2 * NEIGHBOURS;
    let grid = TimeGrid { start_s: 0.0, step_s: 1.0 / rate_hz, frames: 2 * middle + 1 };
    let mut one = vec![0.0; grid.frames];
    one[middle] = 1.0;
    let fitter = SplineFitter::new(SplineDegree::Quintic, &grid.times()).map_err(error)?;
    let spline = fitter.fit(&one, Smoothing::Interpolate).map_err(error)?;
    // The weight of a later neighbour is the derivative before the 1.
    let weights = |order: usize| {
        (0..=2 * NEIGHBOURS).map(|i| spline.derivative(order, grid.time(middle + NEIGHBOURS - i))).collect()
    };
    Ok([weights(1), weights(2)])
}
