//! Predicts forces while the motion is being recorded: takes one frame, returns the forces in a slightly earlier frame.
//!
//! The last few seconds are kept. Later frames change only the newest half second of the smoothed motion, so that the
//! motion of feet and mass centre is kept for the frames before it. At every frame the newest part is smoothed, stances
//! are detected in the window, and the forces are predicted in the frame at the delay by the code for whole recordings,
//! from the steps around it. Only the frames of the delay follow it: the smoothing ends there, and the duration of a
//! stance that has not ended is estimated from earlier stances. docs/STREAMING.md compares the errors with the errors
//! for a whole recording.
//!
//! A missing coordinate is passed as not-a-number. While the newest frame has one, no forces are returned, and those
//! frames are never returned later. A gap of at most 0.2 s is interpolated as in a recording; after a longer one the
//! stream starts again. The first seconds are less accurate, because earlier stances are not known; their standard
//! deviations are larger accordingly.
//!
//! Memory: the frames of the window, allocated once, and scratch memory that is freed after each push. Cost of a push:
//! constant once the window is full, however long the stream runs.
//! Pinned by: tests/ground_stream.rs

pub(crate) mod continuation;
mod error;
mod frame;
pub(crate) mod frame_buffer;
mod settled;
pub(crate) mod step_timing;
pub(crate) mod tail;

use super::footfalls::{OffSpeed, detect};
use super::predict::{FittedParameters, KnownMotion, PredictSettings, Prediction, both_soles, predict_frames};
use crate::dynamics::Workspace;
use crate::findings::Findings;
use crate::kinematics::{Posture, Trajectory, TrajectoryError};
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use crate::motion::filter::LowPass;
use crate::motion::gaps::LONGEST_GAP_S;
use crate::motion::{LiveChecks, Smoother, TimeGrid};
pub use error::StreamError;
#[doc(hidden)]
pub use frame::LoadDeviation;
pub use frame::{FootLoad, StreamFrame};
use frame_buffer::FrameBuffer;
use settled::{SettledFrames, body_frames, window};
use step_timing::StepTiming;
use tail::{FrameRange, Tail, TailSmoother};

/// Lowest and highest frame rate [Hz].
const RATES_HZ: [f64; 2] = [20.0, 2000.0];
/// Shortest and longest window [s]: one stride; a minute.
const WINDOWS_S: [f64; 2] = [1.0, 60.0];
/// A delay is rounded down to whole frames, unless it is this close to the next one [frames].
const NEAR_A_FRAME: f64 = 1e-6;
/// The prediction uses every n-th frame where that leaves at least this rate [Hz]: of a motion filtered at 6 Hz more
/// frames contain no more information.
const WORKING_RATE_HZ: f64 = 100.0;
/// Number of frames that a quintic spline needs.
const FEWEST_FRAMES: usize = 6;

/// Settings of a [`Stream`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreamSettings {
    /// Frame rate of the motion [Hz].
    pub rate_hz: f64,
    /// Longest time from a frame to its forces [s].
    pub delay_s: f64,
    /// Duration of the motion that is kept [s].
    pub window_s: f64,
    /// How the motion is smoothed.
    pub smoother: Smoother,
    /// Parameters of the prediction.
    pub parameters: FittedParameters,
}

impl StreamSettings {
    /// Defaults at a frame rate: a delay of 70 ms, a window of 2.5 s, and the low-pass filter of recordings, 6 Hz.
    #[must_use]
    pub fn at_rate(rate_hz: f64) -> StreamSettings {
        StreamSettings {
            rate_hz,
            delay_s: 0.07,
            window_s: 2.5,
            smoother: Smoother::Butterworth(LowPass::MOTION),
            parameters: FittedParameters::default(),
        }
    }
}

/// Predicts forces frame by frame from a motion that is still being recorded.
#[derive(Debug, Clone)]
pub struct Stream {
    model: Model,
    soles: BySide<Option<Sole>>,
    smoother: TailSmoother,
    motion_filter: Option<LowPass>,
    parameters: FittedParameters,
    buffer: FrameBuffer,
    settled: SettledFrames,
    /// Frames of the motion from one frame of the prediction to the next.
    stride: usize,
    step_timing: StepTiming,
    /// Delay of the results [frames].
    delay: usize,
    /// Number of the next frame that may be returned.
    due: usize,
    workspace: Workspace,
    checks: LiveChecks,
    /// The newest frame without whole turns.
    frame: Vec<f64>,
    findings: Findings,
}

