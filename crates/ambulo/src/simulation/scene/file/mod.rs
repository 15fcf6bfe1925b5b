//! The contents of a scene file as plain records.

mod names;

mod body;
mod built_figure;
mod closure;
mod coordinate;
mod event;
mod figure;
mod joint;
mod material;
mod obstacle;
mod output;
mod shape;
mod time_function;

pub use body::BodyEntry;
pub use built_figure::{ArmEntry, BuiltCoordinate, BuiltFigure, FigureWalkMode, GaitSource, WalkEntry, WalkTracking};
pub use closure::{Anchor, ClosureEntry};
pub use coordinate::{CoordinateEntry, CoordinateMotion, DriveEntry, MotorEntry};
pub use event::{EventAction, EventEntry};
pub use figure::{DrivenCoordinates, FigureEntry, FigureMotion, FigureSource, ModelFigure, RootMotion, SphereEntry};
pub use joint::{JointAxes, JointEntry};
pub use material::MaterialEntry;
pub use names::{Attachment, ContactPartner};
pub use obstacle::{ObstacleEntry, ObstacleMotionEntry};
pub use output::{Outputs, Plot};
pub use shape::ShapeEntry;
pub use time_function::TimeFunction;

pub(super) use closure::LARGEST_GAP_M;

use super::SceneError;
use crate::dynamics::{Method, SolverSettings};
use crate::simulation::{ImpactLaw, Integrator, StepSettings};
use crate::spatial::{STANDARD_GRAVITY, Vec3};
use crate::toml_reader::{Source, Table};
use names::Names;
use output::AllNames;

/// The contents of a scene file in SI units and radians, with references resolved and numbers checked.
#[derive(Debug, Clone)]
pub struct SceneFile {
    /// Title of the scene; may be empty.
    pub title: String,
    /// Gravity, world axes [m/s²].
    pub gravity: Vec3,
    /// Settings of the steps; the time step is above zero and at most the duration.
    pub stepping: StepSettings,
    /// Duration [s], above zero.
    pub duration_s: f64,
    /// The impact law.
    pub impact: ImpactLaw,
    /// Rows of output per second [Hz], at most one per step.
    pub output_rate_hz: f64,
    /// Materials; the first is `default`, the others have the order of the file.
    pub materials: Vec<MaterialEntry>,
    /// Rigid bodies, in the order of the file.
    pub bodies: Vec<BodyEntry>,
    /// Obstacles, in the order of the file.
    pub obstacles: Vec<ObstacleEntry>,
    /// Joints, in the order of the file; a parent's joint may come after its child's.
    pub joints: Vec<JointEntry>,
    /// Joints that close loops, in the order of the file.
    pub closures: Vec<ClosureEntry>,
    /// Events, in the order of time.
    pub events: Vec<EventEntry>,
    /// Figures, in the order of the file.
    pub figures: Vec<FigureEntry>,
    /// Pairs that never touch each other, in addition to bodies that a joint or closure connects.
    pub ignored: Vec<IgnoredPair>,
    /// The results that are written.
    pub outputs: Outputs,
}

/// A pair that never touch each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IgnoredPair {
    /// Line of its header.
    pub line: usize,
    /// The first partner.
    pub first: ContactPartner,
    /// The second partner; the same figure twice means that its bodies do not touch each other.
    pub second: ContactPartner,
}

const KEYS: &[&str] = &[
    "title",
    "gravity",
    "step",
    "duration",
    "integrator",
    "impact",
    "projection",
    "output_rate",
    "solver",
    "material",
    "body",
    "obstacle",
    "joint",
    "closure",
    "event",
    "figure",
    "ignore",
    "output",
];
/// Standard gravity, against y up [m/s²].
const GRAVITY: Vec3 = Vec3::new(0.0, -STANDARD_GRAVITY, 0.0);
/// Rows per second without `output_rate`; one per step if steps are longer.
const OUTPUT_RATE_HZ: f64 = 100.0;
/// Largest number of steps (1e9 microseconds are 17 minutes).
const MOST_STEPS: f64 = 1e9;
/// Relative rounding of 1/step.
const RATE_SLACK: f64 = 1e-9;

