//! Joints and their coordinates, in both layouts of the format.

use super::frame::Frames;
use super::function::{self, OsimFunction};
use super::{OsimFrame, name_of};
use crate::error::{Error, quoted};
use crate::xml;
use roxmltree::Node;

/// A joint: the motion of a frame on the child in a frame on the parent.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimJoint {
    /// Name of the joint.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Kind of motion.
    pub kind: OsimJointKind,
    /// Frame on the parent body.
    pub parent: OsimFrame,
    /// Frame on the child body.
    pub child: OsimFrame,
    /// Coordinates in document order.
    pub coordinates: Vec<OsimCoordinate>,
}

/// Kind of motion of a joint, and the order of its coordinates.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimJointKind {
    /// No motion.
    Weld,
    /// One rotation about z.
    Pin,
    /// One translation along x.
    Slider,
    /// Rotation about x, then the new y.
    Universal,
    /// Any rotation; coordinates are body-fixed X-Y-Z angles, speeds the angular velocity in the parent frame.
    Ball,
    /// Body-fixed X-Y-Z rotations.
    Gimbal,
    /// Rotation about z, translations along x and y.
    Planar,
    /// Rotations as a ball, translations along x, y, z.
    Free,
    /// Rotations as a ball, the origin sliding on an ellipsoid.
    Ellipsoid {
        /// Half axes along x, y, z [m].
        radii_m: [f64; 3],
    },
    /// The shoulder blade on the thorax: an ellipsoid whose first two coordinates move the blade along x and y of the
    /// frame on the parent, turned by 90 degrees; then a rotation about an axis in the plane of the blade (winging).
    Scapulothoracic {
        /// Half axes of the thorax along x, y, z of the frame on the parent [m].
        radii_m: [f64; 3],
        /// Origin of the winging axis in the x-y plane of the frame on the child [m].
        winging_origin_m: [f64; 2],
        /// Angle of the winging axis from y of that frame about z [rad].
        winging_direction_rad: f64,
    },
    /// Body-fixed X-Z-Y rotations, the origin at the end of an arc that leaves the parent along y and ends along y of
    /// the child.
    ConstantCurvature {
        /// Angles about x, z and y where the coordinates are zero [rad].
        neutral_angle_rad: [f64; 3],
        /// Length of the arc [m].
        length_m: f64,
    },
    /// Three body-fixed rotations and three translations, each a function of a coordinate.
    Custom(Box<[OsimAxis; 6]>),
}

/// One axis of a `SpatialTransform`.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimAxis {
    /// Direction, as stated (not always of unit length).
    pub axis: [f64; 3],
    /// Name of the coordinate; `None` for a constant.
    pub coordinate: Option<String>,
    /// Angle [rad] or distance [m] as a function of the coordinate.
    pub function: OsimFunction,
}

/// A coordinate of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimCoordinate {
    /// Name of the coordinate.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Default value [rad or m].
    pub default_value: f64,
    /// Allowed range as stated [rad or m].
    pub range: Option<[f64; 2]>,
    /// Whether motion must stay inside the range; otherwise the range is only advice.
    pub clamped: bool,
    /// Held at its default value.
    pub locked: bool,
    /// Prescribed function of time [s], if it is switched on.
    pub prescribed: Option<OsimFunction>,
}

const KNOWN: &str = "WeldJoint, PinJoint, SliderJoint, BallJoint, UniversalJoint, GimbalJoint, PlanarJoint, \
                     EllipsoidJoint, ScapulothoracicJoint, ConstantCurvatureJoint, FreeJoint or \
                     CustomJoint";

/// A joint of the layout to 30500: inside its child body, frames by location and orientation.
pub(super) fn read_nested(node: Node<'_, '_>, child: &str) -> Result<OsimJoint, Error> {
    let parent = xml::text(node, "parent_body")
        .ok_or_else(|| xml::error_at(node, "no <parent_body>".into(), "the name of the parent body or `ground`"))?;
    let offset = |body: &str, place: &str, turn: &str| -> Result<OsimFrame, Error> {
        let place = xml::triple(node, place)?.unwrap_or_default();
        Ok(OsimFrame::offset(body, place, xml::triple(node, turn)?.unwrap_or_default()))
    };
    let parent = offset(parent, "location_in_parent", "orientation_in_parent")?;
    let child = offset(child, "location", "orientation")?;
    read(node, parent, child)
}

