//! Foot strikes and toe-offs from markers alone, by published methods.
//!
//! | method | strike | off | source |
//! |---|---|---|---|
//! | [`EventMethod::PelvisDistance`] | heel furthest ahead of the pelvis | toe furthest behind it | Zeni, Richards, Higginson 2008 |
//! | [`EventMethod::FootVelocity`] | fastest descent of the foot's middle while it is low | fastest rise | O'Connor, Thorpe, O'Malley, Vaughan 2007 |
//! | [`EventMethod::FootSpeed`] | heel slower than 0.78 of walking speed | toe faster than 0.66 of it | Ghoussayni 2004, thresholds of Bruening, Ridge 2014 |
//! | [`EventMethod::FootAcceleration`] | heel's highest upward acceleration | toe's highest forward acceleration | Hreljac, Marshall 2000 |
//!
//! Errors against plates in five walks of four laboratories (tests/laboratory_files.rs): the methods alone 4 to 63 ms,
//! each with a bias of its own sign (Zeni's strike early, Hreljac's late); their median 1 to 30 ms. In running the offs
//! are 70 ms late.
//!
//! Of Zeni 2008 the abstract and the introduction were read; the others as a review tells them (table 1 of "Automatic
//! detection of human gait events: a simple but versatile 3D algorithm", J. NeuroEng. Rehabil. 2025); the limit of
//! height for the strike of O'Connor is unverified.
//!
//! Markers are low-passed first. Speeds count from the floor, which moves on a treadmill: its speed is that of the
//! markers of the foot while they are low. The instant of an extreme is that of the parabola through three samples.
//! Pinned by: tests/foot_motion.rs, tests/laboratory_files.rs

use super::phases::{Contact, contacts_of_events};
use crate::findings::Findings;
use crate::model::Side;
use crate::motion::filter::{LowPass, low_pass};
use crate::motion::{Event, EventKind, Landmarks, MarkerRecording};
use crate::spatial::Vec3;

/// Low-pass of the markers.
const FILTER: LowPass = LowPass { order: 2, cutoff_hz: 10.0 };
/// Gaps up to this long are bridged [s].
const LONGEST_GAP_S: f64 = 0.2;
/// A peak of a distance or a velocity stands out by this share of the signal's range.
const PROMINENT: f64 = 0.3;
/// O'Connor 2007: a strike happens in the lower part of the foot's range of height (unverified).
const LOW_PART: f64 = 0.35;
/// Bruening, Ridge 2014: share of the walking speed below which the heel stands.
const HEEL_STANDS: f64 = 0.78;
/// Bruening, Ridge 2014: share of the walking speed above which the toe has left.
const TOE_LEFT: f64 = 0.66;
/// Accelerations are searched this far on both sides of an event by speed [s].
const NEAR_SPEED_EVENT_S: f64 = 0.08;
/// Below this speed nobody walks [m/s].
const SLOWEST_WALK_M_S: f64 = 0.15;
/// A marker this close to its lowest places moves with the floor [m].
const ON_FLOOR_M: f64 = 0.01;
/// Two methods saw the same event if they differ by less than this [s].
const SAME_EVENT_S: f64 = 0.15;

/// A way to find events in markers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventMethod {
    /// Heel and toe against the pelvis.
    PelvisDistance,
    /// Vertical velocity of the middle of the foot.
    FootVelocity,
    /// Speed of heel and toe along the floor.
    FootSpeed,
    /// Acceleration of heel and toe.
    FootAcceleration,
}

impl EventMethod {
    /// All of them.
    pub const ALL: [EventMethod; 4] =
        [EventMethod::PelvisDistance, EventMethod::FootVelocity, EventMethod::FootSpeed, EventMethod::FootAcceleration];

    /// Name for people and tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            EventMethod::PelvisDistance => "heel and toe against pelvis (Zeni 2008)",
            EventMethod::FootVelocity => "vertical velocity of the foot (O'Connor 2007)",
            EventMethod::FootSpeed => "speed of heel and toe (Ghoussayni 2004, Bruening 2014)",
            EventMethod::FootAcceleration => "acceleration of heel and toe (Hreljac 2000)",
        }
    }
}

