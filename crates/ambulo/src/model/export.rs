//! From a [`Model`] to an OpenSim document.

use super::{Body, BodyId, Coordinate, Displacement, Drive, Function, Joint, JointAxis, Marker, Measure, Model};
use crate::spatial::{Pose, Vec3};
use ambulo_formats::osim::{
    OsimAxis, OsimBody, OsimCoordinate, OsimFrame, OsimFunction, OsimJoint, OsimJointKind, OsimMarker, OsimModel,
};
use std::collections::BTreeMap;

/// Why a model makes no document.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// Something that the writer does not know.
    #[error("{part} `{name}`: found {found}; expected {expected}")]
    Unknown {
        /// `joint` or `coordinate`.
        part: &'static str,
        /// Its name.
        name: String,
        /// What it has.
        found: &'static str,
        /// What can be written.
        expected: &'static str,
    },
}

/// The layout of the document.
const VERSION: u32 = 40000;
const GROUND: &str = "ground";

/// The document of a model whose joints follow their coordinates along straight lines, as those of
/// [`anthropometry`](super::anthropometry) do.
///
/// # Errors
/// Couplers, prescribed motion, curves, joints that count angular velocities.
pub fn to_osim(model: &Model) -> Result<OsimModel, ExportError> {
    let joints = model.body_ids().map(|id| joint(model, id)).collect::<Result<_, _>>()?;
    Ok(OsimModel {
        name: component_name(model.name()),
        document_version: VERSION,
        gravity: model.gravity().into(),
        bodies: model.bodies().iter().map(body).collect(),
        joints,
        constraints: Vec::new(),
        markers: model.markers().iter().map(|m| marker(model, m)).collect(),
        ignored: BTreeMap::new(),
        remarks: Vec::new(),
    })
}

fn body(body: &Body) -> OsimBody {
    let i = body.inertia.about_center();
    OsimBody {
        name: body.name.clone(),
        line: 0,
        mass_kg: body.inertia.mass(),
        mass_center_m: body.inertia.center().into(),
        inertia: [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23],
    }
}

/// A name that OpenSim takes: it refuses these characters in names of components.
fn component_name(name: &str) -> String {
    name.replace([' ', '\t', '\n', '\r', '/', '\\', '*', '+'], "_")
}

fn name_of(model: &Model, body: Option<BodyId>) -> String {
    body.map_or(GROUND, |id| model.bodies()[id.index()].name.as_str()).to_owned()
}

fn frame(body: String, pose: &Pose) -> OsimFrame {
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| pose.rotation[(i, j)]));
    OsimFrame { body, rotation, translation_m: pose.translation.into() }
}

fn joint(model: &Model, id: BodyId) -> Result<OsimJoint, ExportError> {
    let joint = &model.bodies()[id.index()].joint;
    if joint.measure != Measure::Rates {
        let expected = "joints whose forces go with the rates of their coordinates";
        let found = "forces that go with angular velocity";
        return Err(ExportError::Unknown { part: "joint", name: joint.name.clone(), found, expected });
    }
    let own = joint.coordinates().into_iter().map(|id| &model.coordinates()[id.index()]);
    Ok(OsimJoint {
        name: joint.name.clone(),
        line: 0,
        kind: OsimJointKind::Custom(Box::new(axes(model, joint)?)),
        parent: frame(name_of(model, joint.parent), &joint.parent_from_joint),
        child: frame(name_of(model, Some(id)), &joint.child_from_joint),
        coordinates: own.map(coordinate).collect::<Result<_, _>>()?,
    })
}

/// Three rotations and three translations; those that the joint lacks stand still, at right angles to the others.
fn axes(model: &Model, joint: &Joint) -> Result<[OsimAxis; 6], ExportError> {
    let mut all: [OsimAxis; 6] = std::array::from_fn(|_| still(Vec3::zeros()));
    for (first, list) in [(0, &joint.rotations), (3, &joint.translations)] {
        let mut directions: Vec<Vec3> = list.iter().map(|axis| axis.direction).collect();
        for spare in [Vec3::x(), Vec3::y(), Vec3::z()] {
            let is_new = directions.iter().all(|d| d.dot(&spare).abs() < 0.9);
            if is_new && directions.len() < 3 {
                directions.push(spare);
            }
        }
        for (k, direction) in directions.into_iter().enumerate() {
            all[first + k] = match list.get(k) {
                Some(axis) => moving(model, joint, axis)?,
                None => still(direction),
            };
        }
    }
    Ok(all)
}

fn still(direction: Vec3) -> OsimAxis {
    OsimAxis { axis: direction.into(), coordinate: None, function: OsimFunction::Constant(0.0) }
}

fn moving(model: &Model, joint: &Joint, axis: &JointAxis) -> Result<OsimAxis, ExportError> {
    let direction: [f64; 3] = axis.direction.into();
    match &axis.displacement {
        Displacement::Fixed(value) => {
            Ok(OsimAxis { axis: direction, coordinate: None, function: OsimFunction::Constant(*value) })
        }
        Displacement::Follows(id, Function::Linear { slope, intercept }) => Ok(OsimAxis {
            axis: direction,
            coordinate: Some(model.coordinates()[id.index()].name.clone()),
            function: OsimFunction::Linear { slope: *slope, intercept: *intercept },
        }),
        Displacement::Follows(..) => Err(ExportError::Unknown {
            part: "joint",
            name: joint.name.clone(),
            found: "an axis that follows its coordinate along a curve",
            expected: "straight lines",
        }),
    }
}

fn coordinate(coordinate: &Coordinate) -> Result<OsimCoordinate, ExportError> {
    let locked = match coordinate.drive {
        Drive::Free => false,
        Drive::Locked => true,
        Drive::Prescribed(_) | Drive::Coupled(..) => {
            return Err(ExportError::Unknown {
                part: "coordinate",
                name: coordinate.name.clone(),
                found: "motion that something else decides",
                expected: "coordinates that are free or locked",
            });
        }
    };
    Ok(OsimCoordinate {
        name: coordinate.name.clone(),
        line: 0,
        default_value: coordinate.default_value,
        range: coordinate.range,
        clamped: coordinate.clamped,
        locked,
        prescribed: None,
    })
}

fn marker(model: &Model, marker: &Marker) -> OsimMarker {
    OsimMarker {
        name: component_name(&marker.name),
        body: name_of(model, marker.body),
        location_m: marker.location.into(),
    }
}
