//! Description of tables: OpenSim storage and CSV.

use super::{Sheet, markers, sensors};
use ambulo::findings::Findings;
use ambulo::motion::{is_marker_table, markers_from_table};
use ambulo_formats::table::{OrientationTable, Table, coordinate_of_state_path};
use anyhow::Result;
use std::path::Path;

pub(super) fn describe_storage(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    if OrientationTable::is_stated(bytes) {
        return sensors::describe(path, bytes);
    }
    let (table, remarks) = Table::read_storage(bytes)?;
    let mut sheet = describe("OpenSim storage", &table);
    sheet.remarks(&remarks);
    let shown = path.display();
    if let Some(prefixes) = force_prefixes(&table) {
        sheet.names("force_columns", &prefixes.iter().map(String::as_str).collect::<Vec<_>>());
        sheet.next(format!("ambulo forces MOTION.mot --model MODEL.osim --grf {shown} -o out"));
    } else if table.names().iter().filter_map(|name| coordinate_of_state_path(name)).any(|name| name == "pelvis_ty") {
        sheet.next(format!("ambulo forces {shown} --model MODEL.osim -o out"));
    }
    Ok(sheet)
}

pub(super) fn describe_csv(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let (table, remarks) = Table::read_csv(bytes)?;
    if is_marker_table(&table) {
        let mut sheet = Sheet::of("marker trajectories");
        let mut findings = Findings::default();
        let markers = markers_from_table(&table, &path.display().to_string(), &mut findings)?;
        markers::describe_recording(&mut sheet, path, &markers, "m", &mut findings);
        sheet.remarks(&remarks);
        sheet.findings(&findings);
        return Ok(sheet);
    }
    let mut sheet = describe("CSV", &table);
    sheet.remarks(&remarks);
    Ok(sheet)
}

fn describe(kind: &str, table: &Table) -> Sheet {
    let times = table.times().unwrap_or_default();
    let angles = match table.in_degrees {
        Some(true) => "degrees",
        Some(false) => "radians",
        None => "not stated",
    };
    let missing = |values: &[f64]| values.iter().filter(|value| !value.is_finite()).count();
    let gaps = table.columns().filter(|(_, values)| missing(values) > 0);
    let gaps: Vec<String> = gaps.map(|(name, values)| format!("{name}: {} not a number", missing(values))).collect();
    let mut sheet = Sheet::of(kind);
    sheet.text("name", &table.name);
    sheet.value("rows", table.rows());
    sheet.value("from_s", times.first().copied());
    sheet.value("to_s", times.last().copied());
    sheet.value("rate_hz", rate(times));
    sheet.text("angles", angles);
    sheet.names("columns", &table.names().iter().map(String::as_str).collect::<Vec<_>>());
    if !gaps.is_empty() {
        sheet.list("columns_with_gaps", gaps);
    }
    sheet
}

fn rate(times: &[f64]) -> Option<f64> {
    let duration = times.last()? - times.first()?;
    (duration > 0.0).then(|| (times.len() - 1) as f64 / duration)
}

/// The prefixes of the ground-force columns, which precede `vx`, `vy`, `vz`.
fn force_prefixes(table: &Table) -> Option<Vec<String>> {
    let has = |name: &str| table.column(name).is_some();
    let prefix = |name: &String| {
        let prefix = name.strip_suffix("vx")?;
        (has(&format!("{prefix}vy")) && has(&format!("{prefix}px"))).then(|| format!("{prefix}..."))
    };
    let prefixes: Vec<String> = table.names().iter().filter_map(prefix).collect();
    (!prefixes.is_empty()).then_some(prefixes)
}
