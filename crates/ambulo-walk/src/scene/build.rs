//! Builds a world from a scene file.

use super::acting::acting;
use super::built_figure;
use super::checks::SceneChecks;
use super::closing::Closing;
use super::closure::ClosureEntry;
use super::coordinate::CoordinateEntry;
use super::event::EventEntry;
use super::figure::FigureEntry;
use super::file::SceneFile;
use super::model_figure::{self, PlacedFigure};
use super::names::{Attachment, ContactPartner};
use super::output::Outputs;
use super::placement::{order, place};
use super::recorder::Recorder;
use super::solver::IntegratorReason;
use super::sources::{InputFiles, ReadFile};
use super::starting::start_moving;
use super::surfaces::{material, obstacle, solid};
use super::{Place, SceneError};
use crate::engine::start::start;
use crate::engine::state::WorldState;
use crate::engine::workspace::{Integrator, StepSettings, StepWorkspace};
use crate::engine::world::{
    Closure, ContactLaw, JointCoordinate, Obstacle, ObstaclePath, Owner, RigidBody, Surface, TreeJoint, World,
};
use crate::findings::{Code, Findings};
use crate::optimal::Observer;
use crate::spatial::{Pose, Twist, Vec3, Wrench};
use crate::walking::half_a_step_earlier;

/// Largest initial distance of the points of an active closure with a body of a figure [m].
const LARGEST_GAP_M: f64 = 1e-3;

/// A world with its state, its events and its outputs.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(super) world: World,
    pub(super) state: WorldState,
    pub(super) settings: StepSettings,
    pub(super) integrator_reason: IntegratorReason,
    pub(super) duration_s: f64,
    pub(super) output_rate_hz: f64,
    pub(super) outputs: Outputs,
    pub(super) title: String,
    pub(super) events: Vec<EventEntry>,
    /// Number of events that have happened.
    pub(super) fired: usize,
    /// Number of steps made.
    pub(super) steps: usize,
    pub(super) closings: Vec<Closing>,
    /// Index in the world of each joint of the file; `None` once an event has removed it.
    pub(super) joint_numbers: Vec<Option<usize>>,
    /// Names of the file's joints and bodies, for figures.
    pub(super) joint_names: Vec<String>,
    pub(super) walkers: Vec<PlacedFigure>,
    /// Recorders of the walking figures.
    pub(super) recorders: Vec<Recorder>,
    pub(super) workspace: StepWorkspace,
    pub(super) checks: SceneChecks,
    /// Poses at the beginning of the last step, to which its forces belong; only if there are figures.
    pub(super) before: Vec<Pose>,
    /// Whether the velocities at the start belong to half a step earlier.
    pub(super) starts_early: bool,
    /// Number of steps that were made before this run.
    pub(super) resumed: usize,
    /// Scratch memory of the forces at an instant.
    pub(super) probe: StepWorkspace,
}

/// Settings that replace settings of the file, and an observer.
#[derive(Debug, Clone, Default)]
pub struct SceneSettings {
    /// Time step [s].
    pub step_s: Option<f64>,
    /// Duration [s].
    pub duration_s: Option<f64>,
    /// Follows the steps of the solver that plans the walks of figures, and may stop them.
    pub observer: Observer,
}

