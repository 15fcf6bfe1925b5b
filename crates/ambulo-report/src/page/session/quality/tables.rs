//! Quality tables: markers, plates and feet, events, agreement with plates, residual reduction.

use crate::clinical::ClinicalQuantity;
use crate::page::contract::Table;
use crate::page::session::cells::{Column, at_most_none, count, listed, name, number, text, unit};
use crate::page::session::results::Results;
use crate::page::session::words;
use ambulo::analysis::{EventAgreement, FootAgreement, ForceAgreement, MomentAgreement};
use ambulo::model::Side;
use ambulo::numerics::Order;
use ambulo::simulation::consistent_walk::Magnitude;
use ambulo_results::{ConsistencySummary, MarkerErrorSummary, PlateContactSummary, SegmentSummary, Summary};

/// A marker error above this is marked [mm]: such a marker has little weight in the fit (docs/MARKERS.md).
const FAR_MM: f64 = 40.0;

/// A marker, the frames in which it is missing, and its region of the body.
type MarkerRow = (MarkerErrorSummary, usize, &'static str);
/// The compared source, the reference, and their agreement.
type EventRow = (&'static str, &'static str, EventAgreement);
/// A foot, a component of its force, and the agreement of prediction and plates.
type ForceRow = (Side, &'static str, ForceAgreement);
/// A changed quantity, the size of the change (root mean square and maximum), and the unit.
type ChangeRow = (String, [f64; 2], &'static str);

const MARKERS: [Column<MarkerRow>; 7] = [
    ("Marker", |(marker, ..)| text(&marker.name)),
    ("Region", |(.., region)| text(region)),
    ("RMS [mm]", |(marker, ..)| number(marker.rms_mm, 1, Some([f64::NEG_INFINITY, FAR_MM]))),
    ("Largest [mm]", |(marker, ..)| number(marker.max_mm, 1, None)),
    ("Frames visible", |(marker, ..)| count(marker.frames_seen)),
    ("Frames missing", |(_, missing, _)| at_most_none(*missing)),
    ("Frames rejected", |(marker, ..)| at_most_none(marker.frames_refused)),
];
const PLATES: [Column<PlateContactSummary>; 7] = [
    ("Plate", |contact| text(&contact.plate)),
    ("Foot", |contact| text(&contact.side.map_or_else(|| "-".to_owned(), |side| side.to_string()))),
    ("From [s]", |contact| number(Some(contact.start_s), 2, None)),
    ("To [s]", |contact| number(Some(contact.end_s), 2, None)),
    ("Peak [N]", |contact| number(Some(contact.peak_n), 0, None)),
    ("Contact", |contact| text(contact.quality.word())),
    ("Why not clean", |contact| text(&contact.reason)),
];
const EVENTS: [Column<EventRow>; 8] = [
    ("Source", |(found, ..)| text(found)),
    ("Compared with", |(_, reference, _)| text(reference)),
    ("Event", |(.., events)| text(events.kind.word())),
    ("Pairs", |(.., events)| count(events.pairs)),
    ("Missed", |(.., events)| at_most_none(events.missed)),
    ("Extra", |(.., events)| at_most_none(events.extra)),
    ("Mean distance [ms]", |(.., events)| number(Some(events.mean_absolute_ms), 0, None)),
    ("Mean delay [ms]", |(.., events)| number(Some(events.bias_ms), 0, None)),
];
const AGREEMENT: [Column<ForceRow>; 6] = [
    ("Foot", |(side, ..)| text(&side.to_string())),
    ("Component", |(_, component, _)| text(component)),
    ("RMSE [%BW]", |(.., force)| number(Some(100.0 * force.rmse_bw), 1, None)),
    ("RMSE / range [%]", |(.., force)| number(Some(100.0 * force.rrmse), 1, None)),
    ("r", |(.., force)| number(Some(force.r), 3, None)),
    ("Inside the 90 % band [%]", |(.., force)| number(Some(100.0 * force.band.holds), 0, None)),
];
const CENTERS: [Column<FootAgreement>; 5] = [
    ("Foot", |foot| text(&foot.side.to_string())),
    ("Fore-aft RMS [mm]", |foot| number(Some(foot.center_of_pressure.fore_aft_mm), 0, None)),
    ("Sideways RMS [mm]", |foot| number(Some(foot.center_of_pressure.lateral_mm), 0, None)),
    ("Samples", |foot| count(foot.center_of_pressure.samples)),
    ("Samples without a prediction", |foot| count(foot.center_of_pressure.missing)),
];
const MOMENTS: [Column<MomentAgreement>; 4] = [
    ("Moment", |moment| text(&moment.quantity)),
    ("RMSE [N.m]", |moment| number(Some(moment.rmse_nm), 1, None)),
    ("RMSE [N.m/kg]", |moment| number(Some(moment.rmse_nm_kg), 2, None)),
    ("r", |moment| number(Some(moment.r), 3, None)),
];
const CHANGES: [Column<ChangeRow>; 4] = [
    ("Changed", |(name, ..)| text(name)),
    ("RMS", |(_, [rms, _], _)| number(Some(*rms), 2, None)),
    ("Largest", |(_, [_, largest], _)| number(Some(*largest), 2, None)),
    ("Unit", |(.., symbol)| unit(symbol)),
];
const SEGMENTS: [Column<SegmentSummary>; 3] = [
    ("Segment", |segment| text(&segment.body)),
    ("Length / table", |segment| number(Some(segment.factor), 3, None)),
    ("Measured by markers", |segment| text(if segment.measured { "yes" } else { "no" })),
];
const ADJUSTMENT: [Column<(String, Magnitude)>; 3] = [
    ("Angle", |(name, _)| text(name)),
    ("RMS [deg]", |(_, size)| number(Some(size.rms), 1, None)),
    ("Largest [deg]", |(_, size)| number(Some(size.largest), 1, None)),
];
const TIMES: [Column<(String, [f64; 2])>; 3] = [
    ("Check", |(check, _)| name(check)),
    ("From [s]", |(_, [from, _])| number(Some(*from), 2, None)),
    ("To [s]", |(_, [_, to])| number(Some(*to), 2, None)),
];

/// Tables whose row names come from the files.
const NAMED_BY_FILES: [&str; 3] = ["moments", "changes", "adjustment"];

/// All tables with rows.
pub(super) fn tables(results: &Results, quantities: &[ClinicalQuantity]) -> Vec<Table> {
    let plates = "Which foot loaded which plate; a force is assigned to one foot if the contact is clean.";
    let events = "Differences between foot strikes and foot offs from different sources.";
    let forces = "Over whole stances with the foot wholly on a plate of its own. The 90 % band is the prediction ± \
        1.645 standard deviations; the panels draw ± 1.";
    let segments = "Lengths of the segments of the built-in body, relative to its table for this stature.";
    let Summary { subject, comparison, prediction, consistency, walk, .. } = &results.summary;
    let contacts = subject.iter().flat_map(|subject| &subject.plates);
    let feet = || comparison.iter().flat_map(|comparison| &comparison.feet);
    let moments = comparison.iter().flat_map(|comparison| &comparison.moments);
    let checks = prediction.iter().flat_map(|prediction| &prediction.checks);
    let times: Vec<(String, [f64; 2])> =
        checks.filter_map(|check| Some((check.name.to_string(), check.time_s?))).collect();
    let changes: Vec<ChangeRow> = consistency.iter().flat_map(changes).collect();
    let adjustment = walk.iter().filter_map(|walk| walk.adjustment_deg.clone()).flatten().collect::<Vec<_>>();
    let lengths = subject.iter().flat_map(|subject| &subject.segments);
    let tables = [
        listed(["markers", "Markers", MARKER_NOTE], &markers(results), &MARKERS),
        listed(["plates", "Plates and feet", plates], contacts, &PLATES),
        listed(["events", "Events", events], &event_rows(results), &EVENTS),
        listed(
            ["agreement", "Ground forces: prediction compared with plates", forces],
            &feet().flat_map(components).collect::<Vec<_>>(),
            &AGREEMENT,
        ),
        listed(["centers", "Centre of pressure: prediction compared with plates", ""], feet(), &CENTERS),
        listed(["moments", "Joint moments: with predicted compared with measured forces", ""], moments, &MOMENTS),
        listed(["check_times", "Times of the checks", ""], &times, &TIMES),
        listed(["changes", "Changes by residual reduction", ""], &changes, &CHANGES),
        listed(["adjustment", "Changes of the angles of the gait", ""], &adjustment, &ADJUSTMENT),
        listed(["segments", "Segments", segments], lengths, &SEGMENTS),
    ];
    let mut tables: Vec<Table> = tables.into_iter().flatten().collect();
    for table in tables.iter_mut().filter(|table| NAMED_BY_FILES.contains(&table.id.as_str())) {
        words::reword(table, 0, quantities);
    }
    tables
}

const MARKER_NOTE: &str =
    "Distance of each marker from its place on the body, largest first. Frames without the marker are left out.";

/// Largest error first, with the number of frames in which the marker is missing.
fn markers(results: &Results) -> Vec<MarkerRow> {
    let markers = || results.summary.subject.iter().map(|subject| &subject.markers);
    let region = |name: &String| {
        let own = markers().flat_map(|markers| &markers.regions).find(|(_, fit)| fit.markers.contains(name));
        own.map_or("-", |(region, _)| region.words())
    };
    let missing = |error: &MarkerErrorSummary| results.grid.frames.saturating_sub(error.frames_seen);
    let errors = markers().flat_map(|markers| &markers.errors);
    let mut rows: Vec<MarkerRow> = errors.map(|error| (error.clone(), missing(error), region(&error.name))).collect();
    let size = |row: &MarkerRow| row.0.rms_mm.unwrap_or(f64::INFINITY);
    rows.sort_by_number(|row| -size(row));
    rows
}

/// One row per source and kind of event.
fn event_rows(results: &Results) -> Vec<EventRow> {
    let listed = results.summary.subject.iter().flat_map(|subject| &subject.events);
    let mut rows: Vec<EventRow> = listed
        .flat_map(|entry| entry.kinds.iter().map(|kind| (entry.found.word(), entry.reference.word(), *kind)))
        .collect();
    let compared = results.summary.comparison.iter().flat_map(|comparison| &comparison.events);
    rows.extend(compared.map(|kind| ("prediction", "plates", *kind)));
    rows
}

/// One row per component of the force on a foot.
fn components(foot: &FootAgreement) -> [ForceRow; 3] {
    let rows = [("vertical", foot.vertical), ("fore-aft", foot.fore_aft), ("sideways", foot.lateral)];
    rows.map(|(component, force)| (foot.side, component, force))
}

/// Changes of the coordinates and of the loaded feet.
fn changes(consistency: &ConsistencySummary) -> Vec<ChangeRow> {
    let coordinates =
        consistency.changes.iter().map(|(name, size)| (name.clone(), [size.rms, size.max], size.unit.symbol()));
    let feet = consistency.feet_mm.iter().map(|(body, size)| (body.clone(), [size.rms, size.max], "mm"));
    coordinates.chain(feet).collect()
}
