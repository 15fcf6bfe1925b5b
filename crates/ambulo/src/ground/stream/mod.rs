//! Forces under the feet while the motion still comes in: one frame in, the forces of a frame a little earlier out.
//!
//! The last few seconds are kept. With every frame they are smoothed, and the forces are predicted by the same code as those of a whole
//! recording ([`crate::motion::smooth`], [`predict`]); what it says of the frame at the delay is
//! given out. That frame has only the delay after it: the smoothing ends there, and a stance that lasts longer is as long as the
//! stances before it. docs/STREAMING.md tells what this costs against a whole recording.
//!
//! A coordinate that was not seen is not-a-number. While the newest frame has one nothing can be given out, and the frames that were due
//! then are never given. A gap of at most 0.2 s is then bridged as in a recording; after a longer one the stream begins anew.
//! The first seconds are less certain: nothing is known of earlier stances, and as always, what is not known is not given a small deviation.
//!
//! Memory: the frames of the window, allocated once, and scratch that is given back after each push. Cost of a push: a smoothing and a
//! prediction of the window.
//! Pinned by: tests/ground_stream.rs

mod continuation;
mod error;
mod frame;
mod recent;
mod rhythm;

use super::footfalls::footfalls;
use super::predict::{Known, PredictSettings, Prediction, Weights, predict};
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
use recent::Recent;
use rhythm::Rhythm;

/// Rates that motion is recorded at [Hz].
const RATES_HZ: [f64; 2] = [20.0, 2000.0];
/// A stride at the least; a minute, in which somebody may have turned round, at the most [s].
const WINDOWS_S: [f64; 2] = [1.0, 60.0];
/// A delay is rounded down to whole frames, unless it is this near to one more [frames].
const NEAR_A_FRAME: f64 = 1e-6;
/// A quintic spline needs this many frames.
const FEWEST_FRAMES: usize = 6;

/// How a stream runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreamSettings {
    /// Frames a second that will be pushed [Hz].
    pub rate_hz: f64,
    /// How long after a frame its forces are given out, at most [s].
    pub delay_s: f64,
    /// How much of the motion is kept [s].
    pub window_s: f64,
    /// How the motion is smoothed.
    pub smoother: Smoother,
    /// How much each piece of evidence counts.
    pub weights: Weights,
}

impl StreamSettings {
    /// At this rate, with a delay of 70 ms, a window of 2.5 s, and the low-pass at 6 Hz that recordings have.
    #[must_use]
    pub fn at_rate(rate_hz: f64) -> StreamSettings {
        StreamSettings {
            rate_hz,
            delay_s: 0.07,
            window_s: 2.5,
            smoother: Smoother::Butterworth(LowPass::MOTION),
            weights: Weights::default(),
        }
    }
}

/// Motion in, forces out, frame by frame.
#[derive(Debug, Clone)]
pub struct Stream {
    model: Model,
    soles: BySide<Option<Sole>>,
    smoother: Smoother,
    weights: Weights,
    recent: Recent,
    rhythm: Rhythm,
    /// Frames between what comes in and what goes out.
    delay: usize,
    /// Number of the next frame that may be given out.
    due: usize,
    workspace: Workspace,
    findings: Findings,
}

impl Stream {
    /// A stream for a model; `soles` are those of the right and the left foot.
    ///
    /// # Errors
    /// A rate, delay or window that no stream can have. A model without feet is refused with the first forces.
    pub fn new(model: Model, soles: BySide<Option<Sole>>, settings: &StreamSettings) -> Result<Stream, StreamError> {
        let StreamSettings { rate_hz, delay_s, window_s, smoother, weights } = *settings;
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
        let most = (window_s * rate_hz).round() as usize + 1;
        Ok(Stream {
            recent: Recent::new(&model, rate_hz, most),
            workspace: Workspace::new(&model),
            model,
            soles,
            smoother,
            weights,
            rhythm: Rhythm::default(),
            delay: (delay_s * rate_hz + NEAR_A_FRAME) as usize,
            due: 0,
            findings: Findings::default(),
        })
    }

    /// Takes in the next frame, one value a coordinate of the model [rad or m], not-a-number where it was not seen. Gives out the frame
    /// at the delay; `None` at the beginning and in gaps.
    ///
    /// # Errors
    /// A frame of another length, an infinite value (neither counts as a frame); a model without feet.
    pub fn push(&mut self, q: &[f64]) -> Result<Option<StreamFrame>, StreamError> {
        self.recent.push(&self.model, q)?;
        // From the last complete frame to the next one there is at least one step more than frames are missing.
        if self.recent.missing() > 0 && self.recent.time(self.recent.missing() + 1) > LONGEST_GAP_S {
            self.recent.clear();
            self.due = self.recent.next;
            return Ok(None);
        }
        let newest = self.recent.next - 1;
        let Some(frame) = newest.checked_sub(self.delay).filter(|frame| *frame >= self.due) else { return Ok(None) };
        if self.recent.missing() > 0 {
            return Ok(None);
        }
        let Some(seen) = self.look()? else { return Ok(None) };
        self.due = frame + 1;
        Ok(self.read(&seen, frame))
    }

    /// Gives out the frames inside the delay. They know less of what follows them than others.
    ///
    /// # Errors
    /// As [`Stream::push`].
    pub fn finish(mut self) -> Result<Vec<StreamFrame>, StreamError> {
        if self.recent.missing() > 0 {
            return Ok(Vec::new());
        }
        let Some(seen) = self.look()? else { return Ok(Vec::new()) };
        let first = self.due.max(self.recent.next.saturating_sub(self.delay));
        Ok((first..self.recent.next).filter_map(|frame| self.read(&seen, frame)).collect())
    }

    /// Frames between what comes in and what goes out.
    #[must_use]
    pub fn delay_frames(&self) -> usize {
        self.delay
    }

    /// What was odd in the window that was looked at last.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// Bytes that the kept frames take: as many after the first push as after the last.
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.recent.bytes()
    }

    /// The forces in the window; `None` while it holds too few frames.
    fn look(&mut self) -> Result<Option<(Trajectory, Prediction)>, StreamError> {
        self.recent.forget_leading_gap();
        if self.recent.len() < FEWEST_FRAMES {
            return Ok(None);
        }
        let mut findings = Findings::default();
        let seen = Window { from_s: None, to_s: self.recent.motion().times.last().copied() };
        let settings = SmoothSettings { smoother: self.smoother, window: seen, rate_hz: None };
        let motion = continued(self.recent.motion(), self.recent.time(1));
        let smoothed = smooth(&self.model, &motion, settings, &mut findings)?;
        let trajectory = Trajectory::complete(&self.model, &smoothed, &mut findings)?;
        let mut footfalls = footfalls(&self.model, &trajectory, &self.soles, &mut findings);
        self.rhythm.learn(&footfalls);
        self.rhythm.foretell(&mut footfalls, trajectory.grid());
        let known = Known { footfalls: Some(footfalls), ..Known::default() };
        let settings = PredictSettings { known, weights: self.weights };
        let prediction = predict(&self.model, &trajectory, &self.soles, &settings, &mut findings)?;
        self.findings = findings;
        Ok(Some((trajectory, prediction)))
    }

    /// One frame of what was seen, by its number in the stream; `None` if the window does not hold it.
    fn read(&mut self, seen: &(Trajectory, Prediction), number: usize) -> Option<StreamFrame> {
        let row = number.checked_sub(self.recent.next - self.recent.len())?;
        Some(frame::read(&self.model, &mut self.workspace, seen, row, (number, self.recent.time(number))))
    }
}
