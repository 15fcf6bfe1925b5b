//! The set-up of inverse dynamics.

use super::elements::{Known, path, remark_on_others, time_range};
use crate::error::{Error, Remark};
use crate::xml;
use roxmltree::Node;

pub(super) const TOOL: &str = "InverseDynamicsTool";

/// Joint moments from coordinates and external loads.
#[derive(Debug, Clone, PartialEq)]
pub struct InverseDynamicsSetup {
    /// The model.
    pub model_file: Option<String>,
    /// The coordinates.
    pub coordinates_file: Option<String>,
    /// The external loads; without them nothing acts on the model but gravity.
    pub external_loads_file: Option<String>,
    /// Cut-off of the low-pass filter of the coordinates [Hz]; `None` for no filter.
    pub cutoff_hz: Option<f64>,
    /// Start and end [s].
    pub time_range: Option<[f64; 2]>,
    /// Forces of the model that are left out: names, types, or words such as `muscles` and `all`.
    pub forces_to_exclude: Vec<String>,
}

const CUTOFF: &str = "lowpass_cutoff_frequency_for_coordinates";

const KNOWN: Known<'_> = Known {
    read: &["model_file", "coordinates_file", "external_loads_file", CUTOFF, "time_range", "forces_to_exclude"],
    unused: &[
        "results_directory",
        "input_directory",
        "output_gen_force_file",
        "joints_to_report_body_forces",
        "output_body_forces_file",
        "defaults",
    ],
};

pub(super) fn read(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<InverseDynamicsSetup, Error> {
    remark_on_others(node, &KNOWN, remarks);
    let excluded = xml::text(node, "forces_to_exclude").unwrap_or_default();
    Ok(InverseDynamicsSetup {
        model_file: path(node, "model_file"),
        coordinates_file: path(node, "coordinates_file"),
        external_loads_file: path(node, "external_loads_file"),
        cutoff_hz: xml::number(node, CUTOFF)?.filter(|hz| *hz > 0.0),
        time_range: time_range(node)?,
        forces_to_exclude: excluded.split_whitespace().map(str::to_owned).collect(),
    })
}
