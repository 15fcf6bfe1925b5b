//! Description of markers, in TRC and other files.

use super::Sheet;
use super::sheet::wrapped;
use ambulo::analysis::{LaboratoryRecording, MarkerUse, marker_use};
use ambulo::findings::Findings;
use ambulo::model::Side;
use ambulo::model::marker_set::{Landmark, MarkerSet, RecognisedMarkers};
use ambulo::motion::{MarkerPath, MarkerRecording, laboratory, markers_from_trc};
use ambulo::numerics::counted;
use ambulo_formats::trc::Trc;
use anyhow::Result;
use serde_json::{Value, json};
use std::path::Path;

/// Markers of a standing trial move less than this [m].
const STILL: f64 = 0.1;

pub(super) fn describe_trc(path: &Path, bytes: &[u8]) -> Result<Sheet> {
    let (trc, remarks) = Trc::read(bytes)?;
    let times = trc.times();
    let mut sheet = Sheet::of("marker trajectories");
    sheet.text("name", &trc.name);
    sheet.text("unit", trc.unit.symbol());
    sheet.value("frames", times.len());
    sheet.value("first_frame", trc.frames().first().copied());
    sheet.value("from_s", times.first().copied());
    sheet.value("to_s", times.last().copied());
    sheet.value("rate_hz", trc.rate_hz);
    let mut findings = Findings::default();
    match markers_from_trc(&trc, &mut findings) {
        Ok(recording) => {
            let set = add_markers(&mut sheet, &recording);
            let axes = laboratory(&recording, &[], trc.unit.symbol(), &mut findings);
            sheet.text("axes", &axes.statement);
            sheet.remarks(&remarks);
            sheet.findings(&findings);
            sheet.next(next(path, &recording, set.is_some(), "--mass KG --height M"));
        }
        Err(error) => {
            sheet.names("markers", &trc.markers().iter().map(|m| m.name.as_str()).collect::<Vec<_>>());
            sheet.remarks(&remarks);
            sheet.text("unusable", &error.to_string());
        }
    }
    Ok(sheet)
}

/// Describes markers that are all that a file contains.
pub(super) fn describe_recording(
    sheet: &mut Sheet,
    path: &Path,
    recording: &MarkerRecording,
    unit: &str,
    findings: &mut Findings,
) {
    sheet.value("frames", recording.frames());
    sheet.value("from_s", recording.times.first().copied());
    sheet.value("to_s", recording.times.last().copied());
    sheet.value("rate_hz", recording.rate_hz);
    let set = add_markers(sheet, recording);
    let axes = laboratory(recording, &[], unit, findings);
    sheet.text("axes", &axes.statement);
    sheet.next(next(path, recording, set.is_some(), "--mass KG --height M"));
}

/// The command to type next with markers.
pub(super) fn next(path: &Path, recording: &MarkerRecording, is_known: bool, subject: &str) -> String {
    let shown = path.display();
    let subject = if subject.is_empty() { String::new() } else { format!(" {subject}") };
    if !is_known {
        return format!(
            "ambulo forces {shown} --markers SET.toml{subject} -o out (docs/MARKERS.md explains marker sets), or \
             --model MODEL.osim if the model has these markers"
        );
    }
    let names = recording.markers.iter().map(|marker| marker.name.as_str());
    if MarkerSet::recognise(names).is_ok_and(|recognised| recognised.has_hips_only()) {
        return format!("ambulo forces {shown}{subject} -o out (keypoints need no standing trial)");
    }
    if stands_still(recording) {
        return format!("a standing trial: ambulo forces WALK --static {shown}{subject} -o out");
    }
    format!(
        "ambulo forces {shown} --static STANDING{subject} -o out (without --static the body is calibrated from this \
         trial)"
    )
}

/// Adds the markers, their gaps and their marker set; returns the names of the sets if a body can be built from them.
pub(super) fn add_markers(sheet: &mut Sheet, recording: &MarkerRecording) -> Option<Vec<String>> {
    let names: Vec<&str> = recording.markers.iter().map(|marker| marker.name.as_str()).collect();
    sheet.names("markers", &names);
    add_gaps(sheet, recording);
    match MarkerSet::recognise(names.iter().copied()) {
        Ok(recognised) => {
            let known = recognised.markers.len();
            let head = format!("{}, {known} of {}", recognised.sets.join(" with "), counted(names.len(), "marker"));
            let unknown: Vec<&str> = recognised.unknown.iter().map(String::as_str).collect();
            let mut lines = vec![head];
            if !unknown.is_empty() {
                lines.extend(
                    wrapped(&unknown)
                        .into_iter()
                        .enumerate()
                        .map(|(k, line)| if k == 0 { format!("unknown: {line}") } else { line }),
                );
            }
            sheet.entry("marker_set", json!({ "sets": &recognised.sets, "known": known, "unknown": unknown }), lines);
            add_use(sheet, recording);
            shows_a_pelvis(&recognised).then_some(recognised.sets)
        }
        Err(error) => {
            sheet.entry("marker_set", Value::Null, vec![format!("not recognised: {error}")]);
            None
        }
    }
}

