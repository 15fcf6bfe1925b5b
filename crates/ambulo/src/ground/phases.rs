//! When a foot is on the ground, from its vertical force or from a list of events.
//!
//! A foot is loaded while the vertical force exceeds [`CENTER_OF_PRESSURE_LOAD_N`]; the time of crossing is
//! interpolated linearly between two samples. Contacts and breaks shorter than [`SHORTEST_CONTACT_S`] are noise: breaks
//! are closed first, then contacts that remain too short are dropped.

use crate::model::Side;
use crate::motion::force_plate::CENTER_OF_PRESSURE_LOAD_N;
use crate::motion::{Event, EventKind};

/// A contact or a break shorter than this is noise [s]. Contacts of sprinters last about 0.08 s (unverified).
pub const SHORTEST_CONTACT_S: f64 = 0.05;

/// The time from foot strike to foot off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Foot strike [s]; `None` if the foot was loaded when the recording began.
    pub strike_s: Option<f64>,
    /// Foot off [s]; `None` if the foot was still loaded when the recording ended.
    pub off_s: Option<f64>,
}

impl Contact {
    /// Time from strike to off [s]; a missing end is replaced by the given bound.
    #[must_use]
    pub fn span(&self, from_s: f64, to_s: f64) -> [f64; 2] {
        [self.strike_s.unwrap_or(from_s), self.off_s.unwrap_or(to_s)]
    }

    /// The contact of a motion played back; `ends_s` is the sum of the first and the last time of the motion [s].
    pub(crate) fn played_back(self, ends_s: f64) -> Contact {
        let back = |time_s: f64| ends_s - time_s;
        Contact { strike_s: self.off_s.map(back), off_s: self.strike_s.map(back) }
    }
}

/// Contacts from the vertical force on a foot [N] at increasing times [s].
#[must_use]
pub fn contacts_from_force(times: &[f64], vertical: &[f64]) -> Vec<Contact> {
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

/// Time between samples i - 1 and i at which the threshold is crossed [s].
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
        // Cut by an end of the recording: its length is not known.
        _ => true,
    }
}

/// Contacts of one foot from strikes and offs in order of time. An off before the first strike ends a contact that
/// began before the recording. Of several strikes without an off between them the first counts; likewise of several
/// offs.
#[must_use]
pub fn contacts_from_events(events: &[Event], side: Side) -> Vec<Contact> {
    let mut found: Vec<Contact> = Vec::new();
    for event in events.iter().filter(|e| e.side == side) {
        let first = found.is_empty();
        let open = found.last_mut().filter(|c| c.off_s.is_none());
        match (event.kind, open) {
            (EventKind::Off, Some(contact)) => contact.off_s = Some(event.time_s),
            (EventKind::Off, None) if first => {
                found.push(Contact { strike_s: None, off_s: Some(event.time_s) });
            }
            (EventKind::Strike, None) => found.push(Contact { strike_s: Some(event.time_s), off_s: None }),
            (EventKind::Off, None) | (EventKind::Strike, Some(_)) => {}
        }
    }
    found
}
