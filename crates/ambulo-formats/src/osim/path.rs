//! Paths of muscles: points fixed to bodies, conditional and moving ones, and the surfaces over which a path wraps.

use super::frame::{Frames, socket};
use super::function::{self, OsimFunction};
use super::{OsimFrame, last_part, name_of};
use crate::error::{Error, quoted};
use crate::xml::{self, LineCounter};
use roxmltree::Node;

/// The path of a muscle.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OsimPath {
    /// Points from origin to insertion.
    pub points: Vec<OsimPathPoint>,
    /// Surfaces over which the path may wrap.
    pub wraps: Vec<OsimPathWrap>,
}

/// A point of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimPathPoint {
    /// Name of the point.
    pub name: String,
    /// The frame of its place.
    pub frame: OsimFrame,
    /// Its place in that frame [m].
    pub place: OsimPointPlace,
}

/// Place of a point of a path.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimPointPlace {
    /// A `PathPoint`.
    Fixed([f64; 3]),
    /// A `ConditionalPathPoint`.
    Conditional {
        /// The place [m].
        location_m: [f64; 3],
        /// Name of the coordinate on which it depends; `None` means that the point is never part of the path.
        coordinate: Option<String>,
        /// Range of the coordinate in which the point is part of the path [rad or m].
        range: [f64; 2],
    },
    /// A `MovingPathPoint`: name of the coordinate and function of x, y and z [m].
    Moving(Box<[(Option<String>, OsimFunction); 3]>),
}

/// A surface that a path takes into account.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimPathWrap {
    /// Name of the wrap object.
    pub object: String,
    /// `hybrid`, `midpoint` or `axial`.
    pub method: String,
    /// First and last point of the path between which it may wrap, counted from 1; -1 is the first or the last of all.
    pub range: [i32; 2],
}

/// A surface over which paths wrap.
#[derive(Debug, Clone, PartialEq)]
pub struct OsimWrapObject {
    /// Name of the surface.
    pub name: String,
    /// Line of the element, counted from 1.
    pub line: usize,
    /// Its frame: the body, and axes and origin of the surface there.
    pub frame: OsimFrame,
    /// Its shape.
    pub shape: OsimWrapShape,
    /// `x`, `-x`, `y`, `-y`, `z`, `-z` or `all`.
    pub quadrant: &'static str,
    /// Whether paths wrap over it.
    pub active: bool,
}

/// Shape of a surface over which paths wrap.
#[derive(Debug, Clone, PartialEq)]
pub enum OsimWrapShape {
    /// About the z axis.
    Cylinder {
        /// Radius [m].
        radius: f64,
        /// Length, half of it on each side of the origin [m].
        length: f64,
    },
    /// A sphere.
    Sphere {
        /// Radius [m].
        radius: f64,
    },
    /// Any other shape, by its tag; its measures are not read.
    Other(String),
}

pub(super) const CYLINDER: &str = "WrapCylinder";
pub(super) const SPHERE: &str = "WrapSphere";
/// The functions of a moving point and its sockets, since version 30000.
const MOVING: [(&str, &str, &str); 3] = [
    ("x_location", "XAttachment", "x_coordinate"),
    ("y_location", "YAttachment", "y_coordinate"),
    ("z_location", "ZAttachment", "z_coordinate"),
];

/// The `GeometryPath` of a muscle.
pub(super) fn read(muscle: Node<'_, '_>, frames: &Frames<'_>) -> Result<OsimPath, Error> {
    let path = xml::child(muscle, "GeometryPath")
        .or_else(|| xml::child(muscle, "path").and_then(|held| xml::child(held, "GeometryPath")))
        .ok_or_else(|| xml::error_at(muscle, "no <GeometryPath>".into(), "the path of the muscle"))?;
    let listed = |set: &str| xml::child(path, set).and_then(|s| xml::child(s, "objects"));
    let points = listed("PathPointSet").into_iter().flat_map(|o| xml::elements(o));
    let wraps = listed("PathWrapSet").into_iter().flat_map(|o| xml::elements(o));
    let points: Vec<OsimPathPoint> = points.map(|point| read_point(point, frames)).collect::<Result<_, _>>()?;
    if points.len() < 2 {
        let found = format!("{} points in the path", points.len());
        return Err(xml::error_at(muscle, found, "at least two, the origin and the insertion"));
    }
    Ok(OsimPath { points, wraps: wraps.map(read_path_wrap).collect::<Result<_, _>>()? })
}

fn read_point(node: Node<'_, '_>, frames: &Frames<'_>) -> Result<OsimPathPoint, Error> {
    let frame = match xml::text(node, "body") {
        Some(body) => frames.resolve(node, body)?,
        None => frames.of_socket(node, "parent_frame")?,
    };
    let location = || {
        let found = || xml::error_at(node, "no <location>".into(), "the place of the point: x y z in metres");
        xml::triple(node, "location")?.ok_or_else(found)
    };
    let place = match node.tag_name().name() {
        "PathPoint" => OsimPointPlace::Fixed(location()?),
        "ConditionalPathPoint" => OsimPointPlace::Conditional {
            location_m: location()?,
            coordinate: coordinate(node, "coordinate").or_else(|| coordinate(node, "coordinates")),
            range: range(node)?,
        },
        "MovingPathPoint" => OsimPointPlace::Moving(Box::new(moving(node)?)),
        other => {
            let expected = "PathPoint, ConditionalPathPoint or MovingPathPoint";
            return Err(xml::error_at(node, format!("the point type {}", quoted(other)), expected));
        }
    };
    Ok(OsimPathPoint { name: name_of(node).to_owned(), frame, place })
}

