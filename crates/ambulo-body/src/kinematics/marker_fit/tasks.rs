//! Coordinates that are held near values while the markers are fitted: springs on the unknowns.
//!
//! The cost of [`CoordinateTask`] times Σ w is Σ w |m - p|² + Σ (k Σ w) (q - q_task)², so that a task is a spring of
//! stiffness k Σ w.
//!
//! Pinned by: tests/marker_tasks.rs

use super::settings::{CoordinateTask, TaskTarget};
use super::solve::Bounds;
use super::tree::MarkerTree;
use crate::findings::{Code, Findings};
use crate::model::{Drive, Model};

/// A task on an unknown of the fit.
#[derive(Debug, Clone)]
pub(super) struct HeldUnknown {
    unknown: usize,
    weight: f64,
    target: TaskTarget,
}

/// The tasks on unknowns. Names that the model does not have are reported; a coordinate that is locked or follows
/// others needs no task.
pub(super) fn held_unknowns(
    model: &Model,
    tree: &MarkerTree,
    tasks: &[CoordinateTask],
    findings: &mut Findings,
) -> Vec<HeldUnknown> {
    let mut held = Vec::new();
    for task in tasks {
        let Some(id) = model.coordinate(&task.coordinate) else {
            let message = format!("the model has no coordinate `{}`; its task was left out", task.coordinate);
            findings.report(Code::MarkersTask, message);
            continue;
        };
        let coordinate = &model.coordinates()[id.index()];
        let default = TaskTarget::Value(coordinate.default_value);
        let target = if task.target == TaskTarget::Default { default.clone() } else { task.target.clone() };
        match (0..tree.unknowns()).find(|&u| tree.coordinate(u) == id.index()) {
            Some(unknown) => held.push(HeldUnknown { unknown, weight: task.weight, target }),
            // Without a marker a coordinate keeps its default.
            None if matches!(coordinate.drive, Drive::Free) && target != default => {
                let message = format!("no marker moves with `{}`; its task was left out", task.coordinate);
                findings.report(Code::MarkersTask, message);
            }
            None => {}
        }
    }
    held
}

impl HeldUnknown {
    /// Sets the spring of this task for the time of a frame [s], with the sum of the weights of its markers.
    pub(super) fn hold(&self, time_s: f64, sum_of_weights: f64, bounds: &mut Bounds) {
        bounds.stiffness[self.unknown] = self.weight * sum_of_weights;
        bounds.anchor[self.unknown] = self.target.at(time_s);
    }
}

impl TaskTarget {
    /// The value at a time [s]; the default of the model must be known.
    fn at(&self, time_s: f64) -> f64 {
        match self {
            TaskTarget::Default => 0.0,
            TaskTarget::Value(value) => *value,
            TaskTarget::Samples { times, values } => {
                let after = times.partition_point(|t| *t < time_s);
                match (after.checked_sub(1), values.get(after)) {
                    (None, first) => first.copied().unwrap_or(0.0),
                    (Some(before), None) => values[before],
                    (Some(before), Some(next)) => {
                        let share = (time_s - times[before]) / (times[after] - times[before]);
                        values[before] + share * (next - values[before])
                    }
                }
            }
        }
    }
}
