//! Foot strikes and foot offs from markers alone, by published methods.
//!
//! | method | strike | off | source |
//! |---|---|---|---|
//! | distance from the pelvis | heel furthest ahead of the pelvis | toe furthest behind it | Zeni, Richards, Higginson 2008 |
//! | vertical velocity | fastest descent of the foot's middle while it is low | fastest rise | O'Connor, Thorpe, O'Malley, Vaughan 2007 |
//! | speed along the floor | heel slower than 0.78 of walking speed | toe faster than 0.66 of it | Ghoussayni 2004, thresholds of Bruening, Ridge 2014 |
//! | acceleration | highest upward acceleration of the heel | highest forward acceleration of the toe | Hreljac, Marshall 2000 |
//!
//! Errors relative to force plates in five walks of four laboratories (tests/laboratory_files.rs): single methods 4 to
//! 63 ms, each with its own bias (strikes early by Zeni, late by Hreljac); their median 1 to 30 ms. In running the offs
//! are 70 ms late.
//!
//! Of Zeni 2008 the abstract and the introduction were read; the others as described in a review (table 1 of "Automatic
//! detection of human gait events: a simple but versatile 3D algorithm", J. NeuroEng. Rehabil. 2025); O'Connor's height
//! limit for the strike is unverified.
//!
//! Who walks backwards lands on the toes and leaves the floor with the heel. Played back, this is a walk forwards
//! (Winter, Pluck, Yang 1989, unverified): the events are those of the recording played back, strikes and offs
//! exchanged.
//!
//! Markers are low-pass filtered first. Speeds are relative to the floor, which moves on a treadmill: the speed of the
//! floor is the speed of low foot markers. Times of extrema come from a parabola through three samples.
//! Pinned by: tests/foot_motion.rs, tests/laboratory_files.rs

mod agreement;
mod methods;
mod signals;

use super::phases::{Contact, contacts_from_events};
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::motion::{Event, EventKind, Landmarks, MarkerRecording};
use crate::numerics::Order;
use agreement::agreed;
use methods::events_of;
use signals::{Foot, floor_speed, foot, mean_path, mean_rate};

/// Speed below which the person is standing [m/s].
const SLOWEST_WALK_M_S: f64 = 0.15;

/// A method that detects foot strikes and foot offs in marker trajectories.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum EventMethod {
    /// Distance of heel and toe from the pelvis.
    PelvisDistance,
    /// Vertical velocity of the middle of the foot.
    FootVelocity,
    /// Speed of heel and toe along the floor.
    FootSpeed,
    /// Acceleration of heel and toe.
    FootAcceleration,
}

impl EventMethod {
    /// All methods.
    pub(crate) const ALL: [EventMethod; 4] =
        [EventMethod::PelvisDistance, EventMethod::FootVelocity, EventMethod::FootSpeed, EventMethod::FootAcceleration];

    /// Name in tables, with its source.
    fn name(self) -> &'static str {
        match self {
            EventMethod::PelvisDistance => "heel and toe relative to pelvis (Zeni 2008)",
            EventMethod::FootVelocity => "vertical velocity of the foot (O'Connor 2007)",
            EventMethod::FootSpeed => "speed of heel and toe (Ghoussayni 2004, Bruening 2014)",
            EventMethod::FootAcceleration => "acceleration of heel and toe (Hreljac 2000)",
        }
    }
}

/// Events and contacts of both feet from markers.
#[derive(Debug, Clone, PartialEq)]
pub struct FootMotion {
    /// Each method whose markers were recorded, with its source, and its events.
    pub by_method: Vec<(&'static str, Vec<Event>)>,
    /// The median over the methods; events that only one of several methods detected are left out.
    pub events: Vec<Event>,
    /// Feet without a heel or toe marker: their events cannot be detected, and the direction of the foot is not known.
    pub feet_without_markers: Vec<Side>,
    /// Contacts of the right and the left foot, from `events`.
    pub contacts: [Vec<Contact>; 2],
    /// Speed of the floor along world x [m/s]: negative on a treadmill.
    pub floor_speed_m_s: f64,
    /// Speed of the pelvis relative to the floor along world x [m/s]; not a number without pelvis markers.
    pub walking_speed_m_s: f64,
}

impl FootMotion {
    /// The events of a recording played back, in the recording; `ends_s` is the sum of its first and last time [s].
    fn played_back(mut self, ends_s: f64) -> FootMotion {
        let back = |events: &mut Vec<Event>| {
            for event in events.iter_mut() {
                let kind = if event.kind == EventKind::Strike { EventKind::Off } else { EventKind::Strike };
                *event = Event { kind, time_s: ends_s - event.time_s, ..*event };
            }
            events.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
        };
        self.by_method.iter_mut().for_each(|(_, events)| back(events));
        back(&mut self.events);
        for contacts in &mut self.contacts {
            *contacts = contacts.iter().rev().map(|contact| contact.played_back(ends_s)).collect();
        }
        self.floor_speed_m_s = -self.floor_speed_m_s;
        self.walking_speed_m_s = -self.walking_speed_m_s;
        self
    }

