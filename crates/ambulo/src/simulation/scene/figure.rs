//! Figures: bodies and joints of an OpenSim model, moved by a recording; or those that the program builds.

use super::built::{self, Built};
use super::material::{self, Material};
use super::names::{Item, Names};
use super::{Place, SceneError};
use crate::spatial::{Pose, Vec3};
use crate::toml_reader::{Table, Value};

/// A figure from an OpenSim model, or one that the program builds. Its files are not opened here.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Name, its own among bodies, obstacles and figures.
    pub name: String,
    /// Line of its header.
    pub line: usize,
    /// Where the path of the model stands.
    pub model_place: Place,
    /// Built by the program; then no model, motion, `driven` or `root` plays a part.
    pub built: Option<Built>,
    /// Path of the `.osim` file as it stands in the scene, relative to the scene; empty if the figure is built.
    pub model: String,
    /// Where the path of the motion stands; the model's place if there is none.
    pub motion_place: Place,
    /// Path of the `.mot` or `.sto` file with coordinates, in the same way.
    pub motion: Option<String>,
    /// Time of the recording [s] at which the scene begins; `None` is its first instant.
    pub from_s: Option<f64>,
    /// Which coordinates follow the recording; never more than `Nothing` without one.
    pub driven: Driven,
    /// What becomes of the coordinates that carry the whole figure.
    pub root: Root,
    /// `world_from_ground`, ground being that of the model.
    pub pose: Pose,
    /// Where it touches.
    pub spheres: Vec<FigureSphere>,
}

/// Which coordinates of a figure follow its recording; those of the root aside.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Driven {
    /// All.
    All,
    /// None: a rag doll that starts as the recording does.
    Nothing,
    /// Those named, in the order of the file.
    Only(Vec<String>),
}

/// What becomes of the coordinates that carry the whole figure.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Root {
    /// Forces move them.
    Free,
    /// They follow the recording.
    Driven,
}

/// A sphere on a body of a figure, where it touches others.
#[derive(Debug, Clone, PartialEq)]
pub struct FigureSphere {
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

impl Figure {
    pub(super) fn read_all(
        root: &Table<'_>,
        names: &mut Names,
        materials: &[Material],
        duration_s: f64,
    ) -> Result<Vec<Figure>, SceneError> {
        let read = |(i, table): (usize, &Table<'_>)| {
            if let Some(value) = table.get("build") {
                let name = names.declare_first(table, built::KEYS, Item::Figure(i))?;
                return Figure::read_built(table, name, &value, materials, duration_s);
            }
            Figure::read(table, names.declare_first(table, KEYS, Item::Figure(i))?, materials)
        };
        root.tables("figure")?.iter().enumerate().map(read).collect()
    }

    fn read_built(
        table: &Table<'_>,
        name: String,
        value: &Value<'_>,
        materials: &[Material],
        duration_s: f64,
    ) -> Result<Figure, SceneError> {
        let sphere = |sphere: &Table<'_>| FigureSphere::read(sphere, materials);
        Ok(Figure {
            name,
            line: table.line,
            model_place: value.place(),
            built: Some(Built::read(table, value, materials, duration_s)?),
            model: String::new(),
            motion_place: value.place(),
            motion: None,
            from_s: None,
            driven: Driven::Nothing,
            root: Root::Free,
            pose: table.pose("at")?,
            spheres: table.tables("sphere")?.iter().map(sphere).collect::<Result<_, _>>()?,
        })
    }

    fn read(table: &Table<'_>, name: String, materials: &[Material]) -> Result<Figure, SceneError> {
        let model = table.need("model", "the path of an .osim file, or `build` with a table, a mass and a height")?;
        let motion_place = table.get("motion").map_or_else(|| model.place(), |value| value.place());
        let motion = table.get("motion").map(|value| value.filled_text()).transpose()?;
        let sphere = |sphere: &Table<'_>| FigureSphere::read(sphere, materials);
        let figure = Figure {
            name,
            line: table.line,
            model_place: model.place(),
            built: None,
            model: model.filled_text()?,
            motion_place,
            from_s: table.get("from").map(|value| value.number()).transpose()?,
            driven: table.get("drive").map_or_else(|| Ok(Driven::of_file(motion.as_ref())), |value| driven(&value))?,
            root: table
                .get("root")
                .map_or(Ok(Root::Free), |value| value.choice(&[("free", Root::Free), ("driven", Root::Driven)]))?,
            pose: table.pose("at")?,
            spheres: table.tables("sphere")?.iter().map(sphere).collect::<Result<_, _>>()?,
            motion,
        };
        let follows = figure.driven != Driven::Nothing || figure.root == Root::Driven || figure.from_s.is_some();
        if figure.motion.is_none() && follows {
            return Err(table.missing("motion", "the path of a .mot file that the figure follows"));
        }
        Ok(figure)
    }
}

impl Driven {
    fn of_file(motion: Option<&String>) -> Driven {
        if motion.is_some() { Driven::All } else { Driven::Nothing }
    }
}

fn driven(value: &Value<'_>) -> Result<Driven, SceneError> {
    const EXPECTED: &str = "\"all\", \"none\", or a list of coordinates";
    match value.text() {
        Ok("all") => Ok(Driven::All),
        Ok("none") => Ok(Driven::Nothing),
        Ok(_) => Err(value.wrong(EXPECTED)),
        Err(_) => {
            let names: Result<Vec<String>, _> = value.list(EXPECTED)?.iter().map(Value::filled_text).collect();
            names.map(|names| if names.is_empty() { Driven::Nothing } else { Driven::Only(names) })
        }
    }
}

impl FigureSphere {
    fn read(table: &Table<'_>, materials: &[Material]) -> Result<FigureSphere, SceneError> {
        table.only(&[&["body", "at", "radius", "material"]])?;
        Ok(FigureSphere {
            line: table.line,
            body: table.need("body", "a body of the model")?.filled_text()?,
            at: table.vector_or_zero("at")?,
            radius: table.need("radius", "the radius [m]")?.above_zero()?,
            material: material::of_shape(table, materials)?,
        })
    }
}