/// What markers tell of the feet.
#[derive(Debug, Clone, PartialEq)]
pub struct FootMotion {
    /// Events by each method that had its markers.
    pub by_method: Vec<(EventMethod, Vec<Event>)>,
    /// Events that the methods agree on: the median of what they say; those that only one of several saw are left out.
    pub events: Vec<Event>,
    /// Contacts of right and left foot, from `events`.
    pub contacts: [Vec<Contact>; 2],
    /// Speed of the floor along world x [m/s]: negative on a treadmill.
    pub floor_speed_m_s: f64,
    /// Speed of the pelvis over the floor along world x [m/s]; not a number without pelvis markers.
    pub walking_speed_m_s: f64,
}

impl FootMotion {
    /// Contacts of one foot.
    #[must_use]
    pub fn contacts_of(&self, side: Side) -> &[Contact] {
        match side {
            Side::Right => &self.contacts[0],
            Side::Left => &self.contacts[1],
        }
    }
}

/// Filtered signals of one foot, not a number where a marker was not seen.
struct Foot {
    side: Side,
    heel: Option<Vec<Vec3>>,
    toe: Option<Vec<Vec3>>,
}

/// Strikes and offs of both feet. The markers stand in the world's axes: x forward, y up.
///
/// Feet without heel or toe marker are left out, with a note.
#[must_use]
pub fn foot_motion(markers: &MarkerRecording, findings: &mut Findings) -> FootMotion {
    let landmarks = Landmarks::find(markers);
    let feet: Vec<Foot> = Side::BOTH.into_iter().map(|side| foot(markers, &landmarks, side)).collect();
    let pelvis = mean_path(markers, &landmarks.pelvis());
    let floor = floor_speed(markers, &feet);
    let walking = pelvis.as_ref().map_or(f64::NAN, |p| mean_rate(markers, p) - floor);
    let mut by_method = Vec::new();
    for method in EventMethod::ALL {
        let mut events: Vec<Event> = Vec::new();
        for foot in &feet {
            events.extend(events_of(method, markers, foot, pelvis.as_deref(), floor, walking));
        }
        if !events.is_empty() {
            events.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
            by_method.push((method, events));
        }
    }
    let blind: Vec<String> =
        feet.iter().filter(|f| f.heel.is_none() || f.toe.is_none()).map(|f| f.side.to_string()).collect();
    if !blind.is_empty() {
        let message = format!(
            "the {} foot has no marker on heel or toe; its events were not found from motion",
            blind.join(" and the ")
        );
        findings.note("events.no_foot_markers", message);
    }
    let events = agreed(&by_method);
    let contacts = Side::BOTH.map(|side| contacts(markers, &feet, side, &events, walking));
    FootMotion { by_method, events, contacts, floor_speed_m_s: floor, walking_speed_m_s: walking }
}

/// Contacts from events; a foot of somebody who stands is on the ground all the time.
fn contacts(markers: &MarkerRecording, feet: &[Foot], side: Side, events: &[Event], walking: f64) -> Vec<Contact> {
    let contacts = contacts_of_events(events, side);
    let seen = feet.iter().any(|f| f.side == side && (f.heel.is_some() || f.toe.is_some()));
    let stands = walking.abs() < SLOWEST_WALK_M_S && markers.frames() > 0;
    if contacts.is_empty() && seen && stands {
        return vec![Contact { strike_s: None, off_s: None }];
    }
    contacts
}

// ---- signals ----

fn foot(markers: &MarkerRecording, landmarks: &Landmarks, side: Side) -> Foot {
    let of = landmarks.foot(side);
    let path = |marker: Option<usize>| mean_path(markers, &[marker?]);
    Foot { side, heel: path(of.heel.or(of.ankle)), toe: path(of.toe.or(of.side)) }
}

