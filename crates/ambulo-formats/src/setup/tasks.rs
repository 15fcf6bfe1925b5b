//! Tasks of a fit: weights of markers and of coordinates.

use super::elements::{applies, members, weight};
use crate::error::{Error, quoted};
use crate::xml;
use roxmltree::Node;

/// Targets of a fit. Markers and coordinates that are not listed, or are switched off, are not tracked.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FitTasks {
    /// Markers with their weights.
    pub markers: Vec<MarkerTask>,
    /// Coordinates with their weights and targets.
    pub coordinates: Vec<CoordinateTask>,
}

impl FitTasks {
    /// Whether a coordinate follows the file of coordinates.
    #[must_use]
    pub fn follow_file(&self) -> bool {
        self.coordinates.iter().any(|task| task.target == CoordinateTarget::FromFile)
    }
}

/// The weight of a marker.
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerTask {
    /// Name of the marker.
    pub marker: String,
    /// Weight of its squared distance, relative to the other markers.
    pub weight: f64,
}

/// The weight of a coordinate.
#[derive(Debug, Clone, PartialEq)]
pub struct CoordinateTask {
    /// Name of the coordinate.
    pub coordinate: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Weight of its squared difference [1/rad² or 1/m²], in the cost in which the weights of all markers are divided
    /// by their sum.
    pub weight: f64,
    /// The value that is tracked.
    pub target: CoordinateTarget,
}

/// The value that a coordinate should have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CoordinateTarget {
    /// The default value in the model.
    Default,
    /// A value [rad or m].
    Value(f64),
    /// The column of the coordinate in the file of coordinates.
    FromFile,
}

pub(super) fn read(node: Node<'_, '_>) -> Result<FitTasks, Error> {
    let mut tasks = FitTasks::default();
    for task in members(node, "IKTaskSet")? {
        if !applies(task)? {
            continue;
        }
        let name = task.attribute("name").unwrap_or_default().trim().to_owned();
        match task.tag_name().name() {
            "IKMarkerTask" => tasks.markers.push(MarkerTask { marker: name, weight: weight(task)? }),
            "IKCoordinateTask" => tasks.coordinates.push(CoordinateTask {
                coordinate: name,
                line: xml::line_of(task),
                weight: weight(task)?,
                target: read_target(task)?,
            }),
            other => {
                let found = format!("a task <{other}>");
                return Err(xml::error_at(task, found, "<IKMarkerTask> or <IKCoordinateTask>"));
            }
        }
    }
    Ok(tasks)
}

fn read_target(task: Node<'_, '_>) -> Result<CoordinateTarget, Error> {
    match xml::text(task, "value_type") {
        Some("manual_value") => Ok(CoordinateTarget::Value(xml::number(task, "value")?.unwrap_or(0.0))),
        Some("from_file") => Ok(CoordinateTarget::FromFile),
        Some("default_value") | None => Ok(CoordinateTarget::Default),
        Some(other) => Err(xml::error_at(task, quoted(other), "default_value, manual_value or from_file")),
    }
}
