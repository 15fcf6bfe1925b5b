//! Combines the events of several methods.

use super::EventMethod;
use crate::model::Side;
use crate::motion::{Event, EventKind};
use crate::numerics::{Order, median};

/// Two methods detected the same event if they differ by less than this [s].
const SAME_EVENT_S: f64 = 0.15;

/// An event with the number of methods that detected it.
struct Candidate {
    event: Event,
    methods: usize,
}

/// The median time of each event that at least two methods detected; with a single method, its events.
///
/// Strikes and offs of a foot alternate: of two events of one kind in a row the one that more methods
/// detected is kept, otherwise the first.
pub(super) fn agreed(by_method: &[(&str, Vec<Event>)]) -> Vec<Event> {
    let needed = by_method.len().min(2);
    let mut out = Vec::new();
    for side in Side::BOTH {
        let mut candidates: Vec<Candidate> = Vec::new();
        for kind in [EventKind::Strike, EventKind::Off] {
            let of = |(m, list): (usize, &(&str, Vec<Event>))| {
                let same = list.1.iter().filter(|e| e.side == side && e.kind == kind);
                same.map(|e| (e.time_s, m)).collect::<Vec<_>>()
            };
            let mut seen: Vec<(f64, usize)> = by_method.iter().enumerate().flat_map(of).collect();
            seen.sort_by_number(|found| found.0);
            candidates.extend(groups(&seen).into_iter().filter_map(|group| consensus(group, side, kind)));
        }
        candidates.retain(|v| v.methods >= needed);
        candidates.sort_by_number(|candidate| candidate.event.time_s);
        out.extend(alternating(candidates));
    }
    out.sort_by_numbers(|event| [event.time_s, event.side.rank()]);
    out
}

fn alternating(candidates: Vec<Candidate>) -> impl Iterator<Item = Event> {
    let mut kept: Vec<Candidate> = Vec::new();
    for next in candidates {
        match kept.last_mut() {
            Some(last) if last.event.kind == next.event.kind => {
                if next.methods > last.methods {
                    *last = next;
                }
            }
            _ => kept.push(next),
        }
    }
    kept.into_iter().map(|v| v.event)
}

/// Groups times that belong to one event: each is close to the first.
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

/// Median over the methods, each counted once.
fn consensus(group: &[(f64, usize)], side: Side, kind: EventKind) -> Option<Candidate> {
    let time_of = |m: usize| group.iter().find(|(_, by)| *by == m).map(|(t, _)| *t);
    let times: Vec<f64> = (0..EventMethod::ALL.len()).filter_map(time_of).collect();
    let methods = times.len();
    Some(Candidate { event: Event { side, kind, time_s: median(times)? }, methods })
}
