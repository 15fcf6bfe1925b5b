//! Description of motions of Xsens MVN.

use super::Sheet;
use super::sheet::wrapped;
use ambulo::findings::Findings;
use ambulo::motion::{Event, EventKind, events_from_mvnx, segment_poses_from_mvnx};
use ambulo_formats::mvnx::Mvnx;
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;

pub(super) fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let (mvnx, remarks) = Mvnx::read(bytes)?;
    let mut sheet = Sheet::of("motion of Xsens MVN");
    sheet.text("version", &format!("{} (MVN {})", known(&mvnx.version), known(&mvnx.software)));
    sheet.text("subject", known(&mvnx.subject));
    sheet.text("recorded_on", known(&mvnx.recorded_on));
    sheet.text("configuration", known(&mvnx.configuration));
    sheet.value("frames", mvnx.frames.len());
    sheet.value("from_s", mvnx.frames.first().map(|frame| frame.index as f64 / mvnx.rate_hz));
    sheet.value("to_s", mvnx.frames.last().map(|frame| frame.index as f64 / mvnx.rate_hz));
    sheet.value("rate_hz", mvnx.rate_hz);
    sheet.names("segments", &mvnx.segments.iter().map(|segment| segment.label.as_str()).collect::<Vec<_>>());
    sheet.names("joints", &mvnx.joints.iter().map(|joint| joint.label.as_str()).collect::<Vec<_>>());
    sheet.names("calibration_poses", &mvnx.calibration.iter().map(|(kind, _)| kind.as_str()).collect::<Vec<_>>());
    add_contacts(&mut sheet, &mvnx);
    let mut findings = Findings::default();
    match segment_poses_from_mvnx(&mvnx, &mut findings) {
        Ok(poses) => {
            sheet.text("segment_axes", &poses.statement);
            sheet.remarks(&remarks);
            sheet.findings(&findings);
            sheet.next(format!(
                "ambulo forces {} --mass KG --height M -o out (the file contains no mass; without --height the stature \
                 is estimated from the legs)",
                path.display()
            ));
        }
        Err(error) => {
            sheet.remarks(&remarks);
            sheet.entry("motion", Value::Null, vec![format!("none: {error}")]);
        }
    }
    Ok(sheet)
}

fn known(text: &str) -> &str {
    if text.is_empty() { "not stated" } else { text }
}

/// Adds the contacts of the feet, and the foot strikes that their flags show.
fn add_contacts(sheet: &mut Sheet, mvnx: &Mvnx) {
    if mvnx.contacts.is_empty() {
        sheet.entry("foot_contacts", Value::Null, vec!["none".to_owned()]);
        return;
    }
    let events = events_from_mvnx(mvnx);
    let strikes: Vec<&Event> = events.iter().filter(|event| event.kind == EventKind::Strike).collect();
    let shown: Vec<String> = strikes.iter().map(|event| format!("{} {:.3} s", event.side, event.time_s)).collect();
    let mut lines = vec![mvnx.contacts.join(", "), format!("foot strikes: {}", strikes.len())];
    lines.extend(wrapped(&shown.iter().map(String::as_str).collect::<Vec<_>>()));
    let values: Vec<Value> =
        strikes.iter().map(|event| json!({ "side": event.side.letter(), "time_s": event.time_s })).collect();
    sheet.entry("foot_contacts", json!({ "contacts": mvnx.contacts, "strikes": values }), lines);
}