impl Stream {
    /// Starts a stream for a model.
    ///
    /// # Errors
    /// A rate, delay or window out of range. A model without feet is rejected at the first prediction.
    pub fn new(model: Model, soles: BySide<Option<Sole>>, settings: &StreamSettings) -> Result<Stream, StreamError> {
        let StreamSettings { rate_hz, delay_s, window_s, smoother, parameters } = *settings;
        let ([lowest_hz, highest_hz], [shortest_s, longest_s]) = (RATES_HZ, WINDOWS_S);
        if !(lowest_hz..=highest_hz).contains(&rate_hz) {
            return Err(StreamError::Rate { found_hz: rate_hz, lowest_hz, highest_hz });
        }
        if !(shortest_s..=longest_s).contains(&window_s) {
            return Err(StreamError::Window { found_s: window_s, shortest_s, longest_s });
        }
        if !(0.0..=0.5 * window_s).contains(&delay_s) {
            return Err(StreamError::Delay { found_s: delay_s, longest_s: 0.5 * window_s });
        }
        let capacity = (window_s * rate_hz).round() as usize + 1;
        Ok(Stream {
            buffer: FrameBuffer::new(&model, rate_hz, capacity),
            workspace: Workspace::new(&model),
            checks: LiveChecks::new(&model, rate_hz),
            frame: Vec::with_capacity(model.coordinates().len()),
            model,
            soles,
            smoother: TailSmoother::new(smoother, rate_hz, capacity)?,
            motion_filter: smoother.low_pass(),
            settled: SettledFrames::with_capacity(capacity),
            stride: ((rate_hz / WORKING_RATE_HZ + NEAR_A_FRAME) as usize).max(1),
            parameters,
            step_timing: StepTiming::default(),
            delay: (delay_s * rate_hz + NEAR_A_FRAME) as usize,
            due: 0,
            findings: Findings::default(),
        })
    }

