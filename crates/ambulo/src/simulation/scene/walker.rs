//! Figures of a scene: bodies and joints of an OpenSim model, as the simulator has them.
//!
//! A joint whose coordinates all follow the recording prescribes all six directions between its bodies, whatever its kind.
//! Others must be of a kind that the simulator has: turns about one fixed axis, two square ones or three, slides along one, the
//! plane, or everything.

use super::figure::{DrivenCoordinates, FigureEntry as Asked, RootMotion};
use super::joint::JointAxes as AskedJoint;
use super::placement::place;
use super::sources::InputFiles;
use super::{Place, SceneError};
use crate::contact::Shape;
use crate::findings::Code;
use crate::kinematics::{BodyMotion, Posture, body_motion};
use crate::model::{Body, BodyId, CoordinateId, Displacement, Drive, JointAxis, Model};
use crate::simulation::joint::rotation;
use crate::simulation::signal::Signal;
use crate::simulation::world::{Figure, Follows, JointCoordinate, Owner, RigidBody, Surface, TreeJoint, World};
use crate::spatial::{Mat3, Pose, Vec3, Wrench};

/// Cosine of the angle between axes that should be square.
const SQUARE_SLACK: f64 = 1e-6;
/// Rounding of slopes and offsets of functions that are plain coordinates.
const ROUNDING: f64 = 1e-12;

/// Where a figure's bodies stand in the world.
#[derive(Debug, Clone)]
pub(super) struct PlacedFigure {
    /// Its number among the figures.
    pub(super) figure: usize,
    /// Its first body; the others follow in the model's order.
    pub(super) first_body: usize,
    /// Name in the scene.
    pub(super) name: String,
    /// Of a built figure: where each coordinate of its model is.
    pub(super) placed: Option<Vec<Placed>>,
}

/// A coordinate of a figure's model as that of a joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct Placed {
    /// The joint's child, among the bodies of the world.
    pub(super) body: usize,
    /// Number of the joint's coordinate.
    pub(super) coordinate: usize,
}

/// A figure under construction.
struct FigureAssembly<'a> {
    asked: &'a Asked,
    /// Number in the file, from 1.
    number: usize,
    model: Model,
    signals: Vec<Signal>,
    motions: Vec<BodyMotion>,
    first_body: usize,
    figure: usize,
}

/// Adds a figure to the world.
pub(super) fn add(
    world: &mut World,
    asked: &Asked,
    number: usize,
    sources: &mut InputFiles<'_, '_>,
) -> Result<PlacedFigure, SceneError> {
    let model = sources.model(&asked.model_place, &asked.model)?;
    let model =
        standing_at(&model, &asked.pose).map_err(|e| asked.model_place.error(format!("{}: {e}", asked.model)))?;
    refuse_unknown(asked, number, &model)?;
    let signals = signals(asked, &model, sources)?;
    let values: Vec<[f64; 3]> = signals.iter().map(|signal| signal.at(0.0)).collect();
    let [q, qd, qdd] = [0, 1, 2].map(|k| values.iter().map(|v| v[k]).collect::<Vec<f64>>());
    let motions = body_motion(&model, Posture { q: &q, qd: &qd, qdd: &qdd });
    let (first_body, figure) = (world.bodies.len(), world.figures.len());
    let making = FigureAssembly { asked, number, model, signals, motions, first_body, figure };
    for id in making.model.body_ids() {
        world.bodies.push(making.body(id));
        world.joints.extend(making.joint(id)?);
    }
    making.refuse_massless(world)?;
    add_spheres(world, asked, number, &making.model, first_body)?;
    let FigureAssembly { model, signals, .. } = making;
    world.figures.push(Figure { model, coordinates: signals });
    Ok(PlacedFigure { figure, first_body, name: asked.name.clone(), placed: None })
}

