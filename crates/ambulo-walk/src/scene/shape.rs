//! Contact shapes in a scene file.

use super::SceneError;
use super::material::{self, MaterialEntry};
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::Table;

/// A shape of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapeEntry {
    /// Line of its header.
    pub line: usize,
    /// The solid in its own frame.
    pub solid: Solid,
    /// `body_from_shape`; the body's frame has its origin at the mass centre.
    pub pose: Pose,
    /// Index in [`SceneFile::materials`](super::SceneFile::materials).
    pub material: usize,
}

/// A solid in its own frame [m].
#[derive(Debug, Clone, PartialEq)]
pub enum Solid {
    /// A sphere about the origin.
    Sphere {
        /// Radius, above zero.
        radius: f64,
    },
    /// All points within `radius` of the segment between two different points.
    Capsule {
        /// One end of the segment.
        from: Vec3,
        /// The other end.
        to: Vec3,
        /// Radius, above zero.
        radius: f64,
    },
    /// A box about the origin, along the axes.
    Box {
        /// Edge lengths, above zero.
        size: Vec3,
    },
    /// The convex hull of at least four points that are not in one plane.
    Convex {
        /// The points.
        points: Vec<Vec3>,
    },
}

/// The kinds of solid, by their name in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Word {
    Sphere,
    Capsule,
    Box,
    Convex,
}

/// The names of solids in a scene file.
pub(super) const WORDS: [(&str, Word); 4] =
    [("sphere", Word::Sphere), ("capsule", Word::Capsule), ("box", Word::Box), ("convex", Word::Convex)];

/// Points lie in one plane if the solid around them is thinner than this share of its length.
const THINNEST: f64 = 1e-6;

impl ShapeEntry {
    /// Reads the shapes of a body.
    pub(super) fn read_all(body: &Table<'_>, materials: &[MaterialEntry]) -> Result<Vec<ShapeEntry>, SceneError> {
        body.tables("shape")?.iter().map(|table| ShapeEntry::read(table, materials)).collect()
    }

    fn read(table: &Table<'_>, materials: &[MaterialEntry]) -> Result<ShapeEntry, SceneError> {
        let word = table.need("kind", "the kind of shape: sphere, capsule, box or convex")?.choice(&WORDS)?;
        table.only(&[&["kind", "material"], word.keys(), word.place()])?;
        Ok(ShapeEntry {
            line: table.line,
            solid: Solid::read(word, table)?,
            pose: table.pose("at")?,
            material: material::of_shape(table, materials)?,
        })
    }
}

impl Word {
    /// Keys of the solid's own frame.
    pub(super) fn keys(self) -> &'static [&'static str] {
        match self {
            Word::Sphere => &["radius"],
            Word::Capsule => &["from", "to", "radius"],
            Word::Box => &["size"],
            Word::Convex => &["points"],
        }
    }

    /// Keys of the solid's pose in its body, if its own keys do not define it.
    fn place(self) -> &'static [&'static str] {
        match self {
            Word::Sphere => &["at"],
            Word::Capsule => &[],
            Word::Box | Word::Convex => &["at", "rotation"],
        }
    }
}

impl Solid {
    pub(super) fn read(word: Word, table: &Table<'_>) -> Result<Solid, SceneError> {
        match word {
            Word::Sphere => Ok(Solid::Sphere { radius: radius(table)? }),
            Word::Capsule => capsule(table),
            Word::Box => cuboid(table),
            Word::Convex => convex(table),
        }
    }
}

fn radius(table: &Table<'_>) -> Result<f64, SceneError> {
    table.need("radius", "the radius [m]")?.above_zero()
}

fn capsule(table: &Table<'_>) -> Result<Solid, SceneError> {
    let radius = radius(table)?;
    let from = table.need("from", "one end of the capsule's axis [m]")?.vector()?;
    let value = table.need("to", "the other end of the capsule's axis [m]")?;
    let to = value.vector()?;
    if (to - from).norm() <= THINNEST * radius {
        return Err(value.wrong("another point than `from`").hint("a capsule without length is a sphere"));
    }
    Ok(Solid::Capsule { from, to, radius })
}

fn cuboid(table: &Table<'_>) -> Result<Solid, SceneError> {
    let value = table.need("size", "the edge lengths along x, y, z [m]")?;
    let expected = "three lengths [x, y, z] above zero";
    let lengths: Result<Vec<f64>, _> = value.list(expected)?.iter().map(|length| length.above_zero()).collect();
    let [x, y, z]: [f64; 3] = lengths?.try_into().map_err(|_| value.wrong(expected))?;
    Ok(Solid::Box { size: Vec3::new(x, y, z) })
}

fn convex(table: &Table<'_>) -> Result<Solid, SceneError> {
    let value = table.need("points", "the corners of the solid [m]")?;
    let expected = "at least four points [x, y, z], not all in one plane";
    let points: Result<Vec<Vec3>, _> = value.list(expected)?.iter().map(|point| point.vector()).collect();
    let points = points?;
    if flat(&points) { Err(value.wrong(expected)) } else { Ok(Solid::Convex { points }) }
}

/// Whether points lie in one plane, determined with the farthest point from the first one, from their line, and from
/// that plane.
fn flat(points: &[Vec3]) -> bool {
    let Some(origin) = points.first() else { return true };
    let farthest = |distance: &dyn Fn(&Vec3) -> f64| {
        let rated = points.iter().map(|point| (distance(&(point - origin)), point - origin));
        rated.max_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((0.0, Vec3::zeros()))
    };
    let (length, along) = farthest(&Vec3::norm);
    let Some(along) = along.try_normalize(f64::MIN_POSITIVE) else { return true };
    let (_, aside) = farthest(&|arm| (arm - along * arm.dot(&along)).norm());
    let Some(normal) = along.cross(&aside).try_normalize(THINNEST * length) else { return true };
    farthest(&|arm| arm.dot(&normal).abs()).0 <= THINNEST * length
}
