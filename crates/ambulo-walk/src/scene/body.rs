//! Rigid bodies in a scene file: mass, inertia, initial position and velocity, shapes.

use super::SceneError;
use super::material::MaterialEntry;
use super::names::{Item, Names};
use super::shape::ShapeEntry;
use super::uniform::uniform;
use crate::spatial::{Inertia, Mat3, Pose, Vec3};
use crate::toml_reader::{Table, Value};

/// A rigid body. Its frame has the origin at the mass centre.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyEntry {
    /// Name, unique among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Mass, above zero, and inertia about the mass centre, positive definite, in the axes of the body.
    pub inertia: Inertia,
    /// `world_from_body` at the start.
    pub start: Pose,
    /// Velocity of the mass centre at the start, world axes [m/s]. `None`: from the parent's motion and the rates of
    /// the joint's coordinates; at rest without a joint.
    pub velocity: Option<Vec3>,
    /// Angular velocity at the start, world axes [rad/s]. `None`: as for `velocity`.
    pub angular_velocity: Option<Vec3>,
    /// Contact shapes; bodies without shapes touch nothing.
    pub shapes: Vec<ShapeEntry>,
}

const KEYS: &[&str] = &[
    "name",
    "mass",
    "inertia",
    "position",
    "rotation",
    "velocity",
    "angular_velocity_deg",
    "angular_velocity",
    "shape",
];

/// Allowed distance of the shapes' common centre from the body's origin, as a share of their radius of gyration: for
/// rounded numbers.
const CENTER_SLACK: f64 = 1e-3;
/// Allowed asymmetry of an inertia matrix, as a share of its largest entry.
const SYMMETRY_SLACK: f64 = 1e-9;
/// Smallest principal moment as a share of the largest; below, angular velocities become unbounded.
const THINNEST: f64 = 1e-9;

impl BodyEntry {
    pub(super) fn read_all(
        root: &Table<'_>,
        names: &mut Names,
        materials: &[MaterialEntry],
    ) -> Result<Vec<BodyEntry>, SceneError> {
        let read = |(i, table)| BodyEntry::read(table, names.declare_first(table, KEYS, Item::Body(i))?, materials);
        root.tables("body")?.iter().enumerate().map(read).collect()
    }

    fn read(table: &Table<'_>, name: String, materials: &[MaterialEntry]) -> Result<BodyEntry, SceneError> {
        let mass = mass(table)?;
        let shapes = ShapeEntry::read_all(table, materials)?;
        Ok(BodyEntry {
            name,
            line: table.line,
            inertia: inertia(table, mass, &shapes)?,
            start: table.pose("position")?,
            velocity: table.get("velocity").map(|value| value.vector()).transpose()?,
            angular_velocity: angular_velocity(table)?,
            shapes,
        })
    }
}

fn mass(table: &Table<'_>) -> Result<f64, SceneError> {
    let advice = "a solid that forces do not move is an [[obstacle]]";
    table.need("mass", "the mass [kg]")?.above_zero().map_err(|error| error.hint(advice))
}

fn angular_velocity(table: &Table<'_>) -> Result<Option<Vec3>, SceneError> {
    let read = |(value, unit): (Value<'_>, f64)| value.vector().map(|vector| vector * unit);
    table.either_unit("angular_velocity")?.map(read).transpose()
}

fn inertia(table: &Table<'_>, mass: f64, shapes: &[ShapeEntry]) -> Result<Inertia, SceneError> {
    let about_center = match table.get("inertia") {
        Some(value) => checked(&value)?,
        None => of_shapes(table, shapes)? * mass,
    };
    let expected = "an inertia above zero about every axis";
    let refuse = |what: String| table.get("inertia").map_or_else(|| table.wrong(&what), |value| value.wrong(&what));
    let inertia = Inertia::new(mass, Vec3::zeros(), about_center).map_err(|e| refuse(e.to_string()))?;
    let principal = about_center.symmetric_eigenvalues();
    if principal.min() <= THINNEST * principal.max() {
        return Err(refuse(format!("{expected}; the smallest principal moment is {:e} kg.m²", principal.min()))
            .hint("the moment of a thin rod about its axis is m r²/2"));
    }
    match inertia.defect() {
        Some(defect) => Err(refuse(format!("an inertia that a body can have; {defect}"))),
        None => Ok(inertia),
    }
}

/// Three principal moments or three rows.
fn checked(value: &Value<'_>) -> Result<Mat3, SceneError> {
    const EXPECTED: &str = "three moments [xx, yy, zz] or three rows of three [kg.m²]";
    if let Ok(moments) = value.numbers::<3>(EXPECTED) {
        return Ok(Mat3::from_diagonal(&Vec3::from(moments)));
    }
    let rows = value.list(EXPECTED)?;
    let is_row = |row: &Value<'_>| row.list(EXPECTED).is_ok();
    let (3, true) = (rows.len(), rows.iter().all(is_row)) else {
        // An error about the first wrong entry is more specific than one about the whole list.
        value.numbers::<3>(EXPECTED)?;
        return Err(value.wrong(EXPECTED));
    };
    let mut matrix = Mat3::zeros();
    for (i, row) in rows.iter().enumerate() {
        matrix.set_row(i, &Vec3::from(row.numbers("a row of three numbers [kg.m²]")?).transpose());
    }
    if (matrix - matrix.transpose()).amax() > SYMMETRY_SLACK * matrix.amax() {
        return Err(value.wrong("a symmetric matrix: row 1 column 2 equals row 2 column 1, and so on"));
    }
    Ok((matrix + matrix.transpose()) / 2.0)
}

/// Inertia of the shapes as a uniform solid, for 1 kg [m²].
fn of_shapes(table: &Table<'_>, shapes: &[ShapeEntry]) -> Result<Mat3, SceneError> {
    let meaning = "the moments about the mass centre [xx, yy, zz] [kg.m²]";
    if shapes.is_empty() {
        return Err(table
            .missing("inertia", meaning)
            .hint("`inertia` is optional for a body with shapes, which is then taken as uniform"));
    }
    let Some((center, about_center)) = uniform(shapes) else {
        return Err(table.missing("inertia", meaning).hint("the inertia of a convex shape is not computed"));
    };
    let gyration = (about_center.trace() / 2.0).sqrt();
    if center.norm() > CENTER_SLACK * gyration {
        let [x, y, z] = center.into();
        let found = format!("found shapes whose common centre is [{x:.6}, {y:.6}, {z:.6}]");
        return Err(table
            .wrong(format!("{found}; expected it at the body's origin, its mass centre"))
            .hint("move the shapes, or give `inertia` if the body is not uniform"));
    }
    Ok(about_center)
}
