//! Writes markers as TRC, C3D and tables.

use ambulo::motion::MarkerRecording;
use ambulo_formats::Error;
use ambulo_formats::c3d::{C3d, Point};
use ambulo_formats::table::Table;
use ambulo_formats::trc::{LengthUnit, Marker, Trc};

/// Markers as a TRC file in millimetres, as readers of TRC expect.
///
/// # Errors
/// Duplicate names, or names that the format cannot store.
pub fn trc_of_markers(recording: &MarkerRecording) -> Result<Trc, Error> {
    let markers = recording.markers.iter().map(|marker| Marker {
        name: marker.name.clone(),
        positions_m: marker.positions.iter().map(|p| [p.x, p.y, p.z]).collect(),
    });
    let mut trc = Trc::new(recording.rate_hz, recording.times.clone(), markers.collect())?;
    trc.name.clone_from(&recording.name);
    trc.unit = LengthUnit::Millimetre;
    trc.orig_start_frame = first_frame(recording);
    Ok(trc)
}

/// Markers as a C3D file in millimetres, without analog channels.
#[must_use]
pub fn c3d_of_markers(recording: &MarkerRecording) -> C3d {
    const MILLIMETRES: f64 = 1000.0;
    let mut c3d = C3d::new(recording.rate_hz, "mm");
    c3d.first_frame = first_frame(recording);
    let point = |marker: &ambulo::motion::MarkerPath| {
        Point::new(&marker.name, marker.positions.iter().map(|p| (p * MILLIMETRES).into()).collect())
    };
    c3d.points = recording.markers.iter().map(point).collect();
    c3d
}

/// Markers as a table: `time`, then `<marker>_x`, `_y`, `_z` [m]; NaN while a marker is missing.
///
/// # Errors
/// Duplicate names, or names that the format cannot store.
pub fn table_of_markers(recording: &MarkerRecording) -> Result<Table, Error> {
    let mut columns = vec![("time".to_owned(), recording.times.clone())];
    for marker in &recording.markers {
        for (axis, letter) in ["x", "y", "z"].into_iter().enumerate() {
            columns.push((format!("{}_{letter}", marker.name), marker.positions.iter().map(|p| p[axis]).collect()));
        }
    }
    Table::new(recording.name.clone(), columns)
}

/// The number of the first frame, counted from 1 at time zero; 1 where time begins before zero.
fn first_frame(recording: &MarkerRecording) -> i64 {
    let first = recording.times.first().copied().unwrap_or(0.0) * recording.rate_hz;
    (first.round() as i64).max(0) + 1
}
