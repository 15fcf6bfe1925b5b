//! Foot strikes and foot offs, and reading them from C3D files.

use crate::findings::{Code, Findings, word};
use crate::model::Side;
use crate::numerics::Order;
use ambulo_formats::c3d::C3d;
use std::fmt;

/// Events of one kind and side closer than this are the same event [s].
const REPEATED_S: f64 = 0.005;

/// The kind of a gait event.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum EventKind {
    /// Foot strike.
    Strike,
    /// Foot off.
    Off,
}

/// A foot strike or a foot off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// Which foot.
    pub side: Side,
    /// Strike or off.
    pub kind: EventKind,
    /// Time [s].
    pub time_s: f64,
}

impl EventKind {
    /// `strike` or `off`, as in `events.csv`.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// Reads the foot strikes and foot offs of a C3D file, in order of time. Other events, and those without a side, are
/// reported in a note.
#[must_use]
pub fn events_from_c3d(file: &C3d, findings: &mut Findings) -> Vec<Event> {
    let mut found = Vec::new();
    for event in &file.events {
        match (kind_of(&event.label), side_of(&event.context, &event.label)) {
            (Some(kind), Some(side)) if event.time_s.is_finite() => {
                found.push(Event { side, kind, time_s: event.time_s });
            }
            _ => {
                let message = format!(
                    "the file's event `{}` of `{}` is not a foot strike or foot off of a side; it was not used",
                    event.label, event.context
                );
                findings.report(Code::EventsNotUsed, message);
            }
        }
    }
    found.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    without_repetitions(found)
}

/// Removes repetitions: old programs write every event twice, into the header as well.
fn without_repetitions(events: Vec<Event>) -> Vec<Event> {
    let mut kept: Vec<Event> = Vec::new();
    for event in events {
        let same = |e: &Event| e.side == event.side && e.kind == event.kind && event.time_s - e.time_s < REPEATED_S;
        if !kept.iter().any(same) {
            kept.push(event);
        }
    }
    kept
}

/// `Foot Strike`, `Heel Strike`, `RHS`, `RON`; `Foot Off`, `Toe Off`, `RTO`, `ROFF`.
fn kind_of(label: &str) -> Option<EventKind> {
    let plain: String = label.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect();
    let short = plain.strip_prefix(['r', 'l']).unwrap_or(&plain);
    match short {
        "hs" | "fs" | "ic" | "fc" | "on" => return Some(EventKind::Strike),
        "to" | "fo" | "off" => return Some(EventKind::Off),
        _ => {}
    }
    let has = |words: &[&str]| words.iter().any(|word| plain.contains(word));
    if has(&["strike", "contact", "footon", "touchdown"]) {
        return Some(EventKind::Strike);
    }
    has(&["off"]).then_some(EventKind::Off)
}

/// The side from the context (`Left`), or from the first letter of a short label (`LHS`).
fn side_of(context: &str, label: &str) -> Option<Side> {
    let first = |text: &str| text.trim().chars().next().map(|c| c.to_ascii_lowercase());
    let side = |letter: Option<char>| match letter {
        Some('r') => Some(Side::Right),
        Some('l') => Some(Side::Left),
        _ => None,
    };
    let of_context = if context.trim().eq_ignore_ascii_case("general") { None } else { side(first(context)) };
    let short = label.trim().len() <= 4
        || label.to_ascii_lowercase().starts_with("left")
        || label.to_ascii_lowercase().starts_with("right");
    of_context.or_else(|| if short { side(first(label)) } else { None })
}

impl fmt::Display for EventKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
