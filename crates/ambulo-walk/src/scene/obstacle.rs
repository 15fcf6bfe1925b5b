//! Obstacles in a scene file: floors, walls, terrain, and solids with a prescribed motion.

use super::SceneError;
use super::function::{self, Purpose, TimeFunction};
use super::material::{self, MaterialEntry};
use super::names::{Item, Names};
use super::shape::{self, Solid};
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::{Table, Value};

/// A solid that forces do not move.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleEntry {
    /// Name, unique among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Shape in its own frame.
    pub shape: ObstacleShape,
    /// `world_from_obstacle` without the motion.
    pub pose: Pose,
    /// Index in [`SceneFile::materials`](super::SceneFile::materials).
    pub material: usize,
    /// Prescribed motion, if any.
    pub motion: Option<ObstacleMotion>,
}

/// The shape of an obstacle in its own frame.
#[derive(Debug, Clone, PartialEq)]
pub enum ObstacleShape {
    /// A solid.
    Solid(Solid),
    /// The half-space below a plane through the origin.
    Plane {
        /// Unit normal, out of the ground.
        normal: Vec3,
    },
    /// Terrain: a grid of heights, centred at the origin.
    HeightField {
        /// Heights along y [m]: at least two rows of equal length, at least two each; rows are along x, the first one
        /// at -z/2.
        heights: Vec<Vec<f64>>,
        /// Whole length along x [m].
        size_x: f64,
        /// Whole length along z [m].
        size_z: f64,
    },
}

/// A prescribed motion: `world_from_obstacle(t)` is `pose`, rotated by `angle` about `axis` through its own origin,
/// then translated by `displacement`.
#[derive(Debug, Clone, PartialEq)]
pub struct ObstacleMotion {
    /// Line of its header.
    pub line: usize,
    /// Translation along world x, y, z [m].
    pub displacement: [TimeFunction; 3],
    /// Unit direction in the world.
    pub axis: Vec3,
    /// Angle about `axis` [rad].
    pub angle: TimeFunction,
}

/// The kinds of obstacle, by their name in the file.
#[derive(Clone, Copy)]
enum Word {
    Solid(shape::Word),
    Plane,
    HeightField,
}

const KEYS: &[&str] = &["name", "kind", "at", "rotation", "material", "motion"];

impl ObstacleEntry {
    pub(super) fn read_all(
        root: &Table<'_>,
        names: &mut Names,
        materials: &[MaterialEntry],
        duration_s: f64,
    ) -> Result<Vec<ObstacleEntry>, SceneError> {
        let read = |(i, table): (usize, &Table<'_>)| {
            let name = names.declare(table, Item::Obstacle(i))?;
            ObstacleEntry::read(table, name, materials, duration_s)
        };
        root.tables("obstacle")?.iter().enumerate().map(read).collect()
    }

    fn read(
        table: &Table<'_>,
        name: String,
        materials: &[MaterialEntry],
        duration_s: f64,
    ) -> Result<ObstacleEntry, SceneError> {
        Ok(ObstacleEntry {
            name,
            line: table.line,
            shape: shape(table)?,
            pose: table.pose("at")?,
            material: material::of_shape(table, materials)?,
            motion: table.get("motion").map(|value| motion(&value, duration_s)).transpose()?,
        })
    }
}

fn shape(table: &Table<'_>) -> Result<ObstacleShape, SceneError> {
    let mut words: Vec<(&str, Word)> = vec![("plane", Word::Plane), ("height-field", Word::HeightField)];
    words.extend(shape::WORDS.map(|(text, word)| (text, Word::Solid(word))));
    match table.need("kind", "the kind of obstacle, such as \"plane\" or \"box\"")?.choice(&words)? {
        Word::Solid(word) => {
            table.only(&[KEYS, word.keys()])?;
            Solid::read(word, table).map(ObstacleShape::Solid)
        }
        Word::Plane => {
            table.only(&[KEYS, &["normal"]])?;
            let normal = table.get("normal").map_or(Ok(Vec3::y()), |value| value.direction())?;
            Ok(ObstacleShape::Plane { normal })
        }
        Word::HeightField => {
            table.only(&[KEYS, &["heights", "size"]])?;
            height_field(table)
        }
    }
}

fn height_field(table: &Table<'_>) -> Result<ObstacleShape, SceneError> {
    let value = table.need("heights", "rows of heights [m]")?;
    let expected = "at least two rows of at least two heights [m], all of the same length";
    let row = |row: Value<'_>| row.list("a row of heights [m]")?.iter().map(|height| height.number()).collect();
    let rows: Result<Vec<Vec<f64>>, SceneError> = value.list(expected)?.into_iter().map(row).collect();
    let heights = rows?;
    let columns = heights.first().map_or(0, Vec::len);
    if heights.len() < 2 || columns < 2 || heights.iter().any(|row| row.len() != columns) {
        return Err(value.wrong(expected));
    }
    let size = table.need("size", "the whole lengths [x, z] [m]")?;
    let expected = "two lengths [x, z] above zero";
    let lengths: Result<Vec<f64>, _> = size.list(expected)?.iter().map(|length| length.above_zero()).collect();
    let [size_x, size_z]: [f64; 2] = lengths?.try_into().map_err(|_| size.wrong(expected))?;
    Ok(ObstacleShape::HeightField { heights, size_x, size_z })
}

fn motion(value: &Value<'_>, duration_s: f64) -> Result<ObstacleMotion, SceneError> {
    let table = value.table("a table: displacement = [x, y, z], axis = [x, y, z], angle_deg = …")?;
    table.only(&[&["displacement", "axis", "angle_deg", "angle"]])?;
    let angle = function::either_unit(&table, "angle", Purpose { duration_s, angle: true })?;
    let axis = match (&angle, table.get("axis")) {
        (_, Some(value)) => value.direction()?,
        (Some(_), None) => return Err(table.missing("axis", "the axis of rotation in the world")),
        (None, None) => Vec3::y(),
    };
    Ok(ObstacleMotion {
        line: table.line,
        displacement: displacement(&table, duration_s)?,
        axis,
        angle: angle.unwrap_or(TimeFunction::Constant(0.0)),
    })
}

fn displacement(table: &Table<'_>, duration_s: f64) -> Result<[TimeFunction; 3], SceneError> {
    let still = || TimeFunction::Constant(0.0);
    let Some(value) = table.get("displacement") else { return Ok([still(), still(), still()]) };
    let expected = "three functions [x, y, z] [m]; 0 for no motion";
    let purpose = Purpose { duration_s, angle: false };
    let read = |entry: &Value<'_>| TimeFunction::read(entry, 1.0, purpose);
    let functions: Result<Vec<TimeFunction>, _> = value.list(expected)?.iter().map(read).collect();
    functions?.try_into().map_err(|_| value.wrong(expected))
}
