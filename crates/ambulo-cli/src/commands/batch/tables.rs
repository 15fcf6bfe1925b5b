//! The tables of a part: trials, frames, cycles and events.

use super::trial::{Computed, Key};
use ambulo::job::trials::PlannedTrial;
use ambulo::motion::EventKind;
use ambulo_formats::parquet::{Column, ColumnValues, ParquetTable};
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A trial with what became of it.
pub(super) struct Row<'a> {
    pub(super) trial: &'a PlannedTrial,
    pub(super) key: Key,
    pub(super) found: Result<Computed, String>,
}

/// The tables of a part.
pub(super) struct PartTables {
    pub(super) trials: ParquetTable,
    pub(super) frames: ParquetTable,
    pub(super) cycles: ParquetTable,
    pub(super) events: ParquetTable,
}

/// Numbers of the summary in the table of trials: column, place in the summary.
const NUMBERS: [(&str, &str); 22] = [
    ("mass_kg", "/mass_kg"),
    ("height_m", "/height_m"),
    ("speed_m_s", "/speed_m_s"),
    ("start_s", "/window_s/0"),
    ("end_s", "/window_s/1"),
    ("rate_hz", "/rate_hz"),
    ("residual_force_bw", "/residual/force_rms_bw"),
    ("residual_moment_nm", "/residual/moment_rms_nm"),
    ("measured_share_r", "/ground/measured_share/right"),
    ("measured_share_l", "/ground/measured_share/left"),
    ("judged_share", "/verdict/judged_share"),
    ("marker_error_mm", "/subject/markers/rms_mm"),
    ("marker_error_legs_mm", "/subject/markers/regions/legs/rms_mm"),
    ("marker_error_trunk_mm", "/subject/markers/regions/trunk/rms_mm"),
    ("marker_error_arms_mm", "/subject/markers/regions/arms/rms_mm"),
    ("knee_adduction_first_peak_r_nm_kg", "/knee_adduction_moment/0/right/mean"),
    ("knee_adduction_first_peak_l_nm_kg", "/knee_adduction_moment/0/left/mean"),
    ("knee_adduction_second_peak_r_nm_kg", "/knee_adduction_moment/1/right/mean"),
    ("knee_adduction_second_peak_l_nm_kg", "/knee_adduction_moment/1/left/mean"),
    ("knee_adduction_impulse_r_nms_kg", "/knee_adduction_moment/2/right/mean"),
    ("knee_adduction_impulse_l_nms_kg", "/knee_adduction_moment/2/left/mean"),
    ("muscles_largest_reserve_share", "/muscles/largest_reserve/share"),
];
/// Loads of joints in the table of trials, in the order of the summary.
const CONTACT_LOADS: [&str; 5] = ["hip", "knee", "ankle", "knee_medial", "knee_lateral"];
/// Quantities of each load in the summary: name, unit in the name of the column.
const CONTACT_QUANTITIES: [(&str, &str); 3] = [("first_peak", "bw"), ("second_peak", "bw"), ("impulse", "bw_s")];
/// Texts of the summary in the table of trials.
const TEXTS: [(&str, &str); 10] = [
    ("model", "/model"),
    ("mass_source", "/mass/source"),
    ("mass_state", "/mass/state"),
    ("activity", "/activity/kind"),
    ("ground_source", "/ground/source"),
    ("quality", "/quality/state"),
    ("verdict", "/verdict/state"),
    ("convention", "/convention/used"),
    ("knee_adduction_source_r", "/knee_adduction_moment/0/right/source"),
    ("knee_adduction_source_l", "/knee_adduction_moment/0/left/source"),
];