/// The model with its ground moved.
fn standing_at(model: &Model, world_from_ground: &Pose) -> Result<Model, crate::model::ModelError> {
    let mut bodies = model.bodies().to_vec();
    for body in bodies.iter_mut().filter(|body| body.joint.parent.is_none()) {
        body.joint.parent_from_joint = *world_from_ground * body.joint.parent_from_joint;
    }
    Model::new(model.name(), model.gravity(), bodies, model.coordinates().to_vec(), Vec::new())
}

fn refuse_unknown(asked: &Asked, number: usize, model: &Model) -> Result<(), SceneError> {
    let DrivenCoordinates::Only(names) = &asked.driven else { return Ok(()) };
    let place = Place { line: asked.line, key: format!("figure[{number}].drive") };
    for name in names {
        let Some(id) = model.coordinate(name) else {
            let known: Vec<&str> = model.coordinates().iter().map(|c| c.name.as_str()).collect();
            let found = format!("found \"{name}\"; expected a coordinate of the model");
            return Err(place.error(found).hint(&format!("they are {}", known.join(", "))));
        };
        if is_of_root(model, id) {
            let found = format!("found \"{name}\"; expected coordinates of joints within the figure");
            return Err(place.error(found).hint("this one carries the whole figure; `root` says what becomes of it"));
        }
    }
    Ok(())
}

fn is_of_root(model: &Model, id: CoordinateId) -> bool {
    model.bodies().iter().any(|body| body.joint.parent.is_none() && body.joint.coordinates().contains(&id))
}

/// One signal a coordinate: recorded, or as the model has it.
fn signals(asked: &Asked, model: &Model, sources: &mut InputFiles<'_, '_>) -> Result<Vec<Signal>, SceneError> {
    let free = |id: CoordinateId| matches!(model.coordinates()[id.index()].drive, Drive::Free);
    let (mut columns, mut start) = (vec![None; model.coordinates().len()], 0.0);
    if let Some(file) = &asked.motion {
        let place = &asked.motion_place;
        let table = sources.table(place, file)?;
        let curves = table
            .coordinates(model, free, sources.findings)
            .map_err(|e| place.error(format!("{file}: {}", super::sources::chain(&e))))?;
        start = sources.start(place, file, curves.span_s, asked.from_s)?;
        columns = curves.columns;
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
        let message = format!("{file} has no column for {names}; the default values in brackets are used throughout");
        sources.findings.report(Code::MotionMissingCoordinate, message);
    }
}

