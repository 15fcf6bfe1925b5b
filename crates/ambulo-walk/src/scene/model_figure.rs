//! Adds figures from OpenSim models to the world.
//!
//! If all coordinates of a joint follow the recording, the joint prescribes all six directions between its bodies,
//! whatever its kind. Other joints must be of a kind that the simulator supports: rotations about one fixed axis, two
//! perpendicular axes or three, a translation along one axis, planar, or free.

use super::figure::{DrivenCoordinates, FigureEntry, RootMotion};
use super::joint_axes::JointAxes;
use super::motion_recorder::MotionRecorder;
use super::placement::place;
use super::recorder::Recorder;
use super::sources::InputFiles;
use super::{Place, SceneError};
use crate::contact::Shape;
use crate::engine::figure_tree::FigureTree;
use crate::engine::signal::Signal;
use crate::engine::world::{Figure, Follows, JointCoordinate, Owner, RigidBody, Surface, TreeJoint, World};
use crate::findings::Code;
use crate::kinematics::{BodyMotion, Posture, body_motion};
use crate::model::{Body, BodyId, CoordinateId, Displacement, Drive, JointAxis, Model};
use crate::spatial::{Mat3, Pose, Twist, Vec3, Wrench, rotation};

/// Largest cosine of the angle between axes that should be perpendicular.
const SQUARE_SLACK: f64 = 1e-6;
/// Tolerance for slopes and offsets of functions that equal a coordinate.
const ROUNDING: f64 = 1e-12;

/// Indices of a figure's bodies in the world.
#[derive(Debug, Clone)]
pub(super) struct PlacedFigure {
    /// Index of the figure.
    pub(super) figure: usize,
    /// Index of its first body; the others follow in the model's order.
    pub(super) first_body: usize,
    /// Name in the scene.
    pub(super) name: String,
    /// For a built-in figure: the places of the coordinates of its model.
    pub(super) tree: Option<FigureTree>,
    /// Accelerations of its bodies at the start, if its motion before that is known.
    pub(super) accelerations: Vec<Twist>,
}

/// A figure under construction.
struct FigureAssembly<'a> {
    entry: &'a FigureEntry,
    /// Number in the file, from 1.
    number: usize,
    model: Model,
    signals: Vec<Signal>,
    motions: Vec<BodyMotion>,
    first_body: usize,
    figure: usize,
}

/// Adds a figure to the world; one that follows a recording is recorded.
pub(super) fn add(
    world: &mut World,
    entry: &FigureEntry,
    number: usize,
    sources: &mut InputFiles<'_, '_>,
) -> Result<(PlacedFigure, Option<Recorder>), SceneError> {
    let model = sources.model(&entry.model_place, &entry.model)?;
    note_bushings(&model, &entry.name, sources);
    let model =
        standing_at(&model, &entry.pose).map_err(|e| entry.model_place.error(format!("{}: {e}", entry.model)))?;
    refuse_unknown(entry, number, &model)?;
    let signals = signals(entry, &model, sources)?;
    let values: Vec<[f64; 3]> = signals.iter().map(|signal| signal.at(0.0)).collect();
    let [q, qd, qdd] = [0, 1, 2].map(|k| values.iter().map(|v| v[k]).collect::<Vec<f64>>());
    let motions = body_motion(&model, Posture { q: &q, qd: &qd, qdd: &qdd });
    let (first_body, figure) = (world.bodies.len(), world.figures.len());
    let assembly = FigureAssembly { entry, number, model, signals, motions, first_body, figure };
    for id in assembly.model.body_ids() {
        world.bodies.push(assembly.body(id));
        world.joints.extend(assembly.joint(id)?);
    }
    assembly.refuse_massless(world)?;
    add_spheres(world, entry, number, &assembly.model, first_body)?;
    let follows: Vec<bool> =
        (0..assembly.model.coordinates().len()).map(|id| assembly.follows(CoordinateId(id))).collect();
    let FigureAssembly { model, signals, .. } = assembly;
    let is_judged = entry.motion.is_some() && entry.driven != DrivenCoordinates::Nothing;
    let recorder = || MotionRecorder::new(&entry.name, &model, signals.clone(), follows, first_body);
    let recorder = is_judged.then(|| Recorder::Motion(Box::new(recorder())));
    world.figures.push(Figure { model, coordinates: signals });
    Ok((PlacedFigure { figure, first_body, name: entry.name.clone(), tree: None, accelerations: Vec::new() }, recorder))
}

/// Reports bushings, which the simulator does not have.
fn note_bushings(model: &Model, figure: &str, sources: &mut InputFiles<'_, '_>) {
    for bushing in model.bushings() {
        let message = format!("the simulator does not apply the bushing `{}` of the figure `{figure}`", bushing.name);
        sources.findings.report(Code::ModelIgnored, message);
    }
}

