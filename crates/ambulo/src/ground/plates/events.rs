//! Combines the events from force plates with events from motion.

use super::{ContactQuality, FeetOnPlates, PlateContact};
use crate::ground::foot_motion::FootMotion;
use crate::model::Side;
use crate::motion::{Event, EventKind};
use crate::numerics::Order;

/// Force and motion show the same event if they differ by less than this [s].
const SAME_EVENT_S: f64 = 0.15;

impl FeetOnPlates {
    /// Strikes and offs that plates measured, in order of time: the ends of clean contacts, and the first and last end
    /// of shared ones. There is no event where the recording cuts a contact.
    #[must_use]
    pub fn force_events(&self, recorded_s: [f64; 2]) -> Vec<Event> {
        let mut out = Vec::new();
        for side in Side::BOTH {
            for [start_s, end_s] in self.measured_stances(side) {
                let event = |kind, time_s| Event { side, kind, time_s };
                out.extend((start_s > recorded_s[0]).then_some(event(EventKind::Strike, start_s)));
                out.extend((end_s < recorded_s[1]).then_some(event(EventKind::Off, end_s)));
            }
        }
        sorted(out)
    }

    /// Events from force where they were measured, from motion elsewhere.
    #[must_use]
    pub fn events(&self, motion: &FootMotion, recorded_s: [f64; 2]) -> Vec<Event> {
        let mut out = self.force_events(recorded_s);
        let stances = Side::BOTH.map(|side| self.measured_stances(side));
        let is_measured = |e: &Event| {
            let near = |f: &Event| f.side == e.side && f.kind == e.kind && (f.time_s - e.time_s).abs() < SAME_EVENT_S;
            let during = stances[usize::from(e.side == Side::Left)].iter().any(|s| s[0] < e.time_s && e.time_s < s[1]);
            out.iter().any(near) || during
        };
        let others: Vec<Event> = motion.events.iter().filter(|e| !is_measured(e)).copied().collect();
        out.extend(others);
        sorted(out)
    }

    /// Times during which plates measured all of a foot's load [s]; several plates under one foot count as one.
    #[must_use]
    pub fn measured_stances(&self, side: Side) -> Vec<[f64; 2]> {
        let whole = |c: &&PlateContact| {
            c.side == Some(side) && matches!(c.quality, ContactQuality::Clean | ContactQuality::Shared)
        };
        let mut spans: Vec<[f64; 2]> = self.contacts.iter().filter(whole).map(|c| [c.start_s, c.end_s]).collect();
        spans.sort_by_number(|span| span[0]);
        let mut merged: Vec<[f64; 2]> = Vec::new();
        for span in spans {
            match merged.last_mut() {
                Some(last) if span[0] <= last[1] => last[1] = last[1].max(span[1]),
                _ => merged.push(span),
            }
        }
        merged
    }
}

fn sorted(mut events: Vec<Event>) -> Vec<Event> {
    events.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    events
}
