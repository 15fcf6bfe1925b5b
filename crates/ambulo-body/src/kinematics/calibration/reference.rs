//! Selects the frames for a calibration.

use super::landmark_trajectories::LandmarkTrajectories;
use crate::findings::{Code, Findings};
use crate::numerics::{median, sampled};

/// Kind of recording for a calibration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trial {
    /// Standing still.
    Standing,
    /// The person walks or runs.
    Moving,
}

/// Largest number of frames used.
const MOST_FRAMES: usize = 100;
/// Largest marker speed in quiet standing [m/s]: sway is a few cm/s.
const QUIET_M_PER_S: f64 = 0.06;
/// Time interval for speeds [s].
const SPAN_S: f64 = 0.1;
/// Smallest number of quiet frames in a standing trial.
const LEAST_QUIET: usize = 5;

/// Selects frames spread over the recording; only quiet ones of a standing trial.
pub(super) fn frames(trajectories: &LandmarkTrajectories<'_>, trial: Trial, findings: &mut Findings) -> Vec<usize> {
    let all: Vec<usize> = (0..trajectories.recording.frames()).collect();
    if trial == Trial::Moving {
        return some(&all);
    }
    let quiet: Vec<usize> = all.iter().copied().filter(|&frame| is_quiet(trajectories, frame)).collect();
    if quiet.len() < LEAST_QUIET.min(all.len()) {
        findings.report(
            Code::CalibrationNotStanding,
            format!(
                "in the standing trial the markers move slower than {QUIET_M_PER_S} m/s in only {} of {} frames; all \
                 frames were used. hint: use a trial in which the person stands still, or none",
                quiet.len(),
                all.len()
            ),
        );
        return some(&all);
    }
    some(&quiet)
}

/// At most [`MOST_FRAMES`] of these frames.
fn some(frames: &[usize]) -> Vec<usize> {
    sampled(frames.len(), MOST_FRAMES).map(|k| frames[k]).collect()
}

/// Whether the median speed of all markers is small.
fn is_quiet(trajectories: &LandmarkTrajectories<'_>, frame: usize) -> bool {
    let last = trajectories.recording.frames().saturating_sub(1);
    let rate = trajectories.recording.rate_hz;
    let reach = if rate > 0.0 && rate.is_finite() { (0.5 * SPAN_S * rate).ceil().clamp(1.0, 1e4) as usize } else { 1 };
    let (from, to) = (frame.saturating_sub(reach), (frame + reach).min(last));
    let times = &trajectories.recording.times;
    let span = times[to] - times[from];
    if span <= 0.0 {
        return true;
    }
    let speed =
        |number: usize| Some((trajectories.place(number, to)? - trajectories.place(number, from)?).norm() / span);
    median(trajectories.markers.iter().filter_map(|(_, number)| speed(*number)))
        .is_some_and(|speed| speed < QUIET_M_PER_S)
}
