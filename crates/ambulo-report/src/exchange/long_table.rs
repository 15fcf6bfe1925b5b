//! Results over time as one long table with one number per row, for programs that group and draw by quantity.
//!
//! `time` [s], `quantity` (the column in its file), `unit`, `value`. Where a foot is unloaded its centre of pressure
//! and free moment have no rows, because the zeros of `grf.mot` there are not measurements.

use crate::stage::folder_motion;
use ambulo_formats::table::{Table, guarded};
use ambulo_results::{
    FOOT_CONTACT, Folder, GROUND, GROUND_MEASURED, GROUND_SD, KINEMATICS, KINEMATICS_RECORDED, MOMENTS,
    MOMENTS_BIOLOGICAL, POWERS, ResultsError, unit_of,
};
use std::collections::BTreeSet;
use std::fmt::Write;

const HEAD: &str = "time,quantity,unit,value\n";
/// Tables in addition to the motion, and the suffix added to the names of their columns.
const TABLES: [(&str, &str); 8] = [
    (KINEMATICS_RECORDED, "_recorded"),
    (MOMENTS, ""),
    (MOMENTS_BIOLOGICAL, "_biological"),
    (POWERS, ""),
    (GROUND, ""),
    (GROUND_SD, ""),
    (GROUND_MEASURED, "_measured"),
    (FOOT_CONTACT, ""),
];

/// The table of a folder, or the reason why it has none.
pub(super) fn long_table(folder: &Folder<'_>) -> Result<Result<String, String>, ResultsError> {
    let mut text = HEAD.to_owned();
    let motion = folder_motion(folder)?;
    let body = motion.as_ref().ok().map(|motion| &motion.model);
    if let Ok(motion) = &motion {
        for (name, values) in motion.angles.columns().skip(1) {
            add(&mut text, &motion.angles, name, unit_of(KINEMATICS, name, body), |row| Some(values[row]));
        }
    }
    // Several tables mark the sources of the loads.
    let mut known = BTreeSet::new();
    for (file, suffix) in TABLES {
        let Some(table) = folder.table(file)? else { continue };
        for (name, values) in table.columns().skip(1) {
            let is_mark = name.starts_with("ground_source_");
            let quantity = if is_mark { name.to_owned() } else { format!("{name}{suffix}") };
            let loaded = load(&table, name);
            let shown = |row: usize| loaded.is_none_or(|vertical| vertical[row].abs() > 0.0).then_some(values[row]);
            if known.insert(quantity.clone()) {
                add(&mut text, &table, &quantity, unit_of(file, name, body), shown);
            }
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
