//! OpenSim models (`.osim`): bodies, joints, coordinates, couplers, bushings, markers, muscles with their paths and
//! wrap objects, and motors at coordinates, as in the document.
//!
//! Document versions 20303 to 40600 are read, in both layouts: joints nested in their child body with
//! `location_in_parent` (to 30500), and joints in a `JointSet` with offset frames (from 30505), the frames named by
//! connectors, by `..._connectee_name` or by `socket_...` elements. Other versions are read as well, with a remark.
//!
//! Lengths are metres, masses kg, inertias kg.m² about the mass centre, angles radians, as the format defines them.
//! Other elements (controllers, contact geometry, other forces; muscles and wrap objects of types that are not read)
//! are counted in [`OsimModel::ignored`], by the tag of the element.

mod bushing;
mod constraint;
mod force_set;
mod frame;
mod function;
mod joint;
mod marker_set;
mod muscle;
mod path;
mod write;
mod write_elements;
mod write_muscles;

pub use bushing::OsimBushing;
pub use constraint::OsimConstraint;
pub use force_set::OsimForceSet;
pub use function::{Knots, OsimFunction};
pub use joint::{OsimAxis, OsimCoordinate, OsimJoint, OsimJointKind};
pub use marker_set::OsimMarkerSet;
#[doc(hidden)]
pub use marker_set::OsimSetMarker;
pub use muscle::{
    OsimCoordinateActuator, OsimMuscle, OsimMuscleCurves, OsimMuscleKind, OsimMuscleParameters, OsimMuscles,
};
pub use path::{OsimPath, OsimPathPoint, OsimPathWrap, OsimPointPlace, OsimWrapObject, OsimWrapShape};

use crate::error::{Error, Remark, quoted};
use crate::xml;
use frame::Frames;
use roxmltree::Node;
use std::collections::BTreeMap;

/// Oldest document version whose layout is known.
const OLDEST_VERSION: u32 = 20303;
/// Newest document version whose layout is known.
const NEWEST_VERSION: u32 = 40600;

/// A model as in the document: names, numbers and frames, without physical checks.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimModel {
    /// The model's `name` attribute.
    pub name: String,
    /// The document's `Version`, such as 40000.
    pub document_version: u32,
    /// Gravity in the model's ground frame [m/s²].
    pub gravity: [f64; 3],
    /// Bodies in document order; ground is not among them.
    pub bodies: Vec<OsimBody>,
    /// Joints in document order.
    pub joints: Vec<OsimJoint>,
    /// Constraints in document order.
    pub constraints: Vec<OsimConstraint>,
    /// Bushings that are switched on, in document order.
    pub bushings: Vec<OsimBushing>,
    /// Markers in document order.
    pub markers: Vec<OsimMarker>,
    /// Muscles, wrap objects and motors at coordinates, or why they cannot be read: the rest of the model does not need
    /// them.
    pub muscles: Result<OsimMuscles, Error>,
    /// Offset frames of bodies, joints and other components, by `owner/name`.
    pub frames: BTreeMap<String, OsimFrame>,
    /// Number of ignored elements, by tag.
    pub ignored: BTreeMap<String, usize>,
    /// Remarks on the document.
    pub remarks: Vec<Remark>,
}

/// A rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimBody {
    /// Name of the body.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Mass [kg].
    pub mass_kg: f64,
    /// Mass centre in the body frame [m].
    pub mass_center_m: [f64; 3],
    /// Inertia about the mass centre in body axes: xx, yy, zz, xy, xz, yz [kg.m²].
    pub inertia: [f64; 6],
}

/// Pose of a frame that is fixed to a body or to ground.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimFrame {
    /// Name of the body, or `ground`.
    pub body: String,
    /// Rotation matrix, rows first: columns are the frame's axes in body axes.
    pub rotation: [[f64; 3]; 3],
    /// Origin in the body frame [m].
    pub translation_m: [f64; 3],
}

/// A marker fixed to a body.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimMarker {
    /// Name of the marker.
    pub name: String,
    /// Name of the body, or `ground`.
    pub body: String,
    /// Place in the body frame [m].
    pub location_m: [f64; 3],
    /// Whether scaling leaves the marker where it is on its body.
    pub fixed: bool,
}

impl OsimModel {
    /// Reads a model document.
    ///
    /// # Errors
    /// XML that is not well formed, a document without a model, invalid numbers, joints whose frames lead
    /// nowhere, unknown functions and joint types. Each error names line and element.
    pub fn read(bytes: &[u8]) -> Result<OsimModel, Error> {
        let text = xml::document_text(bytes);
        if text.trim().is_empty() {
            return Err(Error::Empty { expected: "an <OpenSimDocument>" });
        }
        let document = xml::parse(&text)?;
        let root = document.root_element();
        let mut remarks = Vec::new();
        let document_version = document_version(root, &mut remarks)?;
        let model = xml::child(root, "Model")
            .ok_or_else(|| xml::error_at(root, found_children(root), "a <Model> inside <OpenSimDocument>"))?;
        read_model(model, document_version, remarks)
    }
}

