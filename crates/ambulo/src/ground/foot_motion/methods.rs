//! The published methods, applied to the signals of one foot.

use super::signals::{Foot, axis, rate};
use super::{EventMethod, SLOWEST_WALK_M_S};
use crate::motion::{Event, EventKind, MarkerRecording};
use crate::numerics::elementary::hypot;
use crate::spatial::Vec3;

/// A peak of a distance or a velocity rises above its surroundings by this share of the signal's range.
const PROMINENT: f64 = 0.3;
/// O'Connor 2007: a strike occurs in this lowest part of the range of the heel's height (unverified).
const LOW_PART: f64 = 0.35;
/// Bruening, Ridge 2014: share of the walking speed below which the heel is on the ground.
const HEEL_AT_REST: f64 = 0.78;
/// Bruening, Ridge 2014: share of the walking speed above which the toe has left.
const TOE_LEFT: f64 = 0.66;
/// Accelerations are searched this far before and after an event detected by speed [s].
const NEAR_SPEED_EVENT_S: f64 = 0.08;

/// The events of one foot by one method.
pub(super) fn events_of(
    method: EventMethod,
    markers: &MarkerRecording,
    foot: &Foot,
    pelvis: Option<&[Vec3]>,
    floor: f64,
    walking: f64,
) -> Vec<Event> {
    let (Some(heel), Some(toe)) = (&foot.heel, &foot.toe) else { return Vec::new() };
    // Without pelvis markers the walking speed is not a number, and methods that do not need it still apply.
    if walking.abs() < SLOWEST_WALK_M_S {
        return Vec::new();
    }
    let (strikes, offs) = match method {
        EventMethod::PelvisDistance => {
            let Some(pelvis) = pelvis else { return Vec::new() };
            let ahead = |path: &[Vec3]| path.iter().zip(pelvis).map(|(p, q)| p.x - q.x).collect::<Vec<_>>();
            let behind: Vec<f64> = ahead(toe).iter().map(|x| -x).collect();
            (peaks(&ahead(heel)), peaks(&behind))
        }
        EventMethod::FootVelocity => foot_velocity(heel, toe, markers.rate_hz),
        EventMethod::FootSpeed => foot_speed(markers, heel, toe, floor, walking),
        EventMethod::FootAcceleration => foot_acceleration(markers, heel, toe, floor, walking),
    };
    let event = |kind| move |frame: f64| Event { side: foot.side, kind, time_s: time_at(markers, frame) };
    strikes.into_iter().map(event(EventKind::Strike)).chain(offs.into_iter().map(event(EventKind::Off))).collect()
}

fn foot_velocity(heel: &[Vec3], toe: &[Vec3], rate_hz: f64) -> (Vec<f64>, Vec<f64>) {
    let height: Vec<f64> = heel.iter().zip(toe).map(|(h, t)| 0.5 * (h.y + t.y)).collect();
    let velocity = rate(&height, rate_hz);
    let downward: Vec<f64> = velocity.iter().map(|v| -v).collect();
    let heel = axis(heel, 1);
    let (low, high) = bounds(&heel);
    let is_low = |frame: &f64| heel[(*frame).round() as usize] <= low + LOW_PART * (high - low);
    (peaks(&downward).into_iter().filter(is_low).collect(), peaks(&velocity))
}

fn foot_speed(
    markers: &MarkerRecording,
    heel: &[Vec3],
    toe: &[Vec3],
    floor: f64,
    walking: f64,
) -> (Vec<f64>, Vec<f64>) {
    if walking.is_nan() {
        return (Vec::new(), Vec::new());
    }
    let speed = |path: &[Vec3]| {
        let (x, y) = (rate(&axis(path, 0), markers.rate_hz), rate(&axis(path, 1), markers.rate_hz));
        x.iter().zip(&y).map(|(x, y)| hypot(x - floor, *y)).collect::<Vec<_>>()
    };
    (falls_below(&speed(heel), HEEL_AT_REST * walking.abs()), rises_above(&speed(toe), TOE_LEFT * walking.abs()))
}