    /// Contacts of one foot.
    #[must_use]
    pub fn contacts_of(&self, side: Side) -> &[Contact] {
        match side {
            Side::Right => &self.contacts[0],
            Side::Left => &self.contacts[1],
        }
    }
}

/// Detects strikes and offs of both feet. Markers are in the world's axes: x forward, y up.
///
/// Feet without a heel or toe marker are left out, with a note.
#[must_use]
pub fn foot_motion(markers: &MarkerRecording, findings: &mut Findings) -> FootMotion {
    foot_motion_of_landmarks(markers, &Landmarks::find(markers), findings)
}

/// [`foot_motion`] with known landmarks.
#[must_use]
pub(crate) fn foot_motion_of_landmarks(
    markers: &MarkerRecording,
    landmarks: &Landmarks,
    findings: &mut Findings,
) -> FootMotion {
    let found = walking_forwards(markers, landmarks, findings);
    match markers.times[..] {
        [first_s, .., last_s] if found.walking_speed_m_s < -SLOWEST_WALK_M_S => {
            let back = walking_forwards(&played_back(markers), landmarks, &mut Findings::default());
            back.played_back(first_s + last_s)
        }
        _ => found,
    }
}

/// The events of a person who walks forwards, or stands.
fn walking_forwards(markers: &MarkerRecording, landmarks: &Landmarks, findings: &mut Findings) -> FootMotion {
    let feet: Vec<Foot> = Side::BOTH.into_iter().map(|side| foot(markers, landmarks, side)).collect();
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
            events.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
            by_method.push((method.name(), events));
        }
    }
    let bare = feet.iter().filter(|f| f.heel.is_none() || f.toe.is_none());
    let feet_without_markers: Vec<Side> = bare.map(|f| f.side).collect();
    if !feet_without_markers.is_empty() {
        let names: Vec<String> = feet_without_markers.iter().map(Side::to_string).collect();
        let message = format!(
            "the {} foot has no marker on heel or toe; its events were not detected from motion",
            names.join(" and the ")
        );
        findings.report(Code::EventsNoFootMarkers, message);
    }
    let events = agreed(&by_method);
    let contacts = Side::BOTH.map(|side| contacts(markers, &feet, side, &events, walking));
    FootMotion { by_method, events, feet_without_markers, contacts, floor_speed_m_s: floor, walking_speed_m_s: walking }
}

/// The recording from its end to its beginning.
fn played_back(markers: &MarkerRecording) -> MarkerRecording {
    let (Some(first_s), Some(last_s)) = (markers.times.first(), markers.times.last()) else { return markers.clone() };
    let mut back = markers.clone();
    back.times = markers.times.iter().rev().map(|time_s| first_s + last_s - time_s).collect();
    back.markers.iter_mut().for_each(|marker| marker.positions.reverse());
    back
}

/// Contacts from events. While the person stands still, the feet are on the ground all the time.
fn contacts(markers: &MarkerRecording, feet: &[Foot], side: Side, events: &[Event], walking: f64) -> Vec<Contact> {
    let contacts = contacts_from_events(events, side);
    let seen = feet.iter().any(|f| f.side == side && (f.heel.is_some() || f.toe.is_some()));
    let stands = walking.abs() < SLOWEST_WALK_M_S && markers.frames() > 0;
    if contacts.is_empty() && seen && stands {
        return vec![Contact { strike_s: None, off_s: None }];
    }
    contacts
}