/// A joint of the layout since 30505: in the `JointSet`, frames by name.
pub(super) fn read_framed(node: Node<'_, '_>, frames: &Frames<'_>) -> Result<OsimJoint, Error> {
    let parent = match xml::text(node, "parent_body") {
        Some(body) => {
            let place = xml::triple(node, "location_in_parent")?.unwrap_or_default();
            OsimFrame::offset(body, place, xml::triple(node, "orientation_in_parent")?.unwrap_or_default())
        }
        None => frames.of_socket(node, "parent_frame")?,
    };
    read(node, parent, frames.of_socket(node, "child_frame")?)
}

fn read(node: Node<'_, '_>, parent: OsimFrame, child: OsimFrame) -> Result<OsimJoint, Error> {
    if xml::boolean(node, "reverse")? == Some(true) {
        return Err(xml::error_at(node, "<reverse>true</reverse>".into(), "joints that run from parent to child"));
    }
    let kind = read_kind(node)?;
    let coordinates = coordinate_nodes(node).into_iter().map(read_coordinate).collect::<Result<Vec<_>, _>>()?;
    let joint =
        OsimJoint { name: name_of(node).to_owned(), line: xml::line_of(node), kind, parent, child, coordinates };
    check_coordinates(node, &joint)?;
    Ok(joint)
}

fn read_kind(node: Node<'_, '_>) -> Result<OsimJointKind, Error> {
    Ok(match node.tag_name().name() {
        "WeldJoint" => OsimJointKind::Weld,
        "PinJoint" => OsimJointKind::Pin,
        "SliderJoint" => OsimJointKind::Slider,
        "UniversalJoint" => OsimJointKind::Universal,
        "BallJoint" => OsimJointKind::Ball,
        "GimbalJoint" => OsimJointKind::Gimbal,
        "PlanarJoint" => OsimJointKind::Planar,
        "FreeJoint" => OsimJointKind::Free,
        "EllipsoidJoint" => {
            let radii = xml::triple(node, "radii_x_y_z")?;
            let radii_m =
                radii.ok_or_else(|| xml::error_at(node, "no <radii_x_y_z>".into(), "three radii in metres"))?;
            OsimJointKind::Ellipsoid { radii_m }
        }
        "ScapulothoracicJoint" => read_scapulothoracic(node)?,
        "ConstantCurvatureJoint" => OsimJointKind::ConstantCurvature {
            neutral_angle_rad: xml::triple(node, "neutral_angle_x_z_y")?.unwrap_or_default(),
            length_m: xml::number(node, "length")?.unwrap_or(1.0),
        },
        "CustomJoint" => OsimJointKind::Custom(Box::new(read_axes(node)?)),
        other => return Err(xml::error_at(node, format!("the joint type `{other}`"), KNOWN)),
    })
}

fn read_scapulothoracic(node: Node<'_, '_>) -> Result<OsimJointKind, Error> {
    let radii = xml::triple(node, "thoracic_ellipsoid_radii_x_y_z")?;
    let expected = "three radii of the thorax in metres";
    let radii_m = radii.ok_or_else(|| xml::error_at(node, "no <thoracic_ellipsoid_radii_x_y_z>".into(), expected))?;
    let origin = xml::numbers(node, "scapula_winging_axis_origin")?.unwrap_or_else(|| vec![0.0; 2]);
    let found = format!("{} numbers in <scapula_winging_axis_origin>", origin.len());
    let winging_origin_m = origin.try_into().map_err(|_| xml::error_at(node, found, "two numbers in metres"))?;
    let winging_direction_rad = xml::number(node, "scapula_winging_axis_direction")?.unwrap_or(0.0);
    Ok(OsimJointKind::Scapulothoracic { radii_m, winging_origin_m, winging_direction_rad })
}

fn read_axes(joint: Node<'_, '_>) -> Result<[OsimAxis; 6], Error> {
    let expected = "a <SpatialTransform> with six <TransformAxis>: three rotations, then three translations";
    let transform =
        xml::child(joint, "SpatialTransform").ok_or_else(|| xml::error_at(joint, "none".into(), expected))?;
    let axes = xml::elements(transform)
        .filter(|n| n.has_tag_name("TransformAxis"))
        .map(read_axis)
        .collect::<Result<Vec<_>, _>>()?;
    let found = format!("{} axes", axes.len());
    axes.try_into().map_err(|_| xml::error_at(transform, found, expected))
}

