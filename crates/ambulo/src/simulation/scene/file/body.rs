//! Rigid bodies of scene files: mass, inertia, initial pose and velocity, shapes.

use super::material::MaterialEntry;
use super::names::{Item, Names};
use super::shape::ShapeEntry;
use crate::simulation::scene::SceneError;
use crate::spatial::{Inertia, Mat3, Pose, Vec3};
use crate::toml_reader::{Table, Value};

/// A rigid body of a scene file. The origin of its frame is the mass centre.
#[derive(Debug, Clone)]
pub struct BodyEntry {
    /// Name, unique among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Mass, above zero, and inertia about the mass centre, positive definite, in the axes of the body.
    pub inertia: Inertia,
    /// `world_from_body` at the start.
    pub start: Pose,
    /// Velocity of the mass centre at the start, world axes [m/s]. If `None`, it follows from the body's joint, with the motion
    /// of its parent and the rates of its coordinates; a body without a joint is at rest.
    pub velocity: Option<Vec3>,
    /// Angular velocity at the start, world axes [rad/s]; `None` as for `velocity`.
    pub angular_velocity: Option<Vec3>,
    /// Shapes for contact; a body without shapes touches nothing.
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

/// Largest distance of the shapes' common centre from the body's origin, as a share of their radius of gyration: rounding by
/// hand.
const CENTER_SLACK: f64 = 1e-3;
/// Largest asymmetry of an inertia matrix, as a share of its largest entry.
const SYMMETRY_SLACK: f64 = 1e-9;
/// Smallest principal moment as a share of the largest; a body with a smaller one would spin without limit.
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
    let advice = "an [[obstacle]] is not moved by forces";
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
            .hint("a thin rod has m r²/2 about its axis"));
    }
    match inertia.defect() {
        Some(defect) => Err(refuse(format!("an inertia that a body can have; {defect}"))),
        None => Ok(inertia),
    }
}

/// Reads three principal moments or three rows.
fn checked(value: &Value<'_>) -> Result<Mat3, SceneError> {
    const EXPECTED: &str = "three moments [xx, yy, zz] or three rows of three [kg.m²]";
    if let Ok(moments) = value.numbers::<3>(EXPECTED) {
        return Ok(Mat3::from_diagonal(&Vec3::from(moments)));
    }
    let rows = value.list(EXPECTED)?;
    let is_row = |row: &Value<'_>| row.list(EXPECTED).is_ok();
    let (3, true) = (rows.len(), rows.iter().all(is_row)) else {
        // An error at the first entry that is not a number says more than one at the whole list.
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

/// Inertia about the mass centre, for 1 kg, of the uniform solid that the shapes form [m²]. Shapes share the mass by volume; an
/// overlap counts twice.
fn of_shapes(table: &Table<'_>, shapes: &[ShapeEntry]) -> Result<Mat3, SceneError> {
    let parts: Option<Vec<Part>> = shapes.iter().map(Part::of).collect();
    let Some(parts) = parts.filter(|parts| !parts.is_empty()) else {
        return Err(table
            .missing("inertia", "the moments about the mass centre [xx, yy, zz] [kg.m²]")
            .hint("a body with shapes needs no inertia: it is taken as a uniform solid"));
    };
    let total: f64 = parts.iter().map(|part| part.volume).sum();
    let center: Vec3 = parts.iter().map(|part| part.center * (part.volume / total)).sum();
    // Parallel-axis theorem, each part with its share of 1 kg.
    let about = |part: &Part| {
        let d = part.center - center;
        (part.about_center + Mat3::identity() * d.norm_squared() - d * d.transpose()) * (part.volume / total)
    };
    let about_center: Mat3 = parts.iter().map(about).sum();
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

/// A uniform solid in the axes of the body: volume [m³], mass centre [m], inertia about it for 1 kg [m²].
struct Part {
    volume: f64,
    center: Vec3,
    about_center: Mat3,
}

impl Part {
    fn of(entry: &ShapeEntry) -> Option<Part> {
        let (volume, inertia) = (entry.shape.volume()?, entry.shape.inertia(1.0)?);
        let r = entry.pose.rotation;
        Some(Part {
            volume,
            center: entry.pose.place(inertia.center()),
            about_center: r * inertia.about_center() * r.transpose(),
        })
    }
}
