//! The joints of a figure's model as joints of a world: every coordinate of the model is one of a joint, or of a free
//! root.
//!
//! Each rotation of a joint is a hinge of the world, so that every angle of the model has its own motor; between the
//! hinges of one joint are links without mass. The root of a planar figure is a planar joint, the root of a figure in
//! three dimensions is a free body.

use super::check::WorldError;
use super::joint::JointKind;
use super::state::rates;
use super::{RigidBody, TreeJoint, World, WorldState};
use crate::kinematics::{BodyMotion, Posture, angles_zxy, body_motion};
use crate::model::{BodyId, CoordinateId, Displacement, JointAxis, JointSpeeds, Model};
use crate::numerics::elementary::{atan2, sin_cos};
use crate::spatial::{Mat3, Pose, Twist, Vec3, Wrench, rotation};

/// Tolerance for rounding of slopes and directions.
const SLACK: f64 = 1e-9;

/// Where a coordinate of the model is in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum FigurePlace {
    /// A coordinate of the joint that carries a body.
    Joint { child: usize, coordinate: usize },
    /// One of the angles about z, x, y and the distances along x, y, z of a free root, in this order.
    Root(usize),
}

/// The bodies and joints of a figure in a world.
#[derive(Debug, Clone)]
pub(crate) struct FigureTree {
    pub(crate) model: Model,
    /// Index of its first body in the world; the others follow in the order of the model, then the links.
    pub(crate) first_body: usize,
    /// Number of its bodies, with the links.
    pub(super) bodies: usize,
    /// The place of every coordinate of the model.
    pub(crate) places: Vec<FigurePlace>,
}

impl FigurePlace {
    /// Joint of the world and coordinate of the joint; `None` for a free root and where the joint was removed.
    /// `joint_of` has the joint of every body.
    pub(crate) fn joint(&self, joint_of: &[Option<usize>]) -> Option<(usize, usize)> {
        match *self {
            FigurePlace::Root(_) => None,
            FigurePlace::Joint { child, coordinate } => Some((joint_of[child]?, coordinate)),
        }
    }
}

/// Pose, twist and acceleration of a body.
#[derive(Debug, Clone, Copy)]
pub(crate) struct BodyStart {
    pub(crate) pose: Pose,
    pub(crate) twist: Twist,
    pub(crate) acceleration: Twist,
}

impl FigureTree {
    /// Adds bodies and joints of a model to a world, at rest in its origin; names begin with `prefix`.
    pub(crate) fn add(world: &mut World, model: &Model, prefix: &str) -> Result<FigureTree, WorldError> {
        let first_body = world.bodies.len();
        world.bodies.extend(model.bodies().iter().map(|body| RigidBody {
            name: format!("{prefix}{}", body.name),
            mass: body.inertia.mass(),
            inertia: body.inertia.about_center(),
            pose: Pose::IDENTITY,
            twist: Twist::ZERO,
            load: Wrench::ZERO,
        }));
        let mut places = vec![FigurePlace::Root(0); model.coordinates().len()];
        for body in model.body_ids() {
            let joint = JointOf { model, body, first_body, prefix };
            match model.bodies()[body.index()].joint.parent {
                None => joint.add_root(world, &mut places)?,
                Some(parent) => joint.add_hinges(parent, world, &mut places)?,
            }
        }
        Ok(FigureTree { model: model.clone(), first_body, bodies: world.bodies.len() - first_body, places })
    }

    /// Motions of the figure's bodies in a posture, in their order in the world. Links have no acceleration: nothing
    /// depends on it.
    pub(crate) fn motions(&self, world: &World, posture: Posture<'_>) -> Vec<BodyStart> {
        let of = |motion: BodyMotion| {
            let pose = Pose { rotation: motion.pose.rotation, translation: motion.center };
            BodyStart { pose, twist: motion.twist, acceleration: motion.acceleration }
        };
        let mut all: Vec<BodyStart> = body_motion(&self.model, posture).into_iter().map(of).collect();
        let own = self.first_body + all.len()..self.first_body + self.bodies;
        let empty = BodyStart { pose: Pose::IDENTITY, twist: Twist::ZERO, acceleration: Twist::ZERO };
        all.resize(self.bodies, empty);
        for joint in world.joints.iter().filter(|joint| own.contains(&joint.child)) {
            let is_child =
                |place: &FigurePlace| matches!(place, FigurePlace::Joint { child, .. } if *child == joint.child);
            if let (Some(c), Some(parent)) = (self.places.iter().position(is_child), joint.parent) {
                let parent = all[parent - self.first_body];
                all[joint.child - self.first_body] = link(parent, joint, posture.q[c], posture.qd[c]);
            }
        }
        all
    }

