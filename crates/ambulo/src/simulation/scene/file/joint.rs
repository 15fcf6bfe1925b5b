//! Joints of scene files. They connect a body to another one or to the world, and must form trees.

use super::body::BodyEntry;
use super::coordinate::{CoordinateEntry, CoordinateMotion};
use super::names::{Attachment, Item, Names};
use crate::simulation::scene::SceneError;
use crate::spatial::Vec3;
use crate::toml_reader::Table;

/// A joint of a scene file between a child and its parent. The joints form trees; closures close loops.
#[derive(Debug, Clone)]
pub struct JointEntry {
    /// Name, unique among joints and closures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// The motions that it leaves free, with their axes.
    pub kind: JointAxes,
    /// The parent.
    pub parent: Attachment,
    /// The child: index in [`SceneFile::bodies`](super::SceneFile::bodies). No body is the child of two joints.
    pub child: usize,
    /// The joint's centre at the start, in the world [m].
    pub at: Vec3,
    /// One per free motion, in the order of [`JointAxes::coordinates`].
    pub coordinates: Vec<CoordinateEntry>,
}

/// The motions that a joint or closure leaves free, with their axes. Directions are unit vectors of the world at the start (for a
/// closure that is not active then: at the moment it becomes active).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointAxes {
    /// None.
    Weld,
    /// A rotation about an axis of both bodies.
    Revolute {
        /// The axis.
        axis: Vec3,
    },
    /// A rotation about an axis of the parent, then about an axis of the child.
    Universal {
        /// Fixed in the parent.
        axis: Vec3,
        /// Fixed in the child, at right angles to `axis`.
        second_axis: Vec3,
    },
    /// All rotations: the rotation vector in axes of the parent that are the world's at the start.
    Ball,
    /// A translation along an axis of both bodies.
    Prismatic {
        /// The axis.
        axis: Vec3,
    },
    /// A rotation about the normal, then translations along `along` and `normal` × `along`.
    Planar {
        /// Perpendicular to the plane, fixed in the parent.
        normal: Vec3,
        /// In the plane, fixed in the parent.
        along: Vec3,
    },
    /// All motions: rotations as of a ball, then translations along the same axes.
    Free,
}

/// The kinds of joint in scene files.
#[derive(Clone, Copy)]
enum KindWord {
    Weld,
    Revolute,
    Universal,
    Ball,
    Prismatic,
    Planar,
    Free,
}

const KIND_WORDS: [(&str, KindWord); 7] = [
    ("weld", KindWord::Weld),
    ("revolute", KindWord::Revolute),
    ("universal", KindWord::Universal),
    ("ball", KindWord::Ball),
    ("prismatic", KindWord::Prismatic),
    ("planar", KindWord::Planar),
    ("free", KindWord::Free),
];
const KEYS: &[&str] = &["name", "kind", "parent", "child", "at", "coordinate"];
/// Largest cosine of the angle between perpendicular directions.
const SQUARE_SLACK: f64 = 1e-6;

impl JointEntry {
    /// All joints, which must form trees.
    pub(super) fn read_all(
        root: &Table<'_>,
        links: &mut Names,
        things: &Names,
        bodies: &[BodyEntry],
        duration_s: f64,
    ) -> Result<Vec<JointEntry>, SceneError> {
        let tables = root.tables("joint")?;
        let mut joints = Vec::new();
        for (i, table) in tables.iter().enumerate() {
            let name = links.declare(table, Item::Joint(i))?;
            joints.push(JointEntry::read(table, name, things, bodies, duration_s)?);
        }
        refuse_no_tree(&joints, &tables, bodies)?;
        Ok(joints)
    }

    fn read(
        table: &Table<'_>,
        name: String,
        names: &Names,
        bodies: &[BodyEntry],
        duration_s: f64,
    ) -> Result<JointEntry, SceneError> {
        let kind = JointAxes::read(table, KEYS)?;
        let parent = names.attachment(&table.need("parent", "\"world\" or a body")?)?;
        let child = names.body(&table.need("child", "the child body of the joint")?)?;
        let at = match (table.get("at"), kind) {
            (Some(value), _) => value.vector()?,
            (None, JointAxes::Revolute { .. } | JointAxes::Universal { .. } | JointAxes::Ball) => {
                return Err(table.missing("at", "the joint's centre in the world at the start [m]"));
            }
            (None, _) => bodies[child].start.translation,
        };
        let coordinates = CoordinateEntry::read_all(table, kind.coordinates(), &bodies[child], duration_s)?;
        Ok(JointEntry { name, line: table.line, kind, parent, child, at, coordinates })
    }
}

