//! What several methods say together.

use super::EventMethod;
use crate::model::Side;
use crate::motion::{Event, EventKind};
use crate::numerics::median;

/// Two methods saw the same event if they differ by less than this [s].
const SAME_EVENT_S: f64 = 0.15;

/// An event with the number of methods that saw it.
struct Voiced {
    event: Event,
    voices: usize,
}

/// The median of what the methods say of each event that at least two of them saw; with one method alone, what it says.
///
/// Strikes and offs of a foot take turns: of two of one kind without the other between them the one that more methods
/// saw is kept, else the first.
pub(super) fn agreed(by_method: &[(EventMethod, Vec<Event>)]) -> Vec<Event> {
    let needed = by_method.len().min(2);
    let mut out = Vec::new();
    for side in Side::BOTH {
        let mut voiced: Vec<Voiced> = Vec::new();
        for kind in [EventKind::Strike, EventKind::Off] {
            let of = |(m, list): (usize, &(EventMethod, Vec<Event>))| {
                let same = list.1.iter().filter(|e| e.side == side && e.kind == kind);
                same.map(|e| (e.time_s, m)).collect::<Vec<_>>()
            };
            let mut seen: Vec<(f64, usize)> = by_method.iter().enumerate().flat_map(of).collect();
            seen.sort_by(|a, b| a.0.total_cmp(&b.0));
            voiced.extend(groups(&seen).into_iter().filter_map(|group| consensus(group, side, kind)));
        }
        voiced.retain(|v| v.voices >= needed);
        voiced.sort_by(|a, b| a.event.time_s.total_cmp(&b.event.time_s));
        out.extend(taking_turns(voiced));
    }
    out.sort_by(|a, b| a.time_s.total_cmp(&b.time_s).then(a.side.cmp(&b.side)));
    out
}

fn taking_turns(voiced: Vec<Voiced>) -> impl Iterator<Item = Event> {
    let mut kept: Vec<Voiced> = Vec::new();
    for next in voiced {
        match kept.last_mut() {
            Some(last) if last.event.kind == next.event.kind => {
                if next.voices > last.voices {
                    *last = next;
                }
            }
            _ => kept.push(next),
        }
    }
    kept.into_iter().map(|v| v.event)
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

/// Median over the methods, one voice each.
fn consensus(group: &[(f64, usize)], side: Side, kind: EventKind) -> Option<Voiced> {
    let voice = |m: usize| group.iter().find(|(_, by)| *by == m).map(|(t, _)| *t);
    let times: Vec<f64> = (0..EventMethod::ALL.len()).filter_map(voice).collect();
    let voices = times.len();
    Some(Voiced { event: Event { side, kind, time_s: median(times)? }, voices })
}