/// The name of a coordinate, stated as a name (to 30500) or as the path of a socket.
fn coordinate(node: Node<'_, '_>, tag: &str) -> Option<String> {
    xml::text(node, tag).or_else(|| socket(node, tag)).map(|path| last_part(path).to_owned())
}

fn range(node: Node<'_, '_>) -> Result<[f64; 2], Error> {
    let values = xml::numbers(node, "range")?.unwrap_or_else(|| vec![0.0; 2]);
    match values[..] {
        [least, greatest] => Ok([least, greatest]),
        _ => Err(xml::error_at(node, format!("{} numbers in <range>", values.len()), "two: least and greatest value")),
    }
}

fn moving(node: Node<'_, '_>) -> Result<[(Option<String>, OsimFunction); 3], Error> {
    let mut axes = [const { (None, OsimFunction::Constant(0.0)) }; 3];
    for (axis, (tag, older, of)) in axes.iter_mut().zip(MOVING) {
        if let Some(holder) = xml::child(node, tag).or_else(|| xml::child(node, older)) {
            let missing = || xml::error_at(node, format!("no function in <{tag}>"), "a function of a coordinate");
            axis.1 = function::held_by(holder)?.ok_or_else(missing)?;
        }
        axis.0 = coordinate(node, of);
    }
    Ok(axes)
}

fn read_path_wrap(node: Node<'_, '_>) -> Result<OsimPathWrap, Error> {
    let object = xml::text(node, "wrap_object").or_else(|| socket(node, "wrap_object"));
    let missing = || xml::error_at(node, "no <wrap_object>".into(), "the name of a wrap object of the model");
    let method = xml::text(node, "method").unwrap_or("hybrid").to_lowercase();
    if !matches!(method.as_str(), "hybrid" | "midpoint" | "axial") {
        return Err(xml::error_at(node, quoted(&method), "the method hybrid, midpoint or axial"));
    }
    let words: Vec<&str> = xml::text(node, "range").unwrap_or("-1 -1").split_whitespace().collect();
    let range = match words[..] {
        [first, last] => first.parse().ok().zip(last.parse().ok()),
        _ => None,
    };
    let Some((first, last)) = range else {
        return Err(xml::error_at(node, quoted(&words.join(" ")), "a <range> of two whole numbers, such as -1 -1"));
    };
    Ok(OsimPathWrap { object: last_part(object.ok_or_else(missing)?).to_owned(), method, range: [first, last] })
}

/// All wrap objects of a model, in the order of the document.
pub(super) fn wrap_objects(
    model: Node<'_, '_>,
    frames: &Frames<'_>,
    lines: &mut LineCounter<'_>,
) -> Result<Vec<OsimWrapObject>, Error> {
    model.descendants().filter(|node| is_wrap_object(*node)).map(|node| read_wrap_object(node, frames, lines)).collect()
}

pub(super) fn is_wrap_object(node: Node<'_, '_>) -> bool {
    matches!(node.tag_name().name(), CYLINDER | SPHERE | "WrapEllipsoid" | "WrapTorus")
}

fn read_wrap_object(
    node: Node<'_, '_>,
    frames: &Frames<'_>,
    lines: &mut LineCounter<'_>,
) -> Result<OsimWrapObject, Error> {
    let shape = match node.tag_name().name() {
        CYLINDER => OsimWrapShape::Cylinder { radius: size(node, "radius", 1.0)?, length: size(node, "length", 1.0)? },
        SPHERE => OsimWrapShape::Sphere { radius: size(node, "radius", 0.05)? },
        other => OsimWrapShape::Other(other.to_owned()),
    };
    let owner = frames.of_component(node)?;
    let translation = xml::triple(node, "translation")?.unwrap_or_default();
    let rotation = xml::triple(node, "xyz_body_rotation")?.unwrap_or_default();
    Ok(OsimWrapObject {
        name: name_of(node).to_owned(),
        line: lines.line_of(node),
        frame: owner.with_offset(translation, rotation),
        shape,
        quadrant: quadrant(node)?,
        active: xml::boolean(node, "active")?.unwrap_or(true),
    })
}

fn size(node: Node<'_, '_>, tag: &str, default: f64) -> Result<f64, Error> {
    let value = xml::number(node, tag)?.unwrap_or(default);
    if value < 0.0 {
        return Err(xml::error_at(node, format!("{value} in <{tag}>"), "a length of zero or more, in metres"));
    }
    Ok(value)
}

fn quadrant(node: Node<'_, '_>) -> Result<&'static str, Error> {
    let stated = xml::text(node, "quadrant").unwrap_or("all");
    let lower = stated.to_lowercase();
    let known = ["x", "-x", "y", "-y", "z", "-z", "all"];
    let wanted = match lower.strip_prefix('+').unwrap_or(&lower) {
        "unassigned" => "all",
        other => other,
    };
    known.into_iter().find(|name| *name == wanted).ok_or_else(|| {
        let found = format!("the quadrant {}", quoted(stated));
        xml::error_at(node, found, "x, -x, y, -y, z, -z or all")
    })
}
