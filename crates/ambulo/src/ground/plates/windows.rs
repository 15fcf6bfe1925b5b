//! Instrumented windows: the times when all loaded feet are on plates.

use super::feet::FeetInMotion;
use super::{ContactQuality, PlateContact};
use crate::model::Side;
use crate::numerics::Order;

/// Gaps of up to this length in the load of all plates are flight [s].
const FLIGHT_S: f64 = 0.3;
/// Shorter windows are dropped [s].
const SHORTEST_WINDOW_S: f64 = 0.05;

/// The instrumented windows, the longest first.
pub(super) fn windows(feet: &FeetInMotion<'_>, found: &[PlateContact]) -> Vec<[f64; 2]> {
    let is_whole = |c: &&PlateContact| matches!(c.quality, ContactQuality::Clean | ContactQuality::Shared);
    if Side::BOTH.iter().any(|s| feet.stances(*s).is_empty()) {
        return Vec::new();
    }
    let unmeasured = Side::BOTH.into_iter().flat_map(|side| {
        let measured: Vec<[f64; 2]> =
            found.iter().filter(is_whole).filter(|c| c.side == Some(side)).map(|c| [c.start_s, c.end_s]).collect();
        let covered = move |s: &[f64; 2]| measured.iter().any(|m| m[0] < s[1] && m[1] > s[0]);
        feet.stances(side).into_iter().filter(move |s| !covered(s)).collect::<Vec<_>>()
    });
    let mixed = found.iter().filter(|c| !is_whole(c)).map(|c| [c.start_s, c.end_s]);
    let barred: Vec<[f64; 2]> = unmeasured.chain(mixed).collect();
    let mut free = loaded_times(found);
    for bar in barred {
        free = free.iter().flat_map(|span| without(*span, bar)).collect();
    }
    free.retain(|s| s[1] - s[0] >= SHORTEST_WINDOW_S);
    free.sort_by_numbers(|span| [span[0] - span[1], span[0]]);
    free
}

/// The times during which plates were loaded, flights between them included.
fn loaded_times(found: &[PlateContact]) -> Vec<[f64; 2]> {
    let mut spans: Vec<[f64; 2]> = found.iter().map(|c| [c.start_s, c.end_s]).collect();
    spans.sort_by_number(|span| span[0]);
    let mut merged: Vec<[f64; 2]> = Vec::new();
    for span in spans {
        match merged.last_mut() {
            Some(last) if span[0] <= last[1] + FLIGHT_S => last[1] = last[1].max(span[1]),
            _ => merged.push(span),
        }
    }
    merged
}

fn without(span: [f64; 2], bar: [f64; 2]) -> Vec<[f64; 2]> {
    if bar[1] <= span[0] || bar[0] >= span[1] {
        return vec![span];
    }
    let (before, after) = ([span[0], bar[0]], [bar[1], span[1]]);
    [before, after].into_iter().filter(|s| s[1] > s[0]).collect()
}
