//! The table of times and distances, beside those of healthy people at the same speed.

use super::cells::{mean_cell, number, text};
use super::results::Results;
use super::size::BodySize;
use super::strides::Stride;
use crate::model::Side;
use crate::report::normative::{NormalRange, time_distance};
use crate::report::page::contract::{Cell, Table};

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

const ROWS: [Row; 10] = [
    row("cadence", "Cadence", "steps/min", 0, |s| Some(cadence(s))),
    row("stride_length", "Stride length", "m", 2, |s| s.stride_length_m),
    row("step_length", "Step length", "m", 2, |s| s.step_length_m),
    row("step_width", "Step width", "m", 2, |s| s.step_width_m),
    row("cycle_time", "Cycle time", "s", 2, |s| Some(s.cycle_s)),
    row("stance", "Stance", "%", 1, |s| Some(s.stance)),
    row("swing", "Swing", "%", 1, |s| Some(100.0 - s.stance)),
    row("single_support", "Single support", "%", 1, |s| s.single_support),
    row("double_support", "Double support", "%", 1, |s| Some(s.stance - s.single_support?)),
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
        false => {
            std::iter::once(speed_row(results)).chain(ROWS.iter().map(|row| cells(row, strides, &normal))).collect()
        }
    };
    let empty = strides.is_empty().then(|| "No foot was seen to strike, to leave and to strike again.".to_owned());
    Table {
        id: "time_distance".to_owned(),
        title: "Times and distances".to_owned(),
        note: Some(note(strides, size, &normal)),
        columns: ["", "Unit", "Right", "Left", "Mean", "Normal"].map(str::to_owned).to_vec(),
        rows,
        empty,
    }
}

fn note(strides: &[Stride], size: &BodySize, normal: &[NormalRange]) -> String {
    let count = |side: Side| strides.iter().filter(|stride| stride.side == side).count();
    let counted = format!(
        "Mean ± standard deviation of {} right and {} left strides between foot strikes.",
        count(Side::Right),
        count(Side::Left)
    );
    let places = match strides.iter().any(|stride| stride.stride_length_m.is_some()) {
        true => " Lengths are those of the heels on the floor or belt.",
        false => " No lengths: the folder has no body whose feet could be followed.",
    };
    let mut sources: Vec<&str> = normal.iter().map(|range| range.source).collect();
    sources.dedup();
    let norms = match size.walking_speed() {
        Some(speed) => format!(" Normal ranges at V* = {speed:.2}: {}.", sources.join("; ")),
        None if size.runs => " No normal ranges: this is running, and they are those of walking.".to_owned(),
        None => " No normal ranges: speed or leg length are not known.".to_owned(),
    };
    format!("{counted}{places}{norms}")
}

fn cadence(stride: &Stride) -> f64 {
    120.0 / stride.cycle_s
}

fn speed_row(results: &Results) -> Vec<Cell> {
    let speed = number(results.number("/speed_m_s"), 2, None);
    vec![text("Speed"), text("m/s"), text(""), text(""), speed, text("")]
}

/// What is compared between the sides: name, unit, digits, means of right and left.
pub(super) fn sides(strides: &[Stride]) -> Vec<(&'static str, &'static str, usize, [Option<f64>; 2])> {
    const COMPARED: [&str; 5] = ["step_length", "step_width", "stance", "single_support", "double_support"];
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