/// The model with its ground moved, without bushings.
fn standing_at(model: &Model, world_from_ground: &Pose) -> Result<Model, crate::model::ModelError> {
    let mut bodies = model.bodies().to_vec();
    for body in bodies.iter_mut().filter(|body| body.joint.parent.is_none()) {
        body.joint.parent_from_joint = *world_from_ground * body.joint.parent_from_joint;
    }
    Model::new(model.name(), model.gravity(), bodies, model.coordinates().to_vec(), Vec::new())
}

fn refuse_unknown(entry: &FigureEntry, number: usize, model: &Model) -> Result<(), SceneError> {
    let DrivenCoordinates::Only(names) = &entry.driven else { return Ok(()) };
    let place = Place { line: entry.line, key: format!("figure[{number}].drive") };
    for name in names {
        let Some(id) = model.coordinate(name) else {
            let known: Vec<&str> = model.coordinates().iter().map(|c| c.name.as_str()).collect();
            let found = format!("found \"{name}\"; expected a coordinate of the model");
            return Err(place.error(found).hint(&format!("the coordinates are {}", known.join(", "))));
        };
        if is_of_root(model, id) {
            let found = format!("found \"{name}\"; expected coordinates of joints within the figure");
            return Err(place.error(found).hint("this one belongs to the root; see the key `root`"));
        }
    }
    Ok(())
}

fn is_of_root(model: &Model, id: CoordinateId) -> bool {
    model.bodies().iter().any(|body| body.joint.parent.is_none() && body.joint.coordinates().contains(&id))
}

/// One signal per coordinate: from the recording, or the model's default value.
fn signals(entry: &FigureEntry, model: &Model, sources: &mut InputFiles<'_, '_>) -> Result<Vec<Signal>, SceneError> {
    let free = |id: CoordinateId| matches!(model.coordinates()[id.index()].drive, Drive::Free);
    let (mut columns, mut start) = (vec![None; model.coordinates().len()], 0.0);
    if let Some(file) = &entry.motion {
        let place = &entry.motion_place;
        let table = sources.table(place, file)?;
        let (curves, span_s) = table
            .coordinates(model, free, sources.findings)
            .map_err(|e| place.error(format!("{file}: {}", super::error_chain::chain(&e))))?;
        start = sources.start(place, file, span_s, entry.from_s)?;
        columns = curves;
        report_missing(model, &columns, file, sources);
    }
    let own = |(coordinate, column): (&crate::model::Coordinate, Option<_>)| match (&coordinate.drive, column) {
        (Drive::Free, Some(spline)) => Signal::Spline(spline, start),
        (Drive::Prescribed(function), _) => Signal::OfTime(function.clone(), start),
        _ => Signal::Constant(coordinate.default_value),
    };
    let mut signals: Vec<Signal> = model.coordinates().iter().zip(columns).map(own).collect();
    for (number, coordinate) in model.coordinates().iter().enumerate() {
        if let Drive::Coupled(leader, function) = &coordinate.drive {
            signals[number] = Signal::Of(function.clone(), Box::new(signals[leader.index()].clone()));
        }
    }
    Ok(signals)
}

fn report_missing<T>(model: &Model, columns: &[Option<T>], file: &str, sources: &mut InputFiles<'_, '_>) {
    let missing = model.coordinates().iter().zip(columns);
    let missing = missing.filter(|(c, column)| matches!(c.drive, Drive::Free) && column.is_none());
    let names: Vec<String> = missing.map(|(c, _)| format!("`{}` ({})", c.name, c.default_value)).collect();
    if !names.is_empty() {
        let names = names.join(", ");
        let message = format!("{file} has no column for {names}; the default values in brackets are used at all times");
        sources.findings.report(Code::MotionMissingCoordinate, message);
    }
}

