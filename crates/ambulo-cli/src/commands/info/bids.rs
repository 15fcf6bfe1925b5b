//! Description of motions of BIDS data sets.

use super::Sheet;
use crate::caller::Caller;
use crate::files::FilesOf;
use ambulo::job::{BidsFiles, read_bids};
use ambulo::motion::is_bids_markers;
use ambulo_formats::bids_motion::{BidsChannel, BidsMotion};
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;

/// Reads the motion and the files next to it.
pub(super) fn describe(path: &Path) -> Result<Sheet> {
    let BidsFiles { motion, rate_hz, .. } = read_bids(&mut FilesOf(&Caller::default()), path)?;
    let mut sheet = Sheet::of("motion of a BIDS data set");
    let rate_hz = rate_hz.or(motion.rate_hz);
    sheet.value("frames", motion.frames());
    sheet.value("rate_hz", rate_hz);
    sheet.value("duration_s", rate_hz.map(|rate_hz| motion.frames().saturating_sub(1) as f64 / rate_hz));
    add_channels(&mut sheet, &motion.channels);
    sheet.names("tracked_points", &points(&motion.channels));
    let bad: Vec<&str> =
        motion.channels.iter().filter(|channel| channel.is_bad).map(|channel| &*channel.name).collect();
    sheet.names("bad_channels", &bad);
    add_next(&mut sheet, &motion, path);
    Ok(sheet)
}

/// Adds number and units of the channels of each type.
fn add_channels(sheet: &mut Sheet, channels: &[BidsChannel]) {
    let mut kinds: Vec<(&str, usize, Vec<&str>)> = Vec::new();
    for channel in channels {
        let place = kinds.iter().position(|(kind, ..)| *kind == channel.kind).unwrap_or_else(|| {
            kinds.push((&channel.kind, 0, Vec::new()));
            kinds.len() - 1
        });
        let (_, count, units) = &mut kinds[place];
        *count += 1;
        let unit = if channel.units.is_empty() { "no unit" } else { channel.units.as_str() };
        if !units.contains(&unit) {
            units.push(unit);
        }
    }
    let value =
        |(kind, count, units): &(&str, usize, Vec<&str>)| json!({ "type": kind, "count": count, "units": units });
    let line = |(kind, count, units): &(&str, usize, Vec<&str>)| format!("{kind}: {count} in {}", units.join(", "));
    let lines = std::iter::once(channels.len().to_string()).chain(kinds.iter().map(line)).collect();
    sheet.entry("channels", kinds.iter().map(value).collect::<Vec<Value>>(), lines);
}

/// The tracked points, each once.
fn points(channels: &[BidsChannel]) -> Vec<&str> {
    let mut points: Vec<&str> = Vec::new();
    for channel in channels.iter().filter(|channel| !channel.tracked_point.is_empty()) {
        if !points.contains(&channel.tracked_point.as_str()) {
            points.push(&channel.tracked_point);
        }
    }
    points
}

fn add_next(sheet: &mut Sheet, motion: &BidsMotion, path: &Path) {
    let shown = path.display();
    match is_bids_markers(motion) {
        Ok(true) => sheet.next(format!("ambulo forces {shown} --mass KG -o out (the tracked points are markers)")),
        Ok(false) => {
            sheet.next(format!(
                "ambulo forces {shown} --model FILE.osim -o out (joint angles are the coordinates of your model)"
            ));
        }
        Err(error) => sheet.entry("motion", Value::Null, vec![format!("none: {error}")]),
    }
}
