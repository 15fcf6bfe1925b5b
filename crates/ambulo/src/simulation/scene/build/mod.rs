//! Builds the world of a scene file.

mod built_figure;
mod initial_velocity;
mod input_files;
pub(super) mod model_figure;
mod placement;

pub use input_files::ReadFile;

use super::SceneError;
use super::figure_recorder::FigureRecorder;
use super::file::{
    Attachment, ClosureEntry, ContactPartner, CoordinateEntry, EventEntry, FigureEntry, FigureSource, LARGEST_GAP_M,
    Outputs, SceneFile,
};
use crate::findings::{Code, Findings};
use crate::simulation::{
    Closure, ContactLaw, JointCoordinate, Obstacle, ObstaclePath, Owner, RigidBody, StepSettings, StepWorkspace,
    Surface, TreeJoint, World, WorldState,
};
use crate::spatial::{Pose, Twist, Vec3, Wrench};
use crate::toml_reader::Place;
use built_figure::CorrectedWalks;
use initial_velocity::set_initial_velocities;
use input_files::InputFiles;
use model_figure::PlacedFigure;
use placement::{ClosurePlacement, order, place};

/// A world with its state, its events and its outputs.
#[derive(Debug, Clone)]
pub struct Scene {
    pub(super) world: World,
    pub(super) state: WorldState,
    pub(super) settings: StepSettings,
    pub(super) duration_s: f64,
    pub(super) output_rate_hz: f64,
    pub(super) outputs: Outputs,
    pub(super) title: String,
    pub(super) events: Vec<EventEntry>,
    /// Number of events that have happened.
    pub(super) fired: usize,
    /// Number of steps made.
    pub(super) steps: usize,
    pub(super) closure_placements: Vec<ClosurePlacement>,
    /// Index in the world of each joint of the file; `None` once it is removed.
    pub(super) joint_numbers: Vec<Option<usize>>,
    /// Names of the file's joints, for plots.
    pub(super) joint_names: Vec<String>,
    pub(super) figures: Vec<PlacedFigure>,
    /// Recorders of the walking figures.
    pub(super) recorders: Vec<FigureRecorder>,
    pub(super) workspace: StepWorkspace,
    /// Poses at the start of the last step, to which its forces belong; only if there are figures.
    pub(super) before: Vec<Pose>,
}

/// Settings that replace those of the scene file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SceneSettings {
    /// Time step [s].
    pub step_s: Option<f64>,
    /// Duration [s].
    pub duration_s: Option<f64>,
}

impl Scene {
    /// Builds the world of a scene. `read` reads the files that it names: it takes a path as in the scene file and returns the
    /// bytes or an error message.
    ///
    /// # Errors
    /// Files that cannot be read or do not fit, unknown bodies of a figure, or joints of a figure that the simulator does not
    /// support; each with line and key.
    pub fn build(
        file: &SceneFile,
        settings: SceneSettings,
        read: &mut ReadFile<'_>,
        findings: &mut Findings,
    ) -> Result<Scene, SceneError> {
        let duration_s = settings.duration_s.unwrap_or(file.duration_s);
        let step_s = settings.step_s.unwrap_or(file.stepping.step_s);
        let mut files = InputFiles::new(read, findings, duration_s);
        let mut world = World { gravity: file.gravity, impact: file.impact, ..World::default() };
        world.materials = file.materials.iter().map(|entry| entry.material.clone()).collect();
        let (figures, recorders) = add_bodies(&mut world, file, &mut files)?;
        let bodies = Bodies { file, figures: &figures, world: &world };
        let (joints, starts, rates) = make_joints(&bodies, &mut files)?;
        let figure_joints = std::mem::take(&mut world.joints);
        let joint_numbers = (0..joints.len()).map(Some).collect();
        world.joints = joints;
        world.joints.extend(figure_joints);
        set_initial_velocities(&mut world, file, &rates);
        let closure_placements = add_closures(&mut world, file, &figures)?;
        let ignored = ignored(&world, file, &figures)?;
        world.ignored.extend(ignored);
        report_untouchable(&world, findings);
        let mut state = WorldState::new(&world);
        for (number, start) in starts.iter().enumerate() {
            state.coordinates[number].copy_from_slice(start);
            state.measure(&world, number);
        }
        Ok(Scene {
            settings: StepSettings { step_s, ..file.stepping },
            duration_s,
            output_rate_hz: file.output_rate_hz.min(1.0 / step_s),
            outputs: file.outputs.clone(),
            title: file.title.clone(),
            events: file.events.clone(),
            fired: 0,
            steps: 0,
            closure_placements,
            joint_numbers,
            joint_names: file.joints.iter().map(|joint| joint.name.clone()).collect(),
            figures,
            recorders,
            workspace: StepWorkspace::default(),
            before: Vec::new(),
            world,
            state,
        })
    }
}

