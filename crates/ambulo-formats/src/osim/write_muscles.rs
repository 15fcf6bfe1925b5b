//! Muscles, wrap objects and motors at coordinates as elements of a document.

use super::muscle::{
    ACTIVE_CURVE, ACTIVE_FORCE_LENGTH, ACTUATOR, FIBER_CURVE, FIBER_FORCE_LENGTH, FORCE_VELOCITY, MILLARD,
    OsimCoordinateActuator, OsimMuscle, OsimMuscleCurves, OsimMuscleKind, OsimMuscleParameters, TENDON_CURVE,
    TENDON_FORCE_LENGTH, THELEN, THELEN_SHAPE, VELOCITY_CURVE,
};
use super::path::{
    CYLINDER, OsimPath, OsimPathPoint, OsimPathWrap, OsimPointPlace, OsimWrapObject, OsimWrapShape, SPHERE,
};
use super::write_elements::{angles, element, frame, function, group, holder, numbers, path, unknown};
use super::{OsimFrame, OsimJoint, OsimMuscles};
use crate::error::{Error, quoted};
use std::collections::BTreeMap;

/// The wrap objects of each body, as the set inside its element.
pub(super) fn wrap_sets(muscles: &OsimMuscles) -> Result<BTreeMap<&str, String>, Error> {
    let mut objects: BTreeMap<&str, String> = BTreeMap::new();
    for object in &muscles.wrap_objects {
        *objects.entry(&object.frame.body).or_default() += &wrap_object(object)?;
    }
    let set = |objects: String| holder(5, "WrapObjectSet", "wrapobjectset", &group(6, "objects", &objects));
    Ok(objects.into_iter().map(|(body, objects)| (body, set(objects))).collect())
}

fn wrap_object(object: &OsimWrapObject) -> Result<String, Error> {
    let number = |tag: &str, value: f64| Ok::<_, Error>(element(8, tag, &numbers(&[value])?));
    let (tag, size) = match &object.shape {
        OsimWrapShape::Cylinder { radius, length } => {
            (CYLINDER, number("radius", *radius)? + &number("length", *length)?)
        }
        OsimWrapShape::Sphere { radius } => (SPHERE, number("radius", *radius)?),
        OsimWrapShape::Other(kind) => {
            return Err(unknown(format!("the {kind} {}", quoted(&object.name)), "cylinders and spheres"));
        }
    };
    let content = element(8, "active", &object.active.to_string())
        + &element(8, "xyz_body_rotation", &numbers(&angles(&object.frame.rotation))?)
        + &element(8, "translation", &numbers(&object.frame.translation_m)?)
        + &element(8, "quadrant", object.quadrant)
        + &size;
    Ok(holder(7, tag, &object.name, &content))
}

/// Path of each coordinate in the document.
type Paths = BTreeMap<String, String>;

/// The elements of muscles and motors in the set of forces.
pub(super) fn forces(muscles: &OsimMuscles, joints: &[OsimJoint]) -> Result<String, Error> {
    let of_joint = |joint: &OsimJoint| {
        let owner = format!("/jointset/{}", joint.name);
        joint.coordinates.iter().map(|c| (c.name.clone(), format!("{owner}/{}", c.name))).collect::<Vec<_>>()
    };
    let paths: Paths = joints.iter().flat_map(of_joint).collect();
    let written = muscles.muscles.iter().map(|m| muscle(m, &paths)).collect::<Result<String, Error>>()?;
    Ok(written + &muscles.actuators.iter().map(actuator).collect::<Result<String, Error>>()?)
}

fn muscle(muscle: &OsimMuscle, paths: &Paths) -> Result<String, Error> {
    let parameters = match &muscle.kind {
        OsimMuscleKind::Known(parameters) => parameters,
        OsimMuscleKind::Other(kind) => {
            let expected = "muscles of the types Thelen2003Muscle and Millard2012EquilibriumMuscle";
            return Err(unknown(format!("the {kind} {}", quoted(&muscle.name)), expected));
        }
    };
    let tag = match parameters.curves {
        OsimMuscleCurves::Thelen2003(_) => THELEN,
        OsimMuscleCurves::Millard2012 { .. } => MILLARD,
    };
    let content =
        element(5, "appliesForce", &muscle.applies_force.to_string()) + &properties(&muscle.name, parameters, paths)?;
    Ok(holder(4, tag, &muscle.name, &content))
}

fn properties(name: &str, muscle: &OsimMuscleParameters, paths: &Paths) -> Result<String, Error> {
    let listed = [
        ("max_isometric_force", muscle.max_isometric_force),
        ("optimal_fiber_length", muscle.optimal_fiber_length),
        ("tendon_slack_length", muscle.tendon_slack_length),
        ("pennation_angle_at_optimal", muscle.pennation_angle_at_optimal),
        ("max_contraction_velocity", muscle.max_contraction_velocity),
        ("maximum_pennation_angle", muscle.maximum_pennation_angle),
    ];
    Ok(controls(muscle.control_range)?
        + &geometry_path(&muscle.path, paths)?
        + &elements(5, &listed)?
        + &element(5, "ignore_tendon_compliance", &muscle.ignore_tendon_compliance.to_string())
        + &curves(name, &muscle.curves)?)
}

/// One element per number.
fn elements(depth: usize, listed: &[(&str, f64)]) -> Result<String, Error> {
    listed.iter().map(|(tag, value)| Ok(element(depth, tag, &numbers(&[*value])?))).collect()
}

