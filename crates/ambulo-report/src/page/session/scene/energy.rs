//! Panels of the energies of a scene and the iterations of its solver over time.

use super::instants::Instants;
use crate::page::block::Block;
use crate::page::contract::{Group, Origin, Role, Trace};
use crate::page::session::quality::over_time;
use crate::stage::csv_rows::Row;
use ambulo_results::{ENERGY, Folder, ResultsError};

const HEAD: &str = "time,kinetic,gravity,springs,total,iterations,factorizations,residual";

/// Columns: index in the file, name, heading, unit.
const COLUMNS: [(usize, &str, &str, &str); 7] = [
    (4, "total", "Total energy", "J"),
    (1, "kinetic", "Kinetic energy", "J"),
    (2, "gravity", "Potential energy (gravity)", "J"),
    (3, "springs", "Potential energy (springs)", "J"),
    (5, "iterations", "Tree solves per time step", ""),
    (6, "factorizations", "Factorisations per time step", ""),
    (7, "residual", "Residual of the solver, relative", ""),
];

/// The group of panels; `None` without the file.
pub(super) fn groups(
    folder: &Folder<'_>,
    instants: &Instants,
    block: &mut Block,
) -> Result<Option<Group>, ResultsError> {
    let Some(text) = folder.text(ENERGY)? else { return Ok(None) };
    let mut columns: [Vec<(f64, f64)>; 8] = Default::default();
    for row in Row::all(folder, ENERGY, &text, HEAD)? {
        let [time] = row.numbers(0)?;
        for (column, values) in columns.iter_mut().enumerate().skip(1) {
            values.push((time, row.number_or_gap(column)?));
        }
    }
    let panels = COLUMNS.iter().map(|&(column, name, title, unit)| {
        let trace = Trace {
            name: name.to_owned(),
            side: None,
            role: Role::Main,
            values: block.add(&instants.nearest(&columns[column])),
            sd: None,
            predicted: Vec::new(),
            origin: Some(Origin { file: ENERGY.to_owned(), column: name.to_owned(), factor: 1.0 }),
        };
        over_time([&format!("energy_{name}"), title, unit], ["", ""], vec![trace])
    });
    Ok(Some(Group {
        id: "energy".to_owned(),
        title: "Energy and solver".to_owned(),
        note: Some("Energies of all bodies; the potential energy is zero at height 0.".to_owned()),
        columns: 3,
        panels: panels.collect(),
    }))
}
