//! What the tables of a batch hold, column by column: the file `README.md` beside them.

use super::ledger::Description;
use super::rows_of;
use crate::printer::{BatchRow, failures};
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use std::fmt::Write;

/// Meanings of the columns of the table of trials by the beginning of their names; the first that fits is the meaning.
const MEANINGS: [(&str, &str); 36] = [
    ("key", "identity of the trial: a hash of the version, the options and all its files"),
    ("trial", "name of the trial"),
    ("person", "person, as stated or by the folder"),
    ("kind", "kind of trial, as stated"),
    ("inputs", "input files: name and SHA-256, in JSON"),
    ("error", "why the trial could not be computed"),
    ("model", "the body"),
    ("mass_source", "where the body mass comes from"),
    ("mass_state", "whether body mass and force plates agree"),
    ("mass_kg", "body mass"),
    ("height_m", "stature"),
    ("activity", "what the person does"),
    ("ground_source", "where the ground forces come from"),
    ("quality_reasons", "why the quality is not good"),
    ("quality", "whether recording, body and forces fit together"),
    ("verdict_reasons", "why a person could not make this motion"),
    ("verdict_undecided", "why the motion is not judged"),
    ("verdict", "whether a person could make this motion"),
    ("convention", "reference of the pelvis and hip angles in clinical signs"),
    ("speed_m_s", "walking speed"),
    ("start_s", "first instant of the results"),
    ("end_s", "last instant of the results"),
    ("rate_hz", "frame rate of the results"),
    ("residual_force_bw", "force that nothing supplies, root mean square"),
    ("residual_moment_nm", "moment that nothing supplies, root mean square"),
    ("measured_share", "share of the loaded time of this leg with measured forces; empty if no force was measured"),
    ("judged_share", "share of the motion that the verdict covers"),
    ("marker_error", "distance of the markers from the body, root mean square"),
    ("knee_adduction_source", "where the forces of this leg come from"),
    ("knee_adduction", "external knee adduction moment in stance; positive presses on the medial side"),
    ("muscles_largest_reserve_share", "largest share of a moment that the muscles cannot supply"),
    ("knee_medial_contact", "load of the medial condyle of the knee in stance"),
    ("knee_lateral_contact", "load of the lateral condyle of the knee in stance"),
    ("predicted_vertical_rmse", "error of the predicted vertical force against the plates, root mean square"),
    ("frames", "number of rows in `frames/`"),
    ("findings", "warnings and notes, in JSON"),
];

/// Units by the ends of names, the longest first.
const UNITS: [(&str, &str); 10] = [
    ("_nms_kg", "N.m.s/kg"),
    ("_nm_kg", "N.m/kg"),
    ("_m_s", "m/s"),
    ("_bw_s", "body weights x s"),
    ("_bw", "body weights"),
    ("_nm", "N.m"),
    ("_mm", "mm"),
    ("_kg", "kg"),
    ("_hz", "Hz"),
    ("_s", "s"),
];

/// Descriptions of all tables, and their axes and signs.
const TABLES: &str = "\
| folder | one row is | columns |
|---|---|---|
| `trials/` | a trial, also one that could not be computed | below |
| `frames/` | a frame of a trial | below |
| `cycles/` | a curve over one gait cycle | `key`, `trial`, `quantity`, `side` (`r`, `l`), `cycle`, `unit`, \
`percent_0` to `percent_100` |
| `events/` | a foot strike or foot off | `key`, `trial`, `side`, `event` (`strike`, `off`), `time` [s] |

`key` joins the tables. All files of a table have the same columns. A value that a trial does not have is missing.
Numbers in `frames/` and `cycles/` have single precision, all others double precision.

## Axes and signs

- World axes: x forward, y up, z to the right. Units are SI; angles are in degrees.
- Angles: flexion of the hip, dorsiflexion of the ankle, adduction and internal rotation are positive. The knee of the
  built-in body is positive in extension, as in OpenSim's Gait2392. A model that was given has its own signs.
- Moments are the generalised forces of the coordinates [N.m], not divided by the body mass. They are positive if they
  act in the direction in which the angle is positive.
- Powers are positive while energy is given to the body.
- Ground forces are those of the ground on the foot, upwards positive.
- `ground_source_r` and `ground_source_l` of a frame: 0 if the force of this foot was measured or the foot is in the
  air, 1 if it was predicted, 2 if it is unknown.
";

