//! Shapes of bodies and obstacles.

use super::material::{self, MaterialEntry};
use crate::contact::Shape;
use crate::simulation::scene::SceneError;
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::Table;

/// A shape of a body.
#[derive(Debug, Clone)]
pub struct ShapeEntry {
    /// Line of its header.
    pub line: usize,
    /// The shape in its own frame.
    pub shape: Shape,
    /// `body_from_shape`; the origin of the body's frame is the mass centre.
    pub pose: Pose,
    /// Index in [`SceneFile::materials`](super::SceneFile::materials).
    pub material: usize,
}

/// The solids in scene files.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum SolidWord {
    Sphere,
    Capsule,
    Box,
    Convex,
}

/// The words for solids in scene files.
pub(super) const SOLID_WORDS: [(&str, SolidWord); 4] = [
    ("sphere", SolidWord::Sphere),
    ("capsule", SolidWord::Capsule),
    ("box", SolidWord::Box),
    ("convex", SolidWord::Convex),
];

/// Points count as lying in one plane if the solid around them is thinner than this share of its length.
const THINNEST: f64 = 1e-6;

impl ShapeEntry {
    /// The shapes of a body.
    pub(super) fn read_all(body: &Table<'_>, materials: &[MaterialEntry]) -> Result<Vec<ShapeEntry>, SceneError> {
        body.tables("shape")?.iter().map(|table| ShapeEntry::read(table, materials)).collect()
    }

    fn read(table: &Table<'_>, materials: &[MaterialEntry]) -> Result<ShapeEntry, SceneError> {
        let word = table.need("kind", "the kind of shape: sphere, capsule, box or convex")?.choice(&SOLID_WORDS)?;
        table.only(&[&["kind", "material"], word.keys(), word.pose_keys()])?;
        Ok(ShapeEntry {
            line: table.line,
            shape: word.read(table)?,
            pose: table.pose("at")?,
            material: material::of_shape(table, materials)?,
        })
    }
}

impl SolidWord {
    /// Keys of the solid in its own frame.
    pub(super) fn keys(self) -> &'static [&'static str] {
        match self {
            SolidWord::Sphere => &["radius"],
            SolidWord::Capsule => &["from", "to", "radius"],
            SolidWord::Box => &["size"],
            SolidWord::Convex => &["points"],
        }
    }

    /// Keys that place the solid in its body.
    fn pose_keys(self) -> &'static [&'static str] {
        match self {
            SolidWord::Sphere => &["at"],
            SolidWord::Capsule => &[],
            SolidWord::Box | SolidWord::Convex => &["at", "rotation"],
        }
    }

    /// Reads the solid from its keys.
    pub(super) fn read(self, table: &Table<'_>) -> Result<Shape, SceneError> {
        let shape = match self {
            SolidWord::Sphere => Shape::sphere(radius(table)?),
            SolidWord::Capsule => {
                let (from, to, radius) = capsule(table)?;
                Shape::capsule(from, to, radius)
            }
            SolidWord::Box => Shape::cuboid(size(table)? / 2.0),
            SolidWord::Convex => Shape::convex(&corners(table)?),
        };
        shape.map_err(|e| table.place().error(e.to_string()))
    }
}

fn radius(table: &Table<'_>) -> Result<f64, SceneError> {
    table.need("radius", "the radius [m]")?.above_zero()
}

fn capsule(table: &Table<'_>) -> Result<(Vec3, Vec3, f64), SceneError> {
    let radius = radius(table)?;
    let from = table.need("from", "one end of the capsule's axis [m]")?.vector()?;
    let value = table.need("to", "the other end of the capsule's axis [m]")?;
    let to = value.vector()?;
    if (to - from).norm() <= THINNEST * radius {
        return Err(value.wrong("a point other than `from`").hint("a capsule without length is a sphere"));
    }
    Ok((from, to, radius))
}

fn size(table: &Table<'_>) -> Result<Vec3, SceneError> {
    let value = table.need("size", "the whole lengths along x, y, z [m]")?;
    let expected = "three lengths [x, y, z] above zero";
    let lengths: Result<Vec<f64>, _> = value.list(expected)?.iter().map(|length| length.above_zero()).collect();
    let [x, y, z]: [f64; 3] = lengths?.try_into().map_err(|_| value.wrong(expected))?;
    Ok(Vec3::new(x, y, z))
}

fn corners(table: &Table<'_>) -> Result<Vec<Vec3>, SceneError> {
    let value = table.need("points", "the corners of the solid [m]")?;
    let expected = "at least four points [x, y, z], not all in one plane";
    let points: Result<Vec<Vec3>, _> = value.list(expected)?.iter().map(|point| point.vector()).collect();
    let points = points?;
    if flat(&points) { Err(value.wrong(expected)) } else { Ok(points) }
}

/// Whether points lie in one plane. Takes the point farthest from the first, then the farthest from that line, then the farthest
/// from that plane.
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
