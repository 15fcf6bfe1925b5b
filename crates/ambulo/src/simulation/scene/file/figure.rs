//! Figures of scene files: built by the program, or read from an OpenSim model and moved by a recording.

use super::built_figure::{self, BuiltFigure};
use super::material::{self, MaterialEntry};
use super::names::{Item, Names};
use crate::simulation::scene::SceneError;
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::{Place, Table, Value};

/// A figure of a scene file.
#[derive(Debug, Clone)]
pub struct FigureEntry {
    /// Name, unique among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Where the figure comes from.
    pub source: FigureSource,
    /// `world_from_ground`, where ground is that of the figure's model.
    pub pose: Pose,
    /// Spheres for contact, in addition to the soles of a built figure.
    pub spheres: Vec<SphereEntry>,
}

/// Where a figure comes from.
#[derive(Debug, Clone)]
pub enum FigureSource {
    /// Built by the program.
    Built(BuiltFigure),
    /// An OpenSim model.
    Model(ModelFigure),
}

/// A figure from an OpenSim model. Its files are read when the scene is built.
#[derive(Debug, Clone, PartialEq)]
pub struct ModelFigure {
    /// Position of the path of the model in the scene file.
    pub place: Place,
    /// Path of the `.osim` file as in the scene file, relative to the scene.
    pub model: String,
    /// The motion, if there is one.
    pub motion: Option<FigureMotion>,
    /// The coordinates that follow the recording, except those of the root.
    pub driven: DrivenCoordinates,
    /// How the root moves.
    pub root: RootMotion,
}

/// The recorded motion of a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureMotion {
    /// Position of the path in the scene file.
    pub place: Place,
    /// Path of the `.mot` or `.sto` file with coordinates, relative to the scene.
    pub file: String,
    /// Time of the recording [s] at which the scene begins; `None` is its first instant.
    pub from_s: Option<f64>,
}

/// The coordinates of a figure that follow its recording, except those of the root.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum DrivenCoordinates {
    /// All.
    All,
    /// None: the figure starts in the posture of the recording and then moves freely.
    Nothing,
    /// Those named, in the order of the file.
    Only(Vec<String>),
}

/// How the coordinates of the root move, which carry the whole figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RootMotion {
    /// Forces move them.
    Free,
    /// They follow the recording.
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
            let keys = if table.get("build").is_some() { built_figure::KEYS } else { KEYS };
            let name = names.declare_first(table, keys, Item::Figure(i))?;
            let source = match table.get("build") {
                Some(value) => FigureSource::Built(BuiltFigure::read(table, &value, materials, duration_s)?),
                None => FigureSource::Model(ModelFigure::read(table)?),
            };
            let sphere = |sphere: &Table<'_>| SphereEntry::read(sphere, materials);
            Ok(FigureEntry {
                name,
                line: table.line,
                source,
                pose: table.pose("at")?,
                spheres: table.tables("sphere")?.iter().map(sphere).collect::<Result<_, _>>()?,
            })
        };
        root.tables("figure")?.iter().enumerate().map(read).collect()
    }
}

impl ModelFigure {
    fn read(table: &Table<'_>) -> Result<ModelFigure, SceneError> {
        let model = table.need("model", "the path of an .osim file, or `build` with a table, a mass and a height")?;
        let motion = table.get("motion").map(|value| FigureMotion::read(table, &value)).transpose()?;
        let unless_driven = if motion.is_some() { DrivenCoordinates::All } else { DrivenCoordinates::Nothing };
        let roots = [("free", RootMotion::Free), ("driven", RootMotion::Driven)];
        let figure = ModelFigure {
            place: model.place(),
            model: model.filled_text()?,
            driven: table.get("drive").map_or(Ok(unless_driven), |value| driven(&value))?,
            root: table.get("root").map_or(Ok(RootMotion::Free), |value| value.choice(&roots))?,
            motion,
        };
        let follows = figure.driven != DrivenCoordinates::Nothing
            || figure.root == RootMotion::Driven
            || table.get("from").is_some();
        if figure.motion.is_none() && follows {
            return Err(table.missing("motion", "the path of a .mot file that the figure follows"));
        }
        Ok(figure)
    }
}

impl FigureMotion {
    fn read(table: &Table<'_>, value: &Value<'_>) -> Result<FigureMotion, SceneError> {
        Ok(FigureMotion {
            place: value.place(),
            file: value.filled_text()?,
            from_s: table.get("from").map(|value| value.number()).transpose()?,
        })
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
