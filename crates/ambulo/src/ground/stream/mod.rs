//! Predicts forces while the motion is being recorded: takes one frame, returns the forces in a slightly earlier frame.
//!
//! The last few seconds are kept. At every frame they are smoothed, and the forces are predicted by the same code as those of a whole
//! recording ([`crate::motion::smooth`], [`predict`]); the frame at the delay is returned. Only the frames of the delay follow it:
//! the smoothing ends there, and the duration of a stance that has not ended is estimated from earlier stances. docs/STREAMING.md
//! compares the errors with those of a whole recording.
//!
//! A missing coordinate is passed as not-a-number. While the newest frame has one, no forces are returned, and those frames are
//! never returned later. A gap of at most 0.2 s is interpolated as in a recording; after a longer one the stream starts again.
//! The first seconds are less accurate, because earlier stances are not known; their standard deviations are larger accordingly.
//!
//! Memory: the frames of the window, allocated once, and scratch memory that is freed after each push. Cost of a push: one smoothing
//! and one prediction of the window.
//! Pinned by: tests/ground_stream.rs

mod continuation;
mod error;
mod frame;
mod frame_buffer;
mod step_timing;

use super::footfalls::footfalls;
use super::predict::{FittedParameters, PredictSettings, Prediction, Prescribed, predict};
use crate::dynamics::Workspace;
use crate::findings::Findings;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use crate::motion::filter::LowPass;
use crate::motion::gaps::LONGEST_GAP_S;
use crate::motion::{SmoothSettings, Smoother, Window, smooth};
use continuation::continued;
pub use error::StreamError;
pub use frame::{FootLoad, LoadDeviation, StreamFrame};
use frame_buffer::FrameBuffer;
use step_timing::StepTiming;

/// Lowest and highest frame rate [Hz].
const RATES_HZ: [f64; 2] = [20.0, 2000.0];
/// Shortest and longest window [s]: one stride; a minute.
const WINDOWS_S: [f64; 2] = [1.0, 60.0];
/// A delay is rounded down to whole frames, unless it is this close to the next one [frames].
const NEAR_A_FRAME: f64 = 1e-6;
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
    smoother: Smoother,
    parameters: FittedParameters,
    buffer: FrameBuffer,
    step_timing: StepTiming,
    /// Delay of the results [frames].
    delay: usize,
    /// Number of the next frame that may be returned.
    due: usize,
    workspace: Workspace,
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
            model,
            soles,
            smoother,
            parameters,
            step_timing: StepTiming::default(),
            delay: (delay_s * rate_hz + NEAR_A_FRAME) as usize,
            due: 0,
            findings: Findings::default(),
        })
    }

    /// Adds the next frame, one value per coordinate of the model [rad or m], not-a-number where it is missing. Returns the forces in
    /// the frame at the delay; `None` at the beginning and in gaps.
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
        self.buffer.push(&self.model, q)?;
        // The gap, from one complete frame to the next, is at least one step longer than the number of missing frames.
        if self.buffer.missing() > 0 && self.buffer.time(self.buffer.missing() + 1) > LONGEST_GAP_S {
            self.buffer.clear();
            self.due = self.buffer.next;
            return Ok(None);
        }
        let newest = self.buffer.next - 1;
        let Some(frame) = newest.checked_sub(self.delay).filter(|frame| *frame >= self.due) else { return Ok(None) };
        if self.buffer.missing() > 0 {
            return Ok(None);
        }
        let Some(window) = self.predict_window()? else { return Ok(None) };
        self.due = frame + 1;
        Ok(self.read(&window, frame))
    }

    /// Returns the remaining frames, those of the delay. They are less accurate because less motion follows them.
    ///
    /// # Errors
    /// As [`Stream::push`].
    pub fn finish(mut self) -> Result<Vec<StreamFrame>, StreamError> {
        if self.buffer.missing() > 0 {
            return Ok(Vec::new());
        }
        let Some(window) = self.predict_window()? else { return Ok(Vec::new()) };
        let first = self.due.max(self.buffer.next.saturating_sub(self.delay));
        Ok((first..self.buffer.next).filter_map(|frame| self.read(&window, frame)).collect())
    }

    /// Delay of the results [frames].
    #[must_use]
    pub fn delay_frames(&self) -> usize {
        self.delay
    }

    /// Findings of the latest window.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Memory of the kept frames [bytes]: constant from the first push to the last.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.buffer.bytes()
    }

    /// Predicts the forces in the window; `None` while it has too few frames.
    fn predict_window(&mut self) -> Result<Option<(Trajectory, Prediction)>, StreamError> {
        self.buffer.forget_leading_gap();
        if self.buffer.len() < FEWEST_FRAMES {
            return Ok(None);
        }
        let mut findings = Findings::default();
        let all = Window { from_s: None, to_s: self.buffer.motion().times.last().copied() };
        let settings = SmoothSettings { smoother: self.smoother, window: all, rate_hz: None };
        let motion = continued(self.buffer.motion(), self.buffer.time(1));
        let smoothed = smooth(&self.model, &motion, settings, &mut findings)?;
        let trajectory = Trajectory::complete(&self.model, smoothed, &mut findings)?;
        let mut footfalls = footfalls(&self.model, &trajectory, &self.soles, &mut findings);
        self.step_timing.update(&footfalls);
        self.step_timing.extrapolate(&mut footfalls, trajectory.grid());
        let prescribed = Prescribed { footfalls: Some(footfalls), ..Prescribed::default() };
        let settings = PredictSettings {
            prescribed,
            parameters: self.parameters,
            person: None,
            motion_filter: self.smoother.low_pass(),
        };
        let prediction = predict(&self.model, &trajectory, &self.soles, &settings, &mut findings)?;
        self.findings = findings;
        Ok(Some((trajectory, prediction)))
    }

    /// The forces in one frame, by its number in the stream; `None` if it is outside the window.
    fn read(&mut self, window: &(Trajectory, Prediction), number: usize) -> Option<StreamFrame> {
        let row = number.checked_sub(self.buffer.next - self.buffer.len())?;
        Some(frame::read(&self.model, &mut self.workspace, window, row, (number, self.buffer.time(number))))
    }
}
