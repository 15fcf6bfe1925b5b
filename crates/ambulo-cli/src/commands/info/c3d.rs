//! Description of C3D recordings.

use super::sheet::{short, wrapped};
use super::{Sheet, markers};
use ambulo::findings::Findings;
use ambulo::ground::foot_motion::foot_motion;
use ambulo::ground::plates::{ContactQuality, PlateContact, feet_on_plates, plates_under_feet};
use ambulo::motion::{
    Laboratory, MarkerRecording, PlateRecording, PlateSettings, RecordedMotion, SegmentPoses, SubjectParameters,
    laboratory, motion_from_c3d, plates_from_c3d, subject_from_c3d,
};
use ambulo::numerics::Order;
use ambulo_formats::c3d::{C3d, Channel, Encoding, Processor, Rotation, Storage};
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;

/// POINT parameters that list points other than markers, and the words for these points.
const GROUPS: [(&str, &str); 7] = [
    ("ANGLES", "angles"),
    ("MOMENTS", "moments"),
    ("FORCES", "forces"),
    ("POWERS", "powers"),
    ("SCALARS", "scalars"),
    ("MODELED_MARKERS", "modelled markers"),
    ("REACTIONS", "reactions"),
];

pub(super) fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let (c3d, remarks) = C3d::read(bytes)?;
    let times = c3d.times();
    let mut sheet = Sheet::of("C3D recording");
    sheet.text("encoding", &encoding(&c3d.encoding));
    sheet.value("written_by", written_by(&c3d));
    sheet.value("frames", c3d.frames());
    sheet.value("first_frame", c3d.first_frame);
    sheet.value("from_s", times.first().copied());
    sheet.value("to_s", times.last().copied());
    sheet.value("rate_hz", c3d.point_rate_hz);
    sheet.value("analog_rate_hz", (!c3d.channels.is_empty()).then_some(c3d.analog_rate_hz));
    sheet.text("unit", if c3d.point_unit.is_empty() { "not stated" } else { &c3d.point_unit });
    let mut findings = Findings::default();
    let recorded = motion_from_c3d(&c3d, &mut findings);
    let known = match &recorded {
        Ok(RecordedMotion { markers, poses: None }) => markers::add_markers(&mut sheet, markers).is_some(),
        Ok(RecordedMotion { poses: Some(_), .. }) => true,
        Err(error) => {
            sheet.entry("markers", Value::Null, vec![format!("none: {error}")]);
            false
        }
    };
    add_poses(&mut sheet, &c3d, recorded.as_ref().ok().and_then(|recorded| recorded.poses.as_ref()));
    let of_poses = recorded.as_ref().is_ok_and(|recorded| recorded.poses.is_some());
    let recording = recorded.map(|recorded| recorded.markers);
    let markers = recording.as_ref().map_or(0, |recording| if of_poses { 0 } else { recording.markers.len() });
    add_points(&mut sheet, &c3d, markers);
    add_channels(&mut sheet, &c3d.channels);
    let plates = plates_from_c3d(&c3d, PlateSettings::default(), &mut findings);
    match &plates {
        Ok(plates) => add_plates(&mut sheet, plates),
        Err(error) => sheet.entry("plates", Value::Null, vec![format!("unusable: {error}")]),
    }
    add_events(&mut sheet, &c3d);
    let subject = subject_from_c3d(&c3d);
    add_subject(&mut sheet, &subject);
    let plates = plates.unwrap_or_default();
    if let Ok(recording) = &recording {
        let axes = laboratory(recording, &plates, &c3d.point_unit, &mut findings);
        sheet.text("axes", &axes.statement);
        add_feet(&mut sheet, recording, &plates, &axes, &mut findings);
    }
    sheet.remarks(&remarks);
    sheet.findings(&findings);
    if let Ok(recording) = &recording {
        let next =
            if of_poses { next_of_poses(path, &subject) } else { next(path, recording, known, &subject, &plates) };
        sheet.next(next);
    }
    Ok(sheet)
}

fn next(
    path: &Path,
    recording: &MarkerRecording,
    known: bool,
    subject: &SubjectParameters,
    plates: &[PlateRecording],
) -> String {
    let mass = subject.mass_kg.is_none().then_some("--mass KG");
    let height = subject.height_m.is_none().then_some("--height M");
    let stands = markers::stands_still(recording);
    let ground = (!stands && !plates.iter().any(|plate| plate.peak_n() > 0.0)).then_some("--no-ground");
    let options: Vec<&str> = [mass, height, ground].into_iter().flatten().collect();
    markers::next(path, recording, known, &options.join(" "))
}

/// The command for poses of segments, which need no standing trial.
fn next_of_poses(path: &Path, subject: &SubjectParameters) -> String {
    let mass = subject.mass_kg.is_none().then_some(" --mass KG");
    let height = subject.height_m.is_none().then_some(" --height M");
    format!("ambulo forces {}{}{} -o out", path.display(), mass.unwrap_or_default(), height.unwrap_or_default())
}

