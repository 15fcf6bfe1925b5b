//! Table of peaks and impulses of the joint contact loads over whole stances.

use super::contact::{Load, loads};
use crate::page::contract::{Cell, PageCycle, Table};
use crate::page::session::cells::{mean_cell, number, table, text};
use crate::page::session::results::Results;
use ambulo::analysis::symmetry_index;
use ambulo::model::{BySide, Side};

/// Asymmetry above this is marked [%], as in the table of both sides.
const ASYMMETRIC: f64 = 10.0;

/// The loads in the table and their names there.
const ROWS: [(&str, &str); 5] = [
    ("hip_contact", "Hip"),
    ("knee_contact", "Knee"),
    ("knee_medial", "Knee, medial"),
    ("knee_lateral", "Knee, lateral"),
    ("ankle_contact", "Ankle"),
];

const NOTE: &str = "Estimates of the model, not measured loads. Mean ± standard deviation over whole stances: largest \
    values in the first and in the second half of stance, and the area below the curve.";

/// Largest value in both halves of stance [BW], and impulse [BW s].
type Stance = [f64; 3];

/// The table; `None` if no whole stance has loads.
pub(in crate::page::session) fn contact_table(results: &Results) -> Option<Table> {
    let loads = loads(results);
    let stances = |id: &str| {
        let load = loads.iter().find(|load| load.id == id)?;
        Some(BySide::from_fn(|side| stances(results, load, side)))
    };
    let mut rows: Vec<Vec<Cell>> = Vec::new();
    for (id, name) in ROWS {
        let Some(found) = stances(id) else { continue };
        let of = |k: usize| found.as_ref().map(|list| list.iter().map(|stance| stance[k]).collect::<Vec<f64>>());
        rows.extend(row(&format!("{name}, peak in early stance"), "BW", &of(0), 2));
        rows.extend(row(&format!("{name}, peak in late stance"), "BW", &of(1), 2));
        rows.extend(row(&format!("{name}, impulse"), "BW s", &of(2), 2));
    }
    if let Some((medial, lateral)) = stances("knee_medial").zip(stances("knee_lateral")) {
        let share = |(medial, lateral): (&Stance, &Stance)| 100.0 * medial[2] / (medial[2] + lateral[2]);
        let shares = BySide::from_fn(|side| medial[side].iter().zip(&lateral[side]).map(share).collect());
        rows.extend(row("Knee, medial share of the impulse", "%", &shares, 0));
    }
    let columns = ["", "Unit", "Right", "Left", "Difference [%]"].map(str::to_owned).to_vec();
    (!rows.is_empty()).then(|| table(["contact_loads", "Joint contact loads", NOTE], columns, rows))
}

/// A row; `None` if neither side has values.
fn row(name: &str, unit: &str, sides: &BySide<Vec<f64>>, digits: usize) -> Option<Vec<Cell>> {
    if sides.values().all(Vec::is_empty) {
        return None;
    }
    let [right, left] = Side::BOTH.map(|side| mean_cell(&sides[side], digits, None));
    let index = right.value.zip(left.value).and_then(|(right, left)| symmetry_index(right, left));
    let difference = number(index.map(|index| 100.0 * index), 0, Some([-ASYMMETRIC, ASYMMETRIC]));
    Some(vec![text(name), text(unit), right, left, difference])
}

/// Peaks and impulse of every whole stance of a leg.
fn stances(results: &Results, load: &Load, side: Side) -> Vec<Stance> {
    let Some(curve) = &load.curves[side] else { return Vec::new() };
    results.cycles_of(side).filter_map(|cycle| stance(results, cycle, &curve.values)).collect()
}

fn stance(results: &Results, cycle: &PageCycle, values: &[f64]) -> Option<Stance> {
    let off_s = cycle.start_s + (cycle.end_s - cycle.start_s) * cycle.foot_off_percent? / 100.0;
    let middle_s = f64::midpoint(cycle.start_s, off_s);
    let samples = || results.times.iter().copied().zip(values.iter().copied());
    let largest = |from_s: f64, to_s: f64| {
        let inside = samples().filter(|(time_s, _)| (from_s..=to_s).contains(time_s));
        inside.map(|(_, value)| value).fold(f64::NEG_INFINITY, f64::max)
    };
    let inside = samples().filter(|(time_s, _)| (cycle.start_s..=off_s).contains(time_s));
    let impulse = inside.map(|(_, value)| value).sum::<f64>() * results.grid.step_s;
    let found = [largest(cycle.start_s, middle_s), largest(middle_s, off_s), impulse];
    found.iter().all(|value| value.is_finite()).then_some(found)
}