impl SceneFile {
    /// Reads a scene.
    ///
    /// # Errors
    /// The first error found, with line and key.
    pub fn parse(text: &str) -> Result<SceneFile, SceneError> {
        let source = Source::new(text, "docs/SCENES.md");
        let raw = source.parse()?;
        let root = Table::root(&source, &raw);
        root.only(&[KEYS])?;
        let (step_s, duration_s) = times(&root)?;
        let materials = material::read_all(&root)?;
        let (mut things, mut links) = (Names::default(), Names::default());
        let bodies = BodyEntry::read_all(&root, &mut things, &materials)?;
        let obstacles = ObstacleEntry::read_all(&root, &mut things, &materials, duration_s)?;
        let figures = FigureEntry::read_all(&root, &mut things, &materials, duration_s)?;
        if bodies.is_empty() && figures.is_empty() {
            return Err(root.missing("body", "at least one [[body]] or [[figure]]"));
        }
        let integrator = integrator(&root)?;
        let joints = JointEntry::read_all(&root, &mut links, &things, &bodies, duration_s)?;
        let closures = ClosureEntry::read_all(&root, &mut links, &things, &bodies)?;
        Ok(SceneFile {
            title: root.get("title").map_or(Ok(""), |value| value.text())?.to_owned(),
            gravity: root.get("gravity").map_or(Ok(GRAVITY), |value| value.vector())?,
            duration_s,
            impact: impact(&root, integrator)?,
            stepping: StepSettings {
                step_s,
                integrator,
                projection: root.truth_or("projection", true)?,
                solver: solver(&root)?,
            },
            output_rate_hz: output_rate(&root, step_s)?,
            events: event::read_all(&root, &links, (&joints, &closures), duration_s)?,
            ignored: ignored(&root, &things)?,
            outputs: output::read(&root, &AllNames { things: &things, links: &links })?,
            materials,
            bodies,
            obstacles,
            joints,
            closures,
            figures,
        })
    }

    /// Name of an attachment as written in the scene file.
    #[must_use]
    pub fn attachment_name(&self, attachment: &Attachment) -> String {
        match attachment {
            Attachment::World => "world".into(),
            Attachment::Body(body) => self.bodies[*body].name.clone(),
            Attachment::FigureBody { figure, body } => format!("{}/{body}", self.figures[*figure].name),
        }
    }
}

fn times(root: &Table<'_>) -> Result<(f64, f64), SceneError> {
    let duration_s = root.need("duration", "the duration of the scene [s]")?.above_zero()?;
    let value = root.need("step", "the time step [s], such as 0.001")?;
    let step_s = value.above_zero()?;
    if step_s > duration_s {
        return Err(value.wrong(&format!("a step of at most {duration_s} s, the duration")));
    }
    if duration_s / step_s > MOST_STEPS {
        return Err(value.wrong(&format!("at most 1e9 steps; these are {:e}", duration_s / step_s)));
    }
    Ok((step_s, duration_s))
}

fn output_rate(root: &Table<'_>, step_s: f64) -> Result<f64, SceneError> {
    let Some(value) = root.get("output_rate") else { return Ok(OUTPUT_RATE_HZ.min(1.0 / step_s)) };
    let rate = value.above_zero()?;
    if rate * step_s > 1.0 + RATE_SLACK {
        return Err(value.wrong(&format!("at most one row per step, {} per second", 1.0 / step_s)));
    }
    Ok(rate)
}

fn integrator(root: &Table<'_>) -> Result<Integrator, SceneError> {
    let words = [("impulse", Integrator::Impulse), ("runge-kutta", Integrator::RungeKutta)];
    root.get("integrator").map_or(Ok(Integrator::Impulse), |value| value.choice(&words))
}

/// The impact law; `sticking` needs steps of impulses.
fn impact(root: &Table<'_>, integrator: Integrator) -> Result<ImpactLaw, SceneError> {
    let words = [("coulomb", ImpactLaw::Coulomb), ("sticking", ImpactLaw::Sticking)];
    let Some(value) = root.get("impact") else { return Ok(ImpactLaw::Coulomb) };
    let impact = value.choice(&words)?;
    if impact == ImpactLaw::Sticking && integrator == Integrator::RungeKutta {
        return Err(value.wrong("\"coulomb\" with the integrator \"runge-kutta\""));
    }
    Ok(impact)
}

fn solver(root: &Table<'_>) -> Result<SolverSettings, SceneError> {
    let default = SolverSettings::default();
    let Some(value) = root.get("solver") else { return Ok(default) };
    let table = value.table("a table under the header [solver]")?;
    table.only(&[&["method", "tolerance", "max_iterations"]])?;
    let words = [("newton", Method::Newton), ("conjugate-gradient", Method::ConjugateGradient)];
    let tolerance = table.above_zero_or("tolerance", default.tolerance)?;
    if let Some(value) = table.get("tolerance").filter(|_| tolerance >= 1.0) {
        return Err(value.wrong("a number between 0 and 1"));
    }
    Ok(SolverSettings {
        method: table.get("method").map_or(Ok(default.method), |value| value.choice(&words))?,
        tolerance,
        max_iterations: table.get("max_iterations").map_or(Ok(default.max_iterations), |value| value.count())?,
    })
}

fn ignored(root: &Table<'_>, things: &Names) -> Result<Vec<IgnoredPair>, SceneError> {
    let read = |table: &Table<'_>| {
        table.only(&[&["pair"]])?;
        let value = table.need("pair", "two names")?;
        let [first, second] = &value.list("two names")?[..] else { return Err(value.wrong("two names")) };
        let (first, second) = (things.contact_partner(first)?, things.contact_partner(second)?);
        if first == second && !matches!(first, ContactPartner::Figure(_)) {
            return Err(value.wrong("two different names"));
        }
        Ok(IgnoredPair { line: table.line, first, second })
    };
    root.tables("ignore")?.iter().map(read).collect()
}