impl Scene {
    /// Builds the world of a scene. `load` reads the files that it names: it takes a path as written in the scene and
    /// returns bytes or an error message.
    ///
    /// # Errors
    /// Files that cannot be read or do not fit, bodies that a figure lacks, joints of a figure that the simulator does
    /// not support; each with line and key.
    ///
    /// A ball that falls for a tenth of a second:
    ///
    /// ```
    /// use ambulo_walk::findings::Findings;
    /// use ambulo_walk::scene::{Scene, SceneFile, SceneSettings};
    ///
    /// let text = "step = 0.001\nduration = 0.1\n[[body]]\nname = \"ball\"\nmass = 1.0\ninertia = [0.1, 0.1, 0.1]\nposition = [0, 1, 0]";
    /// let mut findings = Findings::default();
    /// let mut no_files = |path: &str| Err(format!("{path}: this scene names no files"));
    /// let file = SceneFile::parse(text)?;
    /// let mut scene = Scene::build(&file, SceneSettings::default(), &mut no_files, &mut findings)?;
    /// scene.run(&mut findings, |_| ())?;
    /// let height = scene.state().poses[0].translation.y;
    /// assert!((height - (1.0 - 0.5 * 9.80665 * 0.1 * 0.1)).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn build(
        file: &SceneFile,
        changes: SceneSettings,
        load: &mut ReadFile<'_>,
        findings: &mut Findings,
    ) -> Result<Scene, SceneError> {
        let duration_s = changes.duration_s.unwrap_or(file.duration_s);
        let mut sources = InputFiles::new(load, findings, duration_s, settings(file, &changes));
        sources.observer = changes.observer.clone();
        sources.signals = file.joints.iter().map(|joint| joint.name.clone()).collect();
        let mut world = World { gravity: file.gravity, impact: file.impact, ..World::default() };
        world.materials = file.materials.iter().map(material).collect();
        let (walkers, recorders) = add_bodies(&mut world, file, &mut sources)?;
        let bodies = Bodies { file, walkers: &walkers, world: &world };
        let (joints, starts, rates) = make_joints(&bodies, &mut sources)?;
        let figure_joints = std::mem::take(&mut world.joints);
        let joint_numbers = (0..joints.len()).map(Some).collect();
        world.joints = joints;
        world.joints.extend(figure_joints);
        start_moving(&mut world, file, &rates);
        let closings = add_closures(&mut world, file, &walkers)?;
        let ignored = ignored(&world, file, &walkers)?;
        world.ignored.extend(ignored);
        report_untouchable(&world, findings);
        let mut state = WorldState::new(&world);
        for (number, start) in starts.iter().enumerate() {
            state.coordinates[number].copy_from_slice(start);
            state.measure(&world, number);
        }
        let settings = settings(file, &changes);
        let trees = |error: crate::dynamics::LinkError| Place { line: 1, key: "joint".into() }.error(error.to_string());
        start(&world, &mut state, &settings.solver, findings).map_err(trees)?;
        let starts_early = start_half_a_step_earlier(&mut state, &walkers, &settings);
        let checks = SceneChecks::new(&world, &state);
        Ok(Scene {
            settings,
            integrator_reason: file.integrator_reason,
            checks,
            duration_s,
            output_rate_hz: file.output_rate_hz.min(1.0 / changes.step_s.unwrap_or(file.step_s)),
            outputs: file.outputs.clone(),
            title: file.title.clone(),
            events: file.events.clone(),
            fired: 0,
            steps: 0,
            closings,
            joint_numbers,
            joint_names: file.joints.iter().map(|joint| joint.name.clone()).collect(),
            walkers,
            recorders,
            workspace: StepWorkspace::default(),
            before: Vec::new(),
            resumed: 0,
            starts_early,
            probe: StepWorkspace::default(),
            world,
            state,
        })
    }
}

pub(super) fn settings(file: &SceneFile, changes: &SceneSettings) -> StepSettings {
    StepSettings {
        step_s: changes.step_s.unwrap_or(file.step_s),
        integrator: file.integrator,
        projection: file.projection,
        solver: file.solver,
    }
}

/// Gives figures whose motion before the start is known the velocities of half a time step earlier, where velocities
/// belong to the middle of a step (`Walker::moving_as`). Returns whether there are any.
fn start_half_a_step_earlier(state: &mut WorldState, figures: &[PlacedFigure], settings: &StepSettings) -> bool {
    if settings.integrator != Integrator::Impulse {
        return false;
    }
    for figure in figures {
        for (twist, acceleration) in state.twists[figure.first_body..].iter_mut().zip(&figure.accelerations) {
            *twist = half_a_step_earlier(*twist, *acceleration, settings.step_s);
        }
    }
    figures.iter().any(|figure| !figure.accelerations.is_empty())
}

/// Adds bodies, obstacles and figures, with their surfaces and the joints of the figures.
fn add_bodies(
    world: &mut World,
    file: &SceneFile,
    sources: &mut InputFiles<'_, '_>,
) -> Result<(Vec<PlacedFigure>, Vec<Recorder>), SceneError> {
    for (i, body) in file.bodies.iter().enumerate() {
        world.bodies.push(RigidBody {
            name: body.name.clone(),
            mass: body.inertia.mass(),
            inertia: body.inertia.about_center(),
            pose: body.start,
            twist: Twist::ZERO,
            load: Wrench::ZERO,
        });
        for (k, shape) in body.shapes.iter().enumerate() {
            let place = Place { line: shape.line, key: format!("body[{}].shape[{}]", i + 1, k + 1) };
            world.surfaces.push(Surface {
                owner: Owner::Body(i),
                shape: solid(&shape.solid, &place)?,
                owner_from_shape: shape.pose,
                material: shape.material,
            });
        }
    }
    for (i, entry) in file.obstacles.iter().enumerate() {
        let place = Place { line: entry.line, key: format!("obstacle[{}]", i + 1) };
        let (shape, owner_from_shape) = obstacle(&entry.shape, &place)?;
        let (owner, material) = (Owner::Obstacle(i), entry.material);
        world.surfaces.push(Surface { owner, shape, owner_from_shape, material });
        let path = entry.motion.as_ref().map(|motion| -> Result<ObstaclePath, SceneError> {
            let place = Place { line: motion.line, key: format!("obstacle[{}].motion", i + 1) };
            let [x, y, z] = &motion.displacement;
            Ok(ObstaclePath {
                shift: [
                    sources.signal(&place, x, false)?,
                    sources.signal(&place, y, false)?,
                    sources.signal(&place, z, false)?,
                ],
                axis: motion.axis,
                turn: sources.signal(&place, &motion.angle, true)?,
            })
        });
        world.obstacles.push(Obstacle { name: entry.name.clone(), pose: entry.pose, path: path.transpose()? });
    }
    let add = |(i, figure): (usize, &FigureEntry)| match &figure.built {
        Some(built) => built_figure::add(world, figure, built, i + 1, sources),
        None => model_figure::add(world, figure, i + 1, sources),
    };
    let added: Vec<(PlacedFigure, Option<Recorder>)> =
        file.figures.iter().enumerate().map(add).collect::<Result<_, _>>()?;
    let (walkers, recorders): (Vec<_>, Vec<_>) = added.into_iter().unzip();
    Ok((walkers, recorders.into_iter().flatten().collect()))
}

