//! The table of times and distances, beside those of healthy people at the same speed.

use super::cells::{mean_cell, number, text};
use super::results::Results;
use super::size::BodySize;
use super::strides::Stride;
use super::way::Way;
use crate::normative::{NormalRange, time_distance};
use crate::page::contract::{Cell, PageSource, Table};
use ambulo::model::Side;

/// A row: the source's word for its normal range, name, unit, digits, factor to what is shown, value of a stride.
struct Row {
    normal: &'static str,
    label: &'static str,
    unit: &'static str,
    digits: usize,
    of: fn(&Stride) -> Option<f64>,
}

const fn row(
    normal: &'static str,
    label: &'static str,
    unit: &'static str,
    digits: usize,
    of: fn(&Stride) -> Option<f64>,
) -> Row {
    Row { normal, label, unit, digits, of }
}

const ROWS: [Row; 15] = [
    row("cadence", "Cadence", "steps/min", 0, |s| Some(cadence(s))),
    row("stride_length", "Stride length", "m", 2, |s| s.stride_length_m),
    row("step_length", "Step length", "m", 2, |s| s.step_length_m),
    row("step_width", "Step width", "m", 2, |s| s.step_width_m),
    row("cycle_time", "Cycle time", "s", 2, |s| Some(s.cycle_s)),
    row("step_time", "Step time", "s", 2, |s| s.step_time_s),
    row("stance_time", "Stance time", "s", 2, |s| Some(0.01 * s.stance * s.cycle_s)),
    row("swing_time", "Swing time", "s", 2, |s| Some((1.0 - 0.01 * s.stance) * s.cycle_s)),
    row("stance", "Stance", "%", 1, |s| Some(s.stance)),
    row("swing", "Swing", "%", 1, |s| Some(100.0 - s.stance)),
    row("single_support", "Single support", "%", 1, |s| s.single_support),
    row("double_support", "Double support", "%", 1, |s| Some(s.stance - s.single_support?)),
    row("initial_double_support", "Initial double support", "%", 1, |s| s.initial_double_support),
    row("terminal_double_support", "Terminal double support", "%", 1, |s| s.terminal_double_support),
    row("walk_ratio", "Walk ratio", "m/(steps/min)", 4, |s| Some(s.step_length_m? / cadence(s))),
];

/// The table; `empty` where no stride was seen.
pub(super) fn table(results: &Results, size: &BodySize, strides: &[Stride]) -> Table {
    let normal = size
        .walking_speed()
        .zip(size.leg.as_ref())
        .map_or_else(Vec::new, |(speed, leg)| time_distance(speed, leg.metres, results.gravity()));
    let rows = match strides.is_empty() {
        true => Vec::new(),
        false => speed_rows(results).into_iter().chain(ROWS.iter().map(|row| cells(row, strides, &normal))).collect(),
    };
    let empty = strides.is_empty().then(|| no_strides(results).to_owned());
    Table {
        id: "time_distance".to_owned(),
        title: "Times and distances".to_owned(),
        note: (!strides.is_empty()).then(|| note(results, strides, size, &normal)),
        columns: ["", "Unit", "Right", "Left", "Mean", "Normal"].map(str::to_owned).to_vec(),
        rows,
        empty,
    }
}

/// Why there is no stride.
fn no_strides(results: &Results) -> &'static str {
    match (results.source, results.events.is_empty()) {
        (PageSource::None, true) => {
            "The motion was computed without ground forces, as asked: no file tells when the feet struck and left."
        }
        (_, true) if !results.curves.is_empty() => {
            "The folder has curves of cycles, but no foot strikes and toe-offs in time (events.csv)."
        }
        (_, true) => "The folder has no foot strikes and toe-offs (events.csv).",
        (_, false) => "No foot was seen to strike, to leave and to strike again.",
    }
}

