//! Obstacles of scene files, which forces do not move: floors, walls, terrain, solids on a prescribed path.

use super::material::{self, MaterialEntry};
use super::names::{Item, Names};
use super::shape::{SOLID_WORDS, SolidWord};
use super::time_function::{self, Purpose, TimeFunction};
use crate::contact::Shape;
use crate::simulation::joint::rotation;
use crate::simulation::scene::SceneError;
use crate::spatial::{Mat3, Pose, Vec3};
use crate::toml_reader::{Table, Value};
use std::f64::consts::PI;

/// A solid that forces do not move.
#[derive(Debug, Clone)]
pub struct ObstacleEntry {
    /// Name, unique among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Its shape.
    pub shape: Shape,
    /// `obstacle_from_shape`.
    pub obstacle_from_shape: Pose,
    /// `world_from_obstacle` before its motion.
    pub pose: Pose,
    /// Index in [`SceneFile::materials`](super::SceneFile::materials).
    pub material: usize,
    /// Prescribed motion, if any.
    pub motion: Option<ObstacleMotionEntry>,
}

/// A prescribed motion: `world_from_obstacle(t)` = (`pose` turned by `angle` about `axis` through its own origin, then
/// moved by `displacement`).
#[derive(Debug, Clone)]
pub struct ObstacleMotionEntry {
    /// Line of its header.
    pub line: usize,
    /// Displacement along world x, y, z [m].
    pub displacement: [TimeFunction; 3],
    /// Axis of rotation, a unit vector of the world.
    pub axis: Vec3,
    /// Angle about `axis` [rad].
    pub angle: TimeFunction,
}

/// The shapes of obstacles in scene files.
#[derive(Clone, Copy)]
enum ShapeWord {
    Solid(SolidWord),
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
        let (shape, obstacle_from_shape) = shape(table)?;
        Ok(ObstacleEntry {
            name,
            line: table.line,
            shape,
            obstacle_from_shape,
            pose: table.pose("at")?,
            material: material::of_shape(table, materials)?,
            motion: table.get("motion").map(|value| motion(&value, duration_s)).transpose()?,
        })
    }
}

fn shape(table: &Table<'_>) -> Result<(Shape, Pose), SceneError> {
    let mut words: Vec<(&str, ShapeWord)> = vec![("plane", ShapeWord::Plane), ("height-field", ShapeWord::HeightField)];
    words.extend(SOLID_WORDS.map(|(text, word)| (text, ShapeWord::Solid(word))));
    match table.need("kind", "the kind of obstacle, such as \"plane\" or \"box\"")?.choice(&words)? {
        ShapeWord::Solid(word) => {
            table.only(&[KEYS, word.keys()])?;
            word.read(table).map(|shape| (shape, Pose::IDENTITY))
        }
        ShapeWord::Plane => {
            table.only(&[KEYS, &["normal"]])?;
            let normal = table.get("normal").map_or(Ok(Vec3::y()), |value| value.direction())?;
            Ok((Shape::half_space(), Pose { rotation: turning_y_to(&normal), translation: Vec3::zeros() }))
        }
        ShapeWord::HeightField => {
            table.only(&[KEYS, &["heights", "size"]])?;
            height_field(table).map(|shape| (shape, Pose::IDENTITY))
        }
    }
}

fn height_field(table: &Table<'_>) -> Result<Shape, SceneError> {
    let value = table.need("heights", "rows of heights [m]")?;
    let expected = "at least two rows of at least two heights [m], all of one length";
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
    let field = Shape::height_field(heights.len(), columns, &heights.concat(), size_x, size_z);
    field.map_err(|e| table.place().error(e.to_string()))
}

fn motion(value: &Value<'_>, duration_s: f64) -> Result<ObstacleMotionEntry, SceneError> {
    let table = value.table("a table: displacement = [x, y, z], axis = [x, y, z], angle_deg = …")?;
    table.only(&[&["displacement", "axis", "angle_deg", "angle"]])?;
    let angle = time_function::either_unit(&table, "angle", Purpose { duration_s, angle: true })?;
    let axis = match (&angle, table.get("axis")) {
        (_, Some(value)) => value.direction()?,
        (Some(_), None) => return Err(table.missing("axis", "the direction to turn about, in the world")),
        (None, None) => Vec3::y(),
    };
    Ok(ObstacleMotionEntry {
        line: table.line,
        displacement: displacement(&table, duration_s)?,
        axis,
        angle: angle.unwrap_or(TimeFunction::constant(0.0)),
    })
}

fn displacement(table: &Table<'_>, duration_s: f64) -> Result<[TimeFunction; 3], SceneError> {
    let still = || TimeFunction::constant(0.0);
    let Some(value) = table.get("displacement") else { return Ok([still(), still(), still()]) };
    let expected = "three functions [x, y, z] [m]; 0 where it does not move";
    let purpose = Purpose { duration_s, angle: false };
    let read = |entry: &Value<'_>| TimeFunction::read(entry, 1.0, purpose);
    let functions: Result<Vec<TimeFunction>, _> = value.list(expected)?.iter().map(read).collect();
    functions?.try_into().map_err(|_| value.wrong(expected))
}

/// The shortest rotation that takes y to a unit vector.
fn turning_y_to(normal: &Vec3) -> Mat3 {
    let across = Vec3::y().cross(normal);
    let angle = across.norm().atan2(normal.y);
    match across.try_normalize(f64::MIN_POSITIVE) {
        Some(axis) => rotation(&(axis * angle)),
        None if normal.y < 0.0 => rotation(&(Vec3::x() * PI)),
        None => Mat3::identity(),
    }
}