/// Adds the poses of segments: their labels, the segments that drive the body, and the frames in which they are seen.
fn add_poses(sheet: &mut Sheet, c3d: &C3d, poses: Option<&SegmentPoses>) {
    if c3d.rotations.is_empty() {
        return;
    }
    let samples = c3d.frames() * c3d.rotations_per_frame();
    let seen = |rotation: &Rotation| (0..samples).filter(|&sample| rotation.is_seen(sample)).count();
    let values = c3d.rotations.iter().map(|rotation| json!({ "label": rotation.name, "samples_seen": seen(rotation) }));
    let mut lines = vec![format!("{} at {} Hz", c3d.rotations.len(), short(c3d.rotation_rate_hz))];
    let fewest = c3d.rotations.iter().map(seen).min().unwrap_or(0);
    lines[0] += &format!(", each seen in at least {fewest} of {samples} samples");
    lines.extend(wrapped(&c3d.rotations.iter().map(|rotation| rotation.name.as_str()).collect::<Vec<_>>()));
    sheet.entry("segment_poses", values.collect::<Vec<_>>(), lines);
    if let Some(poses) = poses {
        sheet.text("segment_axes", &poses.statement);
    }
}

fn encoding(encoding: &Encoding) -> String {
    let processor = match encoding.processor {
        Processor::Intel => "Intel (little-endian)",
        Processor::Dec => "DEC (VAX)",
        Processor::Sgi => "SGI/MIPS (big-endian)",
    };
    let storage = match encoding.storage {
        Storage::Integer => "integers with a scale",
        Storage::Real => "reals",
    };
    format!("{processor}, {storage}")
}

/// Company, software and version as stated in the file.
fn written_by(c3d: &C3d) -> Option<String> {
    let words = ["COMPANY", "SOFTWARE", "VERSION_LABEL", "VERSION"];
    let texts = words.into_iter().filter_map(|name| c3d.parameters.text("MANUFACTURER", name));
    let texts: Vec<&str> = texts.map(str::trim).filter(|text| !text.is_empty()).collect();
    (!texts.is_empty()).then(|| texts.join(" "))
}

/// Adds points that are not markers, by groups.
fn add_points(sheet: &mut Sheet, c3d: &C3d, markers: usize) {
    let mut lines = vec![(c3d.points.len() - markers.min(c3d.points.len())).to_string()];
    let mut groups = serde_json::Map::new();
    for (parameter, word) in GROUPS {
        let listed = c3d.parameters.texts("POINT", parameter);
        let names: Vec<&str> = listed.into_iter().filter(|name| c3d.point(name).is_some()).collect();
        if !names.is_empty() {
            lines.push(format!("{word}: {}", names.len()));
            lines.extend(wrapped(&names).into_iter().map(|line| format!("  {line}")));
            groups.insert(word.replace(' ', "_"), json!(names));
        }
    }
    let unlabelled = c3d.points.iter().filter(|point| point.name.trim().starts_with('*')).count();
    if unlabelled > 0 {
        lines.push(format!("without a label: {unlabelled}"));
    }
    if c3d.points.len() > markers {
        sheet.entry("other_points", groups, lines);
    }
}

fn add_channels(sheet: &mut Sheet, channels: &[Channel]) {
    let named = |channel: &Channel| match channel.unit.trim() {
        "" => channel.name.clone(),
        unit => format!("{} [{unit}]", channel.name),
    };
    let names: Vec<String> = channels.iter().map(named).collect();
    sheet.names("analog_channels", &names.iter().map(String::as_str).collect::<Vec<_>>());
}

fn add_plates(sheet: &mut Sheet, plates: &[PlateRecording]) {
    let values = plates.iter().map(|plate| {
        json!({
            "name": plate.name,
            "type": plate.kind,
            "corners_m": plate.corners.map(|corner| [corner.x, corner.y, corner.z]),
            "size_m": size(plate),
            "peak_n": plate.peak_n(),
            "loaded_s": loaded(plate),
            "baseline_n": plate.baseline_n,
        })
    });
    let values: Vec<Value> = values.collect();
    let lines = std::iter::once(plates.len().to_string()).chain(plates.iter().map(plate_line)).collect();
    sheet.entry("plates", values, lines);
}

fn plate_line(plate: &PlateRecording) -> String {
    let [width, length] = size(plate);
    let center = plate.center();
    let spans: Vec<String> = loaded(plate).iter().map(|[from, to]| format!("{from:.3}-{to:.3} s")).collect();
    let load = if spans.is_empty() {
        "never loaded".to_owned()
    } else {
        format!("loaded {}, peak {:.1} N", spans.join(", "), plate.peak_n())
    };
    let baseline = plate.baseline_n.map_or(String::new(), |n| format!(", baseline {n:.1} N removed"));
    format!(
        "{}: type {}, {width:.3} x {length:.3} m, centre {:.3} {:.3} {:.3} m, {load}{baseline}",
        plate.name, plate.kind, center.x, center.y, center.z
    )
}