fn controls([least, greatest]: [f64; 2]) -> Result<String, Error> {
    let bound = |value: f64| match value {
        f64::NEG_INFINITY => Ok("-Inf".to_owned()),
        f64::INFINITY => Ok("Inf".to_owned()),
        _ => numbers(&[value]),
    };
    Ok(element(5, "min_control", &bound(least)?) + &element(5, "max_control", &bound(greatest)?))
}

fn curves(muscle: &str, curves: &OsimMuscleCurves) -> Result<String, Error> {
    let named = |tag: &str, content: String| holder(5, tag, &format!("{muscle}_{tag}"), &content);
    match curves {
        OsimMuscleCurves::Thelen2003(shape) => elements(5, &paired(&THELEN_SHAPE, shape)),
        OsimMuscleCurves::Millard2012 {
            active_force_length,
            force_velocity,
            fiber_force_length,
            tendon_force_length,
            fiber_damping,
        } => {
            let active = elements(6, &paired(&ACTIVE_FORCE_LENGTH, active_force_length))?;
            let velocity = elements(6, &paired(&FORCE_VELOCITY, force_velocity))?;
            let fiber = elements(6, &paired_where_stated(&FIBER_FORCE_LENGTH, fiber_force_length))?;
            let tendon = elements(6, &paired_where_stated(&TENDON_FORCE_LENGTH, tendon_force_length))?;
            Ok(elements(5, &[("fiber_damping", *fiber_damping)])?
                + &named(ACTIVE_CURVE, active)
                + &named(VELOCITY_CURVE, velocity)
                + &named(FIBER_CURVE, fiber)
                + &named(TENDON_CURVE, tendon))
        }
    }
}

fn paired<'a, const N: usize>(properties: &[(&'a str, f64); N], values: &[f64; N]) -> Vec<(&'a str, f64)> {
    properties.iter().zip(values).map(|((tag, _), value)| (*tag, *value)).collect()
}

fn paired_where_stated<'a, const N: usize>(
    properties: &[(&'a str, Option<f64>); N],
    values: &[Option<f64>; N],
) -> Vec<(&'a str, f64)> {
    properties.iter().zip(values).filter_map(|((tag, _), value)| Some((*tag, (*value)?))).collect()
}

fn geometry_path(path: &OsimPath, paths: &Paths) -> Result<String, Error> {
    let points = path.points.iter().map(|p| point(p, paths)).collect::<Result<String, Error>>()?;
    let wraps: String = path.wraps.iter().enumerate().map(|(i, wrap)| path_wrap(i, wrap)).collect();
    let content = group(6, "PathPointSet", &group(7, "objects", &points))
        + &group(6, "PathWrapSet", &group(7, "objects", &wraps));
    Ok(holder(5, "GeometryPath", "geometrypath", &content))
}

fn path_wrap(index: usize, wrap: &OsimPathWrap) -> String {
    let name = if index == 0 { "pathwrap".to_owned() } else { format!("pathwrap_{index}") };
    let content = element(9, "wrap_object", &wrap.object)
        + &element(9, "method", &wrap.method)
        + &element(9, "range", &format!("{} {}", wrap.range[0], wrap.range[1]));
    holder(8, "PathWrap", &name, &content)
}

fn point(point: &OsimPathPoint, paths: &Paths) -> Result<String, Error> {
    let known = |name: &String| paths.get(name).unwrap_or(name).clone();
    let coordinate_path = |name: &Option<String>| name.as_ref().map(known).unwrap_or_default();
    let (tag, content) = match &point.place {
        OsimPointPlace::Fixed(location) => {
            ("PathPoint", parent(&point.frame)? + &element(9, "location", &numbers(&point.frame.place(*location))?))
        }
        OsimPointPlace::Conditional { location_m, coordinate, range } => {
            let content = parent(&point.frame)?
                + &element(9, "location", &numbers(&point.frame.place(*location_m))?)
                + &element(9, "socket_coordinate", &coordinate_path(coordinate))
                + &element(9, "range", &numbers(range)?);
            ("ConditionalPathPoint", content)
        }
        OsimPointPlace::Moving(axes) => {
            let mut content = moving_parent(point)?;
            for ((coordinate, _), axis) in axes.iter().zip(["x", "y", "z"]) {
                content += &element(9, &format!("socket_{axis}_coordinate"), &coordinate_path(coordinate));
            }
            for ((_, held), axis) in axes.iter().zip(["x", "y", "z"]) {
                content += &group(9, &format!("{axis}_location"), &function(10, "", held)?);
            }
            ("MovingPathPoint", content)
        }
    };
    Ok(holder(8, tag, &point.name, &content))
}

fn parent(frame: &OsimFrame) -> Result<String, Error> {
    Ok(element(9, "socket_parent_frame", &path(&frame.body)))
}

/// The parent of a moving point: its body, or an offset frame of its own.
fn moving_parent(point: &OsimPathPoint) -> Result<String, Error> {
    if point.frame == OsimFrame::of_body(&point.frame.body) {
        return parent(&point.frame);
    }
    let name = format!("{}_frame", point.name);
    Ok(element(9, "socket_parent_frame", &name) + &group(9, "components", &frame(&name, &point.frame)?))
}

fn actuator(actuator: &OsimCoordinateActuator) -> Result<String, Error> {
    let content = controls(actuator.control_range)?
        + &element(5, "coordinate", &actuator.coordinate)
        + &elements(5, &[("optimal_force", actuator.optimal_force)])?;
    Ok(holder(4, ACTUATOR, &actuator.name, &content))
}

/// The element of ground, if surfaces are fixed to it.
pub(super) fn ground(wraps: &BTreeMap<&str, String>) -> String {
    wraps.get("ground").map_or(String::new(), |set| holder(2, "Ground", "ground", set))
}
