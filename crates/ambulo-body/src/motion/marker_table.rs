//! Markers in a table: `time`, and three columns for each marker.
//!
//! The three columns of a marker end with x, y and z after a separator, or with nothing in between: `LASI_x`, `LASI.X`,
//! `LASI X`, `LASI:x`, `LASIx`. Ambulo writes such tables itself (`convert walk.c3d walk.csv`), in metres. The unit is
//! not stated in a table; it is inferred from the size of the person.

use super::clock::clock_of_table;
use super::guessed_unit::unit_of_frames;
use super::marker_recording::{MarkerError, MarkerPath, MarkerRecording, checked};
use crate::findings::{Code, Findings};
use crate::spatial::Vec3;
use ambulo_formats::table::Table;

/// Fewest markers by which a table is one of markers: coordinates of models have no triples of columns.
const FEWEST: usize = 4;
const AXES: [char; 3] = ['x', 'y', 'z'];

/// The columns of a marker.
struct Triple<'t> {
    name: String,
    columns: [&'t [f64]; 3],
}

/// Whether a table contains markers.
#[must_use]
pub fn is_marker_table(table: &Table) -> bool {
    triples(table).len() >= FEWEST
}

/// Reads the markers of a table, in the axes of the laboratory.
///
/// # Errors
/// No column of times, no markers, times that do not increase.
pub fn markers_from_table(table: &Table, name: &str, findings: &mut Findings) -> Result<MarkerRecording, MarkerError> {
    let times = clock_of_table(name, table.times().unwrap_or_default(), None, None, findings);
    let triples = triples(table);
    let place = |triple: &Triple<'_>, frame: usize| Vec3::from_fn(|axis, _| triple.columns[axis][frame]);
    let unit = unit_of_frames(times.len(), |frame| triples.iter().map(move |triple| place(triple, frame)));
    let (unit, metres) = unit.unwrap_or(("m", 1.0));
    let message = format!("{name} states no unit of length; by the size of the markers lengths are in {unit}");
    findings.report(Code::FileUnitGuessed, message);
    let path = |triple: &Triple<'_>| MarkerPath {
        name: triple.name.clone(),
        positions: (0..times.len()).map(|frame| place(triple, frame) * metres).collect(),
    };
    let duration = times.last().zip(times.first()).map_or(0.0, |(last, first)| last - first);
    let rate_hz = if duration > 0.0 { (times.len() - 1) as f64 / duration } else { 1.0 };
    let markers = triples.iter().map(path).collect();
    checked(MarkerRecording { name: name.to_owned(), rate_hz, times, markers }, findings)
}

/// Three columns that follow each other and differ only in their last letter, which is the axis.
fn triples(table: &Table) -> Vec<Triple<'_>> {
    let columns: Vec<(&str, &[f64])> = table.columns().collect();
    let mut found = Vec::new();
    let mut next = 0;
    while let Some([x, y, z]) = columns.get(next..next + 3) {
        let stems = [x, y, z].into_iter().zip(AXES).map(|((name, _), axis)| stem(name, axis));
        let stems: Option<Vec<&str>> = stems.collect();
        match stems.as_deref() {
            Some([a, b, c]) if a == b && b == c => {
                found.push(Triple { name: (*a).to_owned(), columns: [x.1, y.1, z.1] });
                next += 3;
            }
            _ => next += 1,
        }
    }
    found
}

/// The name of a column without the letter of its axis and a separator before it.
fn stem(name: &str, axis: char) -> Option<&str> {
    let name = name.trim();
    // Forces are no markers: `ground_force_vx`, `FX1`.
    let stem = name.strip_suffix(axis).or_else(|| name.strip_suffix(axis.to_ascii_uppercase()))?;
    let stem = stem.trim_end_matches(['_', '.', ':', '-', ' ']);
    let is_force = ["_v", "_p", "force", "moment", "torque"].iter().any(|end| stem.to_lowercase().ends_with(end));
    (!stem.is_empty() && !is_force && stem.chars().any(char::is_alphabetic)).then_some(stem)
}