    /// Adds the next frame, one value per coordinate of the model [rad or m], not-a-number where it is missing. Returns
    /// the forces in the frame at the delay; `None` at the beginning and in gaps.
    ///
    /// # Errors
    /// A frame of another length, an infinite value (neither counts as a frame); a model without feet.
    ///
    /// ```
    /// use ambulo::analysis::feasibility::Person;
    /// use ambulo::ground::stream::{Stream, StreamSettings};
    /// use ambulo::model::anthropometry::{Build, SegmentTable};
    ///
    /// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
    /// let human = build.human()?;
    /// let upright = vec![0.0; human.model.coordinates().len()];
    /// let soles = Person::of_human(&human).soles;
    /// let mut stream = Stream::new(human.model, soles, &StreamSettings::at_rate(100.0))?;
    /// for _ in 0..7 {
    ///     assert!(stream.push(&upright)?.is_none(), "the delay is 70 ms");
    /// }
    /// let frame = stream.push(&upright)?.ok_or("no forces yet")?;
    /// assert!(frame.time_s.abs() < 1e-9, "the forces of the first frame");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn push(&mut self, q: &[f64]) -> Result<Option<StreamFrame>, StreamError> {
        self.frame.clear();
        self.frame.extend_from_slice(q);
        self.buffer.check(&self.model, q)?;
        self.checks.take(&self.model, &mut self.frame);
        self.buffer.push(&self.model, &self.frame);
        // The gap, from one complete frame to the next, is at least one step longer than the number of missing frames.
        if self.buffer.missing() > 0 && self.buffer.time(self.buffer.missing() + 1) > LONGEST_GAP_S {
            self.buffer.clear();
            self.settled.forget_before(self.buffer.next);
            self.due = self.buffer.next;
            return Ok(None);
        }
        let newest = self.buffer.next - 1;
        let Some(frame) = newest.checked_sub(self.delay).filter(|frame| *frame >= self.due) else { return Ok(None) };
        if self.buffer.missing() > 0 {
            return Ok(None);
        }
        let forces = self.forces_in(frame)?;
        if forces.is_some() {
            self.due = frame + 1;
        }
        Ok(forces)
    }

    /// Returns the remaining frames, which are within the delay. They are less accurate because less motion follows
    /// them.
    ///
    /// # Errors
    /// As [`Stream::push`].
    pub fn finish(mut self) -> Result<Vec<StreamFrame>, StreamError> {
        if self.buffer.missing() > 0 {
            return Ok(Vec::new());
        }
        let first = self.due.max(self.buffer.next.saturating_sub(self.delay));
        (first..self.buffer.next).filter_map(|frame| self.forces_in(frame).transpose()).collect()
    }

    /// Delay of the results [frames].
    #[must_use]
    pub fn delay_frames(&self) -> usize {
        self.delay
    }

    /// Number of values of a frame that are read: values of coordinates that nothing else determines.
    #[must_use]
    pub fn values(&self) -> usize {
        self.buffer.motion().columns.iter().flatten().count()
    }

    /// Findings of the latest window.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Doubts about the motion since its start, each once: units, jumps, angles out of range.
    #[must_use]
    pub fn doubts(&self) -> &Findings {
        self.checks.findings()
    }

    /// Memory of the kept frames [bytes]: constant from the first push to the last.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.buffer.bytes() + self.settled.bytes()
    }

    /// The forces in one frame, by its number in the stream; `None` while the window has too few frames.
    fn forces_in(&mut self, frame: usize) -> Result<Option<StreamFrame>, StreamError> {
        self.buffer.forget_leading_gap();
        let oldest = self.buffer.next - self.buffer.len();
        self.settled.forget_before(oldest);
        if self.buffer.fewest_values(FEWEST_FRAMES) < FEWEST_FRAMES || frame < oldest {
            return Ok(None);
        }
        let soles = both_soles(&self.model, &self.soles)?;
        let mut findings = Findings::default();
        let unsettled = self.settled.next;
        let tail = self.smoother.smooth(&self.model, &self.buffer, unsettled, &mut findings)?;
        let settles = self.smoother.settles(self.delay).unwrap_or(usize::MAX);
        if let Some(count) = (self.buffer.next - unsettled).checked_sub(settles).filter(|count| *count > 0) {
            let trajectory =
                self.trajectory(&tail, FrameRange { first: unsettled, stride: 1, count }, &mut findings)?;
            self.settled.extend(body_frames(&self.model, &soles, &trajectory), oldest);
        }
        // The frame is one of the window, all others of which are a multiple of the stride from it.
        let first = self.settled.next + (frame - self.settled.next) % self.stride;
        let range = FrameRange { first, stride: self.stride, count: (self.buffer.next - first).div_ceil(self.stride) };
        let trajectory = self.trajectory(&tail, range, &mut findings)?;
        let prediction = self.predict_window(&soles, &trajectory, range, frame, &mut findings)?;
        self.findings = findings;
        let place = (frame - first) / self.stride;
        let column = |part: usize| trajectory.columns().iter().map(|c| c[part][place]).collect::<Vec<f64>>();
        let (q, qd, qdd) = (column(0), column(1), column(2));
        let posture = Posture { q: &q, qd: &qd, qdd: &qdd };
        let at = (frame, self.buffer.time(frame));
        let (prediction, row) = &prediction;
        Ok(Some(frame::read(&self.model, &mut self.workspace, posture, (prediction, *row), at)))
    }

    fn trajectory(
        &self,
        tail: &Tail,
        frames: FrameRange,
        findings: &mut Findings,
    ) -> Result<Trajectory, TrajectoryError> {
        Trajectory::complete(&self.model, self.smoother.motion(tail, frames), findings)
    }

    /// Predicts the forces in a frame from the settled frames and the newest ones; also returns the row of the frame in
    /// the window.
    fn predict_window(
        &mut self,
        soles: &BySide<Sole>,
        newest: &Trajectory,
        range: FrameRange,
        frame: usize,
        findings: &mut Findings,
    ) -> Result<(Prediction, usize), StreamError> {
        let newest = body_frames(&self.model, soles, newest);
        let (first, settled) = self.settled.before(range.first, range.stride);
        let grid = TimeGrid {
            start_s: self.buffer.time(first),
            step_s: self.buffer.time(range.stride),
            frames: (range.first - first) / range.stride + range.count,
        };
        let (signals, geometry, total) = window(&self.model, &self.soles, grid, settled.chain(&newest));
        let mut footfalls = detect(&signals, OffSpeed::default(), findings);
        self.step_timing.update(&footfalls);
        self.step_timing.extrapolate(&mut footfalls, grid);
        let settings = PredictSettings {
            parameters: self.parameters,
            motion_filter: self.motion_filter,
            ..PredictSettings::default()
        };
        let row = (frame - first) / range.stride;
        let motion = KnownMotion { grid, geometry, total, footfalls };
        Ok((predict_frames(&self.model, soles, motion, &settings, row..row + 1)?, row))
    }
}
