//! Set-up documents of OpenSim's tools: scaling, inverse kinematics from markers and from sensors, placement of
//! sensors, inverse dynamics.
//!
//! Read: documents of all versions, also without the `<OpenSimDocument>` around the tool, with the older names `IKTool`
//! and `InverseKinemtaticsTool`, and with sets of tasks, measurements or scales in separate files (`file="..."`). Paths
//! are as written, but with `/` between their parts; OpenSim resolves them from the folder of the document.
//! Not handled, and rejected: other tools, and several trials in one `IKTool`.
//! Not handled, with a remark: every other element that is not read, by name.
//! Pinned by: tests/setups.rs

mod elements;
mod inverse_dynamics;
mod inverse_kinematics;
mod scale;
mod sensors;
mod sets;
mod tasks;

pub use inverse_dynamics::InverseDynamicsSetup;
pub use inverse_kinematics::InverseKinematicsSetup;
pub use scale::{ManualScale, MeasuredSegment, Measurement, PlacerSetup, ScaleSetup, ScalerSetup, ScalingMethod};
#[doc(hidden)]
pub use sensors::HeadingSensor;
pub use sensors::{SensorKinematicsSetup, SensorPlacerSetup};
#[doc(hidden)]
pub use tasks::MarkerTask;
pub use tasks::{CoordinateTarget, CoordinateTask, FitTasks};

use crate::error::{Error, Remark};
use crate::xml;
use roxmltree::Node;

/// The set-up of a tool.
#[derive(Debug, Clone, PartialEq)]
pub enum Setup {
    /// Scaling of a model to a person.
    Scale(ScaleSetup),
    /// Coordinates from markers.
    InverseKinematics(InverseKinematicsSetup),
    /// Joint moments from coordinates and external loads.
    InverseDynamics(InverseDynamicsSetup),
    /// Places of sensors on a model.
    SensorPlacer(SensorPlacerSetup),
    /// Coordinates from orientations of sensors.
    SensorKinematics(SensorKinematicsSetup),
}

const TOOLS: &str =
    "<ScaleTool>, <InverseKinematicsTool>, <InverseDynamicsTool>, <IMUPlacer> or <IMUInverseKinematicsTool>";

impl Setup {
    /// Reads a set-up document that holds its sets.
    ///
    /// # Errors
    /// XML that is not well formed, another tool, values that are not what the tool needs, sets in separate files. Each
    /// error names line and element.
    pub fn read(bytes: &[u8]) -> Result<(Setup, Vec<Remark>), Error> {
        Setup::read_with(bytes, &mut |_| Err("another file".to_owned()))
    }

    /// Reads a set-up document. `load` reads a file that the document names for a set, by its path from the folder of
    /// the document, or states why it cannot be read.
    ///
    /// # Errors
    /// As [`Setup::read`], and files without the set.
    pub fn read_with(
        bytes: &[u8],
        load: &mut dyn FnMut(&str) -> Result<Vec<u8>, String>,
    ) -> Result<(Setup, Vec<Remark>), Error> {
        if bytes.iter().all(u8::is_ascii_whitespace) {
            return Err(Error::Empty { expected: "the set-up of a tool of OpenSim" });
        }
        let text = xml::document_text(bytes);
        let text = sets::included(&text, load)?.unwrap_or(text);
        let document = xml::parse(&text)?;
        let mut remarks = Vec::new();
        let setup = read_tool(document.root_element(), &mut remarks)?;
        Ok((setup, remarks))
    }

    /// The name of the tool in the format.
    #[must_use]
    pub fn tool(&self) -> &'static str {
        match self {
            Setup::Scale(_) => scale::TOOL,
            Setup::InverseKinematics(_) => inverse_kinematics::TOOL,
            Setup::InverseDynamics(_) => inverse_dynamics::TOOL,
            Setup::SensorPlacer(_) => sensors::PLACER,
            Setup::SensorKinematics(_) => sensors::KINEMATICS,
        }
    }
}

fn read_tool(root: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<Setup, Error> {
    let tool = if root.has_tag_name("OpenSimDocument") { xml::elements(root).next() } else { Some(root) };
    let Some(tool) = tool else { return Err(xml::error_at(root, "nothing".into(), TOOLS)) };
    match tool.tag_name().name() {
        scale::TOOL => scale::read(tool, remarks).map(Setup::Scale),
        inverse_kinematics::TOOL | inverse_kinematics::MISSPELT | inverse_kinematics::OLD => {
            inverse_kinematics::read(tool, remarks).map(Setup::InverseKinematics)
        }
        inverse_dynamics::TOOL => inverse_dynamics::read(tool, remarks).map(Setup::InverseDynamics),
        sensors::PLACER => sensors::read_placer(tool, remarks).map(Setup::SensorPlacer),
        sensors::KINEMATICS => sensors::read_kinematics(tool, remarks).map(Setup::SensorKinematics),
        other => Err(xml::error_at(root, format!("<{other}>"), TOOLS)),
    }
}