/// Adds which markers of a motion the built-in body follows; a standing trial does not show with which segment a marker
/// moves.
fn add_use(sheet: &mut Sheet, recording: &MarkerRecording) {
    if stands_still(recording) {
        return;
    }
    let whole =
        LaboratoryRecording { markers: recording.clone(), poses: None, plates: Vec::new(), unit: String::new() };
    let Some(MarkerUse { used, unused }) = marker_use(&whole) else { return };
    let all = used.len() + unused.len();
    let mut lines = vec![format!("{} of {} by the built-in body", used.len(), counted(all, "marker"))];
    if !unused.is_empty() {
        let names: Vec<&str> = unused.iter().map(String::as_str).collect();
        let shown = wrapped(&names).into_iter().enumerate();
        lines.extend(shown.map(|(k, line)| if k == 0 { format!("not used: {line}") } else { line }));
    }
    sheet.entry("markers_used", json!({ "used": used, "unused": unused }), lines);
}

/// Whether the recognised markers show a pelvis, without which no body can be built.
fn shows_a_pelvis(recognised: &RecognisedMarkers) -> bool {
    let both = |landmark| Side::BOTH.into_iter().all(|side| recognised.on(landmark, Some(side)).is_some());
    let back = both(Landmark::Psis) || recognised.on(Landmark::Sacrum, None).is_some();
    both(Landmark::HipCentre) || (both(Landmark::Asis) && back)
}

/// Adds the gaps of markers.
pub(super) fn add_gaps(sheet: &mut Sheet, recording: &MarkerRecording) {
    let gaps: Vec<Gaps> = recording.markers.iter().filter_map(|marker| Gaps::of(marker, recording.rate_hz)).collect();
    let lines: Vec<String> = gaps.iter().map(|gap| gap.line(recording.frames())).collect();
    let values = gaps.iter().map(|gap| {
        json!({ "marker": gap.name, "gaps": gap.count, "missing_frames": gap.missing, "longest_s": gap.longest_s })
    });
    let head = if gaps.is_empty() { "none".to_owned() } else { gaps.len().to_string() };
    sheet.entry("markers_with_gaps", values.collect::<Vec<_>>(), std::iter::once(head).chain(lines).collect());
}

/// The gaps of a marker.
struct Gaps<'m> {
    name: &'m str,
    count: usize,
    missing: usize,
    longest_s: f64,
}

impl Gaps<'_> {
    fn of(marker: &MarkerPath, rate_hz: f64) -> Option<Gaps<'_>> {
        let (mut count, mut missing, mut longest, mut run) = (0, 0, 0, 0);
        for frame in 0..marker.positions.len() {
            if marker.is_seen(frame) {
                run = 0;
                continue;
            }
            count += usize::from(run == 0);
            run += 1;
            missing += 1;
            longest = longest.max(run);
        }
        (missing > 0).then(|| Gaps { name: &marker.name, count, missing, longest_s: longest as f64 / rate_hz })
    }

    fn line(&self, frames: usize) -> String {
        let Gaps { name, count, missing, longest_s } = self;
        if *missing == frames {
            return format!("{name}: never visible");
        }
        let (gaps, lost) = (counted(*count, "gap"), counted(*missing, "frame"));
        let share = 100.0 * *missing as f64 / frames as f64;
        format!("{name}: {gaps}, {lost} ({share:.0} %), longest {longest_s:.3} s")
    }
}

/// Whether this is a standing trial: no marker moves by [`STILL`] or more.
pub(super) fn stands_still(recording: &MarkerRecording) -> bool {
    let extent = |marker: &MarkerPath| {
        let seen = || (0..marker.positions.len()).filter(|&frame| marker.is_seen(frame)).map(|i| marker.positions[i]);
        let (low, high) = (seen().reduce(|a, b| a.inf(&b))?, seen().reduce(|a, b| a.sup(&b))?);
        Some((high - low).amax())
    };
    recording.markers.iter().filter_map(extent).fold(0.0, f64::max) < STILL
}
