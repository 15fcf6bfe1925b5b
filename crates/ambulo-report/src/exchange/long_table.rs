//! Results over time as one long table with one number per row, for programs that group and draw by quantity.
//!
//! `time` [s], `quantity` (the column in its file), `unit`, `value`. Where a foot is unloaded its centre of pressure
//! and free moment have no rows, because the zeros of `grf.mot` there are not measurements.

use crate::stage::folder_motion;
use ambulo::model::{CoordinateKind, Model};
use ambulo_formats::table::{Table, guarded};
use ambulo_results::{Folder, GROUND, GROUND_MEASURED, GROUND_SD, MOMENTS, MOMENTS_BIOLOGICAL, POWERS, ResultsError};
use std::fmt::Write;

const HEAD: &str = "time,quantity,unit,value\n";
/// Tables whose column endings imply the unit, and the suffix added to the names.
const TABLES: [(&str, &str); 6] = [
    (MOMENTS, ""),
    (MOMENTS_BIOLOGICAL, "_biological"),
    (POWERS, ""),
    (GROUND, ""),
    (GROUND_SD, ""),
    (GROUND_MEASURED, "_measured"),
];
/// Endings of columns and units.
const UNITS: [(&str, &str); 3] = [("_moment", "N.m"), ("_force", "N"), ("_power", "W")];

/// The table of a folder, or the reason why it has none.
pub(super) fn long_table(folder: &Folder<'_>) -> Result<Result<String, String>, ResultsError> {
    let mut text = HEAD.to_owned();
    let motion = folder_motion(folder)?;
    if let Ok(motion) = &motion {
        for (name, values) in motion.angles.columns().skip(1) {
            let unit = unit_of_coordinate(&motion.model, name);
            add(&mut text, &motion.angles, name, unit, |row| Some(values[row]));
        }
    }
    for (file, suffix) in TABLES {
        let Some(table) = folder.table(file)? else { continue };
        for (name, values) in table.columns().skip(1) {
            let quantity = format!("{name}{suffix}");
            let loaded = load(&table, name);
            let shown = |row: usize| loaded.is_none_or(|vertical| vertical[row].abs() > 0.0).then_some(values[row]);
            add(&mut text, &table, &quantity, unit(name), shown);
        }
    }
    let reason = || motion.err().unwrap_or_else(|| "there are no results over time".to_owned());
    Ok(if text.len() > HEAD.len() { Ok(text) } else { Err(reason()) })
}

/// Writes a row for every finite number.
fn add(text: &mut String, table: &Table, quantity: &str, unit: &str, value: impl Fn(usize) -> Option<f64>) {
    let times = table.times().unwrap_or_default();
    let quantity = quoted(quantity);
    for (row, time) in times.iter().enumerate() {
        if let Some(value) = value(row).filter(|value| value.is_finite()) {
            let _ = writeln!(text, "{time},{quantity},{unit},{value}");
        }
    }
}

fn unit_of_coordinate(model: &Model, name: &str) -> &'static str {
    let kind = model.coordinate(name).map(|id| model.coordinates()[id.index()].kind);
    match kind {
        Some(CoordinateKind::Rotation) => "deg",
        Some(CoordinateKind::Translation) => "m",
        Some(CoordinateKind::Coupled) => "rad",
        None => "",
    }
}

fn unit(name: &str) -> &'static str {
    if let Some(rest) = name.strip_prefix("ground_") {
        return match rest {
            _ if rest.starts_with("torque") => "N.m",
            _ if rest.contains("_p") => "m",
            _ => "N",
        };
    }
    UNITS.iter().find(|(ending, _)| name.ends_with(ending)).map_or("", |(_, unit)| unit)
}

/// The vertical force that a foot must have for this column to have a meaning; `None` for columns that always have one.
fn load<'a>(table: &'a Table, name: &str) -> Option<&'a [f64]> {
    let rest = name.strip_prefix("ground_torque_").or_else(|| {
        let rest = name.strip_prefix("ground_force_")?;
        rest.contains("_p").then_some(rest)
    })?;
    table.column(&format!("ground_force_{}_vy", rest.split('_').next()?))
}

fn quoted(name: &str) -> String {
    let name = guarded(name);
    if name.contains([',', '"']) { format!("\"{}\"", name.replace('"', "\"\"")) } else { name.into_owned() }
}
