//! Strength as a measure of quality: muscles at their limit, and reserves, the generalised forces that the muscles
//! could not supply.

use crate::page::contract::{Judged, Table};
use crate::page::session::cells::{Column, listed, number, text};
use crate::page::session::plain_fact::{none_allowed, plain};
use crate::page::session::results::Results;
use ambulo::numerics::Order;
use ambulo_results::{MuscleOrigin, MuscleSummary, ReserveSummary};

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
}

const COLUMNS: [Column<Reserve>; 5] = [
    ("Coordinate", |reserve| text(&reserve.coordinate)),
    ("Largest", |reserve| number(Some(reserve.size), 2, None)),
    ("Unit", |reserve| text(reserve.unit)),
    ("At [s]", |reserve| number(Some(reserve.time_s), 2, None)),
    ("Of the largest moment [%]", |reserve| number(reserve.share.map(|share| 100.0 * share), 0, None)),
];

/// Whose muscles, those without strength left, and the largest reserve.
pub(in crate::page::session) fn facts(results: &Results) -> Vec<Judged> {
    let mut facts = results.summary.muscles.as_ref().map_or_else(Vec::new, of_summary);
    facts.extend(full(results));
    facts
}

fn of_summary(summary: &MuscleSummary) -> Vec<Judged> {
    let whose = match summary.source {
        MuscleOrigin::Model => "the model's own",
        MuscleOrigin::BuiltIn => "the built-in set",
    };
    let own = plain("Muscles", format!("{}, {whose}", summary.muscles));
    let unmet = none_allowed("Frames whose moments muscles and reserves could not give", summary.unmet_frames);
    [own].into_iter().chain(summary.largest_reserve.as_ref().map(largest)).chain([unmet]).collect()
}

fn largest(reserve: &ReserveSummary) -> Judged {
    let ReserveSummary { coordinate, unit, largest, at_s, share } = reserve;
    let value = format!(
        "{largest:.1} {} at {coordinate}, {at_s:.2} s, {:.0} % of the largest moment there",
        unit.symbol(),
        100.0 * share
    );
    Judged {
        allowed: Some(format!("below {:.0} %", 100.0 * SHARE)),
        good: Some(*share < SHARE),
        ..plain("Largest reserve of the muscles", value)
    }
}

/// Muscles that reach full activation.
fn full(results: &Results) -> Option<Judged> {
    let table = results.muscles.as_ref()?;
    let muscles: Vec<(&str, &[f64])> =
        table.columns().filter_map(|(name, values)| Some((name.strip_suffix("_activation")?, values))).collect();
    let is_full = |values: &[f64]| values.iter().any(|activation| *activation > FULL);
    let full: Vec<&str> = muscles.iter().filter(|(_, values)| is_full(values)).map(|(name, _)| *name).collect();
    let more = if full.len() > NAMED { ", ..." } else { "" };
    let names = full.iter().take(NAMED).copied().collect::<Vec<_>>().join(", ");
    let list = if full.is_empty() { String::new() } else { format!(" ({names}{more})") };
    Some(plain("Muscles that reach full activation", format!("{} of {}{list}", full.len(), muscles.len())))
}

/// The table of all reserves, largest first; `None` without reserves.
pub(in crate::page::session) fn reserve_table(results: &Results) -> Option<Table> {
    let note = "Moments that the muscles could not supply and that were added in each coordinate. At the pelvis they \
        are the residual; coordinates without muscles have their whole moment from reserves.";
    let mut rows = reserves(results);
    rows.sort_by_number(|row| -row.size);
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
        Some(Reserve { coordinate: coordinate.to_owned(), unit, size, time_s, share })
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
