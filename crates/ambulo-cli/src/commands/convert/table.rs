//! Conversion of tables: OpenSim storage and CSV.

use super::Converted;
use crate::args::ConvertArgs;
use crate::files;
use ambulo::findings::{Code, Findings};
use ambulo_formats::table::Table;
use anyhow::{Context, Result, bail};

pub(super) fn convert(args: &ConvertArgs, bytes: &[u8], from: &str, to: &str) -> Result<Converted> {
    let shown = args.input.display().to_string();
    let read = if from == "csv" { Table::read_csv(bytes) } else { Table::read_storage(bytes) };
    let (table, remarks) = read.with_context(|| shown.clone())?;
    let mut findings = Findings::default();
    files::note_remarks(&shown, &remarks, &mut findings);
    if to != "csv" && table.times().is_none() {
        let first = table.names().first().map_or("nothing", String::as_str);
        bail!("{shown}: the first column is `{first}`; expected `time`, which OpenSim requires");
    }
    if to == "csv" && table.in_degrees.is_some() {
        let angles = if table.in_degrees == Some(true) { "degrees" } else { "radians" };
        findings
            .report(Code::ConvertLost, format!("not carried over: the header's statement that angles are in {angles}"));
    }
    if from == "csv" {
        let message = "a CSV does not say whether angles are in degrees; the new header does not either";
        findings.report(Code::ConvertDegrees, message);
    }
    let bytes = if to == "csv" { table.write_csv() } else { table.write_storage() };
    Ok(Converted { files: vec![(args.output.clone(), bytes)], findings })
}