/// Makes the tables of a part. `about` are the texts that every table has.
pub(super) fn part_tables(rows: &[Row<'_>], about: &[(String, String)]) -> PartTables {
    PartTables {
        trials: ParquetTable { columns: trials(rows), about: with(about, &TRIAL_UNITS) },
        frames: frames(rows, about),
        cycles: ParquetTable { columns: cycles(rows), about: with(about, &[]) },
        events: ParquetTable { columns: events(rows), about: with(about, &[("unit of time", "s")]) },
    }
}

/// Units of the table of trials whose names do not end with them.
const TRIAL_UNITS: [(&str, &str); 4] = [
    ("unit of judged_share", "1"),
    ("unit of measured_share_r", "1"),
    ("unit of measured_share_l", "1"),
    ("unit of muscles_largest_reserve_share", "1"),
];

fn with(about: &[(String, String)], more: &[(&str, &str)]) -> Vec<(String, String)> {
    let more = more.iter().map(|(key, value)| ((*key).to_owned(), (*value).to_owned()));
    about.iter().cloned().chain(more).collect()
}

/// `knee_contact_first_peak_r_bw` and the like.
fn contact_columns(rows: &[Row<'_>]) -> Vec<Column> {
    let column = |load: &str, index: usize, (quantity, unit): (&str, &str), (letter, side): (&str, &str)| {
        let place = format!("/muscles/contact_loads/{index}/{side}/mean");
        let number = |row: &Row<'_>| {
            let summary = row.found.as_ref().ok().map(|found| &found.summary);
            summary.and_then(|summary| summary.pointer(&place)?.as_f64()).unwrap_or(f64::NAN)
        };
        let name = format!("{load}_contact_{quantity}_{letter}_{unit}");
        Column { name, values: ColumnValues::Double(rows.iter().map(number).collect()) }
    };
    let mut columns = Vec::new();
    for (k, load) in CONTACT_LOADS.into_iter().enumerate() {
        for (q, quantity) in CONTACT_QUANTITIES.into_iter().enumerate() {
            for side in [("r", "right"), ("l", "left")] {
                columns.push(column(load, k * CONTACT_QUANTITIES.len() + q, quantity, side));
            }
        }
    }
    columns
}

fn trials(rows: &[Row<'_>]) -> Vec<Column> {
    let summary = |row: &Row<'_>, place: &str| -> Option<Value> {
        row.found.as_ref().ok().and_then(|found| found.summary.pointer(place)).cloned()
    };
    let texts = |of: &dyn Fn(&Row<'_>) -> Option<String>| ColumnValues::Text(rows.iter().map(of).collect());
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    let mut columns = vec![
        column("key", texts(&|row| Some(row.key.hash.clone()))),
        column("trial", texts(&|row| Some(row.trial.name.clone()))),
        column("person", texts(&|row| Some(row.trial.person.clone()))),
        column("kind", texts(&|row| row.trial.kind.clone())),
        column("inputs", texts(&|row| Some(json!(row.key.inputs).to_string()))),
        column("error", texts(&|row| row.found.as_ref().err().cloned())),
    ];
    columns.extend(TEXTS.map(|(name, place)| {
        column(name, texts(&|row| summary(row, place).and_then(|value| value.as_str().map(str::to_owned))))
    }));
    columns.extend(NUMBERS.map(|(name, place)| {
        let number = |row: &Row<'_>| summary(row, place).and_then(|value| value.as_f64()).unwrap_or(f64::NAN);
        column(name, ColumnValues::Double(rows.iter().map(number).collect()))
    }));
    columns.extend(contact_columns(rows));
    for side in ["r", "l"] {
        // A comparison has the feet that stood on plates: both, or one.
        let error = |row: &Row<'_>| {
            let feet = summary(row, "/comparison/feet")?;
            feet.as_array()?.iter().find(|foot| foot["side"] == side)?["vertical"]["rmse_bw"].as_f64()
        };
        let values = rows.iter().map(|row| error(row).unwrap_or(f64::NAN)).collect();
        columns.push(column(&format!("predicted_vertical_rmse_{side}_bw"), ColumnValues::Double(values)));
    }
    let frames = |row: &Row<'_>| summary(row, "/frames").and_then(|value| value.as_i64());
    columns.push(column("frames", ColumnValues::Whole(rows.iter().map(frames).collect())));
    let reasons = |place: &'static str| {
        texts(&|row| {
            let list = summary(row, place)?;
            let messages = list.as_array()?.iter().filter_map(|reason| reason["message"].as_str().or(reason.as_str()));
            let text = messages.collect::<Vec<_>>().join("; ");
            (!text.is_empty()).then_some(text)
        })
    };
    columns.push(column("quality_reasons", reasons("/quality/reasons")));
    columns.push(column("verdict_reasons", reasons("/verdict/reasons")));
    columns.push(column("verdict_undecided", reasons("/verdict/undecided")));
    columns.push(column("findings", texts(&|row| summary(row, "/findings").map(|list| list.to_string()))));
    columns
}

