//! Energies of a scene and the work of its solver, over time.

use super::instants::Instants;
use crate::report::page::block::Block;
use crate::report::page::contract::{Group, Origin, Role, Trace};
use crate::report::page::folder::{Folder, PageError};
use crate::report::page::session::quality::over_time;
use crate::report::stage::csv_rows::Row;

const FILE: &str = "energy.csv";
const HEAD: &str = "time,kinetic,gravity,springs,total,iterations,factorizations,residual";

/// A column: its place in the file and its name.
type Column = (usize, &'static str);

/// Panels with their unit and columns.
const PANELS: [([&str; 3], &[Column]); 3] = [
    (["energy", "Energy", "J"], &[(1, "kinetic"), (2, "gravity"), (3, "springs"), (4, "total")]),
    (["iterations", "Solves a step", ""], &[(5, "iterations"), (6, "factorizations")]),
    (["solver_residual", "Residual of the solver, relative", ""], &[(7, "residual")]),
];

/// The grid; none without the file.
pub(super) fn groups(folder: &Folder<'_>, instants: &Instants, block: &mut Block) -> Result<Option<Group>, PageError> {
    let Some(text) = folder.text(FILE)? else { return Ok(None) };
    let mut columns: [Vec<(f64, f64)>; 8] = Default::default();
    for row in Row::all(folder, FILE, &text, HEAD)? {
        let [time] = row.numbers(0)?;
        for (column, values) in columns.iter_mut().enumerate().skip(1) {
            values.push((time, row.number_or_gap(column)?));
        }
    }
    let mut trace = |&(column, name): &Column| Trace {
        name: name.to_owned(),
        side: None,
        role: Role::Main,
        values: block.add(&instants.nearest(&columns[column])),
        sd: None,
        origin: Some(Origin { file: FILE.to_owned(), column: name.to_owned(), factor: 1.0 }),
    };
    let panels =
        PANELS.iter().map(|(head, traces)| over_time(*head, ["", ""], traces.iter().map(&mut trace).collect()));
    Ok(Some(Group {
        id: "energy".to_owned(),
        title: "Energy and solver".to_owned(),
        note: Some("Energies of all bodies; gravity counts from height 0.".to_owned()),
        columns: 3,
        panels: panels.collect(),
    }))
}