/// Adds which foot was on which force plate.
fn add_feet(
    sheet: &mut Sheet,
    recording: &MarkerRecording,
    plates: &[PlateRecording],
    axes: &Laboratory,
    findings: &mut Findings,
) {
    let markers = axes.markers(recording);
    let turned: Vec<PlateRecording> = plates.iter().map(|plate| axes.plate(plate)).collect();
    let motion = foot_motion(&markers, findings);
    let turned = plates_under_feet(&markers, turned, &motion, findings);
    let feet = feet_on_plates(&markers, &turned, &motion, &[], findings);
    if feet.contacts.is_empty() {
        return;
    }
    let foot = |contact: &PlateContact| match (contact.quality, contact.side) {
        (ContactQuality::TwoFeet, _) => String::new(),
        (_, Some(side)) => format!("{side} foot, "),
        (_, None) => "unknown foot, ".to_owned(),
    };
    let values = feet.contacts.iter().map(|contact| {
        json!({
            "plate": plates[contact.plate].name,
            "side": contact.side.map(ambulo::model::Side::letter),
            "span_s": [contact.start_s, contact.end_s],
            "quality": contact.quality.word(),
            "reason": contact.reason,
        })
    });
    let line = |contact: &PlateContact| {
        let reason = if contact.reason.is_empty() { String::new() } else { format!(": {}", contact.reason) };
        let (plate, quality) = (&plates[contact.plate].name, contact.quality.word());
        format!("{plate}, {:.3}-{:.3} s: {}{quality}{reason}", contact.start_s, contact.end_s, foot(contact))
    };
    let lines = std::iter::once(feet.contacts.len().to_string()).chain(feet.contacts.iter().map(line)).collect();
    sheet.entry("feet_on_plates", values.collect::<Vec<_>>(), lines);
    let windows: Vec<String> = feet.windows.iter().map(|[from, to]| format!("{from:.3}-{to:.3} s")).collect();
    let shown = if windows.is_empty() { "never".to_owned() } else { windows.join(", ") };
    sheet.entry("every_foot_on_a_plate_s", json!(feet.windows), vec![shown]);
}

/// Lengths of the first two edges [m].
fn size(plate: &PlateRecording) -> [f64; 2] {
    let [a, b, c, _] = plate.corners;
    [(b - a).norm(), (c - b).norm()]
}

/// Times during which the plate was loaded [s]; contacts and gaps shorter than 0.05 s are noise.
fn loaded(plate: &PlateRecording) -> Vec<[f64; 2]> {
    const SHORTEST: f64 = 0.05;
    let mut spans: Vec<[f64; 2]> = Vec::new();
    for (sample, &time) in plate.times.iter().enumerate().filter(|(sample, _)| plate.is_loaded(*sample)) {
        let previous = sample.checked_sub(1).map_or(f64::NEG_INFINITY, |before| plate.times[before]);
        match spans.last_mut() {
            Some(span) if previous <= span[1] || time - span[1] < SHORTEST => span[1] = time,
            _ => spans.push([time, time]),
        }
    }
    spans.retain(|[from, to]| to - from >= SHORTEST);
    spans
}

fn add_events(sheet: &mut Sheet, c3d: &C3d) {
    let mut events: Vec<_> = c3d.events.iter().collect();
    events.sort_by_number(|event| event.time_s);
    let values: Vec<Value> = events
        .iter()
        .map(|event| json!({ "time_s": event.time_s, "label": event.label, "context": event.context }))
        .collect();
    let lines = events.iter().map(|e| format!("{:.3} s {} {}", e.time_s, e.context, e.label).replace("  ", " "));
    sheet.entry("events", values, std::iter::once(events.len().to_string()).chain(lines).collect());
}

fn add_subject(sheet: &mut Sheet, subject: &SubjectParameters) {
    for (label, value) in [("subject", &subject.name), ("recorded_on", &subject.recorded_on)] {
        if let Some(value) = value {
            sheet.value(label, value.clone());
        }
    }
    // C3D stores single precision; two decimals are enough to read.
    let rounded = |value: Option<f64>| value.map(|value| format!("{value:.2}")).into_iter().collect();
    sheet.entry("mass_kg", json!(subject.mass_kg), rounded(subject.mass_kg));
    sheet.entry("height_m", json!(subject.height_m), rounded(subject.height_m));
    if !subject.processing.is_empty() {
        // Names that begin with a sign are internal to a program; --json lists them too.
        let own = subject.processing.iter().filter(|(name, _)| name.starts_with(char::is_alphabetic));
        let lines: Vec<String> = own.map(|(name, value)| format!("{name} {}", short(*value))).collect();
        let lines = wrapped(&lines.iter().map(String::as_str).collect::<Vec<_>>());
        let value: serde_json::Map<String, Value> =
            subject.processing.iter().map(|(name, value)| (name.clone(), json!(value))).collect();
        sheet.entry("processing", value, lines);
    }
}