/// Filtered mean of some markers, where all of them were seen.
fn mean_path(markers: &MarkerRecording, chosen: &[usize]) -> Option<Vec<Vec3>> {
    let useful =
        |m: &&usize| 2 * (0..markers.frames()).filter(|&i| markers.markers[**m].is_seen(i)).count() > markers.frames();
    let chosen: Vec<usize> = chosen.iter().filter(useful).copied().collect();
    if chosen.is_empty() {
        return None;
    }
    let mean = |i: usize| chosen.iter().map(|&m| markers.markers[m].positions[i]).sum::<Vec3>() / chosen.len() as f64;
    let columns: [Vec<f64>; 3] = std::array::from_fn(|axis| {
        let column: Vec<f64> = (0..markers.frames()).map(|i| mean(i)[axis]).collect();
        smoothed(&column, markers.rate_hz)
    });
    Some((0..markers.frames()).map(|i| Vec3::new(columns[0][i], columns[1][i], columns[2][i])).collect())
}

/// Low-passed piece by piece; short gaps are bridged by a straight line, long ones stay.
fn smoothed(column: &[f64], rate_hz: f64) -> Vec<f64> {
    let bridged = bridged(column, (LONGEST_GAP_S * rate_hz).round() as usize);
    let mut out = vec![f64::NAN; column.len()];
    let mut start = 0;
    while start < bridged.len() {
        let length = bridged[start..].iter().take_while(|x| x.is_finite()).count();
        let piece = &bridged[start..start + length];
        // A rate too low for the filter needs none.
        let filtered = low_pass(piece, rate_hz, FILTER).unwrap_or_else(|_| piece.to_vec());
        out[start..start + length].copy_from_slice(&filtered);
        start += length.max(1);
    }
    out
}

fn bridged(column: &[f64], longest: usize) -> Vec<f64> {
    let mut out = column.to_vec();
    let known: Vec<usize> = (0..column.len()).filter(|&i| column[i].is_finite()).collect();
    for pair in known.windows(2).filter(|pair| pair[1] - pair[0] > 1 && pair[1] - pair[0] - 1 <= longest) {
        for i in pair[0] + 1..pair[1] {
            let share = (i - pair[0]) as f64 / (pair[1] - pair[0]) as f64;
            out[i] = column[pair[0]] * (1.0 - share) + column[pair[1]] * share;
        }
    }
    out
}

/// Central differences; not a number at the ends and beside gaps.
fn rate(column: &[f64], rate_hz: f64) -> Vec<f64> {
    let inside = |i: usize| match (i.checked_sub(1).and_then(|j| column.get(j)), column.get(i + 1)) {
        (Some(before), Some(after)) => (after - before) * 0.5 * rate_hz,
        _ => f64::NAN,
    };
    (0..column.len()).map(inside).collect()
}

fn axis(path: &[Vec3], axis: usize) -> Vec<f64> {
    path.iter().map(|p| p[axis]).collect()
}

/// Mean rate along x from the first to the last frame that was seen [m/s].
fn mean_rate(markers: &MarkerRecording, path: &[Vec3]) -> f64 {
    let seen = |i: &usize| path[*i].x.is_finite();
    let (first, last) = ((0..path.len()).find(seen), (0..path.len()).rfind(seen));
    match (first, last) {
        (Some(a), Some(b)) if b > a => (path[b].x - path[a].x) / (markers.times[b] - markers.times[a]),
        _ => f64::NAN,
    }
}

/// Speed along x of what the feet stand on: the median over low places of heels and toes [m/s].
fn floor_speed(markers: &MarkerRecording, feet: &[Foot]) -> f64 {
    let mut speeds = Vec::new();
    for path in feet.iter().flat_map(|f| [&f.heel, &f.toe]).flatten() {
        let heights = axis(path, 1);
        let mut sorted: Vec<f64> = heights.iter().copied().filter(|h| h.is_finite()).collect();
        sorted.sort_by(f64::total_cmp);
        let Some(lowest) = sorted.get(sorted.len() / 20) else { continue };
        let speed = rate(&axis(path, 0), markers.rate_hz);
        let low = (0..path.len()).filter(|&i| heights[i] <= lowest + ON_FLOOR_M && speed[i].is_finite());
        speeds.extend(low.map(|i| speed[i]));
    }
    speeds.sort_by(f64::total_cmp);
    speeds.get(speeds.len() / 2).copied().unwrap_or(0.0)
}

// ---- methods ----