impl FigureAssembly<'_> {
    fn body(&self, id: BodyId) -> RigidBody {
        let (about, motion) = (&self.model.bodies()[id.index()], &self.motions[id.index()]);
        RigidBody {
            name: format!("{}/{}", self.entry.name, about.name),
            mass: about.inertia.mass(),
            inertia: about.inertia.about_center(),
            pose: Pose { rotation: motion.pose.rotation, translation: motion.center },
            twist: motion.twist,
            load: Wrench::ZERO,
        }
    }

    /// Whether a coordinate follows its signal.
    fn follows(&self, id: CoordinateId) -> bool {
        let coordinate = &self.model.coordinates()[id.index()];
        match &coordinate.drive {
            Drive::Locked | Drive::Prescribed(_) => true,
            Drive::Coupled(leader, _) => self.follows(*leader),
            Drive::Free if is_of_root(&self.model, id) => self.entry.root == RootMotion::Driven,
            Drive::Free => match &self.entry.driven {
                DrivenCoordinates::All => true,
                DrivenCoordinates::Nothing => false,
                DrivenCoordinates::Only(names) => names.contains(&coordinate.name),
            },
        }
    }

    /// The joint of a body; `None` for a free body.
    fn joint(&self, id: BodyId) -> Result<Option<TreeJoint>, SceneError> {
        let body = &self.model.bodies()[id.index()];
        let followed: Vec<bool> = body.joint.coordinates().into_iter().map(|c| self.follows(c)).collect();
        if followed.iter().all(|follows| *follows) {
            return Ok(Some(self.following(id)));
        }
        if followed.contains(&true) {
            return Err(self.unfit(body, "some of its coordinates are driven or locked and others are free"));
        }
        let entry = self.free_joint(id)?;
        if body.joint.parent.is_none() && matches!(entry.kind, JointAxes::Free) {
            return Ok(None);
        }
        let center = self.frame_on_child(id).translation;
        let placed = place(&entry.kind, center, &entry.values);
        let on = |body: Option<BodyId>, frame: Pose| body.map_or(frame, |b| self.pose(b).inverse() * frame);
        Ok(Some(TreeJoint {
            name: self.joint_name(body),
            child: self.first_body + id.index(),
            parent: body.joint.parent.map(|p| self.first_body + p.index()),
            parent_from_joint: on(body.joint.parent, placed.world_from_parent_side),
            child_from_joint: on(Some(id), placed.world_from_child_side),
            kind: placed.kind,
            coordinates: vec![JointCoordinate::default(); placed.kind.freedom()],
            follows: None,
        }))
    }

    fn joint_name(&self, body: &Body) -> String {
        format!("{}/{}", self.entry.name, body.joint.name)
    }

    /// `world_from_body`, origin at the mass centre.
    fn pose(&self, id: BodyId) -> Pose {
        let motion = &self.motions[id.index()];
        Pose { rotation: motion.pose.rotation, translation: motion.center }
    }

    /// `world_from_M` at the start.
    fn frame_on_child(&self, id: BodyId) -> Pose {
        self.motions[id.index()].pose * self.model.bodies()[id.index()].joint.child_from_joint
    }

    fn following(&self, id: BodyId) -> TreeJoint {
        let joint = &self.model.bodies()[id.index()].joint;
        let parent = joint.parent;
        let center = |body: BodyId| Pose::at(-self.model.bodies()[body.index()].inertia.center());
        TreeJoint {
            name: self.joint_name(&self.model.bodies()[id.index()]),
            child: self.first_body + id.index(),
            parent: parent.map(|p| self.first_body + p.index()),
            parent_from_joint: parent.map_or(Pose::IDENTITY, center) * joint.parent_from_joint,
            child_from_joint: center(id) * joint.child_from_joint,
            kind: crate::engine::joint::JointKind::Weld,
            coordinates: Vec::new(),
            follows: Some(Follows { figure: self.figure, body: id.index(), parent: parent.map(BodyId::index) }),
        }
    }

    /// Converts a joint of the model to a joint of the simulator.
    fn free_joint(&self, id: BodyId) -> Result<FreeJoint, SceneError> {
        let body = &self.model.bodies()[id.index()];
        let joint = &body.joint;
        let ground = joint.parent.map_or(Pose::IDENTITY, |p| self.motions[p.index()].pose);
        let mut frame = (ground * joint.parent_from_joint).rotation;
        let mut slides: Vec<Axis> = Vec::new();
        for axis in &joint.translations {
            slides.extend(self.moving(body, axis, &frame)?);
        }
        let mut turns: Vec<Axis> = Vec::new();
        for axis in &joint.rotations {
            turns.extend(self.moving(body, axis, &frame)?);
            frame *= rotation(&(axis.direction * self.value(&axis.displacement)));
        }
        let square = |a: &Axis, b: &Axis| a.direction.dot(&b.direction).abs() <= SQUARE_SLACK;
        let (kind, values) = match (&turns[..], &slides[..]) {
            ([a], []) => (JointAxes::Revolute { axis: a.direction }, vec![a.value]),
            ([], [a]) => (JointAxes::Prismatic { axis: a.direction }, vec![a.value]),
            ([a, b], []) if square(a, b) => {
                (JointAxes::Universal { axis: a.direction, second_axis: b.direction }, vec![a.value, b.value])
            }
            ([_, _, _], []) => (JointAxes::Ball, vec![0.0; 3]),
            ([n], [a, b]) if square(n, a) && square(n, b) && square(a, b) => {
                let sense = n.direction.cross(&a.direction).dot(&b.direction).signum();
                let kind = JointAxes::Planar { normal: n.direction, along: a.direction };
                (kind, vec![n.value, a.value, sense * b.value])
            }
            ([_, _, _], [_, _, _]) => (JointAxes::Free, vec![0.0; 6]),
            _ => return Err(self.unfit(body, "its free motions differ from those of the simulator's joints")),
        };
        Ok(FreeJoint { kind, values })
    }

    /// An axis with its own coordinate, in the world; `None` for a fixed axis.
    fn moving(&self, body: &Body, axis: &JointAxis, frame: &Mat3) -> Result<Option<Axis>, SceneError> {
        let Displacement::Follows(id, function) = &axis.displacement else { return Ok(None) };
        if function.as_constant().is_some() {
            return Ok(None);
        }
        let sense = match function.as_linear() {
            Some((slope, intercept)) if (slope.abs() - 1.0).abs() < ROUNDING && intercept.abs() < ROUNDING => slope,
            _ => return Err(self.unfit(body, "its axes are scaled or curved functions of their coordinates")),
        };
        let axes = body.joint.rotations.iter().chain(&body.joint.translations);
        if axes.filter(|a| matches!(&a.displacement, Displacement::Follows(other, _) if other == id)).count() > 1 {
            return Err(self.unfit(body, "one coordinate moves several of its axes"));
        }
        let direction = (frame * axis.direction * sense).normalize();
        Ok(Some(Axis { direction, value: self.signals[id.index()].at(0.0)[0] }))
    }

    fn value(&self, displacement: &Displacement) -> f64 {
        match displacement {
            Displacement::Fixed(value) => *value,
            Displacement::Follows(id, function) => function.at(self.signals[id.index()].at(0.0)[0])[0],
        }
    }

    fn unfit(&self, body: &Body, why: &str) -> SceneError {
        let place = Place { line: self.entry.line, key: format!("figure[{}]", self.number) };
        let of_root = body.joint.parent.is_none();
        let advice = if of_root { "root = \"driven\"" } else { "drive all coordinates of the joint, or none" };
        let message = format!(
            "found the joint `{}` of the model free to move, but {why}; expected one that is driven, or rotates about \
             one axis, two perpendicular axes or three, translates along one axis, is planar, or is free",
            body.joint.name
        );
        place.error(message).hint(advice)
    }

    /// Rejects free bodies without mass, whose acceleration is undefined.
    fn refuse_massless(&self, world: &World) -> Result<(), SceneError> {
        let bodies = self.model.bodies();
        let mut carried: Vec<f64> = bodies.iter().map(|body| body.inertia.mass()).collect();
        for (i, body) in bodies.iter().enumerate().rev() {
            if let Some(parent) = body.joint.parent {
                carried[parent.index()] += carried[i];
            }
        }
        for (i, body) in bodies.iter().enumerate() {
            let joint = world.joints.iter().find(|joint| joint.child == self.first_body + i);
            let free = joint.is_none_or(|joint| joint.kind.freedom() > 0);
            if free && carried[i] <= 0.0 {
                let place = Place { line: self.entry.line, key: format!("figure[{}]", self.number) };
                let found = format!("found the body `{}`, free to move and without mass", body.name);
                return Err(place.error(found + "; expected a mass of the body or of bodies that it carries"));
            }
        }
        Ok(())
    }
}

