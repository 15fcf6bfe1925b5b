//! Writes a [`Model`] as an OpenSim document.

use super::osim_frame::frame;
use super::osim_function::write as function;
use super::{
    Body, BodyId, Bushing, Coordinate, CoordinateId, Displacement, Drive, Joint, JointAxis, JointSpeeds, Marker, Model,
};
use crate::spatial::{Pose, Vec3, rotation};
use ambulo_formats::osim::{
    OsimAxis, OsimBody, OsimBushing, OsimConstraint, OsimCoordinate, OsimFunction, OsimJoint, OsimJointKind,
    OsimMarker, OsimModel, OsimMuscles,
};
use std::collections::{BTreeMap, BTreeSet};

/// Why a model cannot be written.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ExportError {
    /// A part that the format cannot express.
    #[error("{part} `{name}`: found {found}; expected {expected}")]
    Unknown {
        /// `joint` or `coordinate`.
        part: &'static str,
        /// Name of the joint or coordinate.
        name: String,
        /// Found value.
        found: &'static str,
        /// Forms that can be written.
        expected: &'static str,
    },
    /// The file format cannot store the model.
    #[error(transparent)]
    Format(#[from] ambulo_formats::Error),
}

/// Version of the document.
const VERSION: u32 = 40000;
const GROUND: &str = "ground";

/// Converts a model to a document: bodies, joints with their curves, couplers of coordinates, bushings and markers.
///
/// # Errors
/// Joints with angular velocities about other axes than x, y, z in this order; coordinates that move no joint.
pub fn to_osim(model: &Model) -> Result<OsimModel, ExportError> {
    check_coordinates(model)?;
    let joints = model.body_ids().map(|id| joint(model, id)).collect::<Result<_, _>>()?;
    Ok(OsimModel {
        name: component_name(model.name()),
        document_version: VERSION,
        gravity: model.gravity().into(),
        bodies: model.bodies().iter().map(body).collect(),
        joints,
        constraints: model.coordinates().iter().filter_map(|c| coupler(model, c)).collect(),
        bushings: model.bushings().iter().map(|b| bushing(model, b)).collect(),
        markers: model.markers().iter().map(|m| marker(model, m)).collect(),
        muscles: Ok(OsimMuscles::default()),
        frames: BTreeMap::new(),
        ignored: BTreeMap::new(),
        remarks: Vec::new(),
    })
}