impl JointAxes {
    /// The free motions, in order.
    #[must_use]
    pub fn coordinates(&self) -> &'static [CoordinateMotion] {
        use CoordinateMotion::{Rotation, Translation};
        match self {
            JointAxes::Weld => &[],
            JointAxes::Revolute { .. } => &[Rotation],
            JointAxes::Universal { .. } => &[Rotation; 2],
            JointAxes::Ball => &[Rotation; 3],
            JointAxes::Prismatic { .. } => &[Translation],
            JointAxes::Planar { .. } => &[Rotation, Translation, Translation],
            JointAxes::Free => &[Rotation, Rotation, Rotation, Translation, Translation, Translation],
        }
    }

    /// Reads the `kind` of a table and the axes of that kind; refuses keys other than `keys` and the axes.
    pub(super) fn read(table: &Table<'_>, keys: &[&str]) -> Result<JointAxes, SceneError> {
        let words = KIND_WORDS.map(|(text, _)| text).join(", ");
        let word = table.need("kind", &format!("the kind of joint: {words}"))?.choice(&KIND_WORDS)?;
        let axes: &[&str] = match word {
            KindWord::Revolute | KindWord::Prismatic => &["axis"],
            KindWord::Universal | KindWord::Planar => &["axis", "second_axis"],
            KindWord::Weld | KindWord::Ball | KindWord::Free => &[],
        };
        table.only(&[keys, axes])?;
        let axis = || table.need("axis", "a direction of the world at the start")?.direction();
        Ok(match word {
            KindWord::Weld => JointAxes::Weld,
            KindWord::Revolute => JointAxes::Revolute { axis: axis()? },
            KindWord::Universal => {
                let axis = axis()?;
                let second = table.need("second_axis", "a direction at right angles to `axis`")?;
                JointAxes::Universal {
                    axis,
                    second_axis: square(second.direction()?, axis)
                        .ok_or_else(|| second.wrong("a direction at right angles to `axis`"))?,
                }
            }
            KindWord::Ball => JointAxes::Ball,
            KindWord::Prismatic => JointAxes::Prismatic { axis: axis()? },
            KindWord::Planar => {
                let normal = axis()?;
                JointAxes::Planar { normal, along: along(table, normal)? }
            }
            KindWord::Free => JointAxes::Free,
        })
    }
}

/// The direction made exactly perpendicular to another; `None` if it is not perpendicular except for rounding.
fn square(direction: Vec3, to: Vec3) -> Option<Vec3> {
    let cosine = direction.dot(&to);
    (cosine.abs() <= SQUARE_SLACK).then(|| (direction - to * cosine).normalize())
}

/// The first direction of translation: `second_axis`, or world x projected onto the plane (world y if x is nearly the normal).
fn along(table: &Table<'_>, normal: Vec3) -> Result<Vec3, SceneError> {
    const NEARLY: f64 = 0.99;
    if let Some(value) = table.get("second_axis") {
        return square(value.direction()?, normal).ok_or_else(|| value.wrong("a direction at right angles to `axis`"));
    }
    let first = if normal.x.abs() < NEARLY { Vec3::x() } else { Vec3::y() };
    Ok((first - normal * first.dot(&normal)).normalize())
}

const ADVICE: &str = "close the loop with a [[closure]]";

/// Refuses joints that do not form trees; `tables` are the tables of the joints.
fn refuse_no_tree(joints: &[JointEntry], tables: &[Table<'_>], bodies: &[BodyEntry]) -> Result<(), SceneError> {
    let mut joint_of: Vec<Option<usize>> = vec![None; bodies.len()];
    for (i, (joint, table)) in joints.iter().zip(tables).enumerate() {
        if let Some(earlier) = joint_of[joint.child].map(|j| &joints[j]) {
            let expected = format!(
                "a body that is the child of one joint only; \"{}\" (line {}) has it already",
                earlier.name, earlier.line
            );
            return Err(table.need("child", "a body")?.wrong(&expected).hint(ADVICE));
        }
        joint_of[joint.child] = Some(i);
    }
    let parent = |joint: usize| match joints[joint].parent {
        Attachment::Body(body) => joint_of[body],
        Attachment::World | Attachment::FigureBody { .. } => None,
    };
    let Some(circle) = circle(joints.len(), parent) else { return Ok(()) };
    let mut names: Vec<&str> = circle.iter().map(|joint| bodies[joints[*joint].child].name.as_str()).collect();
    names.push(names[0]);
    let first = &tables[circle[0]];
    let expected = format!("parents that do not form a circle; these do: {}", shortened(&names));
    Err(first.need("parent", "a body")?.wrong(&expected).hint(ADVICE))
}

/// The first joint in a circle, followed by its parents; `None` if there is no circle.
fn circle(count: usize, parent: impl Fn(usize) -> Option<usize>) -> Option<Vec<usize>> {
    // The first walk that visited each joint; a walk that meets itself has found a circle.
    let mut walk: Vec<Option<usize>> = vec![None; count];
    for start in 0..count {
        let mut at = Some(start);
        while let Some(joint) = at {
            match walk[joint] {
                None => walk[joint] = Some(start),
                Some(earlier) if earlier == start => return Some(around(joint, parent)),
                Some(_) => break,
            }
            at = parent(joint);
        }
    }
    None
}

/// The joints of the circle through a joint.
fn around(joint: usize, parent: impl Fn(usize) -> Option<usize>) -> Vec<usize> {
    let mut circle = vec![joint];
    while let Some(next) = parent(circle[circle.len() - 1]).filter(|next| *next != joint) {
        circle.push(next);
    }
    // Begin with the joint that is first in the file.
    let first = circle.iter().enumerate().min_by_key(|(_, joint)| **joint).map_or(0, |(i, _)| i);
    circle.rotate_left(first);
    circle
}

/// Names joined by arrows; the middle of a long list is left out.
fn shortened(names: &[&str]) -> String {
    const SHOWN: usize = 6;
    if names.len() <= SHOWN {
        return names.join(" -> ");
    }
    format!("{} -> … -> {}", names[..SHOWN - 1].join(" -> "), names[names.len() - 1])
}