/// Adds the contact spheres of a figure.
pub(super) fn add_spheres(
    world: &mut World,
    entry: &FigureEntry,
    number: usize,
    model: &Model,
    first_body: usize,
) -> Result<(), SceneError> {
    for (k, sphere) in entry.spheres.iter().enumerate() {
        let key = format!("figure[{number}].sphere[{}]", k + 1);
        let Some(id) = model.body(&sphere.body) else {
            let known: Vec<&str> = model.bodies().iter().map(|b| b.name.as_str()).collect();
            let place = Place { line: sphere.line, key: format!("{key}.body") };
            let found = format!("found \"{}\"; expected a body of the model", sphere.body);
            return Err(place.error(found).hint(&format!("the bodies are {}", known.join(", "))));
        };
        let place = Place { line: sphere.line, key };
        world.surfaces.push(Surface {
            owner: Owner::Body(first_body + id.index()),
            shape: Shape::sphere(sphere.radius).map_err(|e| place.error(e.to_string()))?,
            owner_from_shape: Pose::at(sphere.at - model.bodies()[id.index()].inertia.center()),
            material: sphere.material,
        });
    }
    Ok(())
}

/// A joint of the simulator as described in scene files.
struct FreeJoint {
    kind: JointAxes,
    /// Coordinates of the joint at the start, in the order of scene files.
    values: Vec<f64>,
}

/// A moving axis of a joint.
struct Axis {
    /// Unit direction in the world for a positive coordinate.
    direction: Vec3,
    value: f64,
}