impl FigureAssembly<'_> {
    fn body(&self, id: BodyId) -> RigidBody {
        let (about, motion) = (&self.model.bodies()[id.index()], &self.motions[id.index()]);
        RigidBody {
            name: format!("{}/{}", self.asked.name, about.name),
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
            Drive::Free if is_of_root(&self.model, id) => self.asked.root == RootMotion::Driven,
            Drive::Free => match &self.asked.driven {
                DrivenCoordinates::All => true,
                DrivenCoordinates::Nothing => false,
                DrivenCoordinates::Only(names) => names.contains(&coordinate.name),
            },
        }
    }

    /// The joint of a body; none where nothing holds it.
    fn joint(&self, id: BodyId) -> Result<Option<TreeJoint>, SceneError> {
        let body = &self.model.bodies()[id.index()];
        let followed: Vec<bool> = body.joint.coordinates().into_iter().map(|c| self.follows(c)).collect();
        if followed.iter().all(|follows| *follows) {
            return Ok(Some(self.following(id)));
        }
        if followed.contains(&true) {
            return Err(self.unfit(body, "some of its coordinates are driven or locked and others are free"));
        }
        let asked = self.free_joint(id)?;
        if body.joint.parent.is_none() && matches!(asked.kind, AskedJoint::Free) {
            return Ok(None);
        }
        let center = self.frame_on_child(id).translation;
        let placed = place(&asked.kind, center, &asked.values);
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
        format!("{}/{}", self.asked.name, body.joint.name)
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
            kind: crate::simulation::joint::JointKind::Weld,
            coordinates: Vec::new(),
            follows: Some(Follows { figure: self.figure, body: id.index(), parent: parent.map(BodyId::index) }),
        }
    }

    /// The simulator's joint that a joint of the model is.
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
            ([a], []) => (AskedJoint::Revolute { axis: a.direction }, vec![a.value]),
            ([], [a]) => (AskedJoint::Prismatic { axis: a.direction }, vec![a.value]),
            ([a, b], []) if square(a, b) => {
                (AskedJoint::Universal { axis: a.direction, second_axis: b.direction }, vec![a.value, b.value])
            }
            ([_, _, _], []) => (AskedJoint::Ball, vec![0.0; 3]),
            ([n], [a, b]) if square(n, a) && square(n, b) && square(a, b) => {
                let sense = n.direction.cross(&a.direction).dot(&b.direction).signum();
                let kind = AskedJoint::Planar { normal: n.direction, along: a.direction };
                (kind, vec![n.value, a.value, sense * b.value])
            }
            ([_, _, _], [_, _, _]) => (AskedJoint::Free, vec![0.0; 6]),
            _ => return Err(self.unfit(body, "it turns or slides in another way than the simulator's joints")),
        };
        Ok(FreeJoint { kind, values })
    }

    /// An axis that a coordinate of its own moves, in the world; none if it stays.
    fn moving(&self, body: &Body, axis: &JointAxis, frame: &Mat3) -> Result<Option<Axis>, SceneError> {
        let Displacement::Follows(id, function) = &axis.displacement else { return Ok(None) };
        if function.as_constant().is_some() {
            return Ok(None);
        }
        let sense = match function.as_linear() {
            Some((slope, intercept)) if (slope.abs() - 1.0).abs() < ROUNDING && intercept.abs() < ROUNDING => slope,
            _ => return Err(self.unfit(body, "its axes follow their coordinates by curves or factors")),
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
        let place = Place { line: self.asked.line, key: format!("figure[{}]", self.number) };
        let of_root = body.joint.parent.is_none();
        let advice = if of_root { "root = \"driven\"" } else { "drive all coordinates of the joint, or none" };
        let message = format!(
            "found the joint `{}` of the model free to move, but {why}; expected one that is driven, or turns about one \
             axis, two square axes or three, slides along one, moves in a plane, or moves freely",
            body.joint.name
        );
        place.error(message).hint(advice)
    }

    /// What nothing resists has no motion under forces.
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
                let place = Place { line: self.asked.line, key: format!("figure[{}]", self.number) };
                let found = format!("found the body `{}`, free to move and without mass", body.name);
                return Err(place.error(found + "; expected a mass, its own or of what it carries"));
            }
        }
        Ok(())
    }
}

/// Spheres that the scene adds to a figure.
pub(super) fn add_spheres(
    world: &mut World,
    asked: &Asked,
    number: usize,
    model: &Model,
    first_body: usize,
) -> Result<(), SceneError> {
    for (k, sphere) in asked.spheres.iter().enumerate() {
        let key = format!("figure[{number}].sphere[{}]", k + 1);
        let Some(id) = model.body(&sphere.body) else {
            let known: Vec<&str> = model.bodies().iter().map(|b| b.name.as_str()).collect();
            let place = Place { line: sphere.line, key: format!("{key}.body") };
            let found = format!("found \"{}\"; expected a body of the model", sphere.body);
            return Err(place.error(found).hint(&format!("they are {}", known.join(", "))));
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

/// A joint of the simulator, in the words of a scene.
struct FreeJoint {
    kind: AskedJoint,
    /// Its coordinates at the start, in the order of scene files.
    values: Vec<f64>,
}

/// A moving axis of a joint.
struct Axis {
    /// Unit direction in the world, positive with its coordinate.
    direction: Vec3,
    value: f64,
}
