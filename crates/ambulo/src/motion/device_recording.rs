//! What a worn device (an exoskeleton, a prosthesis) contributes to the joints.
//!
//! Inverse dynamics gives the total at each joint; what the body itself does is the total less the device:
//! biological moment = total - device. A device that pushes against both segments of a joint changes nothing else; its
//! mass is added to the model (`Model::with_point_mass`).

use super::import::rows_with_rising_time;
use super::recording::MotionError;
use super::time_grid::{TimeGrid, interpolate};
use crate::findings::{Code, Findings};
use crate::model::Model;
use ambulo_formats::table::Table;

/// Generalised forces of a device over time.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviceRecording {
    /// Instants [s], strictly rising.
    pub times: Vec<f64>,
    /// One column a coordinate of the model [N.m or N]; `None` where the device does nothing.
    pub columns: Vec<Option<Vec<f64>>>,
}

impl DeviceRecording {
    /// Says when the device was recorded for part of a grid only.
    pub fn report_cover(&self, grid: TimeGrid, findings: &mut Findings) {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return };
        if *first > grid.start_s + grid.step_s || *last < grid.end_s() - grid.step_s {
            let message = format!(
                "the device was recorded from {first:.3} s to {last:.3} s only; elsewhere its contribution counts as zero"
            );
            findings.report(Code::DeviceShorterThanMotion, message);
        }
    }

    /// The device on the frames of a grid: one column a coordinate, zero where and when it does nothing.
    #[must_use]
    pub fn on(&self, grid: TimeGrid) -> Vec<Vec<f64>> {
        let (first, last) = (self.times.first().copied(), self.times.last().copied());
        let inside = |t: f64| first.is_some_and(|f| t >= f) && last.is_some_and(|l| t <= l);
        let at = |column: &[f64], t: f64| if inside(t) { interpolate(&self.times, column, t) } else { 0.0 };
        self.columns
            .iter()
            .map(|column| match column {
                Some(column) => grid.times().iter().map(|&t| at(column, t)).collect(),
                None => vec![0.0; grid.frames],
            })
            .collect()
    }
}

/// A device from a table whose columns are named as the generalised forces of the model (`ankle_angle_r_moment`).
///
/// # Errors
/// Times that do not rise, no column that the model knows, numbers that are not finite.
pub fn device_from_table(
    model: &Model,
    table: &Table,
    findings: &mut Findings,
) -> Result<DeviceRecording, MotionError> {
    let kept = rows_with_rising_time(table, findings)?;
    let times = table.times().unwrap_or_default();
    let names = model.force_names();
    let mut device =
        DeviceRecording { times: kept.iter().map(|&row| times[row]).collect(), columns: vec![None; names.len()] };
    for (name, values) in table.columns().skip(1) {
        let Some(index) = names.iter().position(|n| n == name) else {
            findings
                .report(Code::DeviceUnknownColumn, format!("the model has no generalised force `{name}`; not used"));
            continue;
        };
        if let Some(&row) = kept.iter().find(|&&row| !values[row].is_finite()) {
            let (column, time) = (name.to_owned(), times[row]);
            return Err(MotionError::Gap { column, from_s: time, to_s: time, longest_s: 0.0 });
        }
        device.columns[index] = Some(kept.iter().map(|&row| values[row]).collect());
    }
    if device.columns.iter().all(Option::is_none) {
        let found = table.names().join(", ");
        return Err(MotionError::NoDeviceColumn { found, known: names.join(", ") });
    }
    Ok(device)
}