/// Extrema of acceleration near the events detected by speed: alone, accelerations have too many extrema.
fn foot_acceleration(
    markers: &MarkerRecording,
    heel: &[Vec3],
    toe: &[Vec3],
    floor: f64,
    walking: f64,
) -> (Vec<f64>, Vec<f64>) {
    let (strikes, offs) = foot_speed(markers, heel, toe, floor, walking);
    let acceleration = |path: &[Vec3], k: usize| rate(&rate(&axis(path, k), markers.rate_hz), markers.rate_hz);
    let reach = NEAR_SPEED_EVENT_S * markers.rate_hz;
    let near = |signal: &[f64], frames: Vec<f64>| -> Vec<f64> {
        frames.into_iter().filter_map(|frame| highest_near(signal, frame, reach)).collect()
    };
    (near(&acceleration(heel, 1), strikes), near(&acceleration(toe, 0), offs))
}

/// Frame of the highest local maximum within `reach` frames.
fn highest_near(signal: &[f64], frame: f64, reach: f64) -> Option<f64> {
    let from = (frame - reach).max(1.0) as usize;
    let to = ((frame + reach) as usize + 1).min(signal.len().saturating_sub(1));
    let is_top = |&i: &usize| signal[i] > signal[i - 1] && signal[i] >= signal[i + 1];
    let top = (from..to).filter(is_top).max_by(|&a, &b| signal[a].total_cmp(&signal[b]))?;
    Some(top as f64 + vertex(signal, top))
}

/// Offset of the vertex of the parabola through three samples [samples].
fn vertex(signal: &[f64], i: usize) -> f64 {
    let bend = signal[i - 1] - 2.0 * signal[i] + signal[i + 1];
    if bend < 0.0 { 0.5 * (signal[i - 1] - signal[i + 1]) / bend } else { 0.0 }
}

/// Frames, with fraction, of the maxima with a prominence of at least [`PROMINENT`] of the range; never the first or
/// last sample.
fn peaks(signal: &[f64]) -> Vec<f64> {
    let (low, high) = bounds(signal);
    let needed = PROMINENT * (high - low);
    let mut found = Vec::new();
    for i in 1..signal.len().saturating_sub(1) {
        let [before, here, after] = [signal[i - 1], signal[i], signal[i + 1]];
        let is_top = here > before && here >= after;
        if is_top
            && is_prominent(signal[..i].iter().rev(), here, needed)
            && is_prominent(signal[i + 1..].iter(), here, needed)
        {
            found.push(i as f64 + vertex(signal, i));
        }
    }
    found
}

/// Whether the signal falls by `needed` before it rises above `top` again.
fn is_prominent<'a>(signal: impl Iterator<Item = &'a f64>, top: f64, needed: f64) -> bool {
    for &x in signal {
        if x > top {
            return false;
        }
        if x <= top - needed {
            return true;
        }
    }
    false
}

fn bounds(signal: &[f64]) -> (f64, f64) {
    let finite = signal.iter().copied().filter(|x| x.is_finite());
    finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)))
}

fn falls_below(signal: &[f64], limit: f64) -> Vec<f64> {
    crossings(signal, limit, |before, after| before >= limit && after < limit)
}

fn rises_above(signal: &[f64], limit: f64) -> Vec<f64> {
    crossings(signal, limit, |before, after| before <= limit && after > limit)
}

fn crossings(signal: &[f64], limit: f64, is: impl Fn(f64, f64) -> bool) -> Vec<f64> {
    let crossing = |i: usize| {
        let (before, after) = (signal[i - 1], signal[i]);
        is(before, after).then(|| (i - 1) as f64 + (limit - before) / (after - before))
    };
    (1..signal.len()).filter_map(crossing).collect()
}

fn time_at(markers: &MarkerRecording, frame: f64) -> f64 {
    let last = markers.frames().saturating_sub(1);
    let i = (frame.max(0.0).floor() as usize).min(last);
    let next = (i + 1).min(last);
    markers.times[i] + (frame - i as f64) * (markers.times[next] - markers.times[i])
}
