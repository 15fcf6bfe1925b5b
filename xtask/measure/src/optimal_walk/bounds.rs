//! What bounds the criteria that are missed: the same walks with other costs.

use super::criteria::{self, Criterion};
use super::{BUILDS, FREE, Found, MAN, find_with, spatial};
use crate::normative::{Band, SPEEDS};
use crate::table::Table;
use crate::walk_bands::build_name;
use ambulo::optimal::WalkCosts;

/// Beginnings of the names of the rows that are missed.
const ROWS: [&str; 4] = ["peaks of the hip abduction", "sideways force over stance", "step width", "slip of a stance"];

/// A change of the costs.
type Change = (&'static str, fn(&mut WalkCosts));

/// Each cost that has to do with these rows is twice as large, or half.
const CHANGES: [Change; 7] = [
    ("none", |_| {}),
    ("sideways force costs twice as much", |costs| costs.sideways_force *= 0.5_f64.sqrt()),
    ("sideways force costs half as much", |costs| costs.sideways_force *= 2.0_f64.sqrt()),
    ("hip adduction follows people twice as closely", |costs| costs.hip_adduction *= 0.5_f64.sqrt()),
    ("hip adduction follows people half as closely", |costs| costs.hip_adduction *= 2.0_f64.sqrt()),
    ("hip abduction moment follows people twice as closely", |costs| costs.abduction *= 0.5_f64.sqrt()),
    ("slip costs half as much", |costs| costs.slip *= 2.0_f64.sqrt()),
];

/// The missed rows of two walks, for each change of the costs.
pub(super) struct Bounds(Vec<(String, &'static str, Vec<Criterion>)>);

/// Very slow walking of the main figure, and free walking of the last of the other figures.
pub(super) fn measure(people: [&[Band]; 2], sideways: &[f64]) -> Result<Bounds, String> {
    let last = BUILDS[BUILDS.len() - 1];
    let mut all = Vec::new();
    for ((build, speed), bands) in [(MAN, 0), (last, FREE)].into_iter().zip(people) {
        for (name, change) in CHANGES {
            let mut costs = WalkCosts::default();
            change(&mut costs);
            let found: Found = find_with(&spatial(&build)?, SPEEDS[speed], None, &costs)?;
            let walk = format!("{}, {:.2} m/s", build_name(&build), found.speed);
            all.push((walk, name, criteria::all(&found, bands, speed, sideways)));
        }
    }
    Ok(Bounds(all))
}

impl Bounds {
    pub(super) fn text(&self) -> String {
        let mut table = Table::new(&[
            "walk",
            "change",
            "peaks of the hip abduction moment",
            "sideways force, r",
            "step width [m]",
            "slip [mm]",
            "criteria met",
        ]);
        for (walk, change, lines) in &self.0 {
            let of = |name: &str| lines.iter().find(|line| line.what.starts_with(name));
            let [a, b, c, d] = ROWS.map(|name| of(name).map_or_else(String::new, super::page::cell));
            let judged: Vec<&Criterion> = lines.iter().filter(|line| !line.limit.is_empty()).collect();
            let met = judged.iter().filter(|line| line.met).count();
            table.row([walk.clone(), (*change).to_owned(), a, b, c, d, format!("{met} of {}", judged.len())]);
        }
        format!(
            "The walks with missed rows, solved again with one cost changed by a factor of two, which is a factor of 1.41 of its deviation.\n\n{}",
            table.text()
        )
    }
}
