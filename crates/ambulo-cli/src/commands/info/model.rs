//! Description of OpenSim models.

use super::Sheet;
use ambulo::findings::Findings;
use ambulo::model::{CoordinateKind, Drive, Model, from_osim};
use ambulo_formats::osim::OsimModel;
use anyhow::Result;
use std::path::Path;

pub(super) fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let document = OsimModel::read(bytes)?;
    let mut findings = Findings::default();
    let model = from_osim(&document, &mut findings)?;
    let bodies = model.bodies().iter().map(|b| format!("{} ({:.3} kg)", b.name, b.inertia.mass())).collect();
    let gravity: Vec<f64> = model.gravity().iter().copied().collect();
    let mut sheet = Sheet::of("OpenSim model");
    sheet.value("document_version", document.document_version);
    sheet.text("name", model.name());
    sheet.value("mass_kg", model.mass());
    sheet.value("gravity_m_s2", gravity);
    sheet.list("bodies", bodies);
    sheet.list("coordinates", coordinates(&model));
    sheet.value("markers", model.markers().len());
    sheet.list("findings", findings.as_slice().iter().map(ToString::to_string).collect());
    let markers = if model.markers().is_empty() { "" } else { ", or markers: ambulo forces TRIAL.c3d --model ..." };
    sheet.next(format!("ambulo forces MOTION.mot --model {} -o out{markers}", path.display()));
    Ok(sheet)
}

fn coordinates(model: &Model) -> Vec<String> {
    let described = |c: &ambulo::model::Coordinate| {
        let kind = match c.kind {
            CoordinateKind::Rotation => "rotation",
            CoordinateKind::Translation => "translation",
            CoordinateKind::Coupled => "coupled",
        };
        let drive = match c.drive {
            Drive::Free => "",
            Drive::Locked => ", locked",
            Drive::Prescribed(_) => ", prescribed",
            Drive::Coupled(..) => ", follows a coupler",
        };
        format!("{} ({kind}{drive})", c.name)
    };
    model.coordinates().iter().map(described).collect()
}
