//! The files of a run, as names and bytes.

use crate::cycle_table::{self, cycle_rows};
use crate::tables;
use ambulo::analysis::Analysis;
use ambulo::model::Model;
use ambulo_formats::Error;

/// A file to be written.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputFile {
    /// Name, relative to the output folder.
    pub name: String,
    /// Content.
    pub bytes: Vec<u8>,
}

/// Every table of a run. `device`, if worn, is its generalised forces: one column a coordinate [N.m or N], one
/// entry a frame; what remains for the body is written beside the total.
///
/// # Errors
/// Column names that no table can hold.
pub fn output_files(model: &Model, analysis: &Analysis, device: Option<&[Vec<f64>]>) -> Result<Vec<OutputFile>, Error> {
    let file = |name: &str, bytes: Vec<u8>| OutputFile { name: name.to_owned(), bytes };
    let rows = cycle_rows(model, analysis);
    let mut files = vec![
        file("kinematics.mot", tables::kinematics(model, analysis)?.write_storage()),
        file("moments.sto", tables::moments(model, analysis, None)?.write_storage()),
        file("powers.sto", tables::powers(model, analysis)?.write_storage()),
        file("reactions.sto", tables::reactions(model, analysis)?.write_storage()),
    ];
    if let Some(device) = device {
        let biological = tables::moments(model, analysis, Some(device))?;
        files.push(file("moments_biological.sto", biological.write_storage()));
    }
    if !analysis.ground.bodies.is_empty() {
        files.push(file("grf.mot", tables::ground(model, analysis)?.write_storage()));
        files.push(file("external_loads.xml", tables::external_loads(model, analysis).write()));
        files.push(file("events.csv", tables::events_csv(analysis).into_bytes()));
    }
    if !rows.is_empty() {
        files.push(file("cycles.csv", cycle_table::csv(&rows).into_bytes()));
    }
    Ok(files)
}