/// Adds bodies, obstacles and figures with their surfaces, and the joints of the figures.
fn add_bodies(
    world: &mut World,
    file: &SceneFile,
    files: &mut InputFiles<'_, '_>,
) -> Result<(Vec<PlacedFigure>, Vec<FigureRecorder>), SceneError> {
    for (i, body) in file.bodies.iter().enumerate() {
        world.bodies.push(RigidBody {
            name: body.name.clone(),
            mass: body.inertia.mass(),
            inertia: body.inertia.about_center(),
            pose: body.start,
            twist: Twist::ZERO,
            load: Wrench::ZERO,
        });
        world.surfaces.extend(body.shapes.iter().map(|entry| Surface {
            owner: Owner::Body(i),
            shape: entry.shape.clone(),
            owner_from_shape: entry.pose,
            material: entry.material,
        }));
    }
    for (i, entry) in file.obstacles.iter().enumerate() {
        world.surfaces.push(Surface {
            owner: Owner::Obstacle(i),
            shape: entry.shape.clone(),
            owner_from_shape: entry.obstacle_from_shape,
            material: entry.material,
        });
        let path = entry.motion.as_ref().map(|motion| -> Result<ObstaclePath, SceneError> {
            let [x, y, z] = &motion.displacement;
            Ok(ObstaclePath {
                shift: [files.signal(x, false)?, files.signal(y, false)?, files.signal(z, false)?],
                axis: motion.axis,
                turn: files.signal(&motion.angle, true)?,
            })
        });
        world.obstacles.push(Obstacle { name: entry.name.clone(), pose: entry.pose, path: path.transpose()? });
    }
    let mut corrected = CorrectedWalks::default();
    let add = |(i, entry): (usize, &FigureEntry)| match &entry.source {
        FigureSource::Built(built) => built_figure::add(world, entry, built, i + 1, files, &mut corrected),
        FigureSource::Model(model) => {
            model_figure::add(world, (entry, model), i + 1, files).map(|figure| (figure, None))
        }
    };
    let added: Vec<(PlacedFigure, Option<FigureRecorder>)> =
        file.figures.iter().enumerate().map(add).collect::<Result<_, _>>()?;
    let (figures, recorders): (Vec<_>, Vec<_>) = added.into_iter().unzip();
    Ok((figures, recorders.into_iter().flatten().collect()))
}

/// Finds the bodies of the world for names of the file.
struct Bodies<'a> {
    file: &'a SceneFile,
    figures: &'a [PlacedFigure],
    world: &'a World,
}

impl Bodies<'_> {
    /// The body of an attachment; `None` is the world.
    fn of(&self, carrier: &Attachment, place: impl Fn() -> Place) -> Result<Option<usize>, SceneError> {
        self.point_of(carrier, place).map(|(body, _)| body)
    }

    /// The body of an attachment, and the origin of points on it: the mass centre, or a marker of a figure.
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
        let (walker, name) = (&self.figures[figure], &self.file.figures[figure].name);
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
        Err(place().error(found).hint(&format!("they are {}", known.join(", "))))
    }
}

