//! Foot strikes and foot offs from all sources of a recording of markers, and the gait cycles between them.
//!
//! Two plates catch one stance of each foot: no plate sees the next strike, but markers and the file's own list do. A
//! cycle that begins with a strike on a plate is whole for the leg of that foot if the next strike of the foot is known
//! from any source.

use crate::analysis::{Analysis, BodyInMotion, Cycle, Event, EventKind, cycles};
use crate::findings::{Code, Findings};
use crate::model::Side;
use crate::numerics::{Order, counted, median};

/// Events of one foot and kind closer than this are one event [s].
const SAME_S: f64 = 0.15;

/// An analysis with the events of plates, of the file's list (if it has one) and of the markers; with the events that
/// the plates saw.
pub(super) fn with_events_of_markers(
    analysis: Analysis,
    body: &BodyInMotion,
    listed: &[Event],
) -> (Analysis, Vec<Event>) {
    let seen = if listed.is_empty() { &body.feet.events } else { listed };
    if body.on_plates.contacts.is_empty() {
        return (with_events_besides_forces(analysis, seen), Vec::new());
    }
    let measured = body.measured_events();
    (with_events(analysis, &measured, &body.events(seen)), measured)
}

/// Replaces the events that the forces alone show. `measured` are those among `all` that plates saw. Cycles begin with
/// measured strikes, because the moments of a leg that stood off the plates mean little.
fn with_events(analysis: Analysis, measured: &[Event], all: &[Event]) -> Analysis {
    let grid = analysis.trajectory.grid();
    let inside = |e: &&Event| (grid.start_s..=grid.end_s()).contains(&e.time_s);
    let mut events: Vec<Event> = all.iter().filter(inside).copied().collect();
    events.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    let was_measured = |cycle: &Cycle| {
        let strike = Event { side: cycle.side, kind: EventKind::Strike, time_s: cycle.start_s };
        measured.iter().any(|event| is_same(event, &strike))
    };
    let mut cycles: Vec<Cycle> = cycles(&events, grid).into_iter().filter(was_measured).collect();
    for i in 0..cycles.len() {
        let side = cycles[i].side;
        cycles[i].number = cycles[..=i].iter().filter(|cycle| cycle.side == side).count();
    }
    Analysis { events, cycles, ..analysis }
}

/// The events of the forces and, where the forces show none, those that were seen otherwise.
fn with_events_besides_forces(analysis: Analysis, seen: &[Event]) -> Analysis {
    let measured = analysis.events.clone();
    let others = seen.iter().filter(|event| !measured.iter().any(|known| is_same(known, event)));
    let all: Vec<Event> = measured.iter().chain(others).copied().collect();
    with_events(analysis, &measured, &all)
}

/// Force plates and the file's list name the same event if it is not further apart than this [s].
const LIST_LATE_S: f64 = 0.05;
/// Fewest events of plates by which a list is judged.
const FEWEST: usize = 2;

/// How the events of force plates contradict those that the file lists: right and left are exchanged, or most are early
/// or late. `None` if they agree, or too few are near each other.
pub fn contradiction(measured: &[Event], listed: &[Event]) -> Option<String> {
    let nearest = |event: &Event, side: Side| {
        let same_kind = listed.iter().filter(|other| other.side == side && other.kind == event.kind);
        let off_s = same_kind.map(|other| other.time_s - event.time_s).filter(|off_s| off_s.abs() < SAME_S);
        off_s.min_by(|a, b| a.abs().total_cmp(&b.abs()))
    };
    let own: Vec<f64> = measured.iter().filter_map(|event| nearest(event, event.side)).collect();
    let other = measured.iter().filter_map(|event| nearest(event, event.side.other()));
    let exchanged = other.filter(|off_s| off_s.abs() < LIST_LATE_S).count();
    if exchanged >= FEWEST && own.iter().filter(|off_s| off_s.abs() < LIST_LATE_S).count() == 0 {
        return Some(format!("right and left are exchanged in {} of {}", exchanged, counted(measured.len(), "event")));
    }
    let late_s = median(own.iter().copied()).filter(|late_s| late_s.abs() > LIST_LATE_S && own.len() >= FEWEST)?;
    let word = if late_s > 0.0 { "late" } else { "early" };
    Some(format!("{} are {:.0} ms {word}, by the median", counted(own.len(), "event"), 1e3 * late_s.abs()))
}

/// Whether the events that a file lists agree with force plates; reports if not.
pub(super) fn are_believed(body: &BodyInMotion, listed: &[Event], findings: &mut Findings) -> bool {
    let found = contradiction(&body.measured_events(), listed);
    if let Some(how) = &found {
        let message = format!(
            "the events in the file contradict the force plates: {how}; they were not used, those of the markers were"
        );
        findings.report(Code::EventsContradicted, message);
    }
    found.is_none()
}

fn is_same(a: &Event, b: &Event) -> bool {
    a.side == b.side && a.kind == b.kind && (a.time_s - b.time_s).abs() < SAME_S
}