    /// Value and rate of every coordinate; `joint_of` has the joint of every body of the world.
    pub(crate) fn read(&self, world: &World, state: &WorldState, joint_of: &[Option<usize>]) -> Vec<[f64; 2]> {
        let mut root = None;
        let of = |place: &FigurePlace| match *place {
            FigurePlace::Root(k) => root.get_or_insert_with(|| self.read_root(state))[k],
            FigurePlace::Joint { child, coordinate } => {
                let Some(number) = joint_of[child] else { return [0.0; 2] };
                let joint = &world.joints[number];
                let rates = rates(state, joint, &state.frames(joint));
                [state.coordinates[number][coordinate], rates[coordinate]]
            }
        };
        self.places.iter().map(of).collect()
    }

    /// Value and rate of the angles and distances of a free root: R = R_z R_x R_y, and ω = e_z ȧ + R_z e_x ḃ + R_z R_x
    /// e_y ċ.
    fn read_root(&self, state: &WorldState) -> [[f64; 2]; 6] {
        let joint = &self.model.bodies()[0].joint;
        let (pose, twist) = (state.poses[self.first_body], state.twists[self.first_body]);
        let in_ground = joint.parent_from_joint.rotation.transpose();
        let at_joint = pose * center_from(&self.model, BodyId(0)) * joint.child_from_joint;
        let [a, b, c] = angles_zxy(&(in_ground * at_joint.rotation));
        let w = rotation(&(Vec3::z() * -a)) * (in_ground * twist.angular);
        let (sin, cos) = sin_cos(b);
        // Where the pelvis lies on its side, the other two angles are not defined.
        let c_rate = w.y / cos.max(f64::EPSILON);
        let place = in_ground * (at_joint.translation - joint.parent_from_joint.translation);
        let velocity = in_ground * twist.velocity_at(at_joint.translation - pose.translation);
        let along = |k: usize| [place[k], velocity[k]];
        [[a, w.z - sin * c_rate], [b, w.x], [c, c_rate], along(0), along(1), along(2)]
    }
}

/// The frame of a body of the model in the frame of the world's body, whose origin is the mass centre.
pub(super) fn center_from(model: &Model, id: BodyId) -> Pose {
    Pose::at(-model.bodies()[id.index()].inertia.center())
}

/// The link that a hinge moves, from the body or link that carries it. The origin of a link is on its hinge.
fn link(parent: BodyStart, joint: &TreeJoint, angle: f64, rate: f64) -> BodyStart {
    let hinge = parent.pose * joint.parent_from_joint;
    let turned = Pose { rotation: rotation(&(Vec3::z() * angle)), translation: Vec3::zeros() };
    let pose = hinge * turned * joint.child_from_joint.inverse();
    let linear = parent.twist.velocity_at(pose.translation - parent.pose.translation);
    let angular = parent.twist.angular + hinge.rotation * Vec3::z() * rate;
    BodyStart { pose, twist: Twist { angular, linear }, acceleration: Twist::ZERO }
}

/// The joint of a body.
struct JointOf<'a> {
    model: &'a Model,
    body: BodyId,
    first_body: usize,
    prefix: &'a str,
}

