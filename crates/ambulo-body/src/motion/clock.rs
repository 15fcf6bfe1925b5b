//! The clock of a recording: the times of its samples, compared with the frame rate that the file states.
//!
//! The time between two samples of a motion lies in [`PLAUSIBLE_S`]. Other values are milliseconds, frames per second
//! in place of seconds per frame, or a broken clock. Times may be rounded until they repeat, or all be zero: the frame
//! number divided by the frame rate is used then.
//!
//! Pinned by: tests/motion_clock.rs

use crate::findings::{Code, Findings};
use crate::numerics::median;

/// Time between two samples of a recorded motion or its forces [s]: 2.5 to 20 000 samples per second.
const PLAUSIBLE_S: [f64; 2] = [5e-5, 0.4];
/// Times agree with a rate if the difference over the whole recording is smaller, as a share.
const SAME: f64 = 0.02;
/// Rates of cameras and films [Hz].
const USUAL_HZ: [f64; 15] =
    [24.0, 25.0, 29.97, 30.0, 48.0, 50.0, 59.94, 60.0, 72.0, 90.0, 100.0, 120.0, 150.0, 200.0, 240.0];

/// Interprets an implausible time between two samples: the quantity that it probably is, and the time in seconds that
/// follows. `None` if the time is plausible.
///
/// At 120 frames per second the step is 0.00833 s; a value of 120 is probably the rate itself, and 8.33 the step in
/// milliseconds.
#[must_use]
pub fn misread_step(step_s: f64) -> Option<(&'static str, f64)> {
    let [shortest, longest] = PLAUSIBLE_S;
    if (shortest..=longest).contains(&step_s) || step_s.is_nan() || step_s <= 0.0 {
        return None;
    }
    let is_usual = |hz: f64| USUAL_HZ.iter().any(|usual| (hz / usual - 1.0).abs() < 0.005);
    let plausible = |seconds: f64| (shortest..=longest).contains(&seconds);
    let choices = [
        ("frames per second", 1.0 / step_s),
        ("milliseconds", 1e-3 * step_s),
        ("microseconds", 1e-6 * step_s),
        ("nanoseconds", 1e-9 * step_s),
    ];
    let usual = choices.iter().find(|(_, seconds)| plausible(*seconds) && is_usual(1.0 / seconds));
    usual.or_else(|| choices[1..].iter().find(|(_, seconds)| plausible(*seconds))).copied()
}

/// The time unit of a column of times with implausible steps: its name, and its length in seconds. `None` if the steps
/// are plausible in seconds.
///
/// The median step of `times` decides, so that some lost samples do not matter. For a stream, any dozen stamps suffice.
#[must_use]
pub fn unit_of_times(times: &[f64]) -> Option<(&'static str, f64)> {
    let step = median(times.windows(2).map(|pair| pair[1] - pair[0]).filter(|step| *step > 0.0))?;
    let (name, seconds) = match misread_step(step)? {
        ("frames per second", _) => ("milliseconds", 1e-3 * step),
        found => found,
    };
    (PLAUSIBLE_S[0]..=PLAUSIBLE_S[1]).contains(&seconds).then_some((name, seconds / step))
}

/// Corrects the times of a table: another unit, times that do not increase, rounded times. Each correction is reported.
/// `frames` has the number of each frame, counted from 1; `stated_hz` is the frame rate in the header, if it has one.
///
/// Other times are returned unchanged.
#[must_use]
pub fn clock_of_table(
    name: &str,
    times: &[f64],
    frames: Option<&[i64]>,
    stated_hz: Option<f64>,
    findings: &mut Findings,
) -> Vec<f64> {
    let name = &if name.is_empty() { "the recording".to_owned() } else { format!("`{name}`") };
    let in_seconds = in_seconds(name, times, findings);
    let times = in_seconds.as_deref().unwrap_or(times);
    let Some(stated_hz) = stated_hz.filter(|rate| rate.is_finite() && *rate > 0.0) else {
        return unrounded(name, times, None, findings).unwrap_or_else(|| times.to_vec());
    };
    if let Some(by_number) = numbered(name, times, frames, stated_hz, findings) {
        return by_number;
    }
    report_other_rate(name, times, stated_hz, findings);
    unrounded(name, times, Some(stated_hz), findings).unwrap_or_else(|| times.to_vec())
}

/// Times in seconds, if they are in another unit.
fn in_seconds(name: &str, times: &[f64], findings: &mut Findings) -> Option<Vec<f64>> {
    let (unit, seconds) = unit_of_times(times)?;
    let step = median(times.windows(2).map(|pair| pair[1] - pair[0]))?;
    let message = format!(
        "{name}: the times are {step:.4} apart, which cannot be the seconds between two samples; they were read as \
         {unit} ({:.2} samples per second). hint: write the times in seconds",
        1.0 / (seconds * step)
    );
    findings.report(Code::MotionClock, message);
    Some(times.iter().map(|time| time * seconds).collect())
}

