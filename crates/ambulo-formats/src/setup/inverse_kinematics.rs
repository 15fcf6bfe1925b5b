//! The set-up of inverse kinematics.

use super::elements::{Known, members, path, remark_on_others, time_range};
use super::tasks::{self, FitTasks};
use crate::error::{Error, Remark};
use crate::xml;
use roxmltree::Node;

pub(super) const TOOL: &str = "InverseKinematicsTool";
/// As OpenSim 2 and 3 wrote it.
pub(super) const MISSPELT: &str = "InverseKinemtaticsTool";
/// The tool of OpenSim 1 and 2, which has its files in a set of trials.
pub(super) const OLD: &str = "IKTool";

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
    read: &["model_file", "marker_file", "coordinate_file", "time_range", "IKTaskSet", "IKTrialSet"],
    unused: &[
        "results_directory",
        "input_directory",
        "output_motion_file",
        "constraint_weight",
        "accuracy",
        "report_errors",
        "report_marker_locations",
        "ignore_convergence_errors",
        "optimizer_algorithm",
        "defaults",
    ],
};

pub(super) fn read(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<InverseKinematicsSetup, Error> {
    remark_on_others(node, &KNOWN, remarks);
    let trial = trial_of(node)?.unwrap_or(node);
    Ok(InverseKinematicsSetup {
        model_file: path(node, "model_file"),
        marker_file: path(trial, "marker_file"),
        coordinate_file: path(trial, "coordinate_file"),
        time_range: time_range(trial)?,
        tasks: tasks::read(node)?,
    })
}

/// The only trial of an old tool.
fn trial_of<'a, 'i>(node: Node<'a, 'i>) -> Result<Option<Node<'a, 'i>>, Error> {
    match members(node, "IKTrialSet")?[..] {
        [] => Ok(None),
        [trial] => Ok(Some(trial)),
        ref trials => {
            let found = format!("{} trials in <IKTrialSet>", trials.len());
            Err(xml::error_at(node, found, "one. hint: make a set-up of each"))
        }
    }
}