impl JointOf<'_> {
    fn wrong(&self, found: &str) -> WorldError {
        let name = self.model.bodies()[self.body.index()].joint.name.clone();
        WorldError {
            what: "joint",
            name,
            problem: format!("found {found}; expected hinges, and a planar or a free root"),
        }
    }

    /// Direction of an axis for a positive coordinate.
    fn moving(&self, axis: &JointAxis) -> Result<(CoordinateId, Vec3), WorldError> {
        let Displacement::Follows(id, function) = &axis.displacement else {
            return Err(self.wrong("an axis with a fixed value"));
        };
        match function.as_linear() {
            Some((slope, offset)) if (slope.abs() - 1.0).abs() <= SLACK && offset.abs() <= SLACK => {
                Ok((*id, axis.direction * slope.signum()))
            }
            _ => Err(self.wrong("an axis that is a curved function of its coordinate")),
        }
    }

    fn add_root(&self, world: &mut World, places: &mut [FigurePlace]) -> Result<(), WorldError> {
        let joint = &self.model.bodies()[self.body.index()].joint;
        let axes = |axes: &[JointAxis]| axes.iter().map(|axis| self.moving(axis)).collect::<Result<Vec<_>, _>>();
        let (turns, slides) = (axes(&joint.rotations)?, axes(&joint.translations)?);
        let along = |moving: &[(CoordinateId, Vec3)], expected: &[Vec3]| {
            let same = |((_, found), expected): (&(CoordinateId, Vec3), &Vec3)| (found - expected).amax() <= SLACK;
            moving.len() == expected.len() && moving.iter().zip(expected).all(same)
        };
        let [x, y, z] = [Vec3::x(), Vec3::y(), Vec3::z()];
        if along(&turns, &[z, x, y]) && along(&slides, &[x, y, z]) {
            turns.iter().chain(&slides).enumerate().for_each(|(k, (id, _))| places[id.index()] = FigurePlace::Root(k));
            return Ok(());
        }
        if !(along(&turns, &[z]) && along(&slides, &[x, y])) {
            return Err(self.wrong("a root that is neither free nor planar"));
        }
        let child = self.first_body + self.body.index();
        for (coordinate, (id, _)) in slides.iter().chain(&turns).enumerate() {
            places[id.index()] = FigurePlace::Joint { child, coordinate };
        }
        let frames = [joint.parent_from_joint, center_from(self.model, self.body) * joint.child_from_joint];
        world.joints.push(self.joint(None, child, frames, JointKind::Planar));
        Ok(())
    }

    /// Hinges about all axes of the joint, one after the other.
    fn add_hinges(&self, parent: BodyId, world: &mut World, places: &mut [FigurePlace]) -> Result<(), WorldError> {
        let joint = &self.model.bodies()[self.body.index()].joint;
        if !joint.translations.is_empty() || joint.rotations.is_empty() {
            return Err(self.wrong("slides, or nothing that moves"));
        }
        if matches!(joint.speeds, JointSpeeds::Ellipsoid(_) | JointSpeeds::Arc(_)) {
            return Err(self.wrong("a centre that slides on an ellipsoid or along an arc"));
        }
        let mut parent_body = self.first_body + parent.index();
        let mut parent_from = center_from(self.model, parent) * joint.parent_from_joint;
        for (k, axis) in joint.rotations.iter().enumerate() {
            let (id, direction) = self.moving(axis)?;
            let turned = Pose { rotation: with_z_along(direction), translation: Vec3::zeros() };
            let is_last = k + 1 == joint.rotations.len();
            let child_from =
                if is_last { center_from(self.model, self.body) * joint.child_from_joint } else { Pose::IDENTITY };
            let child = if is_last { self.first_body + self.body.index() } else { self.add_link(world, k) };
            places[id.index()] = FigurePlace::Joint { child, coordinate: 0 };
            let frames = [parent_from * turned, child_from * turned];
            let mut hinge = self.joint(Some(parent_body), child, frames, JointKind::Revolute);
            if joint.rotations.len() > 1 {
                hinge.name = format!("{}{}", self.prefix, self.model.coordinates()[id.index()].name);
            }
            world.joints.push(hinge);
            (parent_body, parent_from) = (child, Pose::IDENTITY);
        }
        Ok(())
    }

    fn joint(&self, parent: Option<usize>, child: usize, frames: [Pose; 2], kind: JointKind) -> TreeJoint {
        let name = format!("{}{}", self.prefix, self.model.bodies()[self.body.index()].joint.name);
        TreeJoint::free(name, kind, child, parent, frames)
    }

    /// Adds a body without mass, between two hinges.
    fn add_link(&self, world: &mut World, number: usize) -> usize {
        let joint = &self.model.bodies()[self.body.index()].joint.name;
        world.bodies.push(RigidBody {
            name: format!("{}{joint} link {}", self.prefix, number + 1),
            mass: 0.0,
            inertia: Mat3::zeros(),
            pose: Pose::IDENTITY,
            twist: Twist::ZERO,
            load: Wrench::ZERO,
        });
        world.bodies.len() - 1
    }
}

/// A rotation that turns z into a direction.
fn with_z_along(direction: Vec3) -> Mat3 {
    let across = Vec3::z().cross(&direction);
    let sine = across.norm();
    if sine <= SLACK {
        return if direction.z > 0.0 { Mat3::identity() } else { rotation(&(Vec3::x() * std::f64::consts::PI)) };
    }
    rotation(&(across * (atan2(sine, direction.z) / sine)))
}
