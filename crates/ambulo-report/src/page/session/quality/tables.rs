//! Tables of quality: markers, plates and feet, events, agreement with plates, changes made.

use crate::clinical::ClinicalQuantity;
use crate::page::contract::Table;
use crate::page::session::cells::Form::{Answer, AtMost, Check, Number, Side, Unit, Words};
use crate::page::session::cells::{Column, column, listed};
use crate::page::session::results::Results;
use crate::page::session::words;
use serde_json::{Value, json};

/// A marker further away than this stands out [mm]: a marker beyond it counts little in the fit (docs/MARKERS.md).
const FAR_MM: f64 = 40.0;

const MARKERS: [Column; 6] = [
    column("Marker", "/name", Words),
    column("RMS [mm]", "/rms_mm", AtMost(1.0, 1, FAR_MM)),
    column("Largest [mm]", "/max_mm", Number(1.0, 1)),
    column("Frames seen", "/frames_seen", Number(1.0, 0)),
    column("Frames in gaps", "/frames_missing", AtMost(1.0, 0, 0.5)),
    column("Frames not believed", "/frames_refused", AtMost(1.0, 0, 0.5)),
];
const PLATES: [Column; 7] = [
    column("Plate", "/plate", Words),
    column("Foot", "/side", Side),
    column("From [s]", "/start_s", Number(1.0, 2)),
    column("To [s]", "/end_s", Number(1.0, 2)),
    column("Peak [N]", "/peak_n", Number(1.0, 0)),
    column("Contact", "/quality", Words),
    column("Why not clean", "/reason", Words),
];
const EVENTS: [Column; 8] = [
    column("Found by", "/found", Words),
    column("Held against", "/reference", Words),
    column("Event", "/kind", Words),
    column("Pairs", "/pairs", Number(1.0, 0)),
    column("Missed", "/missed", AtMost(1.0, 0, 0.5)),
    column("Extra", "/extra", AtMost(1.0, 0, 0.5)),
    column("Mean distance [ms]", "/mean_absolute_ms", Number(1.0, 0)),
    column("Later by [ms]", "/bias_ms", Number(1.0, 0)),
];
const AGREEMENT: [Column; 6] = [
    column("Foot", "/side", Side),
    column("Component", "/component", Words),
    column("RMSE [%BW]", "/rmse_bw", Number(100.0, 1)),
    column("RMSE over range [%]", "/rrmse", Number(100.0, 1)),
    column("r", "/r", Number(1.0, 3)),
    column("In the 90 % band [%]", "/band/holds", Number(100.0, 0)),
];
const CENTERS: [Column; 5] = [
    column("Foot", "/side", Side),
    column("Fore-aft RMS [mm]", "/center_of_pressure/fore_aft_mm", Number(1.0, 0)),
    column("Sideways RMS [mm]", "/center_of_pressure/lateral_mm", Number(1.0, 0)),
    column("Samples", "/center_of_pressure/samples", Number(1.0, 0)),
    column("Samples without a prediction", "/center_of_pressure/missing", Number(1.0, 0)),
];
const MOMENTS: [Column; 4] = [
    column("Moment", "/quantity", Words),
    column("RMSE [N.m]", "/rmse_nm", Number(1.0, 1)),
    column("RMSE [N.m/kg]", "/rmse_nm_kg", Number(1.0, 2)),
    column("r", "/r", Number(1.0, 3)),
];
const CHANGES: [Column; 4] = [
    column("Changed", "/name", Words),
    column("RMS", "/rms", Number(1.0, 2)),
    column("Largest", "/max", Number(1.0, 2)),
    column("Unit", "/unit", Unit),
];
const SEGMENTS: [Column; 3] = [
    column("Segment", "/body", Words),
    column("Length over the table's", "/factor", Number(1.0, 3)),
    column("Measured by markers", "/measured", Answer),
];
const ADJUSTMENT: [Column; 3] = [
    column("Angle", "/name", Words),
    column("RMS [deg]", "/rms", Number(1.0, 1)),
    column("Largest [deg]", "/largest", Number(1.0, 1)),
];
const TIMES: [Column; 3] = [
    column("Check", "/name", Check),
    column("From [s]", "/time_s/0", Number(1.0, 2)),
    column("To [s]", "/time_s/1", Number(1.0, 2)),
];

/// Tables whose rows are called as in the files.
const NAMED_BY_FILES: [&str; 3] = ["moments", "changes", "adjustment"];