/// Looks up the bodies of the world that attachments refer to.
struct Bodies<'a> {
    file: &'a SceneFile,
    walkers: &'a [PlacedFigure],
    world: &'a World,
}

impl Bodies<'_> {
    /// The body of an attachment; `None` is the world.
    fn of(&self, carrier: &Attachment, place: impl Fn() -> Place) -> Result<Option<usize>, SceneError> {
        self.point_of(carrier, place).map(|(body, _)| body)
    }

    /// The body of an attachment and the reference point for points on it: the mass centre, or a marker of a figure.
    fn point_of(&self, carrier: &Attachment, place: impl Fn() -> Place) -> Result<(Option<usize>, Vec3), SceneError> {
        match carrier {
            Attachment::World => Ok((None, Vec3::zeros())),
            Attachment::Body(body) => Ok((Some(*body), Vec3::zeros())),
            Attachment::FigureBody { figure, body } => {
                self.of_figure(*figure, body, place).map(|(body, point)| (Some(body), point))
            }
        }
    }

    fn of_figure(&self, figure: usize, body: &str, place: impl Fn() -> Place) -> Result<(usize, Vec3), SceneError> {
        let (walker, name) = (&self.walkers[figure], &self.file.figures[figure].name);
        let model = &self.world.figures[walker.figure].model;
        if let Some(id) = model.body(body) {
            return Ok((walker.first_body + id.index(), Vec3::zeros()));
        }
        let marker = model.markers().iter().find(|marker| marker.name == body);
        if let Some((marker, id)) = marker.and_then(|marker| Some((marker, marker.body?))) {
            let point = marker.location - model.bodies()[id.index()].inertia.center();
            return Ok((walker.first_body + id.index(), point));
        }
        let known: Vec<String> = model.bodies().iter().map(|b| format!("{name}/{}", b.name)).collect();
        let found = format!("found \"{name}/{body}\"; expected a body of the figure");
        Err(place().error(found).hint(&format!("the bodies are {}", known.join(", "))))
    }
}

/// Joints with the initial values and rates of their coordinates, in the simulator's order.
type Started = (Vec<TreeJoint>, Vec<Vec<f64>>, Vec<Vec<f64>>);

fn make_joints(bodies: &Bodies<'_>, sources: &mut InputFiles<'_, '_>) -> Result<Started, SceneError> {
    let Bodies { file, world, .. } = bodies;
    let (mut joints, mut starts, mut rates) = (Vec::new(), Vec::new(), Vec::new());
    for (i, entry) in file.joints.iter().enumerate() {
        let parent =
            bodies.of(&entry.parent, || Place { line: entry.line, key: format!("joint[{}].parent", i + 1) })?;
        let mut coordinates = Vec::new();
        for (k, coordinate) in entry.coordinates.iter().enumerate() {
            let key = format!("joint[{}].coordinate[{}]", i + 1, k + 1);
            coordinates.push(acting(coordinate, &Place { line: coordinate.line, key }, sources)?);
        }
        let start = |(entry, acting): (&CoordinateEntry, &JointCoordinate)| match &acting.drive {
            Some(drive) => {
                let [value, rate, _] = drive.signal.at(0.0);
                (value, rate)
            }
            None => (entry.start, entry.rate),
        };
        let (values, speeds): (Vec<f64>, Vec<f64>) = entry.coordinates.iter().zip(&coordinates).map(start).unzip();
        let placed = place(&entry.kind, entry.at, &values);
        let order = order(placed.kind);
        let on =
            |body: Option<usize>, frame: Pose| body.map_or(frame, |body| world.bodies[body].pose.inverse() * frame);
        joints.push(TreeJoint {
            name: entry.name.clone(),
            child: entry.child,
            parent,
            parent_from_joint: on(parent, placed.world_from_parent_side),
            child_from_joint: on(Some(entry.child), placed.world_from_child_side),
            kind: placed.kind,
            coordinates: (0..placed.kind.freedom()).map(|k| coordinates[order[k]].clone()).collect(),
            follows: None,
        });
        starts.push(placed.values);
        rates.push((0..placed.kind.freedom()).map(|k| speeds[order[k]]).collect());
    }
    Ok((joints, starts, rates))
}