fn frames(rows: &[Row<'_>], about: &[(String, String)]) -> ParquetTable {
    let known = || rows.iter().filter_map(|row| Some((row, row.found.as_ref().ok()?)));
    let count = |found: &Computed| found.frames.first().map_or(0, |column| column.values.len());
    let all: usize = known().map(|(_, found)| count(found)).sum();
    let (mut keys, mut trials, mut numbers, mut times) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut names: Vec<&str> = Vec::new();
    let mut columns: BTreeMap<&str, (Vec<f32>, &'static str)> = BTreeMap::new();
    for (row, found) in known() {
        let begun = keys.len();
        keys.extend((0..count(found)).map(|_| Some(row.key.hash.clone())));
        trials.extend((0..count(found)).map(|_| Some(row.trial.name.clone())));
        numbers.extend((0..count(found)).map(|frame| i64::try_from(frame).ok()));
        for column in &found.frames {
            if column.name == "time" {
                times.extend(column.values.iter().copied());
                continue;
            }
            let (values, _) = columns.entry(&column.name).or_insert_with(|| {
                names.push(&column.name);
                (Vec::with_capacity(all), column.unit)
            });
            values.resize(begun, f32::NAN);
            values.extend(column.values.iter().map(|value| *value as f32));
        }
    }
    let mut out = ParquetTable { columns: Vec::new(), about: with(about, &[("unit of time", "s")]) };
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    out.columns.push(column("key", ColumnValues::Text(keys)));
    out.columns.push(column("trial", ColumnValues::Text(trials)));
    out.columns.push(column("frame", ColumnValues::Whole(numbers)));
    out.columns.push(column("time", ColumnValues::Double(times)));
    for name in names {
        if let Some((mut values, unit)) = columns.remove(name) {
            values.resize(all, f32::NAN);
            out.about.push((format!("unit of {name}"), unit.to_owned()));
            out.columns.push(column(name, ColumnValues::Single(values)));
        }
    }
    out
}

/// A row per curve, with the values at 0, 1, ... 100 % of the cycle in columns.
fn cycles(rows: &[Row<'_>]) -> Vec<Column> {
    const VALUES: usize = 101;
    let all = || {
        let known = rows.iter().filter_map(|row| Some((row, row.found.as_ref().ok()?)));
        known.flat_map(|(row, found)| found.cycles.iter().map(move |cycle| (row, cycle)))
    };
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    let mut columns = vec![
        column("key", ColumnValues::Text(all().map(|(row, _)| Some(row.key.hash.clone())).collect())),
        column("trial", ColumnValues::Text(all().map(|(row, _)| Some(row.trial.name.clone())).collect())),
        column("quantity", ColumnValues::Text(all().map(|(_, row)| Some(row.quantity.clone())).collect())),
        column("side", ColumnValues::Text(all().map(|(_, row)| Some(row.side.letter().to_string())).collect())),
        column("cycle", ColumnValues::Whole(all().map(|(_, row)| i64::try_from(row.cycle).ok()).collect())),
        column("unit", ColumnValues::Text(all().map(|(_, row)| Some(row.unit.to_owned())).collect())),
    ];
    columns.extend((0..VALUES).map(|k| {
        let value =
            |(_, row): (_, &ambulo_results::CycleRow)| row.values.get(k).map_or(f32::NAN, |value| *value as f32);
        column(&format!("percent_{k}"), ColumnValues::Single(all().map(value).collect()))
    }));
    columns
}

fn events(rows: &[Row<'_>]) -> Vec<Column> {
    let all = || {
        let known = rows.iter().filter_map(|row| Some((row, row.found.as_ref().ok()?)));
        known.flat_map(|(row, found)| found.events.iter().map(move |event| (row, event)))
    };
    let kind = |kind: EventKind| match kind {
        EventKind::Strike => "strike",
        EventKind::Off => "off",
    };
    let column = |name: &str, values| Column { name: name.to_owned(), values };
    vec![
        column("key", ColumnValues::Text(all().map(|(row, _)| Some(row.key.hash.clone())).collect())),
        column("trial", ColumnValues::Text(all().map(|(row, _)| Some(row.trial.name.clone())).collect())),
        column("side", ColumnValues::Text(all().map(|(_, event)| Some(event.side.letter().to_string())).collect())),
        column("event", ColumnValues::Text(all().map(|(_, event)| Some(kind(event.kind).to_owned())).collect())),
        column("time", ColumnValues::Double(all().map(|(_, event)| event.time_s).collect())),
    ]
}