fn read_axis(node: Node<'_, '_>) -> Result<OsimAxis, Error> {
    let axis =
        xml::triple(node, "axis")?.ok_or_else(|| xml::error_at(node, "no <axis>".into(), "a direction x y z"))?;
    if axis.iter().all(|a| a.abs() < f64::MIN_POSITIVE) {
        return Err(xml::error_at(node, "the axis 0 0 0".into(), "a direction of non-zero length"));
    }
    let mut names = xml::text(node, "coordinates").unwrap_or_default().split_whitespace();
    let coordinate = names.next().map(str::to_owned);
    if let (Some(first), Some(second)) = (&coordinate, names.next()) {
        return Err(of_two_coordinates(node, first, second));
    }
    let function = match (function::held_by(node)?, &coordinate) {
        (Some(function), _) => function,
        // An axis without a function is constant; one with a coordinate follows it.
        (None, None) => OsimFunction::Constant(0.0),
        (None, Some(_)) => OsimFunction::Linear { slope: 1.0, intercept: 0.0 },
    };
    if coordinate.is_none() && !is_constant(&function) {
        return Err(xml::error_at(node, "a function without a coordinate".into(), "a name in <coordinates>"));
    }
    Ok(OsimAxis { axis, coordinate, function })
}

/// The error of an axis that follows several coordinates.
fn of_two_coordinates(axis: Node<'_, '_>, first: &str, second: &str) -> Error {
    let joint =
        axis.ancestors().find(|node| node.tag_name().name().ends_with("Joint")).map_or("", |node| name_of(node));
    let function = function::tag_held_by(axis).unwrap_or("no function");
    let found = format!(
        "the axis {} of the joint {} with {function} of several coordinates, {}, {}",
        quoted(name_of(axis)),
        quoted(joint),
        quoted(first),
        quoted(second)
    );
    let expected = "a function of one coordinate. hint: keep the coordinate that moves the axis most, and write the \
        function at the usual \
                    value of the others, as a SimmSpline or PolynomialFunction";
    xml::error_at(axis, found, expected)
}

fn is_constant(function: &OsimFunction) -> bool {
    match function {
        OsimFunction::Constant(_) => true,
        OsimFunction::Multiplier { function, .. } => is_constant(function),
        _ => false,
    }
}

fn coordinate_nodes<'a, 'i>(joint: Node<'a, 'i>) -> Vec<Node<'a, 'i>> {
    let list = xml::child(joint, "coordinates")
        .or_else(|| xml::child(joint, "CoordinateSet").and_then(|set| xml::child(set, "objects")));
    list.into_iter().flat_map(|l| xml::elements(l)).filter(|n| n.has_tag_name("Coordinate")).collect()
}

fn read_coordinate(node: Node<'_, '_>) -> Result<OsimCoordinate, Error> {
    let range = match xml::numbers(node, "range")?.unwrap_or_default()[..] {
        [] => None,
        [low, high] => Some([low, high]),
        ref other => return Err(xml::error_at(node, format!("a range of {} numbers", other.len()), "two numbers")),
    };
    let prescribed = match xml::boolean(node, "prescribed")? {
        Some(true) => xml::child(node, "prescribed_function").map(function::held_by).transpose()?.flatten(),
        _ => None,
    };
    Ok(OsimCoordinate {
        name: name_of(node).to_owned(),
        line: xml::line_of(node),
        default_value: xml::number(node, "default_value")?.unwrap_or(0.0),
        range,
        clamped: xml::boolean(node, "clamped")?.unwrap_or(false),
        locked: xml::boolean(node, "locked")?.unwrap_or(false),
        prescribed,
    })
}

/// Checks that a joint has the coordinates of its kind, and that its axes use only these.
fn check_coordinates(node: Node<'_, '_>, joint: &OsimJoint) -> Result<(), Error> {
    let expected = match &joint.kind {
        OsimJointKind::Weld => 0,
        OsimJointKind::Pin | OsimJointKind::Slider => 1,
        OsimJointKind::Universal => 2,
        OsimJointKind::Ball
        | OsimJointKind::Gimbal
        | OsimJointKind::Planar
        | OsimJointKind::Ellipsoid { .. }
        | OsimJointKind::ConstantCurvature { .. } => 3,
        OsimJointKind::Scapulothoracic { .. } => 4,
        OsimJointKind::Free => 6,
        OsimJointKind::Custom(axes) => {
            let known = |name: &String| joint.coordinates.iter().any(|c| c.name == *name);
            return match axes.iter().filter_map(|a| a.coordinate.as_ref()).find(|name| !known(name)) {
                Some(name) => Err(xml::error_at(
                    node,
                    format!("an axis that follows {}", quoted(name)),
                    "the name of one of this joint's coordinates",
                )),
                None => Ok(()),
            };
        }
    };
    if joint.coordinates.len() == expected {
        return Ok(());
    }
    Err(xml::error_at(node, format!("{} coordinates", joint.coordinates.len()), format!("{expected} coordinates")))
}
