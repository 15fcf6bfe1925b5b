//! Reads a whole scene file.

use super::SceneError;
use super::body::BodyEntry;
use super::closure::ClosureEntry;
use super::event::{self, EventEntry};
use super::figure::FigureEntry;
use super::joint::JointEntry;
use super::material::{self, MaterialEntry};
use super::names::{ContactPartner, Item, Names};
use super::obstacle::ObstacleEntry;
use super::output::{self, Outputs};
use super::solver::{IntegratorReason, STICKING, read_impact, read_integrator, read_solver};
use super::tree;
use crate::dynamics::SolverSettings;
use crate::engine::{ImpactLaw, Integrator};
use crate::spatial::{STANDARD_GRAVITY, Vec3};
use crate::toml_reader::{Source, Table};

/// The content of a scene file, in SI units and radians, with references resolved and numbers checked.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneFile {
    /// Title; may be empty.
    pub title: String,
    /// Gravity in the world [m/s²].
    pub gravity: Vec3,
    /// Time step [s], above zero, at most the duration.
    pub step_s: f64,
    /// Duration [s], above zero.
    pub duration_s: f64,
    /// The integrator.
    pub integrator: Integrator,
    /// Why it is this one.
    pub integrator_reason: IntegratorReason,
    /// The impact law.
    pub impact: ImpactLaw,
    /// Whether positions are projected back onto the constraints after each step.
    pub projection: bool,
    /// Rate of output rows [Hz], at most one per step.
    pub output_rate_hz: f64,
    /// Settings of the constraint solver.
    pub solver: SolverSettings,
    /// Materials: first `default`, then in the order of the file.
    pub materials: Vec<MaterialEntry>,
    /// Rigid bodies, in the order of the file.
    pub bodies: Vec<BodyEntry>,
    /// Solids that forces do not move, in the order of the file.
    pub obstacles: Vec<ObstacleEntry>,
    /// Joints, in the order of the file; a parent's joint may follow its child's.
    pub joints: Vec<JointEntry>,
    /// Joints that close loops, in the order of the file.
    pub closures: Vec<ClosureEntry>,
    /// Events, in order of time.
    pub events: Vec<EventEntry>,
    /// Figures, in the order of the file.
    pub figures: Vec<FigureEntry>,
    /// Pairs that pass through each other, in addition to those that a joint or closure connects.
    pub ignored: Vec<IgnoredPair>,
    /// The results to write.
    pub outputs: Outputs,
}

/// Two parts of a scene that pass through each other.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct IgnoredPair {
    /// Line of its header.
    pub line: usize,
    /// The first part.
    pub first: ContactPartner,
    /// The second part; the same figure as the first if its bodies ignore each other.
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
/// Standard gravity along -y [m/s²].
const GRAVITY: Vec3 = Vec3::new(0.0, -STANDARD_GRAVITY, 0.0);
/// Default output rate; one row per step if steps are longer.
const OUTPUT_RATE_HZ: f64 = 100.0;
/// More steps are a mistake: eleven days at a microsecond per step would be 1e12.
pub(super) const MOST_STEPS: f64 = 1e9;
/// Rounding of 1/step, relative.
const RATE_SLACK: f64 = 1e-9;

impl SceneFile {
    /// Reads a scene.
    ///
    /// # Errors
    /// The first error in the file, with line and key.
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
        let joints = joints(&root, &mut links, &things, &bodies, duration_s)?;
        let closures = closures(&root, &mut links, &things, &bodies)?;
        let of_scene = || {
            let carriers = bodies.iter().filter(|body| !body.shapes.is_empty()).count();
            let is_driven = |joint: &JointEntry| joint.coordinates.iter().any(|c| c.drive.is_some());
            let sticks = root.get("impact").is_some_and(|value| value.text().is_ok_and(|word| word == STICKING));
            match (
                figures.is_empty() && !joints.iter().any(is_driven),
                sticks || carriers > 0,
                sticks || carriers + obstacles.len() > 1,
            ) {
                (false, ..) => IntegratorReason::Driven,
                (true, true, true) => IntegratorReason::MayTouch,
                _ => IntegratorReason::FreeMotion,
            }
        };
        let (integrator, integrator_reason) = read_integrator(&root, of_scene)?;
        Ok(SceneFile {
            title: root.get("title").map_or(Ok(""), |value| value.text())?.to_owned(),
            gravity: root.get("gravity").map_or(Ok(GRAVITY), |value| value.vector())?,
            step_s,
            duration_s,
            integrator,
            integrator_reason,
            impact: read_impact(&root, integrator)?,
            projection: root.truth_or("projection", true)?,
            output_rate_hz: output_rate(&root, step_s)?,
            solver: read_solver(&root)?,
            events: event::read_all(&root, &links, (&joints, &closures), duration_s)?,
            ignored: ignored(&root, &things)?,
            outputs: output::read(&root, &things, &links)?,
            materials,
            bodies,
            obstacles,
            joints,
            closures,
            figures,
        })
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
        return Err(value.wrong(&format!("at most one row per step, {} Hz", 1.0 / step_s)));
    }
    Ok(rate)
}

fn joints(
    root: &Table<'_>,
    links: &mut Names,
    things: &Names,
    bodies: &[BodyEntry],
    duration_s: f64,
) -> Result<Vec<JointEntry>, SceneError> {
    let tables = root.tables("joint")?;
    let mut joints = Vec::new();
    for (i, table) in tables.iter().enumerate() {
        let name = links.declare(table, Item::Joint(i))?;
        joints.push(JointEntry::read(table, name, things, bodies, duration_s)?);
    }
    tree::check(&joints, &tables, bodies)?;
    Ok(joints)
}

fn closures(
    root: &Table<'_>,
    links: &mut Names,
    things: &Names,
    bodies: &[BodyEntry],
) -> Result<Vec<ClosureEntry>, SceneError> {
    let read = |(i, table): (usize, &Table<'_>)| {
        let name = links.declare(table, Item::Closure(i))?;
        ClosureEntry::read(table, name, things, bodies)
    };
    root.tables("closure")?.iter().enumerate().map(read).collect()
}

fn ignored(root: &Table<'_>, things: &Names) -> Result<Vec<IgnoredPair>, SceneError> {
    let read = |table: &Table<'_>| {
        table.only(&[&["pair"]])?;
        let value = table.need("pair", "two names")?;
        let [first, second] = &value.list("two names")?[..] else { return Err(value.wrong("two names")) };
        let (first, second) = (things.partner(first)?, things.partner(second)?);
        if first == second && !matches!(first, ContactPartner::Figure(_)) {
            return Err(value.wrong("two different names"));
        }
        Ok(IgnoredPair { line: table.line, first, second })
    };
    root.tables("ignore")?.iter().map(read).collect()
}
