//! Description of skeletons in motion.

use super::Sheet;
use ambulo::findings::Findings;
use ambulo::motion::skeleton::skeleton_from_bvh;
use ambulo_formats::bvh::{Bvh, ChannelKind, Joint};
use anyhow::Result;
use serde_json::Value;
use std::path::Path;

pub(super) fn describe(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let (bvh, remarks) = Bvh::read(bytes)?;
    let frames = bvh.frames();
    let mut sheet = Sheet::of("skeleton in motion (BVH)");
    sheet.value("frames", frames);
    sheet.value("rate_hz", 1.0 / bvh.frame_time_s());
    sheet.value("duration_s", frames.saturating_sub(1) as f64 * bvh.frame_time_s());
    sheet.names("joints", &bvh.joints().iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>());
    sheet.value("channels", bvh.channels());
    sheet.text("rotations", &rotation_orders(bvh.joints()));
    sheet.names("joints_that_slide", &sliding(bvh.joints()));
    add_body(&mut sheet, &bvh, path);
    sheet.remarks(&remarks);
    Ok(sheet)
}

/// Adds how Ambulo interprets the skeleton.
fn add_body(sheet: &mut Sheet, bvh: &Bvh, path: &Path) {
    let mut findings = Findings::default();
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    match skeleton_from_bvh(bvh, &name, None, &mut findings) {
        Ok(skeleton) => {
            sheet.text("axes", &skeleton.statement);
            sheet.value("height_m", skeleton.height_m);
            let centres: Vec<&str> = skeleton.markers.markers.iter().map(|marker| marker.name.as_str()).collect();
            sheet.names("recognised", &centres);
            sheet.findings(&findings);
            sheet.next(format!(
                "ambulo forces {} --mass KG --height M -o out (the file contains neither mass nor unit of length; \
                 forces will be estimates)",
                path.display()
            ));
        }
        Err(error) => sheet.entry("axes", Value::Null, vec![format!("unknown: {error}")]),
    }
}

/// The orders of rotations that occur, most frequent first: `ZXY (22 joints), none (1)`.
fn rotation_orders(joints: &[Joint]) -> String {
    let mut orders: Vec<(String, usize)> = Vec::new();
    for joint in joints {
        let turning = joint.channels.iter().filter(|channel| channel.kind == ChannelKind::Rotation);
        let order: String = turning.map(|channel| ['X', 'Y', 'Z'][channel.axis.min(2)]).collect();
        match orders.iter_mut().find(|(known, _)| *known == order) {
            Some((_, count)) => *count += 1,
            None => orders.push((order, 1)),
        }
    }
    orders.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let named = |(order, count): &(String, usize)| {
        let order = if order.is_empty() { "none" } else { order.as_str() };
        format!("{order} ({count} joint{})", if *count == 1 { "" } else { "s" })
    };
    orders.iter().map(named).collect::<Vec<_>>().join(", ")
}

/// Joints with position channels.
fn sliding(joints: &[Joint]) -> Vec<&str> {
    let slides = |joint: &&Joint| joint.channels.iter().any(|channel| channel.kind == ChannelKind::Position);
    joints.iter().filter(slides).map(|joint| joint.name.as_str()).collect()
}
