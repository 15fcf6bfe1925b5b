//! Figures: bodies and joints of an OpenSim model, moved by a recording; or those that the program builds.

use super::built::{self, BuiltFigure};
use super::material::{self, MaterialEntry};
use super::names::{Item, Names};
use super::{Place, SceneError};
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::{Table, Value};

/// A figure from an OpenSim model, or one that the program builds. Its files are not opened here.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureEntry {
    /// Name, its own among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Where the path of the model stands.
    pub model_place: Place,
    /// Built by the program; then no model, motion, `driven` or `root` plays a part.
    pub built: Option<BuiltFigure>,
    /// Path of the `.osim` file as it stands in the scene, relative to the scene; empty if the figure is built.
    pub model: String,
    /// Where the path of the motion stands; the model's place if there is none.
    pub motion_place: Place,
    /// Path of the `.mot` or `.sto` file with coordinates, in the same way.
    pub motion: Option<String>,
    /// Time of the recording [s] at which the scene begins; `None` is its first instant.
    pub from_s: Option<f64>,
    /// Which coordinates follow the recording; never more than `Nothing` without one.
    pub driven: DrivenCoordinates,
    /// What becomes of the coordinates that carry the whole figure.
    pub root: RootMotion,
    /// `world_from_ground`, ground being that of the model.
    pub pose: Pose,
    /// Where it touches.
    pub spheres: Vec<SphereEntry>,
}

/// Which coordinates of a figure follow its recording; those of the root aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DrivenCoordinates {
    /// All.
    All,
    /// None: a rag doll that starts as the recording does.
    Nothing,
    /// Those named, in the order of the file.
    Only(Vec<String>),
}

/// What becomes of the coordinates that carry the whole figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootMotion {
    /// Forces move them.
    Free,
    /// They follow the recording.
    Driven,
}

/// A sphere on a body of a figure, where it touches others.
#[derive(Debug, Clone, PartialEq)]
pub struct SphereEntry {
    /// Line of its header.
    pub line: usize,
    /// Name of the body in the model.
    pub body: String,
    /// Centre in the body's frame of the model [m].
    pub at: Vec3,
    /// Radius [m], above zero.
    pub radius: f64,
    /// Index in [`SceneFile::materials`](super::SceneFile::materials).
    pub material: usize,
}

const KEYS: &[&str] = &["name", "build", "model", "motion", "from", "drive", "root", "at", "rotation", "sphere"];

impl FigureEntry {
    pub(super) fn read_all(
        root: &Table<'_>,
        names: &mut Names,
        materials: &[MaterialEntry],
        duration_s: f64,
    ) -> Result<Vec<FigureEntry>, SceneError> {
        let read = |(i, table): (usize, &Table<'_>)| {
            if let Some(value) = table.get("build") {
                let name = names.declare_first(table, built::KEYS, Item::Figure(i))?;
                return FigureEntry::read_built(table, name, &value, materials, duration_s);
            }
            FigureEntry::read(table, names.declare_first(table, KEYS, Item::Figure(i))?, materials)
        };
        root.tables("figure")?.iter().enumerate().map(read).collect()
    }

    fn read_built(
        table: &Table<'_>,
        name: String,
        value: &Value<'_>,
        materials: &[MaterialEntry],
        duration_s: f64,
    ) -> Result<FigureEntry, SceneError> {
        let sphere = |sphere: &Table<'_>| SphereEntry::read(sphere, materials);
        Ok(FigureEntry {
            name,
            line: table.line,
            model_place: value.place(),
            built: Some(BuiltFigure::read(table, value, materials, duration_s)?),
            model: String::new(),
            motion_place: value.place(),
            motion: None,
            from_s: None,
            driven: DrivenCoordinates::Nothing,
            root: RootMotion::Free,
            pose: table.pose("at")?,
            spheres: table.tables("sphere")?.iter().map(sphere).collect::<Result<_, _>>()?,
        })
    }

    fn read(table: &Table<'_>, name: String, materials: &[MaterialEntry]) -> Result<FigureEntry, SceneError> {
        let model = table.need("model", "the path of an .osim file, or `build` with a table, a mass and a height")?;
        let motion_place = table.get("motion").map_or_else(|| model.place(), |value| value.place());
        let motion = table.get("motion").map(|value| value.filled_text()).transpose()?;
        let sphere = |sphere: &Table<'_>| SphereEntry::read(sphere, materials);
        let figure = FigureEntry {
            name,
            line: table.line,
            model_place: model.place(),
            built: None,
            model: model.filled_text()?,
            motion_place,
            from_s: table.get("from").map(|value| value.number()).transpose()?,
            driven: table
                .get("drive")
                .map_or_else(|| Ok(DrivenCoordinates::of_file(motion.as_ref())), |value| driven(&value))?,
            root: table.get("root").map_or(Ok(RootMotion::Free), |value| {
                value.choice(&[("free", RootMotion::Free), ("driven", RootMotion::Driven)])
            })?,
            pose: table.pose("at")?,
            spheres: table.tables("sphere")?.iter().map(sphere).collect::<Result<_, _>>()?,
            motion,
        };
        let follows =
            figure.driven != DrivenCoordinates::Nothing || figure.root == RootMotion::Driven || figure.from_s.is_some();
        if figure.motion.is_none() && follows {
            return Err(table.missing("motion", "the path of a .mot file that the figure follows"));
        }
        Ok(figure)
    }
}

impl DrivenCoordinates {
    fn of_file(motion: Option<&String>) -> DrivenCoordinates {
        if motion.is_some() { DrivenCoordinates::All } else { DrivenCoordinates::Nothing }
    }
}

fn driven(value: &Value<'_>) -> Result<DrivenCoordinates, SceneError> {
    const EXPECTED: &str = "\"all\", \"none\", or a list of coordinates";
    match value.text() {
        Ok("all") => Ok(DrivenCoordinates::All),
        Ok("none") => Ok(DrivenCoordinates::Nothing),
        Ok(_) => Err(value.wrong(EXPECTED)),
        Err(_) => {
            let names: Result<Vec<String>, _> = value.list(EXPECTED)?.iter().map(Value::filled_text).collect();
            names
                .map(|names| if names.is_empty() { DrivenCoordinates::Nothing } else { DrivenCoordinates::Only(names) })
        }
    }
}

impl SphereEntry {
    fn read(table: &Table<'_>, materials: &[MaterialEntry]) -> Result<SphereEntry, SceneError> {
        table.only(&[&["body", "at", "radius", "material"]])?;
        Ok(SphereEntry {
            line: table.line,
            body: table.need("body", "a body of the model")?.filled_text()?,
            at: table.vector_or_zero("at")?,
            radius: table.need("radius", "the radius [m]")?.above_zero()?,
            material: material::of_shape(table, materials)?,
        })
    }
}