/// Joints with the initial values and rates of their coordinates, in the simulator's order.
type Started = (Vec<TreeJoint>, Vec<Vec<f64>>, Vec<Vec<f64>>);

fn make_joints(bodies: &Bodies<'_>, files: &mut InputFiles<'_, '_>) -> Result<Started, SceneError> {
    let Bodies { file, world, .. } = bodies;
    let (mut joints, mut starts, mut rates) = (Vec::new(), Vec::new(), Vec::new());
    for (i, entry) in file.joints.iter().enumerate() {
        let parent =
            bodies.of(&entry.parent, || Place { line: entry.line, key: format!("joint[{}].parent", i + 1) })?;
        let coordinates: Vec<JointCoordinate> =
            entry.coordinates.iter().map(|coordinate| files.actuation(coordinate)).collect::<Result<_, _>>()?;
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

fn add_closures(
    world: &mut World,
    file: &SceneFile,
    figures: &[PlacedFigure],
) -> Result<Vec<ClosurePlacement>, SceneError> {
    let mut placements = Vec::new();
    for (i, entry) in file.closures.iter().enumerate() {
        let place = |key: &str| Place { line: entry.line, key: format!("closure[{}].{key}", i + 1) };
        let bodies = Bodies { file, figures, world };
        let (first, on_first) = bodies.point_of(&entry.first, || place("first"))?;
        let (second, on_second) = bodies.point_of(&entry.second, || place("second"))?;
        let entry = &ClosureEntry { anchor: entry.anchor.shifted(on_first, on_second), ..entry.clone() };
        let pose = |body: Option<usize>| body.map_or(Pose::IDENTITY, |body| world.bodies[body].pose);
        let Some(placement) = ClosurePlacement::new(entry, [first, second], [pose(first), pose(second)]) else {
            return Err(place("second").error("found the world at both ends; expected a body at one of them"));
        };
        let [on, other] = [world.bodies[placement.first].pose, pose(placement.second)];
        let gap = placement.gap(&on, &other);
        if entry.active && gap > LARGEST_GAP_M {
            let found =
                format!("found points that are {gap:.4} m apart; expected points that meet at the start, within 1 mm");
            let advice = "move the bodies, or set active = false and add the closure by an [[event]]";
            return Err(place("on_second").error(found).hint(advice));
        }
        let (first_from_joint, second_from_joint) = placement.frames(&on, &other);
        world.closures.push(Closure {
            name: entry.name.clone(),
            first: placement.first,
            second: placement.second,
            first_from_joint,
            second_from_joint,
            kind: placement::kind(&entry.kind),
            active: entry.active,
        });
        placements.push(placement);
    }
    Ok(placements)
}

fn ignored(world: &World, file: &SceneFile, figures: &[PlacedFigure]) -> Result<Vec<(Owner, Owner)>, SceneError> {
    let bodies = Bodies { file, figures, world };
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
                    let walker = &figures[*figure];
                    let count = world.figures[walker.figure].model.bodies().len();
                    (walker.first_body..walker.first_body + count).map(Owner::Body).collect()
                }
            })
        };
        let (first, second) = (owners(&pair.first)?, owners(&pair.second)?);
        pairs.extend(first.iter().flat_map(|a| second.iter().filter(move |b| a != *b).map(move |b| (*a, *b))));
    }
    // Only owners with surfaces make a difference.
    let touches = |owner: &Owner| world.surfaces.iter().any(|surface| surface.owner == *owner);
    pairs.retain(|(a, b)| touches(a) && touches(b));
    Ok(pairs)
}

/// Warns of surfaces that pass through each other: Hunt and Crossley's law needs a round shape.
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
                        "`{a}` and `{b}` pass through each other: the law hunt-crossley needs a sphere or a capsule on one \
                         side. hint: law = \"regularised\""
                    ),
                );
            }
        }
    }
}
