//! The free motions of joints and closures in a scene file.

use super::SceneError;
use crate::spatial::Vec3;
use crate::toml_reader::Table;

/// Whether a coordinate is a rotation or a translation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MotionKind {
    /// An angle [rad].
    Rotation,
    /// A length [m].
    Translation,
}

/// The free motions of a joint or closure. Directions are unit vectors in the world at the start (for a closure that is
/// added later: when it becomes active).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointAxes {
    /// No free motion.
    Weld,
    /// A rotation about an axis fixed in both bodies.
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
    /// All rotations: the rotation vector in axes of the parent that are the world's axes at the start.
    Ball,
    /// A translation along an axis fixed in both bodies.
    Prismatic {
        /// The axis.
        axis: Vec3,
    },
    /// A rotation about the normal, then translations along `along` and `normal` × `along`.
    Planar {
        /// At right angles to the plane, fixed in the parent.
        normal: Vec3,
        /// Direction in the plane, fixed in the parent.
        along: Vec3,
    },
    /// All motions: rotations as for a ball joint, then translations along x, y, z of the parent, which are the world's
    /// axes at the start.
    Free,
}

/// The kinds of joint, by their name in the file.
#[derive(Clone, Copy)]
enum Word {
    Weld,
    Revolute,
    Universal,
    Ball,
    Prismatic,
    Planar,
    Free,
}

const WORDS: [(&str, Word); 7] = [
    ("weld", Word::Weld),
    ("revolute", Word::Revolute),
    ("universal", Word::Universal),
    ("ball", Word::Ball),
    ("prismatic", Word::Prismatic),
    ("planar", Word::Planar),
    ("free", Word::Free),
];
/// Cosine of the angle between directions that should be at right angles.
const SQUARE_SLACK: f64 = 1e-6;

impl JointAxes {
    /// The kinds of the free motions, in order.
    #[must_use]
    pub fn coordinates(&self) -> &'static [MotionKind] {
        use MotionKind::{Rotation, Translation};
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

    /// Reads `kind` and its axes; rejects other keys except `keys`.
    pub(super) fn read(table: &Table<'_>, keys: &[&str]) -> Result<JointAxes, SceneError> {
        let words = WORDS.map(|(text, _)| text).join(", ");
        let word = table.need("kind", &format!("the kind of joint: {words}"))?.choice(&WORDS)?;
        let axes: &[&str] = match word {
            Word::Revolute | Word::Prismatic => &["axis"],
            Word::Universal | Word::Planar => &["axis", "second_axis"],
            Word::Weld | Word::Ball | Word::Free => &[],
        };
        table.only(&[keys, axes])?;
        let axis = || table.need("axis", "a direction of the world at the start")?.direction();
        Ok(match word {
            Word::Weld => JointAxes::Weld,
            Word::Revolute => JointAxes::Revolute { axis: axis()? },
            Word::Universal => {
                let axis = axis()?;
                let second = table.need("second_axis", "a direction at right angles to `axis`")?;
                JointAxes::Universal {
                    axis,
                    second_axis: square(second.direction()?, axis)
                        .ok_or_else(|| second.wrong("a direction at right angles to `axis`"))?,
                }
            }
            Word::Ball => JointAxes::Ball,
            Word::Prismatic => JointAxes::Prismatic { axis: axis()? },
            Word::Planar => {
                let normal = axis()?;
                JointAxes::Planar { normal, along: along(table, normal)? }
            }
            Word::Free => JointAxes::Free,
        })
    }
}

/// The direction, made exactly perpendicular to the other; `None` if it is not perpendicular to rounding.
fn square(direction: Vec3, to: Vec3) -> Option<Vec3> {
    let cosine = direction.dot(&to);
    (cosine.abs() <= SQUARE_SLACK).then(|| (direction - to * cosine).normalize())
}

/// The first translation axis: `second_axis`, or world x projected onto the plane, or world y if x is nearly the
/// normal.
fn along(table: &Table<'_>, normal: Vec3) -> Result<Vec3, SceneError> {
    const NEARLY: f64 = 0.99;
    if let Some(value) = table.get("second_axis") {
        return square(value.direction()?, normal).ok_or_else(|| value.wrong("a direction at right angles to `axis`"));
    }
    let first = if normal.x.abs() < NEARLY { Vec3::x() } else { Vec3::y() };
    Ok((first - normal * first.dot(&normal)).normalize())
}
