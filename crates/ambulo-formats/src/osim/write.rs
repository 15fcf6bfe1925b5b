//! Models as documents that OpenSim 4 loads: bodies, joints, coordinates, couplers, bushings, markers, muscles.
//!
//! Numbers are written such that they read back to the same bits, except orientations of frames, which are written as
//! angles and read back to rounding.

use super::write_elements::{element, frame, function, group, holder, numbers, path, unknown};
use super::write_muscles;
use super::{
    OsimAxis, OsimBody, OsimBushing, OsimConstraint, OsimCoordinate, OsimFunction, OsimJoint, OsimJointKind,
    OsimMarker, OsimModel,
};
use crate::error::{Error, quoted};
use crate::xml::escaped;
use std::collections::{BTreeMap, BTreeSet};

/// Document version of the layout that is written.
const VERSION: u32 = 40000;

impl OsimModel {
    /// Writes a document.
    ///
    /// # Errors
    /// Constraints other than couplers of coordinates; muscles that could not be read, muscles and wrap objects of
    /// types that are not read; numbers that are not finite.
    pub fn write(&self) -> Result<Vec<u8>, Error> {
        let constraints = self.constraints.iter().map(constraint).collect::<Result<String, Error>>()?;
        let muscles = self.muscles.as_ref().map_err(Clone::clone)?;
        let wraps = write_muscles::wrap_sets(muscles)?;
        let bodies = self.bodies.iter().map(|b| body(b, &wraps)).collect::<Result<String, Error>>()?;
        let joints = self.joints.iter().map(joint).collect::<Result<String, Error>>()?;
        let bushings = self.bushings.iter().map(bushing).collect::<Result<String, Error>>()?;
        let forces = bushings + &write_muscles::forces(muscles, &self.joints)?;
        let markers = self.markers.iter().map(marker).collect::<Result<String, Error>>()?;
        let mut out = format!("<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\"{VERSION}\">\n");
        out += &format!("\t<Model name=\"{}\">\n", escaped(&self.name));
        out += &element(2, "gravity", &numbers(&self.gravity)?);
        out += &write_muscles::ground(&wraps);
        out += &set("BodySet", "bodyset", &bodies);
        out += &set("JointSet", "jointset", &joints);
        if !constraints.is_empty() {
            out += &set("ConstraintSet", "constraintset", &constraints);
        }
        if !forces.is_empty() {
            out += &holder(2, "ForceSet", "forceset", &(group(3, "objects", &forces) + &self.groups()));
        }
        if !markers.is_empty() {
            out += &set("MarkerSet", "markerset", &markers);
        }
        out += "\t</Model>\n</OpenSimDocument>\n";
        Ok(out.into_bytes())
    }

    /// The groups of forces; a name with spaces cannot be a member of one.
    fn groups(&self) -> String {
        let names: BTreeSet<&String> = self.bushings.iter().flat_map(|bushing| &bushing.groups).collect();
        let members = |group: &String| {
            let inside = self.bushings.iter().filter(|bushing| bushing.groups.contains(group));
            inside.map(|bushing| bushing.name.as_str()).collect::<Vec<_>>().join(" ")
        };
        let all: String = names
            .into_iter()
            .map(|name| holder(4, "ObjectGroup", name, &element(5, "members", &members(name))))
            .collect();
        if all.is_empty() { all } else { group(3, "groups", &all) }
    }
}

fn set(tag: &str, name: &str, objects: &str) -> String {
    holder(2, tag, name, &group(3, "objects", objects))
}

fn body(body: &OsimBody, wraps: &BTreeMap<&str, String>) -> Result<String, Error> {
    let wraps = wraps.get(body.name.as_str()).map_or("", String::as_str);
    let content = wraps.to_owned()
        + &element(5, "mass", &numbers(&[body.mass_kg])?)
        + &element(5, "mass_center", &numbers(&body.mass_center_m)?)
        + &element(5, "inertia", &numbers(&body.inertia)?);
    Ok(holder(4, "Body", &body.name, &content))
}

fn joint(joint: &OsimJoint) -> Result<String, Error> {
    let [parent, child] = ["parent", "child"].map(|end| format!("{}_{end}", joint.name));
    let coordinates = joint.coordinates.iter().map(coordinate).collect::<Result<String, Error>>()?;
    let frames = frame(&parent, &joint.parent)? + &frame(&child, &joint.child)?;
    let mut content = element(5, "socket_parent_frame", &parent) + &element(5, "socket_child_frame", &child);
    content += &group(5, "coordinates", &coordinates);
    content += &group(5, "frames", &frames);
    match &joint.kind {
        OsimJointKind::Custom(axes) => {
            let axes = axes.iter().enumerate().map(|(i, a)| axis(i, a)).collect::<Result<String, Error>>()?;
            content += &group(5, "SpatialTransform", &axes);
        }
        OsimJointKind::Ellipsoid { radii_m } => content += &element(5, "radii_x_y_z", &numbers(radii_m)?),
        OsimJointKind::ConstantCurvature { neutral_angle_rad, length_m } => {
            content += &element(5, "neutral_angle_x_z_y", &numbers(neutral_angle_rad)?);
            content += &element(5, "length", &numbers(&[*length_m])?);
        }
        OsimJointKind::Scapulothoracic { radii_m, winging_origin_m, winging_direction_rad } => {
            content += &element(5, "thoracic_ellipsoid_radii_x_y_z", &numbers(radii_m)?);
            content += &element(5, "scapula_winging_axis_origin", &numbers(winging_origin_m)?);
            content += &element(5, "scapula_winging_axis_direction", &numbers(&[*winging_direction_rad])?);
        }
        _ => {}
    }
    Ok(holder(4, tag(joint), &joint.name, &content))
}

