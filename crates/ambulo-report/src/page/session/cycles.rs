//! Finds the times of the cycles in `cycles.csv`.
//!
//! The file numbers cycles but has no times. A cycle lies between two strikes of one foot in `events.csv`, but not
//! every pair of strikes is a cycle of the file (cycles that no plate measured are left out). A cycle's angles and
//! positions identify its pair: sampled from `kinematics.mot` between the right pair of strikes, they equal the curves
//! of the file.

use super::sides;
use crate::page::contract::{PageCycle, PageEvent};
use ambulo::model::Side;
use ambulo::motion::interpolate;
use ambulo_formats::table::Table;
use ambulo_results::CycleRow;

/// Curves of the same cycle differ by less than this (rounding); curves of other cycles differ by more at some point
/// [deg or m].
const SAME: f64 = 0.02;

/// The cycles with their times, right foot first; empty without curves.
pub(super) fn cycles(events: &[PageEvent], curves: &[CycleRow], kinematics: &Table, times: &[f64]) -> Vec<PageCycle> {
    let mut list = Vec::new();
    for side in Side::BOTH {
        let of_side = || events.iter().filter(|event| event.side == sides::page(side));
        let strikes: Vec<f64> = of_side().filter(|event| event.strike).map(|event| event.time_s).collect();
        let mut pairs: Vec<[f64; 2]> = strikes.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        for number in numbers(curves, side) {
            let of_cycle: Vec<&CycleRow> =
                curves.iter().filter(|curve| curve.side == side && curve.cycle == number).collect();
            let Some(place) = nearest(&pairs, &of_cycle, side, kinematics, times) else { continue };
            let [start_s, end_s] = pairs[place];
            pairs.drain(..=place);
            let off = of_side().find(|event| !event.strike && event.time_s > start_s && event.time_s < end_s);
            let foot_off_percent = off.map(|off| 100.0 * (off.time_s - start_s) / (end_s - start_s));
            list.push(PageCycle { side: sides::page(side), number, start_s, end_s, foot_off_percent });
        }
    }
    list
}

/// Numbers of a foot's cycles, ascending.
fn numbers(curves: &[CycleRow], side: Side) -> Vec<usize> {
    let mut numbers: Vec<usize> = curves.iter().filter(|curve| curve.side == side).map(|curve| curve.cycle).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The first pair of strikes between which the motion equals the curves; otherwise the nearest pair.
fn nearest(pairs: &[[f64; 2]], curves: &[&CycleRow], side: Side, kinematics: &Table, times: &[f64]) -> Option<usize> {
    let mut best: Option<(usize, f64)> = None;
    for (place, pair) in pairs.iter().enumerate().filter(|(_, pair)| pair[1] > pair[0]) {
        let least = best.map_or(f64::INFINITY, |(_, least)| least);
        let mut distances = curves.iter().filter_map(|curve| distance(curve, *pair, side, kinematics, times));
        // Stops at the first curve that is farther away than the best pair.
        let Some(largest) = distances.try_fold(0.0_f64, |largest, x| (x < least).then(|| largest.max(x))) else {
            continue;
        };
        best = Some((place, largest));
        if largest < SAME {
            break;
        }
    }
    best.map(|(place, _)| place)
}

/// Largest distance of a curve from the motion between two strikes; `None` if the motion has no such column.
fn distance(
    curve: &CycleRow,
    [start_s, end_s]: [f64; 2],
    side: Side,
    kinematics: &Table,
    times: &[f64],
) -> Option<f64> {
    let stem = ["_angle", "_position"].iter().find_map(|suffix| curve.quantity.strip_suffix(suffix))?;
    let column = kinematics.column(&format!("{stem}_{}", side.letter())).or_else(|| kinematics.column(stem))?;
    let last = (curve.values.len() - 1) as f64;
    let at = |k: usize| interpolate(times, column, start_s + (end_s - start_s) * k as f64 / last);
    let largest = curve.values.iter().enumerate().map(|(k, value)| (value - at(k)).abs());
    Some(largest.fold(0.0, f64::max))
}
