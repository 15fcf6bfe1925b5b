//! Which frames a body is measured on.

use super::sight::Sight;
use crate::findings::{Code, Findings};
use crate::numerics::median;

/// What the person does in the recording that the body is measured on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trial {
    /// Stands still.
    Standing,
    /// Walks or runs.
    Moving,
}

/// Frames that are measured, at most.
const MOST_FRAMES: usize = 100;
/// A standing person's markers move no faster than this [m/s]: sway is a few cm/s.
const QUIET_M_PER_S: f64 = 0.06;
/// Speeds are taken over this time [s].
const SPAN_S: f64 = 0.1;
/// Fewer quiet frames than this are no standing.
const LEAST_QUIET: usize = 5;

/// The frames to measure on, spread over the recording: quiet ones of a person who stands.
pub(super) fn frames(sight: &Sight<'_>, trial: Trial, findings: &mut Findings) -> Vec<usize> {
    let all: Vec<usize> = (0..sight.recording.frames()).collect();
    if trial == Trial::Moving {
        return spread(&all);
    }
    let quiet: Vec<usize> = all.iter().copied().filter(|&frame| is_quiet(sight, frame)).collect();
    if quiet.len() < LEAST_QUIET.min(all.len()) {
        findings.report(
            Code::CalibrationNotStanding,
            format!(
                "in the standing trial the markers move slower than {QUIET_M_PER_S} m/s in only {} of {} frames; all frames were taken. hint: give a trial in which the person stands still, or none",
                quiet.len(),
                all.len()
            ),
        );
        return spread(&all);
    }
    spread(&quiet)
}

/// Every so many, so that at most [`MOST_FRAMES`] are left.
fn spread(frames: &[usize]) -> Vec<usize> {
    let step = frames.len().div_ceil(MOST_FRAMES).max(1);
    frames.iter().copied().step_by(step).collect()
}

/// Whether the middle one of all markers' speeds is small.
fn is_quiet(sight: &Sight<'_>, frame: usize) -> bool {
    let last = sight.recording.frames().saturating_sub(1);
    let rate = sight.recording.rate_hz;
    let reach = if rate > 0.0 && rate.is_finite() { (0.5 * SPAN_S * rate).ceil().clamp(1.0, 1e4) as usize } else { 1 };
    let (from, to) = (frame.saturating_sub(reach), (frame + reach).min(last));
    let times = &sight.recording.times;
    let span = times[to] - times[from];
    if span <= 0.0 {
        return true;
    }
    let speed = |number: usize| Some((sight.place(number, to)? - sight.place(number, from)?).norm() / span);
    median(sight.markers.iter().filter_map(|(_, number)| speed(*number))).is_some_and(|speed| speed < QUIET_M_PER_S)
}