fn tag(joint: &OsimJoint) -> &'static str {
    match joint.kind {
        OsimJointKind::Weld => "WeldJoint",
        OsimJointKind::Pin => "PinJoint",
        OsimJointKind::Slider => "SliderJoint",
        OsimJointKind::Universal => "UniversalJoint",
        OsimJointKind::Ball => "BallJoint",
        OsimJointKind::Gimbal => "GimbalJoint",
        OsimJointKind::Planar => "PlanarJoint",
        OsimJointKind::Free => "FreeJoint",
        OsimJointKind::Custom(_) => "CustomJoint",
        OsimJointKind::Ellipsoid { .. } => "EllipsoidJoint",
        OsimJointKind::Scapulothoracic { .. } => "ScapulothoracicJoint",
        OsimJointKind::ConstantCurvature { .. } => "ConstantCurvatureJoint",
    }
}

fn coordinate(coordinate: &OsimCoordinate) -> Result<String, Error> {
    let mut content = element(7, "default_value", &numbers(&[coordinate.default_value])?);
    if let Some(range) = coordinate.range {
        content += &element(7, "range", &numbers(&range)?);
    }
    content += &element(7, "clamped", if coordinate.clamped { "true" } else { "false" });
    content += &element(7, "locked", if coordinate.locked { "true" } else { "false" });
    if let Some(prescribed) = &coordinate.prescribed {
        content += &group(7, "prescribed_function", &function(8, "", prescribed)?);
        content += &element(7, "prescribed", "true");
    }
    Ok(holder(6, "Coordinate", &coordinate.name, &content))
}

fn axis(number: usize, axis: &OsimAxis) -> Result<String, Error> {
    const NAMES: [&str; 6] = ["rotation1", "rotation2", "rotation3", "translation1", "translation2", "translation3"];
    let content = element(7, "coordinates", axis.coordinate.as_deref().unwrap_or_default())
        + &element(7, "axis", &numbers(&axis.axis)?)
        + &function(7, "function", &axis.function)?;
    Ok(holder(6, "TransformAxis", NAMES.get(number).copied().unwrap_or_default(), &content))
}

/// `dependent = scale · function(independent)`: the reader wraps the function in the factor; here it is unwrapped.
fn constraint(constraint: &OsimConstraint) -> Result<String, Error> {
    let (name, independent, dependent, held) = match constraint {
        OsimConstraint::CoordinateCoupler { name, independent, dependent, function, .. } => {
            (name, independent, dependent, function)
        }
        OsimConstraint::Other { kind, name, .. } => {
            let found = format!("the {kind} {}", quoted(name));
            return Err(unknown(found, "couplers of coordinates"));
        }
        // A constraint that is switched off has no effect, and its type is not known here.
        OsimConstraint::Off { .. } => return Ok(String::new()),
    };
    let (scale, held) = match held {
        OsimFunction::Multiplier { scale, function } => (*scale, function.as_ref()),
        other => (1.0, other),
    };
    let content = group(5, "coupled_coordinates_function", &function(6, "", held)?)
        + &element(5, "independent_coordinate_names", independent)
        + &element(5, "dependent_coordinate_name", dependent)
        + &element(5, "scale_factor", &numbers(&[scale])?);
    Ok(holder(4, "CoordinateCouplerConstraint", name, &content))
}

fn bushing(bushing: &OsimBushing) -> Result<String, Error> {
    let [first, second] = [1, 2].map(|end| format!("{}_frame{end}", bushing.name));
    let frames = frame(&first, &bushing.frames[0])? + &frame(&second, &bushing.frames[1])?;
    let content = element(5, "socket_frame1", &first)
        + &element(5, "socket_frame2", &second)
        + &group(5, "frames", &frames)
        + &element(5, "rotational_stiffness", &numbers(&bushing.rotational_stiffness)?)
        + &element(5, "translational_stiffness", &numbers(&bushing.translational_stiffness)?)
        + &element(5, "rotational_damping", &numbers(&bushing.rotational_damping)?)
        + &element(5, "translational_damping", &numbers(&bushing.translational_damping)?);
    Ok(holder(4, super::bushing::TAG, &bushing.name, &content))
}

fn marker(marker: &OsimMarker) -> Result<String, Error> {
    let content = element(5, "socket_parent_frame", &path(&marker.body))
        + &element(5, "location", &numbers(&marker.location_m)?)
        + &element(5, "fixed", &marker.fixed.to_string());
    Ok(holder(4, "Marker", &marker.name, &content))
}