/// The frame number divided by the frame rate, where the times do not increase at all.
fn numbered(
    name: &str,
    times: &[f64],
    frames: Option<&[i64]>,
    stated_hz: f64,
    findings: &mut Findings,
) -> Option<Vec<f64>> {
    let first = *times.first()?;
    let is_still = times.len() > 1 && times.iter().all(|time| (time - first).abs() < 0.5 / stated_hz);
    if !is_still {
        return None;
    }
    let message = format!(
        "{name}: the times do not increase (all are {first} s); the frame number divided by the stated rate of \
         {stated_hz} Hz was used instead"
    );
    findings.report(Code::MotionClock, message);
    let number = |frame: usize| match frames.and_then(|frames| frames.get(frame)) {
        Some(number) => (number - 1) as f64,
        None => frame as f64,
    };
    Some((0..times.len()).map(|frame| number(frame) / stated_hz).collect())
}

/// Evenly spaced times in place of times that were rounded so coarsely that their steps differ: at the stated rate if
/// the times agree with it, otherwise at the mean rate.
fn unrounded(name: &str, times: &[f64], stated_hz: Option<f64>, findings: &mut Findings) -> Option<Vec<f64>> {
    let (first, last) = (*times.first()?, *times.last()?);
    let steps = times.len().checked_sub(1)? as f64;
    let digit = resolution(times)?;
    let agrees = |stated: &f64| (steps / stated - (last - first)).abs() <= 1.01 * digit;
    let rate_hz = stated_hz.filter(agrees).unwrap_or(steps / (last - first));
    let at = |frame: usize| first + frame as f64 / rate_hz;
    let is_near = (0..times.len()).all(|i| (times[i] - at(i)).abs() <= 1.01 * digit);
    if !is_near || !off_grid(times, rate_hz) || !alternates(times, digit) {
        return None;
    }
    let message = format!(
        "{name}: the times were rounded to {digit} s, too coarse for {rate_hz:.2} samples per second; the frame number \
         divided by this rate was used instead"
    );
    findings.report(Code::MotionClock, message);
    Some((0..times.len()).map(at).collect())
}

/// Whether the steps have two neighbouring lengths that are both frequent, as after rounding. A repeated row changes
/// only one step.
fn alternates(times: &[f64], digit: f64) -> bool {
    const OFTEN: f64 = 0.03;
    const FEWEST: usize = 12;
    let lengths: Vec<i64> = times.windows(2).map(|pair| ((pair[1] - pair[0]) / digit).round() as i64).collect();
    let (Some(least), Some(most)) = (lengths.iter().min(), lengths.iter().max()) else { return false };
    let share = |length: &i64| lengths.iter().filter(|other| *other == length).count() as f64 / lengths.len() as f64;
    lengths.len() >= FEWEST && *least >= 0 && most - least == 1 && share(least).min(share(most)) > OFTEN
}

/// Whether times differ from an even clock by a share of a step that matters for velocities.
fn off_grid(times: &[f64], rate_hz: f64) -> bool {
    const LARGEST: f64 = 0.06;
    times.iter().enumerate().any(|(i, time)| (time - times[0] - i as f64 / rate_hz).abs() * rate_hz > LARGEST)
}

/// The rounding of times [s]: the power of ten of which all are multiples; `None` if it is finer than 0.1 ms.
fn resolution(times: &[f64]) -> Option<f64> {
    let is_multiple = |digits: i32| {
        let scale = 10_f64.powi(digits);
        times.iter().all(|time| (time * scale - (time * scale).round()).abs() < 1e-6 * scale)
    };
    (0..=4).find(|digits| is_multiple(*digits)).map(|digits| 10_f64.powi(-digits))
}

/// Reports even times that contradict the stated rate. The times are used.
fn report_other_rate(name: &str, times: &[f64], stated_hz: f64, findings: &mut Findings) {
    let Some((first, last)) = times.first().zip(times.last()).filter(|(first, last)| last > first) else { return };
    let rate_hz = (times.len() - 1) as f64 / (last - first);
    // Lost samples make times longer than the rate states; their steps do not.
    let step_hz = median(times.windows(2).map(|pair| pair[1] - pair[0])).map_or(rate_hz, f64::recip);
    let differs = |hz: f64| (hz / stated_hz - 1.0).abs() > SAME;
    if differs(rate_hz) && differs(step_hz) {
        let message = format!(
            "{name}: the header states {stated_hz} samples per second, but by the times there are {rate_hz:.2}; the \
             times were used. hint: every speed and force depends on it; correct the one that is wrong"
        );
        findings.report(Code::MotionClock, message);
    }
}
