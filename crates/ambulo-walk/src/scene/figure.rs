//! Figures in a scene file: an OpenSim model that follows a recording, or a built-in figure.

use super::built_entry::{self, BuiltFigure};
use super::material::{self, MaterialEntry};
use super::names::{Item, Names};
use super::{Place, SceneError};
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::{Table, Value};

/// A figure from an OpenSim model, or a built-in figure. Its files are not opened here.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureEntry {
    /// Name, unique among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Place of the model's path in the file.
    pub model_place: Place,
    /// The built-in figure; then model, motion, `driven` and `root` are not used.
    pub built: Option<BuiltFigure>,
    /// Path of the `.osim` file, relative to the scene; empty for a built-in figure.
    pub model: String,
    /// Place of the motion's path in the file; the model's place if there is none.
    pub motion_place: Place,
    /// Path of the `.mot` or `.sto` file with coordinates, relative to the scene.
    pub motion: Option<String>,
    /// Time of the recording at which the scene begins [s]; `None`: its first sample.
    pub from_s: Option<f64>,
    /// The coordinates that follow the recording; `Nothing` without one.
    pub driven: DrivenCoordinates,
    /// How the root's coordinates move.
    pub root: RootMotion,
    /// `world_from_ground`, with the ground of the model.
    pub pose: Pose,
    /// Contact spheres.
    pub spheres: Vec<SphereEntry>,
}

/// The coordinates of a figure that follow its recording, except the root's.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DrivenCoordinates {
    /// All.
    All,
    /// No coordinate: the figure is passive and starts in the posture of the recording.
    Nothing,
    /// The named ones, in the order of the file.
    Only(Vec<String>),
}

/// How the root's coordinates of a figure move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootMotion {
    /// Forces move them.
    Free,
    /// The coordinates of the root follow the recording.
    Driven,
}

/// A contact sphere on a body of a figure.
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
                let name = names.declare_first(table, built_entry::KEYS, Item::Figure(i))?;
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
