//! Reserves: generalised forces that the muscles could not supply, as a measure of quality.

use crate::page::contract::{Judged, Table};
use crate::page::session::cells::{Column, listed, number, text};
use crate::page::session::plain_fact::plain;
use crate::page::session::results::Results;
use ambulo::model::Region;

/// Largest reserve of a joint in relation to its largest moment: "peak reserve actuator torques should typically be
/// less than 10% of the peak joint torque" (OpenSim documentation, page "Reserves and Residuals").
const SHARE: f64 = 0.1;
/// A muscle with a larger activation has no strength left.
const FULL: f64 = 0.99;
/// Most names of muscles in a line.
const NAMED: usize = 4;

/// The largest reserve of a coordinate.
struct Reserve {
    coordinate: String,
    unit: &'static str,
    /// Its size [N.m or N].
    size: f64,
    /// When [s].
    time_s: f64,
    /// In relation to the largest force of the coordinate; `None` without it.
    share: Option<f64>,
    /// Whether the coordinate belongs to a leg.
    of_leg: bool,
}

const COLUMNS: [Column<Reserve>; 5] = [
    ("Coordinate", |reserve| text(&reserve.coordinate)),
    ("Largest", |reserve| number(Some(reserve.size), 2, None)),
    ("Unit", |reserve| text(reserve.unit)),
    ("At [s]", |reserve| number(Some(reserve.time_s), 2, None)),
    ("Of the largest moment [%]", |reserve| {
        let limit = reserve.of_leg.then_some([f64::NEG_INFINITY, 100.0 * SHARE]);
        number(reserve.share.map(|share| 100.0 * share), 0, limit)
    }),
];

/// Muscles, those without strength left, and the largest reserve of the legs.
pub(in crate::page::session) fn facts(results: &Results) -> Vec<Judged> {
    let Some(table) = &results.muscles else { return Vec::new() };
    let muscles: Vec<(&str, &[f64])> =
        table.columns().filter_map(|(name, values)| Some((name.strip_suffix("_activation")?, values))).collect();
    let is_full = |values: &[f64]| values.iter().any(|activation| *activation > FULL);
    let full: Vec<&str> = muscles.iter().filter(|(_, values)| is_full(values)).map(|(name, _)| *name).collect();
    let more = if full.len() > NAMED { ", ..." } else { "" };
    let names = full.iter().take(NAMED).copied().collect::<Vec<_>>().join(", ");
    let list = if full.is_empty() { String::new() } else { format!(" ({names}{more})") };
    let at_limit = format!("{} of {}{list}", full.len(), muscles.len());
    let mut facts = vec![plain("Muscles that reach full activation", at_limit)];
    let of_legs = reserves(results).into_iter().filter(|reserve| reserve.of_leg);
    facts.extend(of_legs.max_by(|a, b| a.size.total_cmp(&b.size)).map(largest));
    facts
}

fn largest(reserve: Reserve) -> Judged {
    let Reserve { coordinate, unit, size, time_s, share, .. } = reserve;
    let of = share.map_or_else(String::new, |share| format!(", {:.0} % of its largest moment", 100.0 * share));
    Judged {
        allowed: share.map(|_| format!("below {:.0} %", 100.0 * SHARE)),
        good: share.map(|share| share < SHARE),
        ..plain("Largest reserve of the legs", format!("{size:.1} {unit} at {coordinate}, {time_s:.2} s{of}"))
    }
}

/// The table of all reserves, largest first; `None` without reserves.
pub(in crate::page::session) fn reserve_table(results: &Results) -> Option<Table> {
    let note = "Moments that the muscles could not supply and that were added in each coordinate. At the pelvis they \
        are the residual; coordinates without muscles have their whole moment from reserves.";
    let mut rows = reserves(results);
    rows.sort_by(|a, b| b.size.total_cmp(&a.size));
    listed(["reserves", "Reserves", note], &rows, &COLUMNS)
}

/// The largest reserve of every coordinate, in the order of the file.
fn reserves(results: &Results) -> Vec<Reserve> {
    let columns = results.muscles.iter().flat_map(|table| table.columns());
    let of_column = |(name, values): (&str, &[f64])| {
        let coordinate = name.strip_suffix("_reserve")?;
        let sizes = values.iter().map(|value| value.abs()).zip(results.times.iter().copied());
        let (size, time_s) = sizes.reduce(|largest, next| if next.0 > largest.0 { next } else { largest })?;
        let (force, unit) = of_coordinate(results, coordinate);
        let share = force.filter(|force| *force > 0.0).map(|force| size / force);
        Some(Reserve {
            coordinate: coordinate.to_owned(),
            unit,
            size,
            time_s,
            share,
            of_leg: is_of_leg(results, coordinate),
        })
    };
    columns.filter_map(of_column).collect()
}

/// The largest generalised force of a coordinate, and its unit.
fn of_coordinate(results: &Results, coordinate: &str) -> (Option<f64>, &'static str) {
    let column = |ending: &str| results.moments.as_ref()?.column(&format!("{coordinate}_{ending}"));
    let largest = |values: &[f64]| values.iter().fold(0.0_f64, |size, value| size.max(value.abs()));
    match (column("moment"), column("force")) {
        (None, Some(force)) => (Some(largest(force)), "N"),
        (moment, _) => (moment.map(largest), "N.m"),
    }
}

fn is_of_leg(results: &Results, coordinate: &str) -> bool {
    let Some((_, model)) = &results.body else { return false };
    let id = model.coordinate(coordinate);
    id.is_some_and(|id| {
        model.anatomy().coordinate_side(id).is_some() && Region::of_coordinate(model, id) == Some(Region::Legs)
    })
}