/// All tables that have rows.
pub(super) fn tables(results: &Results, quantities: &[ClinicalQuantity]) -> Vec<Table> {
    let plates = "Whose foot loaded which plate; forces count as one foot's where the contact is clean.";
    let events = "How far foot strikes and toe-offs of different sources are apart.";
    let forces = "Over whole stances of feet that stood wholly on a plate of their own. The 90 % band is the prediction ± 1.645 standard deviations; the panels draw ± 1.";
    let segments = "Lengths of the built-in body's segments over those that its table gives for the stature.";
    let tables = [
        listed(["markers", "Markers", MARKER_NOTE], &markers(results), &MARKERS),
        listed(["plates", "Plates and feet", plates], results.list("/subject/plates"), &PLATES),
        listed(["events", "Events", events], &event_rows(results), &EVENTS),
        listed(["agreement", "Ground forces, prediction against plates", forces], &force_rows(results), &AGREEMENT),
        listed(
            ["centers", "Centre of pressure, prediction against plates", ""],
            results.list("/comparison/feet"),
            &CENTERS,
        ),
        listed(
            ["moments", "Moments, by predicted against by measured forces", ""],
            results.list("/comparison/moments"),
            &MOMENTS,
        ),
        listed(["check_times", "Times of the checks", ""], judged_checks(results), &TIMES),
        listed(["changes", "Changes to agree with the forces", ""], &changes(results), &CHANGES),
        listed(
            ["adjustment", "Changes of the gait's angles", ""],
            &named(results, "/walk/adjustment_deg"),
            &ADJUSTMENT,
        ),
        listed(["segments", "Segments", segments], results.list("/subject/segments"), &SEGMENTS),
    ];
    let mut tables: Vec<Table> = tables.into_iter().flatten().collect();
    for table in tables.iter_mut().filter(|table| NAMED_BY_FILES.contains(&table.id.as_str())) {
        words::reword(table, 0, quantities);
    }
    tables
}

const MARKER_NOTE: &str = "Distance of each marker from its place on the body, the worst first. Gaps are frames without the marker; they do not count.";

/// Worst first, with the frames in which the marker was not there.
fn markers(results: &Results) -> Vec<Value> {
    let mut rows: Vec<Value> = results.list("/subject/markers/errors").to_vec();
    for row in &mut rows {
        if let Some(seen) = row["frames_seen"].as_f64() {
            row["frames_missing"] = json!((results.grid.frames as f64 - seen).max(0.0));
        }
    }
    let size = |row: &Value| row["rms_mm"].as_f64().unwrap_or(f64::INFINITY);
    rows.sort_by(|a, b| size(b).total_cmp(&size(a)));
    rows
}

/// A row a source and kind of event.
fn event_rows(results: &Results) -> Vec<Value> {
    let of = |found: &Value, reference: &Value, kinds: &[Value]| -> Vec<Value> {
        kinds.iter().map(|kind| with(kind, &[("found", found.clone()), ("reference", reference.clone())])).collect()
    };
    let kinds = |entry: &Value| entry["kinds"].as_array().cloned().unwrap_or_default();
    let mut rows: Vec<Value> = results
        .list("/subject/events")
        .iter()
        .flat_map(|entry| of(&entry["found"], &entry["reference"], &kinds(entry)))
        .collect();
    rows.extend(of(&json!("prediction"), &json!("plates"), results.list("/comparison/events")));
    rows
}

/// A row a foot and component.
fn force_rows(results: &Results) -> Vec<Value> {
    const COMPONENTS: [(&str, &str); 3] = [("vertical", "vertical"), ("fore_aft", "fore-aft"), ("lateral", "sideways")];
    let rows = results.list("/comparison/feet").iter().flat_map(|foot| {
        COMPONENTS
            .iter()
            .map(|(key, word)| with(&foot[*key], &[("side", foot["side"].clone()), ("component", json!(word))]))
    });
    rows.collect()
}

fn judged_checks(results: &Results) -> impl Iterator<Item = &Value> {
    results.list("/prediction/checks").iter().filter(|check| check["time_s"].is_array())
}

/// Coordinates, and the bodies that carry loads.
fn changes(results: &Results) -> Vec<Value> {
    let mut rows = named(results, "/consistency/changes");
    rows.extend(named(results, "/consistency/feet_mm").iter().map(|foot| with(foot, &[("unit", json!("mm"))])));
    rows
}

/// The entries of a map with their keys as `name`.
fn named(results: &Results, path: &str) -> Vec<Value> {
    let map = results.summary.pointer(path).and_then(Value::as_object);
    map.map_or_else(Vec::new, |map| map.iter().map(|(key, entry)| with(entry, &[("name", json!(key))])).collect())
}

/// An entry with other keys beside its own.
fn with(entry: &Value, keys: &[(&str, Value)]) -> Value {
    let mut entry = entry.clone();
    if let Some(map) = entry.as_object_mut() {
        map.extend(keys.iter().map(|(key, value)| ((*key).to_owned(), value.clone())));
    }
    entry
}