/// Checks that every coordinate moves a joint, because a document has coordinates only in joints.
fn check_coordinates(model: &Model) -> Result<(), ExportError> {
    let moving: BTreeSet<CoordinateId> = model.bodies().iter().flat_map(|body| body.joint.coordinates()).collect();
    match model.coordinate_ids().find(|id| !moving.contains(id)) {
        None => Ok(()),
        Some(id) => Err(ExportError::Unknown {
            part: "coordinate",
            name: model.coordinates()[id.index()].name.clone(),
            found: "no axis of a joint that follows it",
            expected: "coordinates that move a joint",
        }),
    }
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

/// A name that OpenSim accepts: these characters are not allowed in names of components.
fn component_name(name: &str) -> String {
    name.replace([' ', '\t', '\n', '\r', '/', '\\', '*', '+'], "_")
}

fn name_of(model: &Model, body: Option<BodyId>) -> String {
    body.map_or(GROUND, |id| model.bodies()[id.index()].name.as_str()).to_owned()
}

fn joint(model: &Model, id: BodyId) -> Result<OsimJoint, ExportError> {
    let joint = &model.bodies()[id.index()].joint;
    // In the order of the model, which may differ from the order of the axes.
    let own: BTreeSet<CoordinateId> = joint.coordinates().into_iter().collect();
    let as_stated = joint.parent_from_joint;
    let (kind, on_parent) = match (ball_kind(joint)?, standing(joint)) {
        (Some(kind), _) => (kind, as_stated),
        // OpenSim 4.6 crashes with a custom joint without coordinates.
        (None, Some(standing)) => (OsimJointKind::Weld, as_stated * standing),
        (None, None) => (OsimJointKind::Custom(Box::new(axes(model, joint))), as_stated),
    };
    Ok(OsimJoint {
        name: joint.name.clone(),
        line: 0,
        kind,
        parent: frame(name_of(model, joint.parent), &on_parent),
        child: frame(name_of(model, Some(id)), &joint.child_from_joint),
        coordinates: own.into_iter().map(|id| coordinate(&model.coordinates()[id.index()])).collect(),
    })
}

/// Type of a joint with angular velocities as speeds, whose axes are not in the document: x, y, z of the joint frames,
/// each with the coordinate in its position. `None` for joints with the rates of their coordinates as speeds.
fn ball_kind(joint: &Joint) -> Result<Option<OsimJointKind>, ExportError> {
    let in_turn = |axes: &[JointAxis]| {
        let units = [Vec3::x(), Vec3::y(), Vec3::z()];
        axes.len() == 3 && axes.iter().zip(units).all(|(axis, unit)| axis.direction == unit)
    };
    let leaders: Vec<CoordinateId> = joint.coordinates();
    let is_known = in_turn(&joint.rotations) && leaders.is_sorted();
    let slides = !joint.translations.is_empty();
    match joint.speeds {
        JointSpeeds::Rates => Ok(None),
        JointSpeeds::AngularVelocity if is_known && !slides => Ok(Some(OsimJointKind::Ball)),
        JointSpeeds::AngularVelocity if is_known && in_turn(&joint.translations) && leaders.len() == 6 => {
            Ok(Some(OsimJointKind::Free))
        }
        JointSpeeds::Arc(length_m) => {
            let neutral_angle_rad = arc_angles(joint).ok_or_else(|| ExportError::Unknown {
                part: "joint",
                name: joint.name.clone(),
                found: "an arc with other axes",
                expected: "rotations about x, z, y, each by a separate coordinate",
            })?;
            Ok(Some(OsimJointKind::ConstantCurvature { neutral_angle_rad, length_m }))
        }
        JointSpeeds::Ellipsoid(radii) if is_known && !slides => {
            Ok(Some(OsimJointKind::Ellipsoid { radii_m: radii.into() }))
        }
        _ => Err(ExportError::Unknown {
            part: "joint",
            name: joint.name.clone(),
            found: "angular velocities about its own axes as speeds",
            expected: "rotations about x, y, z, and translations along x, y, z or none",
        }),
    }
}

/// The neutral angles of an arc about x, z, y; `None` if its axes are others.
fn arc_angles(joint: &Joint) -> Option<[f64; 3]> {
    let units = [Vec3::x(), Vec3::z(), Vec3::y()];
    let [a, b, c] = &joint.rotations[..] else { return None };
    let mut angles = [0.0; 3];
    for ((axis, unit), angle) in [a, b, c].into_iter().zip(units).zip(&mut angles) {
        let Displacement::Follows(_, function) = &axis.displacement else { return None };
        let (slope, intercept) = function.as_linear().filter(|_| axis.direction == unit)?;
        *angle = ((slope - 1.0).abs() <= f64::EPSILON).then_some(intercept)?;
    }
    (joint.translations.is_empty() && joint.coordinates().is_sorted()).then_some(angles)
}

/// Pose of the joint frame of the child in the joint frame of the parent; `None` if a coordinate moves it.
fn standing(joint: &Joint) -> Option<Pose> {
    let mut pose = Pose::IDENTITY;
    for (axis, value) in fixed(&joint.rotations)? {
        pose.rotation *= rotation(&(axis * value));
    }
    pose.translation = fixed(&joint.translations)?.into_iter().map(|(axis, value)| axis * value).sum();
    Some(pose)
}

/// Directions and displacements of axes; `None` if a coordinate moves one.
fn fixed(axes: &[JointAxis]) -> Option<Vec<(Vec3, f64)>> {
    let displacement = |axis: &JointAxis| match axis.displacement {
        Displacement::Fixed(value) => Some((axis.direction, value)),
        Displacement::Follows(..) => None,
    };
    axes.iter().map(displacement).collect()
}

/// Three rotations and three translations; missing ones are constant, perpendicular to the others.
fn axes(model: &Model, joint: &Joint) -> [OsimAxis; 6] {
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
                Some(axis) => moving(model, axis),
                None => still(direction),
            };
        }
    }
    all
}

fn still(direction: Vec3) -> OsimAxis {
    OsimAxis { axis: direction.into(), coordinate: None, function: OsimFunction::Constant(0.0) }
}

fn moving(model: &Model, axis: &JointAxis) -> OsimAxis {
    let (coordinate, function) = match &axis.displacement {
        Displacement::Fixed(value) => (None, OsimFunction::Constant(*value)),
        Displacement::Follows(id, curve) => (Some(model.coordinates()[id.index()].name.clone()), function(curve)),
    };
    OsimAxis { axis: axis.direction.into(), coordinate, function }
}

fn coordinate(coordinate: &Coordinate) -> OsimCoordinate {
    OsimCoordinate {
        name: coordinate.name.clone(),
        line: 0,
        default_value: coordinate.default_value,
        range: coordinate.range,
        clamped: coordinate.clamped,
        locked: matches!(coordinate.drive, Drive::Locked),
        prescribed: match &coordinate.drive {
            Drive::Prescribed(curve) => Some(function(curve)),
            _ => None,
        },
    }
}

fn coupler(model: &Model, coordinate: &Coordinate) -> Option<OsimConstraint> {
    let Drive::Coupled(leader, curve) = &coordinate.drive else { return None };
    Some(OsimConstraint::CoordinateCoupler {
        name: format!("{}_coupler", coordinate.name),
        line: 0,
        independent: model.coordinates()[leader.index()].name.clone(),
        dependent: coordinate.name.clone(),
        function: function(curve),
    })
}

fn bushing(model: &Model, bushing: &Bushing) -> OsimBushing {
    OsimBushing {
        name: component_name(&bushing.name),
        line: 0,
        frames: bushing.ends.map(|end| frame(name_of(model, end.body), &end.frame)),
        rotational_stiffness: bushing.stiffness.angular.into(),
        translational_stiffness: bushing.stiffness.linear.into(),
        rotational_damping: bushing.damping.angular.into(),
        translational_damping: bushing.damping.linear.into(),
        groups: bushing.groups.clone(),
    }
}

fn marker(model: &Model, marker: &Marker) -> OsimMarker {
    OsimMarker {
        name: component_name(&marker.name),
        body: name_of(model, marker.body),
        location_m: marker.location.into(),
        fixed: marker.fixed,
    }
}
