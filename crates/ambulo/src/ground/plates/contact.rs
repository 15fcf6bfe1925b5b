//! Assigns one contact to a foot and decides how much of the foot's load the plate measured.

use super::feet::{FeetInMotion, OVER_EDGE_M};
use super::{ContactQuality, FARTHEST_M, PlateContact};
use crate::ground::phases::{Contact, contacts_from_force};
use crate::model::Side;
use crate::motion::PlateRecording;
use crate::numerics::median;

/// Force and motion show the same strike or off if they differ by less than this [s]: errors of events from motion
/// reach 0.06.
const SAME_EVENT_S: f64 = 0.1;
/// A second foot on a plate for less than this is an error of its events [s].
const SECOND_FOOT_S: f64 = 0.08;

/// The times during which a plate is loaded.
pub(super) fn loaded_spans(plate: &PlateRecording) -> Vec<[f64; 2]> {
    let vertical: Vec<f64> = (0..plate.times.len()).map(|i| plate.vertical(i)).collect();
    let (Some(&first), Some(&last)) = (plate.times.first(), plate.times.last()) else { return Vec::new() };
    contacts_from_force(&plate.times, &vertical).iter().map(|c: &Contact| c.span(first, last)).collect()
}

fn samples(plate: &PlateRecording, span: [f64; 2]) -> impl Iterator<Item = usize> + '_ {
    let from = plate.times.partition_point(|&t| t < span[0]);
    let to = plate.times.partition_point(|&t| t <= span[1]);
    from..to
}

pub(super) fn peak(plate: &PlateRecording, span: [f64; 2]) -> f64 {
    samples(plate, span).map(|i| plate.vertical(i)).fold(0.0, f64::max)
}

/// Assigns a contact to a foot and rates it by its own plate. `assigned` is the foot given by the user.
pub(super) fn classified(
    feet: &FeetInMotion<'_>,
    index: usize,
    plate: &PlateRecording,
    span: [f64; 2],
    assigned: Option<Side>,
) -> PlateContact {
    let distances = Side::BOTH.map(|side| (side, mean_distance(feet, plate, span, side)));
    let nearest = distances.iter().filter(|(_, d)| *d <= FARTHEST_M).min_by(|a, b| a.1.total_cmp(&b.1));
    let by_stance = || {
        // A foot without visible markers, if it is the only such foot on the ground.
        let hidden = distances.iter().filter(|(side, d)| d.is_nan() && feet.stance_of(*side, span).is_some());
        let on_ground: Vec<Side> = hidden.map(|(side, _)| *side).collect();
        if let [only] = on_ground[..] { Some(only) } else { None }
    };
    let side = assigned.or(nearest.map(|n| n.0)).or_else(by_stance);
    let together = both_feet(feet, plate, span);
    let (quality, reason) = match side {
        _ if assigned.is_none() && together.is_some() => (ContactQuality::TwoFeet, together.unwrap_or_default()),
        None => (ContactQuality::Unassigned, unassigned_reason(&distances)),
        Some(side) => quality(feet, plate, span, side),
    };
    PlateContact {
        plate: index,
        side,
        start_s: span[0],
        end_s: span[1],
        peak_n: peak(plate, span),
        distance_m: side.map_or(f64::NAN, |s| distances[usize::from(s == Side::Left)].1),
        quality,
        reason,
    }
}

/// Mean distance of the foot from the centre of pressure, weighted by the load [m].
fn mean_distance(feet: &FeetInMotion<'_>, plate: &PlateRecording, span: [f64; 2], side: Side) -> f64 {
    let (mut sum, mut weight) = (0.0, 0.0);
    for i in samples(plate, span) {
        let load = plate.vertical(i);
        if let Some(distance) =
            feet.distance(side, plate.center_of_pressure(i), plate, plate.times[i]).filter(|d| d.is_finite())
        {
            sum += load * distance;
            weight += load;
        }
    }
    if weight > 0.0 { sum / weight } else { f64::NAN }
}

fn unassigned_reason(distances: &[(Side, f64); 2]) -> String {
    match distances {
        [(_, r), (_, l)] if r.is_nan() && l.is_nan() => "no foot marker was visible".to_owned(),
        [(_, r), (_, l)] => {
            format!("no foot is near its centre of pressure (right {}, left {})", away(*r), away(*l))
        }
    }
}

