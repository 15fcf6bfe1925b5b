//! Units of the columns of tables (docs/OUTPUTS.md).

use crate::{
    CLINICAL, FOOT_CONTACT, GROUND, GROUND_MEASURED, GROUND_SD, KINEMATICS, KINEMATICS_RECORDED, MOMENTS,
    MOMENTS_BIOLOGICAL, POWERS, REACTIONS,
};
use ambulo::model::{CoordinateKind, Model};

/// Whether a file is an OpenSim storage file; other tables are comma-separated values.
#[must_use]
pub fn is_storage(file: &str) -> bool {
    file.ends_with(".sto") || file.ends_with(".mot")
}

/// The unit of a column of a table: `deg`, `N.m`, `s`; empty if it has none or is not known. `model` is the body of the
/// run.
#[must_use]
pub fn unit_of(file: &str, column: &str, model: Option<&Model>) -> &'static str {
    if column.eq_ignore_ascii_case("time") {
        return "s";
    }
    if column.starts_with("ground_source_") {
        return "1";
    }
    match file {
        KINEMATICS | KINEMATICS_RECORDED => model.map_or("", |model| unit_of_coordinate(column, model)),
        MOMENTS | MOMENTS_BIOLOGICAL if column.ends_with("_force") => "N",
        MOMENTS | MOMENTS_BIOLOGICAL => "N.m",
        POWERS => "W",
        FOOT_CONTACT => "1",
        REACTIONS | GROUND | GROUND_SD | GROUND_MEASURED => unit_of_load(column),
        CLINICAL => unit_of_clinical(column),
        _ => "",
    }
}

fn unit_of_coordinate(name: &str, model: &Model) -> &'static str {
    match model.coordinates().iter().find(|coordinate| coordinate.name == name).map(|coordinate| coordinate.kind) {
        Some(CoordinateKind::Rotation) => "deg",
        Some(CoordinateKind::Translation) => "m",
        Some(CoordinateKind::Coupled) => "rad",
        None => "",
    }
}

/// Force and moment have a letter for the kind before the letter of the axis: `_vx`, `_fx`, `_px`, `_mx`; the free
/// moment is a torque.
fn unit_of_load(column: &str) -> &'static str {
    let column = column.trim_end_matches("_sd");
    if column.starts_with("ground_torque") {
        return "N.m";
    }
    match column.as_bytes() {
        [.., b'v' | b'f', _] => "N",
        [.., b'm', _] => "N.m",
        [.., b'p', _] => "m",
        _ => "",
    }
}

/// Body weights are a ratio, so ground forces have the unit `BW` of `cycles.csv`.
fn unit_of_clinical(column: &str) -> &'static str {
    if column.starts_with("ground_force") {
        "BW"
    } else if column.contains("_moment") {
        "N.m/kg"
    } else if column.contains("_power") {
        "W/kg"
    } else {
        "deg"
    }
}
