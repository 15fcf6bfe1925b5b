//! Contribution of a worn device (an exoskeleton, a prosthesis) to the joint moments.
//!
//! Inverse dynamics gives the total at each joint; the contribution of the body is
//! biological moment = total - device. A device that acts on both segments of a joint changes nothing else; its
//! mass is added to the model (`Model::with_point_mass`).

use super::import::rows_with_clock;
use super::recording::MotionError;
use super::time_grid::{TimeGrid, interpolate};
use crate::findings::{Code, Findings};
use crate::model::Model;
use ambulo_formats::table::Table;

/// Generalised forces of a device over time, such as the moments of an exoskeleton.
#[derive(Debug, Clone, PartialEq)]
pub struct DeviceRecording {
    /// Times [s], strictly increasing.
    pub times: Vec<f64>,
    /// One column per coordinate of the model [N.m or N]; `None` where the device does not act.
    pub columns: Vec<Option<Vec<f64>>>,
}

impl DeviceRecording {
    /// Reports a device that was recorded for only a part of a time grid.
    pub fn report_cover(&self, grid: TimeGrid, findings: &mut Findings) {
        let (Some(first), Some(last)) = (self.times.first(), self.times.last()) else { return };
        if *first > grid.start_s + grid.step_s || *last < grid.end_s() - grid.step_s {
            let message = format!(
                "the device was recorded only from {first:.3} s to {last:.3} s; elsewhere its contribution is assumed \
                 zero"
            );
            findings.report(Code::DeviceShorterThanMotion, message);
        }
    }

    /// The forces of the device at the frames of a grid: one column per coordinate, zero where it does not act.
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

/// Reads a device from a table whose columns are named as the generalised forces of the model (`ankle_angle_r_moment`).
///
/// # Errors
/// Times that do not increase, no known column, numbers that are not finite.
pub fn device_from_table(
    model: &Model,
    table: &Table,
    findings: &mut Findings,
) -> Result<DeviceRecording, MotionError> {
    let (kept, times) = rows_with_clock(table, findings)?;
    let names = model.force_names();
    let mut device = DeviceRecording { times, columns: vec![None; names.len()] };
    for (name, values) in table.columns().skip(1) {
        let Some(index) = names.iter().position(|n| n == name) else {
            findings.report(
                Code::DeviceUnknownColumn,
                format!("the model has no generalised force `{name}`; this column was not used"),
            );
            continue;
        };
        if let Some(number) = kept.iter().position(|&row| !values[row].is_finite()) {
            let (column, time) = (name.to_owned(), device.times[number]);
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
