//! Recordings of the orientations of inertial sensors.

use super::recording::MotionError;
use crate::spatial::Mat3;
use ambulo_formats::table::OrientationTable;
use nalgebra::{Quaternion, UnitQuaternion};

/// Orientations of sensors over time.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorRecording {
    /// Name for messages.
    pub name: String,
    /// Times [s], strictly increasing.
    pub times: Vec<f64>,
    /// The sensors.
    pub sensors: Vec<SensorPath>,
}

/// Orientations of one sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorPath {
    /// Name.
    pub name: String,
    /// Rotation `earth_from_sensor` at each time; `None` without data of the sensor.
    pub orientations: Vec<Option<Mat3>>,
}

/// The sensors of a table of quaternions.
///
/// # Errors
/// Fewer than two rows, times that do not increase.
pub fn sensors_from_table(table: &OrientationTable, name: &str) -> Result<SensorRecording, MotionError> {
    let place = |row: usize| table.lines.get(row).map_or(format!("row {}", row + 1), |line| format!("line {line}"));
    if let Some(row) = (1..table.times.len()).find(|&row| table.times[row] <= table.times[row - 1]) {
        let (earlier, later) = (table.times[row - 1], table.times[row]);
        return Err(MotionError::TimeNotRising { place: place(row), earlier, later });
    }
    let rotation = |q: [f64; 4]| {
        let [w, x, y, z] = q;
        UnitQuaternion::from_quaternion(Quaternion::new(w, x, y, z)).to_rotation_matrix().into_inner()
    };
    let path = |(name, path): &(String, Vec<Option<[f64; 4]>>)| SensorPath {
        name: name.clone(),
        orientations: path.iter().map(|q| q.map(rotation)).collect(),
    };
    let sensors = table.sensors.iter().map(path).collect();
    Ok(SensorRecording { name: name.to_owned(), times: table.times.clone(), sensors })
}
