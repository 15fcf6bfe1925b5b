//! Reads the coordinates of a model from a table.

use super::clock::clock_of_table;
use super::held::release_held_coordinates;
use super::jumps;
use super::recording::{Motion, MotionError};
use crate::findings::{Code, Findings};
use crate::model::{Coordinate, CoordinateId, CoordinateKind, Model};
use crate::numerics::median;
use ambulo_formats::table::{Table, coordinate_of_state_path};

/// Largest plausible angle [rad]; larger ones under a header that states radians were written in degrees.
pub(super) const LARGEST_PLAUSIBLE_ANGLE: f64 = 7.0;
/// If all angles under a header that states degrees are smaller than this [deg], they were written in radians.
pub(super) const SMALLEST_PLAUSIBLE_SPAN_DEG: f64 = 3.2;
/// Smallest number of moving rotations for this test.
pub(super) const ENOUGH_ROTATIONS: usize = 4;

/// Reads the coordinates of `model` from a table. Columns are coordinate names or absolute state paths
/// (`/jointset/hip_r/hip_flexion_r/value`); rotations are converted from degrees if the header states degrees.
///
/// Whole turns between two frames are removed from angles. Unknown columns, repeated rows, angles in the wrong unit and
/// jumps are findings.
///
/// # Errors
/// Times that do not increase, two different rows at one time, no known column.
pub fn coordinates_from_table(
    model: &Model,
    table: &Table,
    origin: &str,
    findings: &mut Findings,
) -> Result<Motion, MotionError> {
    let (kept, times) = rows_with_clock(table, findings)?;
    let in_degrees = table.in_degrees.or_else(|| unit_of_names(table)).unwrap_or_else(|| {
        let unit = unstated_unit(model, table);
        let reason = match unit {
            true => format!("degrees, because they exceed {LARGEST_PLAUSIBLE_ANGLE}"),
            false => "radians".to_owned(),
        };
        let message = format!("the motion's header has no `inDegrees`; its angles are read as {reason}");
        findings.report(Code::MotionUnitUnstated, message);
        unit
    });
    let mut motion = Motion { origin: origin.to_owned(), times, columns: vec![None; model.coordinates().len()] };
    let mut unknown = Vec::new();
    for (name, values) in table.columns().skip(1) {
        let (name, _) = without_unit(name);
        let plain = if name.contains('/') { coordinate_of_state_path(name) } else { Some(name) };
        match plain.and_then(|n| coordinate_named(model, n)).filter(|id| motion.columns[id.index()].is_none()) {
            Some(id) => {
                let turn = in_degrees && model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
                let convert = |x: f64| if turn { x.to_radians() } else { x };
                motion.columns[id.index()] = Some(kept.iter().map(|&row| convert(values[row])).collect());
            }
            None if plain.is_some() => unknown.push(name),
            None => {}
        }
    }
    if motion.columns.iter().all(Option::is_none) {
        return Err(no_coordinate(model, table));
    }
    report_unknown(model, &unknown, &motion, findings);
    release_held_coordinates(model, &mut motion, findings);
    if is_usual_unit(model, &motion, in_degrees, findings) {
        jumps::without_whole_turns(model, &mut motion, findings);
        jumps::report_jumps(model, &motion, findings);
    }
    Ok(motion)
}

/// Whether angles without a stated unit are in degrees: as radians they would be more than a turn.
fn unstated_unit(model: &Model, table: &Table) -> bool {
    let of_coordinate = |(name, values): (&str, &[f64])| {
        let (name, _) = without_unit(name);
        let plain = if name.contains('/') { coordinate_of_state_path(name) } else { Some(name) };
        let id = plain.and_then(|name| coordinate_named(model, name))?;
        let is_rotation = model.coordinates()[id.index()].kind == CoordinateKind::Rotation;
        let sizes = values.iter().map(|x| x.abs()).filter(|x| x.is_finite());
        is_rotation.then(|| median(sizes).unwrap_or(0.0))
    };
    // The median of each column: a few wrong rows are no unit.
    table.columns().skip(1).filter_map(of_coordinate).any(|usual| usual > LARGEST_PLAUSIBLE_ANGLE)
}

/// The coordinate with this name; otherwise the only coordinate with this name apart from upper and lower case.
fn coordinate_named(model: &Model, name: &str) -> Option<CoordinateId> {
    let is_same = |id: &CoordinateId| model.coordinates()[id.index()].name.eq_ignore_ascii_case(name);
    let mut others = model.coordinate_ids().filter(is_same);
    model.coordinate(name).or_else(|| others.next().filter(|_| others.next().is_none()))
}

/// A name without the unit in brackets behind it, and whether this is a unit of angles: `Some(true)` for degrees.
fn without_unit(name: &str) -> (&str, Option<bool>) {
    let in_brackets = |open: char, close: char| name.trim_end().strip_suffix(close)?.rsplit_once(open);
    let Some((plain, unit)) = in_brackets('(', ')').or_else(|| in_brackets('[', ']')) else { return (name, None) };
    match unit.trim().to_lowercase().as_str() {
        "deg" | "degrees" | "degree" | "°" => (plain.trim_end(), Some(true)),
        "rad" | "radians" => (plain.trim_end(), Some(false)),
        "m" => (plain.trim_end(), None),
        _ => (name, None),
    }
}

/// Whether the names of the columns state degrees; `None` if they state nothing, or contradict each other.
fn unit_of_names(table: &Table) -> Option<bool> {
    let mut units = table.names().iter().filter_map(|name| without_unit(name).1);
    let first = units.next()?;
    units.all(|unit| unit == first).then_some(first)
}

