//! The table of times and distances, with normal ranges at the same speed.

use super::cells::{number, spread_cell, text};
use super::results::Results;
use super::size::BodySize;
use crate::normative::{NormalRange, time_distance};
use crate::page::contract::{Cell, PageSource, Table};
use ambulo::analysis::StrideQuantity;
use ambulo::model::Side;
use ambulo_results::WalkingSummary;

/// How a quantity is shown. Units are as in the summary.
struct Row {
    quantity: StrideQuantity,
    label: &'static str,
    unit: &'static str,
    digits: usize,
}

const fn row(quantity: StrideQuantity, label: &'static str, unit: &'static str, digits: usize) -> Row {
    Row { quantity, label, unit, digits }
}

const ROWS: [Row; 15] = [
    row(StrideQuantity::Cadence, "Cadence", "steps/min", 0),
    row(StrideQuantity::StrideLength, "Stride length", "m", 2),
    row(StrideQuantity::StepLength, "Step length", "m", 2),
    row(StrideQuantity::StepWidth, "Step width", "m", 2),
    row(StrideQuantity::CycleTime, "Cycle time", "s", 2),
    row(StrideQuantity::StepTime, "Step time", "s", 2),
    row(StrideQuantity::StanceTime, "Stance time", "s", 2),
    row(StrideQuantity::SwingTime, "Swing time", "s", 2),
    row(StrideQuantity::Stance, "Stance", "%", 1),
    row(StrideQuantity::Swing, "Swing", "%", 1),
    row(StrideQuantity::SingleSupport, "Single support", "%", 1),
    row(StrideQuantity::DoubleSupport, "Double support", "%", 1),
    row(StrideQuantity::InitialDoubleSupport, "Initial double support", "%", 1),
    row(StrideQuantity::TerminalDoubleSupport, "Terminal double support", "%", 1),
    row(StrideQuantity::WalkRatio, "Walk ratio", "m/(steps/min)", 4),
];

/// The table; without strides its text gives the reason.
pub(super) fn table(results: &Results, size: &BodySize) -> Table {
    let walking = &results.summary.times_and_distances;
    let normal = size
        .walking_speed()
        .zip(size.leg.as_ref())
        .map_or_else(Vec::new, |(speed, leg)| time_distance(speed, leg.metres, results.gravity()));
    let no_strides = walking.quantities.is_empty();
    let rows = match no_strides {
        true => Vec::new(),
        false => speed_rows(walking).into_iter().chain(ROWS.iter().map(|row| cells(row, walking, &normal))).collect(),
    };
    Table {
        id: "time_distance".to_owned(),
        title: "Times and distances".to_owned(),
        note: (!no_strides).then(|| note(results, size, &normal)),
        columns: ["", "Unit", "Right", "Left", "Mean", "Normal"].map(str::to_owned).to_vec(),
        rows,
        empty: no_strides.then(|| why_no_strides(results).to_owned()),
    }
}

fn why_no_strides(results: &Results) -> &'static str {
    match (results.source, results.events.is_empty()) {
        (PageSource::None, true) => {
            "The motion was computed without ground forces, as requested, so foot strike and foot off are not known."
        }
        (_, true) if !results.curves.is_empty() => {
            "The folder has curves of gait cycles, but no times of foot strike and foot off (events.csv)."
        }
        (_, true) => "The folder has no times of foot strike and foot off (events.csv).",
        (_, false) => "There is no whole stride: no foot has a foot strike, a foot off and a second foot strike.",
    }
}

/// `Mean ± standard deviation of 2 right strides and 1 left stride, between foot strikes.`
fn counted(walking: &WalkingSummary) -> String {
    let cycles = walking.quantity(StrideQuantity::CycleTime);
    let of = |side: Side| match cycles?.side(side)?.strides {
        1 => Some(format!("1 {side} stride")),
        several => Some(format!("{several} {side} strides")),
    };
    let parts: Vec<String> = Side::BOTH.into_iter().filter_map(of).collect();
    let several = cycles.and_then(|cycles| cycles.both).is_some_and(|both| both.strides > 1);
    let kind = if several { "Mean ± standard deviation of" } else { "Values of" };
    format!("{kind} {}, between foot strikes.", parts.join(" and "))
}

fn note(results: &Results, size: &BodySize, normal: &[NormalRange]) -> String {
    let walking = &results.summary.times_and_distances;
    let lengths = match walking.quantity(StrideQuantity::StrideLength) {
        Some(_) => " Lengths are distances between the heels on the floor or belt.",
        None => " No lengths: the soles of the model are not known.",
    };
    let mut sources: Vec<&str> = normal.iter().map(|range| range.source).collect();
    sources.dedup();
    let norms = match (size.walking_speed(), size.why_no_norm()) {
        (Some(speed), _) => format!(" Normal ranges at V* = {speed:.2}: {}.", sources.join("; ")),
        (None, why) => format!(" No normal ranges: {}.", why.unwrap_or_default()),
    };
    format!("{}{lengths}{norms}", counted(walking))
}

/// Rows of the speed, and of the speed along the path if it is not straight.
fn speed_rows(walking: &WalkingSummary) -> Vec<Vec<Cell>> {
    let row = |label, speed| vec![text(label), text("m/s"), text(""), text(""), number(speed, 2, None), text("")];
    let along = walking.path_speed_m_s.map(|along| row("Speed along the path", Some(along)));
    std::iter::once(row("Speed", walking.speed_m_s)).chain(along).collect()
}

/// Quantities to compare between the sides: name, unit, digits, means of right and left.
pub(super) fn sides(walking: &WalkingSummary) -> Vec<(&'static str, &'static str, usize, [Option<f64>; 2])> {
    const COMPARED: [StrideQuantity; 6] = [
        StrideQuantity::StepLength,
        StrideQuantity::StepWidth,
        StrideQuantity::StepTime,
        StrideQuantity::Stance,
        StrideQuantity::SingleSupport,
        StrideQuantity::DoubleSupport,
    ];
    let mean = |row: &Row, side: Side| Some(walking.quantity(row.quantity)?.side(side)?.mean);
    let compared = ROWS.iter().filter(|row| COMPARED.contains(&row.quantity));
    compared.map(|row| (row.label, row.unit, row.digits, Side::BOTH.map(|side| mean(row, side)))).collect()
}

fn cells(row: &Row, walking: &WalkingSummary, normal: &[NormalRange]) -> Vec<Cell> {
    let found = walking.quantity(row.quantity);
    let range = normal.iter().find(|range| range.id == row.quantity.word());
    let shown = |spread| spread_cell(spread, row.digits, range.and_then(|range| range.range));
    let side = |side: Side| shown(found.and_then(|found| found.side(side)));
    let both = shown(found.and_then(|found| found.both.as_ref()));
    let words = range.map_or_else(String::new, |range| in_words(range, row.digits));
    vec![text(row.label), text(row.unit), side(Side::Right), side(Side::Left), both, text(&words)]
}

fn in_words(range: &NormalRange, digits: usize) -> String {
    match (range.range, range.mean) {
        (Some([low, high]), _) => format!("{low:.digits$} to {high:.digits$}"),
        (None, Some(mean)) => format!("about {mean:.digits$}"),
        (None, None) => String::new(),
    }
}
