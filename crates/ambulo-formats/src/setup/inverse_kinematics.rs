//! The set-up of inverse kinematics.

use super::elements::{Known, path, remark_on_others, time_range};
use super::tasks::{self, FitTasks};
use crate::error::{Error, Remark};
use roxmltree::Node;

pub(super) const TOOL: &str = "InverseKinematicsTool";

/// Coordinates from markers.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseKinematicsSetup {
    /// The model.
    pub model_file: Option<String>,
    /// The markers.
    pub marker_file: Option<String>,
    /// Coordinates that tasks follow.
    pub coordinate_file: Option<String>,
    /// Start and end [s].
    pub time_range: Option<[f64; 2]>,
    /// Weights of markers and coordinates.
    pub tasks: FitTasks,
}

const KNOWN: Known<'_> = Known {
    read: &["model_file", "marker_file", "coordinate_file", "time_range", "IKTaskSet"],
    unused: &[
        "results_directory",
        "input_directory",
        "output_motion_file",
        "constraint_weight",
        "accuracy",
        "report_errors",
        "report_marker_locations",
        "ignore_convergence_errors",
        "defaults",
    ],
};

pub(super) fn read(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<InverseKinematicsSetup, Error> {
    remark_on_others(node, &KNOWN, remarks);
    Ok(InverseKinematicsSetup {
        model_file: path(node, "model_file"),
        marker_file: path(node, "marker_file"),
        coordinate_file: path(node, "coordinate_file"),
        time_range: time_range(node)?,
        tasks: tasks::read(node)?,
    })
}
