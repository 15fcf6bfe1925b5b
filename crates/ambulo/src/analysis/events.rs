//! Foot strikes and toe-offs, from the vertical force that a foot carries.
//!
//! A foot is loaded while the vertical force exceeds [`CENTER_OF_PRESSURE_LOAD_N`]; the instant of crossing is found on the
//! straight line between two samples. Contacts and breaks shorter than [`SHORTEST_CONTACT_S`] are noise: breaks are
//! closed first, then contacts that remain too short are dropped.

use crate::ground::CENTER_OF_PRESSURE_LOAD_N;
use crate::model::Side;

/// A contact or a break shorter than this is noise [s]. Sprinters' contacts last about 0.08 s (unverified).
pub const SHORTEST_CONTACT_S: f64 = 0.05;

/// A time during which a foot was loaded.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Foot strike [s]; `None` if the foot was loaded when the recording began.
    pub strike_s: Option<f64>,
    /// Toe-off [s]; `None` if the foot was still loaded when it ended.
    pub off_s: Option<f64>,
}

/// What happened.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EventKind {
    /// The foot meets the ground.
    Strike,
    /// The foot leaves the ground.
    Off,
}

/// A foot strike or a toe-off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Which foot.
    pub side: Side,
    /// What happened.
    pub kind: EventKind,
    /// When [s].
    pub time_s: f64,
}

impl EventKind {
    /// `strike` or `off`, as `events.csv` has it.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            EventKind::Strike => "strike",
            EventKind::Off => "off",
        }
    }
}

/// Contacts from a foot's vertical force [N] at rising instants [s].
#[must_use]
pub fn contacts(times: &[f64], vertical: &[f64]) -> Vec<Contact> {
    let mut found: Vec<Contact> = Vec::new();
    let mut loaded = false;
    for i in 0..times.len().min(vertical.len()) {
        let now = vertical[i] > CENTER_OF_PRESSURE_LOAD_N;
        if now == loaded {
            continue;
        }
        loaded = now;
        let crossing = (i > 0).then(|| crossing(times, vertical, i));
        match (now, found.last_mut()) {
            (true, _) => found.push(Contact { strike_s: crossing, off_s: None }),
            (false, Some(contact)) => contact.off_s = crossing,
            (false, None) => {}
        }
    }
    close_breaks(found).into_iter().filter(is_long_enough).collect()
}

/// Instant between samples i - 1 and i at which the threshold is crossed [s].
fn crossing(times: &[f64], vertical: &[f64], i: usize) -> f64 {
    let (before, after) = (vertical[i - 1], vertical[i]);
    let share = (CENTER_OF_PRESSURE_LOAD_N - before) / (after - before);
    times[i - 1] + share * (times[i] - times[i - 1])
}

fn close_breaks(found: Vec<Contact>) -> Vec<Contact> {
    let mut out: Vec<Contact> = Vec::new();
    for contact in found {
        match (out.last_mut(), contact.strike_s) {
            (Some(last), Some(strike)) if last.off_s.is_some_and(|off| strike - off < SHORTEST_CONTACT_S) => {
                last.off_s = contact.off_s;
            }
            _ => out.push(contact),
        }
    }
    out
}

fn is_long_enough(contact: &Contact) -> bool {
    match (contact.strike_s, contact.off_s) {
        (Some(strike), Some(off)) => off - strike >= SHORTEST_CONTACT_S,
        // Cut by the end of the recording: its length is not known.
        _ => true,
    }
}

/// The events of both feet in order of time.
#[must_use]
pub fn events(contacts: &[(Side, Vec<Contact>)]) -> Vec<Event> {
    let mut list = Vec::new();
    for (side, contacts) in contacts {
        for contact in contacts {
            let event = |kind, time_s| Event { side: *side, kind, time_s };
            list.extend(contact.strike_s.map(|t| event(EventKind::Strike, t)));
            list.extend(contact.off_s.map(|t| event(EventKind::Off, t)));
        }
    }
    list.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
    list
}