/// `2 right strides and 1 left stride between foot strikes`.
fn counted(strides: &[Stride]) -> String {
    let of = |side: Side| match strides.iter().filter(|stride| stride.side == side).count() {
        0 => None,
        1 => Some(format!("1 {side} stride")),
        several => Some(format!("{several} {side} strides")),
    };
    let parts: Vec<String> = Side::BOTH.into_iter().filter_map(of).collect();
    let kind = if strides.len() > 1 { "Mean ± standard deviation of" } else { "Of" };
    format!("{kind} {}, between foot strikes.", parts.join(" and "))
}

fn note(results: &Results, strides: &[Stride], size: &BodySize, normal: &[NormalRange]) -> String {
    let counted = counted(strides);
    let places = match strides.iter().any(|stride| stride.stride_length_m.is_some()) {
        true => " Lengths are those of the heels on the floor or belt.",
        false if results.body.is_none() => " No lengths: the folder has no body whose feet could be followed.",
        false => " No lengths: the body has no feet whose soles are known.",
    };
    let mut sources: Vec<&str> = normal.iter().map(|range| range.source).collect();
    sources.dedup();
    let norms = match size.walking_speed() {
        Some(speed) => format!(" Normal ranges at V* = {speed:.2}: {}.", sources.join("; ")),
        None if size.runs => " No normal ranges: this is running, and they are those of walking.".to_owned(),
        None if size.turn.is_some() => {
            " No normal ranges: the path turns, and they are those of straight walking.".to_owned()
        }
        None => " No normal ranges: speed or leg length are not known.".to_owned(),
    };
    format!("{counted}{places}{norms}")
}

fn cadence(stride: &Stride) -> f64 {
    120.0 / stride.cycle_s
}

/// The speed of the summary, and that along a path that is longer than the straight way.
fn speed_rows(results: &Results) -> Vec<Vec<Cell>> {
    let row = |label, speed| vec![text(label), text("m/s"), text(""), text(""), number(speed, 2, None), text("")];
    let along = Way::of(results).and_then(|way| way.longer_speed());
    let along = along.map(|along| row("Speed along the path", Some(along)));
    std::iter::once(row("Speed", results.summary.speed_m_s)).chain(along).collect()
}

/// What is compared between the sides: name, unit, digits, means of right and left.
pub(super) fn sides(strides: &[Stride]) -> Vec<(&'static str, &'static str, usize, [Option<f64>; 2])> {
    const COMPARED: [&str; 6] =
        ["step_length", "step_width", "step_time", "stance", "single_support", "double_support"];
    let mean = |row: &Row, side: Side| {
        let values: Vec<f64> = strides.iter().filter(|stride| stride.side == side).filter_map(row.of).collect();
        (!values.is_empty()).then(|| values.iter().sum::<f64>() / values.len() as f64)
    };
    let compared = ROWS.iter().filter(|row| COMPARED.contains(&row.normal));
    compared.map(|row| (row.label, row.unit, row.digits, Side::BOTH.map(|side| mean(row, side)))).collect()
}

fn cells(row: &Row, strides: &[Stride], normal: &[NormalRange]) -> Vec<Cell> {
    let values = |side: Option<Side>| {
        let chosen = strides.iter().filter(|stride| side.is_none_or(|side| stride.side == side));
        chosen.filter_map(row.of).collect::<Vec<f64>>()
    };
    let range = normal.iter().find(|range| range.id == row.normal);
    let of = |side| mean_cell(&values(side), row.digits, range.and_then(|range| range.range));
    let sides = [of(Some(Side::Right)), of(Some(Side::Left)), of(None)];
    let words = range.map_or_else(String::new, |range| in_words(range, row.digits));
    [text(row.label), text(row.unit)].into_iter().chain(sides).chain([text(&words)]).collect()
}

fn in_words(range: &NormalRange, digits: usize) -> String {
    match (range.range, range.mean) {
        (Some([low, high]), _) => format!("{low:.digits$} to {high:.digits$}"),
        (None, Some(mean)) => format!("about {mean:.digits$}"),
        (None, None) => String::new(),
    }
}