fn no_coordinate(model: &Model, table: &Table) -> MotionError {
    let join = |names: Vec<&str>| names.into_iter().take(6).collect::<Vec<_>>().join(", ");
    MotionError::NoCoordinate {
        model: model.name().to_owned(),
        found: join(table.names().iter().map(String::as_str).collect()),
        known: join(model.coordinates().iter().map(|c| c.name.as_str()).collect()),
        are_forces: ["vx", "vy", "px", "py"].iter().all(|end| table.names().iter().any(|name| name.ends_with(end))),
    }
}

/// The times of a table [s], as written.
pub(super) fn times(table: &Table) -> Result<&[f64], MotionError> {
    let first = || table.names().first().cloned().unwrap_or_default();
    table.times().ok_or_else(|| MotionError::NoTime { found: first() })
}

/// Rows to keep of a recording, with the times that its clock means [s].
pub(super) fn rows_with_clock(table: &Table, findings: &mut Findings) -> Result<(Vec<usize>, Vec<f64>), MotionError> {
    let clock = clock_of_table("", times(table)?, None, None, findings);
    let kept = rows_with_rising_time(table, &clock, findings)?;
    let times = kept.iter().map(|&row| clock[row]).collect();
    Ok((kept, times))
}

/// Rows to keep: exact repetitions of the previous row are dropped and counted.
pub(super) fn rows_with_rising_time(
    table: &Table,
    times: &[f64],
    findings: &mut Findings,
) -> Result<Vec<usize>, MotionError> {
    let place = |row: usize| match table.line_of_row(row) {
        Some(line) => format!("line {line}"),
        None => format!("row {}", row + 1),
    };
    let mut kept: Vec<usize> = Vec::with_capacity(times.len());
    for (row, &time) in times.iter().enumerate() {
        if !time.is_finite() {
            return Err(MotionError::TimeNotFinite { place: place(row), found: time });
        }
        let Some(&before) = kept.last() else {
            kept.push(row);
            continue;
        };
        let earlier = times[before];
        if time > earlier {
            kept.push(row);
        } else if time < earlier {
            return Err(MotionError::TimeNotRising { place: place(row), earlier, later: time });
        } else if let Some(column) = first_difference(table, before, row) {
            return Err(MotionError::TwoRows { place: place(row), time, column });
        } else {
            findings.report(Code::MotionRepeatedRow, "rows that repeat the one before them were dropped");
        }
    }
    if let ([only], true) = (&kept[..], times.len() > 1) {
        return Err(MotionError::OneTime { rows: times.len(), time: times[*only] });
    }
    Ok(kept)
}

fn first_difference(table: &Table, a: usize, b: usize) -> Option<String> {
    let differ = |values: &[f64]| values[a].to_bits() != values[b].to_bits();
    table.columns().find(|(_, values)| differ(values)).map(|(name, _)| name.to_owned())
}

fn report_unknown(model: &Model, unknown: &[&str], motion: &Motion, findings: &mut Findings) {
    if unknown.is_empty() {
        return;
    }
    let unmatched: Vec<&str> = model
        .coordinates()
        .iter()
        .zip(&motion.columns)
        .filter(|(_, c)| c.is_none())
        .map(|(c, _)| c.name.as_str())
        .collect();
    let unmatched = match unmatched[..] {
        [] => String::new(),
        _ => format!(" (coordinates of the model without a column: {})", unmatched.join(", ")),
    };
    let message = format!(
        "the model has no such coordinates: {}; these columns were not used{unmatched}",
        unknown.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ")
    );
    findings.report(Code::MotionUnknownCoordinate, message);
}

/// Whether the angles can be in the unit that the header states; a finding otherwise.
fn is_usual_unit(model: &Model, motion: &Motion, in_degrees: bool, findings: &mut Findings) -> bool {
    let recorded = model.coordinates().iter().zip(&motion.columns);
    let rotations: Vec<(&Coordinate, f64)> = recorded
        .filter(|(c, _)| c.kind == CoordinateKind::Rotation)
        .filter_map(|(c, column)| {
            let largest = column.as_ref()?.iter().filter(|x| x.is_finite()).fold(0.0_f64, |m, x| m.max(x.abs()));
            Some((c, largest))
        })
        .collect();
    if !in_degrees {
        let large: Vec<String> = rotations
            .iter()
            .filter(|(_, largest)| *largest > LARGEST_PLAUSIBLE_ANGLE)
            .map(|(c, largest)| format!("`{}` {largest:.0}", c.name))
            .collect();
        if !large.is_empty() {
            let message = format!(
                "angles that were read as radians look like degrees: they reach {}. hint: set inDegrees=yes in the \
                 header of a .mot or .sto; a .csv cannot state its unit",
                large.join(", ")
            );
            findings.report(Code::MotionDegreesAsRadians, message);
        }
        return large.is_empty();
    }
    let moving: Vec<f64> = rotations.iter().map(|(_, largest)| largest.to_degrees()).filter(|x| *x > 0.0).collect();
    let is_too_small = moving.len() >= ENOUGH_ROTATIONS && moving.iter().all(|x| *x < SMALLEST_PLAUSIBLE_SPAN_DEG);
    if is_too_small {
        let message = format!(
            "no angle exceeds {SMALLEST_PLAUSIBLE_SPAN_DEG} under a header that states degrees; the angles look like \
             radians. hint: set inDegrees=no in the header"
        );
        findings.report(Code::MotionRadiansAsDegrees, message);
    }
    !is_too_small
}
