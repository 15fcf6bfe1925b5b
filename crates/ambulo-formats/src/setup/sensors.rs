//! The set-ups of OpenSim's tools for inertial sensors: their placement on a model, and inverse kinematics from their
//! orientations.

use super::elements::{Known, members, path, remark_on_others, time_range, weight};
use crate::error::{Error, Remark, quoted};
use crate::xml;
use roxmltree::Node;

pub(super) const PLACER: &str = "IMUPlacer";
pub(super) const KINEMATICS: &str = "IMUInverseKinematicsTool";

/// Places of sensors on a model, from a standing posture.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorPlacerSetup {
    /// The model without sensors.
    pub model_file: Option<String>,
    /// Orientations of the sensors while the person stands in the default posture of the model.
    pub orientations_file: Option<String>,
    /// The sensor with an axis that points forward in that posture.
    pub heading: Option<HeadingSensor>,
    /// Turn from the earth of the sensors to the axes of the model: angles about the fixed axes x, y and z [rad].
    pub earth_rad: [f64; 3],
}

/// A sensor with an axis that points forward.
#[derive(Debug, Clone, PartialEq)]
pub struct HeadingSensor {
    /// Name of the sensor.
    pub sensor: String,
    /// Number of the axis: x, y, z.
    pub axis: usize,
    /// Whether the opposite direction points forward.
    pub is_negative: bool,
}

/// Coordinates from orientations of sensors.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorKinematicsSetup {
    /// The model with its sensors.
    pub model_file: Option<String>,
    /// Orientations of the sensors.
    pub orientations_file: Option<String>,
    /// As [`SensorPlacerSetup::earth_rad`].
    pub earth_rad: [f64; 3],
    /// Start and end [s].
    pub time_range: Option<[f64; 2]>,
    /// Weights of sensors, by name; the others have 1.
    pub weights: Vec<(String, f64)>,
}

const EARTH: &str = "sensor_to_opensim_rotations";
const KNOWN_TO_PLACER: Known<'_> = Known {
    read: &["model_file", "base_imu_label", "base_heading_axis", EARTH, "orientation_file_for_calibration"],
    unused: &["output_model_file", "defaults"],
};
const KNOWN_TO_KINEMATICS: Known<'_> = Known {
    read: &["model_file", "orientations_file", EARTH, "time_range", "OrientationWeightSet"],
    unused: &["results_directory", "constraint_weight", "accuracy", "output_motion_file", "report_errors", "defaults"],
};

pub(super) fn read_placer(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<SensorPlacerSetup, Error> {
    remark_on_others(node, &KNOWN_TO_PLACER, remarks);
    Ok(SensorPlacerSetup {
        model_file: path(node, "model_file"),
        orientations_file: path(node, "orientation_file_for_calibration"),
        heading: read_heading(node)?,
        earth_rad: xml::triple(node, EARTH)?.unwrap_or_default(),
    })
}

/// OpenSim corrects the heading if both elements are filled.
fn read_heading(node: Node<'_, '_>) -> Result<Option<HeadingSensor>, Error> {
    let (Some(sensor), Some(stated)) = (xml::text(node, "base_imu_label"), xml::text(node, "base_heading_axis")) else {
        return Ok(None);
    };
    if sensor.is_empty() || stated.is_empty() {
        return Ok(None);
    }
    let word = stated.to_ascii_lowercase();
    let axis = word.trim_start_matches('-');
    match ["x", "y", "z"].iter().position(|name| *name == axis) {
        Some(axis) => Ok(Some(HeadingSensor { sensor: sensor.to_owned(), axis, is_negative: word.starts_with('-') })),
        None => {
            let at = xml::child(node, "base_heading_axis").unwrap_or(node);
            Err(xml::error_at(at, quoted(stated), "x, -x, y, -y, z or -z"))
        }
    }
}

pub(super) fn read_kinematics(node: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<SensorKinematicsSetup, Error> {
    remark_on_others(node, &KNOWN_TO_KINEMATICS, remarks);
    let mut weights = Vec::new();
    for member in members(node, "OrientationWeightSet")? {
        weights.push((member.attribute("name").unwrap_or_default().trim().to_owned(), weight(member)?));
    }
    Ok(SensorKinematicsSetup {
        model_file: path(node, "model_file"),
        orientations_file: path(node, "orientations_file"),
        earth_rad: xml::triple(node, EARTH)?.unwrap_or_default(),
        time_range: time_range(node)?,
        weights,
    })
}