fn document_version(root: Node<'_, '_>, remarks: &mut Vec<Remark>) -> Result<u32, Error> {
    if !root.has_tag_name("OpenSimDocument") {
        let found = format!("the root element <{}>", root.tag_name().name());
        return Err(xml::error_at(root, found, "the root element <OpenSimDocument> of an .osim model"));
    }
    let stated = root.attribute("Version").unwrap_or_default();
    let version = stated
        .trim()
        .parse()
        .map_err(|_| xml::error_at(root, quoted(stated), "a Version attribute such as \"40000\""))?;
    if !(OLDEST_VERSION..=NEWEST_VERSION).contains(&version) {
        let message =
            format!("document version {version} is outside the known {OLDEST_VERSION}-{NEWEST_VERSION}; read as it is");
        remarks.push(Remark::of_line(xml::line_of(root), message));
    }
    Ok(version)
}

fn found_children(node: Node<'_, '_>) -> String {
    let tags: Vec<_> = xml::elements(node).take(5).map(|c| format!("<{}>", c.tag_name().name())).collect();
    if tags.is_empty() { "nothing".into() } else { tags.join(", ") }
}

fn read_model(model: Node<'_, '_>, document_version: u32, remarks: Vec<Remark>) -> Result<OsimModel, Error> {
    let body_nodes: Vec<_> = members(model, "BodySet").filter(|b| b.has_tag_name("Body")).collect();
    let body_nodes: Vec<_> = body_nodes.into_iter().filter(|b| !is_ground(name_of(*b))).collect();
    let bodies = body_nodes.iter().map(|b| read_body(*b)).collect::<Result<Vec<_>, _>>()?;
    let frames = Frames::collect(model, &bodies)?;

    let mut joints = Vec::new();
    for body in &body_nodes {
        let nested = xml::child(*body, "Joint").or_else(|| xml::child(*body, "joint"));
        for node in nested.into_iter().flat_map(|n| xml::elements(n)) {
            joints.push(joint::read_nested(node, name_of(*body))?);
        }
    }
    for node in members(model, "JointSet") {
        joints.push(joint::read_framed(node, &frames)?);
    }
    let constraints = members(model, "ConstraintSet").map(constraint::read).collect::<Result<_, _>>()?;
    let bushings = bushing::of_model(model, &frames)?;
    let markers = marker_set::of_model(model, &frames)?;
    Ok(OsimModel {
        name: name_of(model).to_owned(),
        document_version,
        gravity: xml::triple(model, "gravity")?.unwrap_or([0.0, -9.80665, 0.0]),
        bodies,
        joints,
        constraints,
        bushings,
        markers,
        muscles: muscle::of_model(model, &frames),
        frames: frames.by_owner(),
        ignored: count_ignored(model),
        remarks,
    })
}

/// The elements of a set's `<objects>`.
fn members<'a, 'i>(model: Node<'a, 'i>, set: &str) -> impl Iterator<Item = Node<'a, 'i>> {
    xml::child(model, set).and_then(|s| xml::child(s, "objects")).into_iter().flat_map(|o| xml::elements(o))
}

fn name_of<'a>(node: Node<'a, '_>) -> &'a str {
    node.attribute("name").unwrap_or_default().trim()
}

fn is_ground(name: &str) -> bool {
    name == "ground"
}

fn read_body(node: Node<'_, '_>) -> Result<OsimBody, Error> {
    Ok(OsimBody {
        name: name_of(node).to_owned(),
        line: xml::line_of(node),
        mass_kg: xml::number(node, "mass")?.ok_or_else(|| xml::error_at(node, "no <mass>".into(), "a mass in kg"))?,
        mass_center_m: xml::triple(node, "mass_center")?.unwrap_or_default(),
        inertia: read_inertia(node)?,
    })
}

/// `<inertia>` with six numbers (from 30500), or six elements `inertia_xx`, ...
fn read_inertia(body: Node<'_, '_>) -> Result<[f64; 6], Error> {
    if let Some(values) = xml::numbers(body, "inertia")? {
        let found = format!("{} numbers in <inertia>", values.len());
        return values.try_into().map_err(|_| xml::error_at(body, found, "six numbers: xx yy zz xy xz yz"));
    }
    let mut inertia = [0.0; 6];
    for (value, axes) in inertia.iter_mut().zip(["xx", "yy", "zz", "xy", "xz", "yz"]) {
        *value = xml::number(body, &format!("inertia_{axes}"))?.unwrap_or(0.0);
    }
    Ok(inertia)
}

/// Counts the components that are not read, by tag, within their sets.
fn count_ignored(model: Node<'_, '_>) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    let sets = ["ForceSet", "ControllerSet", "ProbeSet", "ContactGeometrySet", "ComponentSet"];
    let is_read = |tag: &str| tag == bushing::TAG || muscle::is_read(tag);
    let listed = sets.iter().flat_map(|set| members(model, set)).filter(|node| !is_read(node.tag_name().name()));
    let is_read = |tag: &str| matches!(tag, path::CYLINDER | path::SPHERE);
    let wrapped = model.descendants().filter(|n| path::is_wrap_object(*n) && !is_read(n.tag_name().name()));
    for node in listed.chain(wrapped) {
        *counts.entry(node.tag_name().name().to_owned()).or_insert(0) += 1;
    }
    counts
}

/// The name at the end of a path of components.
fn last_part(path: &str) -> &str {
    path.rsplit('/').find(|part| !part.is_empty()).unwrap_or(path)
}