/// The text of the card. `trials` are all tables of trials, `frames` one of the tables of frames.
pub(super) fn text(batch: &Description, trials: &[ParquetTable], frames: Option<&ParquetTable>) -> String {
    let rows: Vec<BatchRow> = trials.iter().flat_map(rows_of).collect();
    let failed: Vec<&BatchRow> = rows.iter().filter(|row| row.error.is_some()).collect();
    let named = |words: &[String], between: &str| match words {
        [] => "none".to_owned(),
        _ => format!("`{}`", words.join(between).replace('|', "\\|")),
    };
    let mut out = format!(
        "# Joint angles, moments and ground forces of {} trials\n\nThese tables were computed by Ambulo {}. {} trials \
         were computed, {} could not be.\nOptions of every trial: {}. Tables of frames: {}.\n\nNo licence is stated \
         here: the person who holds the rights to the recordings decides on it.\n\n## Tables\n\n{TABLES}",
        rows.len(),
        batch.version,
        rows.len() - failed.len(),
        failed.len(),
        named(&batch.options, " "),
        named(&batch.keep, ", "),
    );
    if let Some(table) = trials.first() {
        add_columns(&mut out, "trials", table);
    }
    if let Some(table) = frames {
        add_columns(&mut out, "frames", table);
    }
    if !failed.is_empty() {
        out.push_str("\n## Trials that could not be computed\n\n| reason | trials |\n|---|---|\n");
        for (reason, names) in failures(&failed) {
            // Writing to memory does not fail.
            let _ = writeln!(out, "| {} | {} |", reason.replace('|', "\\|"), names.len());
        }
    }
    out
}

fn add_columns(out: &mut String, name: &str, table: &ParquetTable) {
    let _ = write!(out, "\n## Columns of `{name}/`\n\n| column | type | unit | meaning |\n|---|---|---|---|\n");
    for column in &table.columns {
        let kind = match column.values {
            ColumnValues::Text(_) => "text",
            ColumnValues::Whole(_) => "whole number",
            ColumnValues::Double(_) => "number",
            ColumnValues::Single(_) => "number, single precision",
        };
        let stated = table.about(&format!("unit of {}", column.name)).filter(|unit| *unit != "1");
        let is_number = matches!(column.values, ColumnValues::Double(_) | ColumnValues::Single(_));
        let unit = stated.or_else(|| (is_number && name == "trials").then(|| unit_of(&column.name))).unwrap_or("");
        let meaning = if name == "trials" { meaning_of(&column.name) } else { of_frame(&column.name, unit) };
        let _ = writeln!(out, "| `{}` | {kind} | {unit} | {meaning} |", column.name);
    }
}

fn unit_of(column: &str) -> &'static str {
    match UNITS.iter().find(|(end, _)| column.ends_with(end)) {
        Some((_, unit)) => unit,
        None if column.ends_with("_m") => "m",
        None => "",
    }
}

fn meaning_of(column: &str) -> &'static str {
    let known = MEANINGS.iter().find(|(begin, _)| column.starts_with(begin)).map(|(_, meaning)| *meaning);
    known.unwrap_or(if column.contains("_contact_") { "load of this joint in stance" } else { "" })
}

/// The meaning of a column of frames, by its name and unit.
fn of_frame(column: &str, unit: &str) -> &'static str {
    match column {
        "key" | "trial" => "as in `trials/`",
        "frame" => "number of the frame, from 0",
        "time" => "time in the recording",
        _ if column.starts_with("ground_source_") => "source of the force: 0, 1 or 2, see above",
        _ if column.ends_with("_sd") => "standard deviation of the predicted force",
        _ if column.starts_with("measured_") => "force that the plates measured, where forces were predicted",
        _ if column.starts_with("recorded_") => "before the motion was changed",
        _ if column.ends_with("_contact") => "1 while this end of the sole touches the ground, else 0",
        _ if column.starts_with("clinical_") => "in clinical signs",
        _ if column.starts_with("ground_force") && column.contains("_v") => "ground force on the foot",
        _ if column.starts_with("ground_force") => "centre of pressure",
        _ if column.starts_with("ground_torque") => "free moment",
        _ if column.contains("_on_") => "reaction of the joint: force `f`, moment `m` or place `p`",
        _ if column.ends_with("_moment") => "moment",
        _ if column.ends_with("_force") => "generalised force of a translation",
        _ if column.ends_with("_power") => "power",
        _ if column.ends_with("_activation") => "activation of the muscle, 0 to 1",
        _ if column.ends_with("_length") => "length of the muscle with its tendon",
        _ if column.ends_with("_reserve") => "force that the muscles cannot supply",
        _ if column.ends_with("_emg") => "envelope of the electromyogram",
        _ if ["deg", "rad", "m"].contains(&unit) => "coordinate of the body",
        _ => "",
    }
}