fn add_closures(world: &mut World, file: &SceneFile, walkers: &[PlacedFigure]) -> Result<Vec<Closing>, SceneError> {
    let mut closings = Vec::new();
    for (i, entry) in file.closures.iter().enumerate() {
        let place = |key: &str| Place { line: entry.line, key: format!("closure[{}].{key}", i + 1) };
        let bodies = Bodies { file, walkers, world };
        let (first, on_first) = bodies.point_of(&entry.first, || place("first"))?;
        let (second, on_second) = bodies.point_of(&entry.second, || place("second"))?;
        let entry = &ClosureEntry { anchor: entry.anchor.shifted(on_first, on_second), ..entry.clone() };
        let pose = |body: Option<usize>| body.map_or(Pose::IDENTITY, |body| world.bodies[body].pose);
        let Some(closing) = Closing::new(entry, [first, second], [pose(first), pose(second)]) else {
            return Err(place("second").error("found the world at both ends; expected a body at one of them"));
        };
        let [on, other] = [world.bodies[closing.first].pose, pose(closing.second)];
        let gap = closing.gap(&on, &other);
        if entry.active && gap > LARGEST_GAP_M {
            let found = format!(
                "found points that are {gap:.4} m apart; expected points that coincide at the start, within 1 mm"
            );
            let advice = "move the bodies, or set active = false and add the closure by an [[event]]";
            return Err(place("on_second").error(found).hint(advice));
        }
        let (first_from_joint, second_from_joint) = closing.frames(&on, &other);
        world.closures.push(Closure {
            name: entry.name.clone(),
            first: closing.first,
            second: closing.second,
            first_from_joint,
            second_from_joint,
            kind: super::placement::kind(&entry.kind),
            active: entry.active,
        });
        closings.push(closing);
    }
    Ok(closings)
}

fn ignored(world: &World, file: &SceneFile, walkers: &[PlacedFigure]) -> Result<Vec<(Owner, Owner)>, SceneError> {
    let bodies = Bodies { file, walkers, world };
    let mut pairs = Vec::new();
    for (i, pair) in file.ignored.iter().enumerate() {
        let place = || Place { line: pair.line, key: format!("ignore[{}].pair", i + 1) };
        let owners = |partner: &ContactPartner| -> Result<Vec<Owner>, SceneError> {
            Ok(match partner {
                ContactPartner::Body(body) => vec![Owner::Body(*body)],
                ContactPartner::Obstacle(obstacle) => vec![Owner::Obstacle(*obstacle)],
                ContactPartner::FigureBody { figure, body } => {
                    vec![Owner::Body(bodies.of_figure(*figure, body, place)?.0)]
                }
                ContactPartner::Figure(figure) => {
                    let walker = &walkers[*figure];
                    let count = world.figures[walker.figure].model.bodies().len();
                    (walker.first_body..walker.first_body + count).map(Owner::Body).collect()
                }
            })
        };
        let (first, second) = (owners(&pair.first)?, owners(&pair.second)?);
        pairs.extend(first.iter().flat_map(|a| second.iter().filter(move |b| a != *b).map(move |b| (*a, *b))));
    }
    // Only owners that can touch make a difference.
    let touches = |owner: &Owner| world.surfaces.iter().any(|surface| surface.owner == *owner);
    pairs.retain(|(a, b)| touches(a) && touches(b));
    Ok(pairs)
}

/// Warns about pairs without a contact force: Hunt and Crossley's law requires a round shape on one side.
fn report_untouchable(world: &World, findings: &mut Findings) {
    let soft = |surface: &Surface| matches!(world.materials[surface.material].law, ContactLaw::HuntCrossley(_));
    for (i, a) in world.surfaces.iter().enumerate() {
        for b in &world.surfaces[i + 1..] {
            let fixed = matches!((a.owner, b.owner), (Owner::Obstacle(_), Owner::Obstacle(_)));
            let round = a.shape.radius().is_some() || b.shape.radius().is_some();
            if a.owner != b.owner && !fixed && !round && (soft(a) || soft(b)) {
                let (a, b) = (world.owner_name(a.owner), world.owner_name(b.owner));
                findings.report(
                    Code::ContactNotRound,
                    format!(
                        "`{a}` and `{b}` pass through each other: the law hunt-crossley requires a sphere or a capsule \
                         on one \
                         side. hint: law = \"regularised\""
                    ),
                );
            }
        }
    }
}
