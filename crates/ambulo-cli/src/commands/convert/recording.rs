//! Conversion of laboratory recordings: C3D and TRC.

use super::{Converted, counted, report_lost};
use crate::args::{C3dPart, ConvertArgs};
use crate::files;
use ambulo::analysis::LaboratoryRecording;
use ambulo::findings::{Code, Findings};
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::plates::feet_on_plates;
use ambulo::motion::{
    MarkerRecording, PlateRecording, PlateSettings, RecordedMotion, laboratory, markers_from_trc, motion_from_c3d,
    plates_from_c3d,
};
use ambulo::study::LaboratoryFile;
use ambulo_formats::c3d::C3d;
use ambulo_formats::table::Table;
use ambulo_formats::trc::Trc;
use ambulo_report::{GroundReactions, c3d_of_markers, ground_reactions, table_of_markers, trc_of_markers};
use anyhow::{Context, Result, bail};

pub(super) fn convert(args: &ConvertArgs, bytes: &[u8], from: &str, to: &str) -> Result<Converted> {
    let shown = args.input.display().to_string();
    let read = if from == "c3d" { from_c3d(args, bytes, to) } else { from_trc(args, bytes, to) };
    read.context(shown)
}

fn from_trc(args: &ConvertArgs, bytes: &[u8], to: &str) -> Result<Converted> {
    let (trc, remarks) = Trc::read(bytes)?;
    let mut findings = Findings::default();
    files::note_remarks(&args.input.display().to_string(), &remarks, &mut findings);
    let markers = markers_from_trc(&trc, &mut findings)?;
    let markers = in_requested_axes(args, markers, &[], trc.unit.symbol(), &mut findings);
    let bytes = marker_bytes(&markers, to)?;
    Ok(Converted { files: vec![(args.output.clone(), bytes)], findings })
}

fn from_c3d(args: &ConvertArgs, bytes: &[u8], to: &str) -> Result<Converted> {
    let (c3d, remarks) = C3d::read(bytes)?;
    let mut findings = Findings::default();
    files::note_remarks(&args.input.display().to_string(), &remarks, &mut findings);
    match (to, args.what.unwrap_or(C3dPart::Markers)) {
        ("mot" | "sto", _) | (_, C3dPart::Forces) => forces(args, &c3d, to, findings),
        ("csv", C3dPart::Analog) => {
            report_lost(&mut findings, &others(&c3d, &[counted(c3d.points.len(), "point")]));
            let table = analog_table(&c3d)?;
            Ok(Converted { files: vec![(args.output.clone(), table.write_csv())], findings })
        }
        _ => {
            let RecordedMotion { markers, poses } = motion_from_c3d(&c3d, &mut findings)?;
            let own = if poses.is_some() { 0 } else { markers.markers.len() };
            let other = c3d.points.len().saturating_sub(own);
            let channels = counted(c3d.channels.len(), "analog channel");
            report_lost(&mut findings, &others(&c3d, &[counted(other, "other point"), channels]));
            let plates =
                if args.world { plates_from_c3d(&c3d, PlateSettings::default(), &mut findings)? } else { vec![] };
            let markers = in_requested_axes(args, markers, &plates, &c3d.point_unit, &mut findings);
            let bytes = marker_bytes(&markers, to)?;
            Ok(Converted { files: vec![(args.output.clone(), bytes)], findings })
        }
    }
}

/// Other content of a C3D, which no other format can hold.
fn others(c3d: &C3d, first: &[Option<String>]) -> Vec<String> {
    let parameters: usize = c3d.parameters.groups.iter().map(|group| group.parameters.len()).sum();
    let rest = [counted(c3d.events.len(), "event"), counted(parameters, "parameter")];
    first.iter().cloned().chain(rest).flatten().collect()
}

/// Rotates markers to world axes if `--world` is given.
fn in_requested_axes(
    args: &ConvertArgs,
    markers: MarkerRecording,
    plates: &[PlateRecording],
    unit: &str,
    findings: &mut Findings,
) -> MarkerRecording {
    if !args.world {
        return markers;
    }
    let axes = laboratory(&markers, plates, unit, findings);
    findings.report(Code::ConvertAxes, axes.statement.clone());
    axes.markers(&markers)
}

fn marker_bytes(markers: &MarkerRecording, to: &str) -> Result<Vec<u8>> {
    Ok(match to {
        "trc" => trc_of_markers(markers)?.write(),
        "c3d" => c3d_of_markers(markers).write()?,
        _ => table_of_markers(markers)?.write_csv(),
    })
}

/// `time` and one column per channel with its unit in brackets; repeated names are numbered.
fn analog_table(c3d: &C3d) -> Result<Table> {
    if c3d.channels.is_empty() {
        bail!("there are no analog channels; expected at least one");
    }
    let mut columns = vec![("time".to_owned(), c3d.analog_times())];
    for channel in &c3d.channels {
        let unit = channel.unit.trim();
        let unit = if unit.is_empty() { String::new() } else { format!(" [{unit}]") };
        let own = format!("{}{unit}", channel.name.trim());
        let numbered = (2..).map(|k| format!("{own} #{k}"));
        let free = std::iter::once(own.clone()).chain(numbered).find(|name| columns.iter().all(|(n, _)| n != name));
        columns.push((free.unwrap_or(own), channel.samples.clone()));
    }
    Ok(Table::new("analog", columns)?)
}

/// Ground forces per foot, with OpenSim external loads.
fn forces(args: &ConvertArgs, c3d: &C3d, to: &str, mut findings: Findings) -> Result<Converted> {
    let (axes, recording) = LaboratoryFile::recording_of_c3d(c3d, &mut findings)?.in_world(&mut findings);
    findings.report(Code::ConvertAxes, axes.statement);
    let LaboratoryRecording { markers, plates, .. } = recording;
    let motion = foot_motion(&markers, &mut findings);
    let feet = feet_on_plates(&markers, &plates, &motion, &[], &mut findings);
    let Some(GroundReactions { table, mut loads, is_level }) = ground_reactions(&plates, &feet)? else {
        bail!("there are no force plates; expected at least one");
    };
    if !is_level {
        let message = "the force plates have different heights; every centre of pressure was moved to the height of \
            the first plate";
        findings.report(Code::ConvertHeights, message);
    }
    let points = counted(c3d.points.len(), "point");
    report_lost(&mut findings, &others(c3d, &[points, counted(c3d.channels.len(), "raw analog channel")]));
    if to == "csv" {
        return Ok(Converted { files: vec![(args.output.clone(), table.write_csv())], findings });
    }
    loads.datafile = args.output.file_name().map(|name| name.to_string_lossy().into_owned());
    let files = vec![(args.output.clone(), table.write_storage()), (args.output.with_extension("xml"), loads.write())];
    Ok(Converted { files, findings })
}