/// A distance [m] in words.
fn away(distance_m: f64) -> String {
    if distance_m.is_nan() { "not seen".to_owned() } else { format!("{:.0} mm", 1000.0 * distance_m) }
}

fn quality(feet: &FeetInMotion<'_>, plate: &PlateRecording, span: [f64; 2], side: Side) -> (ContactQuality, String) {
    if let Some(stance) = feet.stance_of(side, span) {
        if span[0] - stance[0] > SAME_EVENT_S {
            return (
                ContactQuality::Partial,
                format!("the foot was on the floor {:.2} s before the force began", span[0] - stance[0]),
            );
        }
        if stance[1] - span[1] > SAME_EVENT_S {
            return (
                ContactQuality::Partial,
                format!("the force ended {:.2} s before the foot left the floor", stance[1] - span[1]),
            );
        }
    }
    match over_edge(feet, plate, span, side) {
        Some(reason) => (ContactQuality::Partial, reason),
        None => (ContactQuality::Clean, String::new()),
    }
}

/// Explanation if both feet were on this plate during the span.
fn both_feet(feet: &FeetInMotion<'_>, plate: &PlateRecording, span: [f64; 2]) -> Option<String> {
    let [right, left] = Side::BOTH.map(|side| time_on_plate(feet, plate, span, side));
    (right.min(left) >= SECOND_FOOT_S)
        .then(|| format!("the right foot was on it for {right:.2} s, the left foot for {left:.2} s"))
}

/// Time that the foot was on this plate during the span [s].
fn time_on_plate(feet: &FeetInMotion<'_>, plate: &PlateRecording, span: [f64; 2], side: Side) -> f64 {
    let times = feet.markers.times.iter().filter(|t| (span[0]..=span[1]).contains(*t));
    let frames = times.filter(|t| feet.is_on(side, plate, **t)).count();
    frames as f64 / feet.markers.rate_hz
}

/// Explanation if heel or toe was off the plate in the middle of the contact, when the foot is flat.
fn over_edge(feet: &FeetInMotion<'_>, plate: &PlateRecording, span: [f64; 2], side: Side) -> Option<String> {
    let length = span[1] - span[0];
    let middle = [span[0] + 0.3 * length, span[0] + 0.6 * length];
    let times = || feet.markers.times.iter().filter(|t| (middle[0]..=middle[1]).contains(*t));
    for (k, part) in ["heel", "toe"].into_iter().enumerate() {
        let depths = times().filter_map(|&t| feet.line(side, t)).map(|l| plate.depth_inside(l[k]));
        let depth = median(depths).unwrap_or(0.0);
        if depth < -OVER_EDGE_M {
            return Some(format!("the {part} was {:.0} mm beyond the edge", -1000.0 * depth));
        }
    }
    None
}

/// Turns a partial contact into a shared one if together with other plates it covers the whole stance of its foot.
pub(super) fn with_other_plates(feet: &FeetInMotion<'_>, all: &[PlateContact], index: usize) -> PlateContact {
    let contact = &all[index];
    let Some(side) = contact.side.filter(|_| contact.quality == ContactQuality::Partial) else {
        return contact.clone();
    };
    let Some(stance) = feet.stance_of(side, [contact.start_s, contact.end_s]) else { return contact.clone() };
    let overlaps = |c: &&PlateContact| {
        c.plate != contact.plate && c.side == Some(side) && c.start_s < stance[1] && c.end_s > stance[0]
    };
    let whole = |c: &PlateContact| !matches!(c.quality, ContactQuality::TwoFeet | ContactQuality::Unassigned);
    let partners: Vec<&PlateContact> = all.iter().filter(|c| whole(c)).filter(overlaps).collect();
    let mut spans: Vec<[f64; 2]> = partners.iter().map(|c| [c.start_s, c.end_s]).collect();
    spans.push([contact.start_s, contact.end_s]);
    let (start, end) =
        (spans.iter().map(|s| s[0]).fold(f64::INFINITY, f64::min), spans.iter().map(|s| s[1]).fold(0.0, f64::max));
    let covered = start - stance[0] <= SAME_EVENT_S && stance[1] - end <= SAME_EVENT_S && !partners.is_empty();
    if !covered {
        return contact.clone();
    }
    let plates: Vec<String> = partners.iter().map(|c| (c.plate + 1).to_string()).collect();
    PlateContact {
        quality: ContactQuality::Shared,
        reason: format!("the foot was on plate {} as well", plates.join(" and ")),
        ..contact.clone()
    }
}