fn events_of(
    method: EventMethod,
    markers: &MarkerRecording,
    foot: &Foot,
    pelvis: Option<&[Vec3]>,
    floor: f64,
    walking: f64,
) -> Vec<Event> {
    let (Some(heel), Some(toe)) = (&foot.heel, &foot.toe) else { return Vec::new() };
    // Without a pelvis nobody knows how fast the body goes; the feet may still tell.
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
        x.iter().zip(&y).map(|(x, y)| (x - floor).hypot(*y)).collect::<Vec<_>>()
    };
    (falls_below(&speed(heel), HEEL_STANDS * walking.abs()), rises_above(&speed(toe), TOE_LEFT * walking.abs()))
}

/// The extremes of acceleration next to the events by speed: alone, accelerations have too many extremes.
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

/// Where between the neighbours the parabola through three samples has its top.
fn vertex(signal: &[f64], i: usize) -> f64 {
    let bend = signal[i - 1] - 2.0 * signal[i] + signal[i + 1];
    if bend < 0.0 { 0.5 * (signal[i - 1] - signal[i + 1]) / bend } else { 0.0 }
}

/// Frames of the maxima that stand out by [`PROMINENT`] of the range on both sides, on the parabola through three
/// samples; none within a sample of an end.
fn peaks(signal: &[f64]) -> Vec<f64> {
    let (low, high) = bounds(signal);
    let needed = PROMINENT * (high - low);
    let mut found = Vec::new();
    for i in 1..signal.len().saturating_sub(1) {
        let [before, here, after] = [signal[i - 1], signal[i], signal[i + 1]];
        let is_top = here > before && here >= after;
        if is_top
            && stands_out(signal[..i].iter().rev(), here, needed)
            && stands_out(signal[i + 1..].iter(), here, needed)
        {
            found.push(i as f64 + vertex(signal, i));
        }
    }
    found
}

/// Whether the signal falls by `needed` before it rises above `top` again.
fn stands_out<'a>(signal: impl Iterator<Item = &'a f64>, top: f64, needed: f64) -> bool {
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

// ---- agreement ----

/// The median of what the methods say of each event that at least two of them saw; with one method alone, what it says.
fn agreed(by_method: &[(EventMethod, Vec<Event>)]) -> Vec<Event> {
    if let [(_, alone)] = by_method {
        return alone.clone();
    }
    let mut out = Vec::new();
    for side in Side::BOTH {
        for kind in [EventKind::Strike, EventKind::Off] {
            let of = |(m, list): (usize, &(EventMethod, Vec<Event>))| {
                let same = list.1.iter().filter(|e| e.side == side && e.kind == kind);
                same.map(|e| (e.time_s, m)).collect::<Vec<_>>()
            };
            let mut seen: Vec<(f64, usize)> = by_method.iter().enumerate().flat_map(of).collect();
            seen.sort_by(|a, b| a.0.total_cmp(&b.0));
            let times = groups(&seen).into_iter().filter_map(median_of_methods);
            out.extend(times.map(|time_s| Event { side, kind, time_s }));
        }
    }
    out.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
    out
}

/// Runs of instants that are one event: each close to the first.
fn groups(seen: &[(f64, usize)]) -> Vec<&[(f64, usize)]> {
    let mut groups = Vec::new();
    let mut rest = seen;
    while let Some(first) = rest.first() {
        let (group, after) = rest.split_at(rest.partition_point(|(t, _)| t - first.0 <= SAME_EVENT_S));
        groups.push(group);
        rest = after;
    }
    groups
}

/// Median over the methods, one voice each; `None` if only one spoke.
fn median_of_methods(group: &[(f64, usize)]) -> Option<f64> {
    let voice = |m: usize| group.iter().find(|(_, by)| *by == m).map(|(t, _)| *t);
    let mut times: Vec<f64> = (0..EventMethod::ALL.len()).filter_map(voice).collect();
    times.sort_by(f64::total_cmp);
    let middle = times.len() / 2;
    match times.len() {
        0 | 1 => None,
        n if n % 2 == 1 => Some(times[middle]),
        _ => Some(0.5 * (times[middle - 1] + times[middle])),
    }
}
