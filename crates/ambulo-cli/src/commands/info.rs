//! `ambulo info`: what a file holds.

use crate::args::InfoArgs;
use crate::{Verdict, files, printer};
use ambulo::findings::Findings;
use ambulo::model::{CoordinateKind, Drive, from_osim};
use ambulo_formats::external_loads::ExternalLoads;
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use anyhow::{Context, Result, bail};
use serde_json::{Value, json};
use std::path::Path;

pub(crate) fn run(args: &InfoArgs) -> Result<Verdict> {
    let bytes = files::read(&args.file)?;
    let info = describe(&args.file, &bytes).with_context(|| args.file.display().to_string())?;
    printer::info(&info, args.voice)?;
    Ok(Verdict::Accepted)
}

/// What the file holds, as a flat list of keys; the same for text and JSON.
fn describe(path: &Path, bytes: &[u8]) -> Result<Value> {
    let ending = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match ending.as_str() {
        "osim" => model(bytes),
        "mot" | "sto" => Ok(table("OpenSim storage", &Table::read_storage(bytes)?.0)),
        "csv" => Ok(table("CSV", &Table::read_csv(bytes)?.0)),
        "trc" => Ok(markers(&Trc::read(bytes)?.0)),
        "xml" => Ok(loads(&ExternalLoads::read(bytes)?.0)),
        _ => bail!("unknown kind of file `.{ending}`; expected .osim, .mot, .sto, .csv, .trc or .xml (external loads)"),
    }
}

fn model(bytes: &[u8]) -> Result<Value> {
    let document = OsimModel::read(bytes)?;
    let mut findings = Findings::default();
    let model = from_osim(&document, &mut findings)?;
    let coordinates: Vec<String> = model
        .coordinates()
        .iter()
        .map(|c| {
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
        })
        .collect();
    let bodies: Vec<String> =
        model.bodies().iter().map(|b| format!("{} ({:.3} kg)", b.name, b.inertia.mass())).collect();
    let gravity: Vec<f64> = model.gravity().iter().copied().collect();
    Ok(json!({
        "kind": "OpenSim model",
        "document_version": document.document_version,
        "name": model.name(),
        "mass_kg": model.mass(),
        "gravity_m_s2": gravity,
        "bodies": bodies,
        "coordinates": coordinates,
        "markers": model.markers().len(),
        "findings": findings.as_slice().iter().map(ToString::to_string).collect::<Vec<_>>(),
    }))
}

fn table(kind: &str, table: &Table) -> Value {
    let times = table.times().unwrap_or_default();
    let angles = match table.in_degrees {
        Some(true) => "degrees",
        Some(false) => "radians",
        None => "not stated",
    };
    json!({
        "kind": kind,
        "name": table.name,
        "rows": table.rows(),
        "from_s": times.first(),
        "to_s": times.last(),
        "rate_hz": rate(times),
        "angles": angles,
        "columns": table.names(),
    })
}

fn rate(times: &[f64]) -> Option<f64> {
    let duration = times.last()? - times.first()?;
    (duration > 0.0).then(|| (times.len() - 1) as f64 / duration)
}

fn markers(trc: &Trc) -> Value {
    let times = trc.times();
    let gaps = |m: &&ambulo_formats::trc::Marker| m.positions_m.iter().any(|p| p[0].is_nan());
    json!({
        "kind": "marker trajectories",
        "name": trc.name,
        "unit": trc.unit.symbol(),
        "frames": times.len(),
        "first_frame": trc.frames().first(),
        "from_s": times.first(),
        "to_s": times.last(),
        "rate_hz": trc.rate_hz,
        "markers": trc.markers().iter().map(|m| m.name.as_str()).collect::<Vec<_>>(),
        "markers_with_gaps": trc.markers().iter().filter(gaps).map(|m| m.name.as_str()).collect::<Vec<_>>(),
    })
}

fn loads(loads: &ExternalLoads) -> Value {
    let forces: Vec<String> = loads
        .forces
        .iter()
        .map(|f| {
            let columns = f.force_identifier.as_deref().unwrap_or("no columns");
            let switch = if f.enabled { "" } else { ", switched off" };
            format!("{}: {columns} on {}{switch}", f.name, f.applied_to_body)
        })
        .collect();
    json!({ "kind": "external loads", "name": loads.name, "data_file": loads.datafile, "forces": forces })
}
