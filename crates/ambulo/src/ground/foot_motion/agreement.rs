//! What several methods say together.

use super::EventMethod;
use crate::model::Side;
use crate::motion::{Event, EventKind};

/// Two methods saw the same event if they differ by less than this [s].
const SAME_EVENT_S: f64 = 0.15;

/// The median of what the methods say of each event that at least two of them saw; with one method alone, what it says.
pub(super) fn agreed(by_method: &[(EventMethod, Vec<Event>)]) -> Vec<Event> {
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
