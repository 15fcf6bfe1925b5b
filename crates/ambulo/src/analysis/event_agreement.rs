//! Agreement of two lists of events, such as events from force plates, from the motion or from the file.
//!
//! Events of the same side and kind are paired, the closest pair first, up to 0.15 s apart.
//! Pinned by: tests/foot_motion.rs

use super::events::{Event, EventKind};
use crate::numerics::{Order, or_nan};
use serde::{Deserialize, Serialize};

/// Events further apart than this are different events [s]: a third of a fast step.
const FARTHEST_S: f64 = 0.15;

/// Agreement of the events of one kind.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EventAgreement {
    /// `strike` or `off`.
    pub kind: EventKind,
    /// Pairs.
    pub pairs: usize,
    /// Unpaired events of the reference.
    pub missed: usize,
    /// Unpaired events found within the time that the reference covers.
    pub extra: usize,
    /// Mean of |found - reference| over the pairs [ms]; not a number without pairs.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub mean_absolute_ms: f64,
    /// Mean of found - reference [ms]: positive if found late.
    #[serde(deserialize_with = "or_nan")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<f64>"))]
    pub bias_ms: f64,
}

/// Agreement of foot strikes, then of foot offs. Found events more than 0.15 s before the first or after the last one
/// of the reference are not counted, because the reference does not show whether they are right.
#[must_use]
pub fn event_agreement(reference: &[Event], found: &[Event]) -> [EventAgreement; 2] {
    [EventKind::Strike, EventKind::Off].map(|kind| of_kind(reference, found, kind))
}

fn of_kind(reference: &[Event], found: &[Event], kind: EventKind) -> EventAgreement {
    let of_kind = |list: &[Event]| list.iter().filter(|e| e.kind == kind).copied().collect::<Vec<_>>();
    let (reference, found) = (of_kind(reference), of_kind(found));
    let differences = pairs(&reference, &found);
    let times = || reference.iter().map(|e| e.time_s);
    let (first, last) = (times().fold(f64::INFINITY, f64::min), times().fold(f64::NEG_INFINITY, f64::max));
    let covered = found.iter().filter(|e| (first - FARTHEST_S..=last + FARTHEST_S).contains(&e.time_s)).count();
    let mean_ms = |sum: f64| 1000.0 * sum / differences.len() as f64;
    EventAgreement {
        kind,
        pairs: differences.len(),
        missed: reference.len() - differences.len(),
        extra: covered.saturating_sub(differences.len()),
        mean_absolute_ms: mean_ms(differences.iter().map(|d| d.abs()).sum()),
        bias_ms: mean_ms(differences.iter().sum()),
    }
}

/// found - reference of each pair [s], the closest pairs first.
fn pairs(reference: &[Event], found: &[Event]) -> Vec<f64> {
    let mut candidates: Vec<(usize, usize, f64)> = Vec::new();
    for (i, a) in reference.iter().enumerate() {
        let same = found.iter().enumerate().filter(|(_, b)| b.side == a.side);
        candidates.extend(same.map(|(j, b)| (i, j, b.time_s - a.time_s)).filter(|(_, _, d)| d.abs() <= FARTHEST_S));
    }
    candidates.sort_by_number(|(_, _, difference)| difference.abs());
    let (mut used, mut taken) = (vec![false; reference.len()], vec![false; found.len()]);
    let mut differences = Vec::new();
    for (i, j, difference) in candidates {
        if !used[i] && !taken[j] {
            (used[i], taken[j]) = (true, true);
            differences.push(difference);
        }
    }
    differences
}
