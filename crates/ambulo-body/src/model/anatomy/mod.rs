//! The anatomy of a model: sides, pelvis, legs, soles, stature, and the clinical meaning and sign of every coordinate.
//!
//! It is determined once, when the model is created, from the positions and axes of its joints in the neutral posture
//! (every coordinate zero, if its range allows it): the legs are below the hips, the feet point forward, the right hip
//! is on the right, and a knee flexes when the shank rotates backward. Names are used only if the geometry is not
//! sufficient, so models in any language and with any naming scheme are supported. Models without legs (a pendulum, an
//! arm) have no pelvis, no legs and no movements; their sides are those in their names.
//!
//! Pinned by: tests/anatomy.rs

mod axes;
mod joint_system;
mod legs;
mod movement;
mod pelvic_frame;
mod region;
mod sole;

pub(crate) use joint_system::JointSystem;
pub use joint_system::{LegJoint, LegJointAxes};
pub use movement::{Meaning, Movement};
pub use pelvic_frame::{PelvicFrame, PelvicFrameError};
pub use region::Region;
pub use sole::{Sole, SolePoint, Stature};

use super::posture::ModelPosture;
use super::{BodyId, BySide, Coordinate, CoordinateId, Model, Side};
use crate::numerics::mean;
use crate::spatial::{Mat3, Pose, Vec3};
use axes::Oriented;
use legs::{LegChain, Tree};
use movement::Meanings;
use sole::foot_axes;

/// The bodies and joints of one leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leg {
    /// The thigh.
    pub thigh: BodyId,
    /// The shank.
    pub shank: BodyId,
    /// The foot below ankle and subtalar joint (calcaneus), on which the ground acts.
    pub foot: BodyId,
    /// The toes, if they are a separate body.
    pub toes: Option<BodyId>,
    /// The body whose joint to its parent is the hip.
    pub hip: BodyId,
    /// The body whose joint to its parent is the knee.
    pub knee: BodyId,
    /// The body whose joint to its parent is the ankle.
    pub ankle: BodyId,
    /// Ankle centre in the frame of the foot [m].
    ankle_in_foot: Vec3,
    /// Forward and up in the frame of the foot.
    foot_axes: [Vec3; 2],
    /// Hip to knee and knee to ankle together [m].
    thigh_and_shank_m: f64,
    /// Joint coordinate systems of hip, knee and ankle; `None` for a leg that moves in the sagittal plane only.
    pub(crate) systems: Option<[JointSystem; 3]>,
}

impl Leg {
    /// Forward and up in the frame of the foot.
    #[doc(hidden)]
    pub fn foot_axes(&self) -> [Vec3; 2] {
        self.foot_axes
    }
}

/// Anatomical meaning of the parts of a model. See the [module](self).
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Anatomy {
    pelvis: Option<BodyId>,
    trunk: Option<BodyId>,
    legs: BySide<Option<Leg>>,
    body_sides: Vec<Option<Side>>,
    coordinate_sides: Vec<Option<Side>>,
    meanings: Vec<Option<Meaning>>,
    neutral: Option<NeutralPosture>,
}

/// The posture in which the anatomy was determined.
#[derive(Debug, Clone, PartialEq)]
#[doc(hidden)]
pub struct NeutralPosture {
    /// Forward, up and right in the world, as columns.
    pub(crate) axes: Mat3,
    /// `world_from_body` of every body.
    pub poses: Vec<Pose>,
}

impl Anatomy {
    /// Determines the anatomy of a model.
    pub(super) fn find(model: &Model) -> Anatomy {
        let defaults: Vec<f64> = model.coordinates.iter().map(|c| c.default_value).collect();
        let neutral = model.coordinates.iter().map(neutral_value).collect();
        [neutral, defaults]
            .into_iter()
            .find_map(|q| Anatomy::in_posture(model, &ModelPosture::new(model, q)))
            .unwrap_or_else(|| Anatomy::by_names(model))
    }

    fn in_posture(model: &Model, posture: &ModelPosture<'_>) -> Option<Anatomy> {
        let up = (-model.gravity).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::y);
        let tree = Tree { bodies: &model.bodies, posture, up };
        let lower = tree.lower()?;
        let pelvis = lower.pelvis;
        let oriented = tree.oriented(lower)?;
        let body_sides = tree.sides(pelvis, &oriented);
        let trunk = trunk(&tree, pelvis, &oriented, &body_sides);
        let meanings = Meanings::find(&tree, &model.coordinates, &oriented, [Some(pelvis), trunk]);
        let legs = BySide::from_fn(|side| {
            let chain = oriented.legs[side].as_ref()?;
            let systems = JointSystem::of_leg(&tree, chain, side, &oriented.axes, &meanings);
            Some(Leg { systems, ..leg(&tree, chain, &oriented.axes) })
        });
        Some(Anatomy {
            pelvis: Some(pelvis),
            trunk,
            legs,
            coordinate_sides: coordinate_sides(model, &body_sides),
            body_sides,
            meanings,
            neutral: Some(NeutralPosture { axes: nearest_axes(&oriented.axes), poses: posture.poses.clone() }),
        })
    }

    /// Anatomy of a model without legs, from names.
    fn by_names(model: &Model) -> Anatomy {
        let body_sides: Vec<Option<Side>> = model.bodies.iter().map(|body| Side::of_name(&body.name)).collect();
        Anatomy {
            coordinate_sides: coordinate_sides(model, &body_sides),
            body_sides,
            meanings: vec![None; model.coordinates.len()],
            ..Anatomy::default()
        }
    }

    /// The pelvis: the body between the hips. In figures with an undivided trunk it is the whole trunk.
    #[inline]
    #[must_use]
    pub fn pelvis(&self) -> Option<BodyId> {
        self.pelvis
    }

    /// The trunk above the pelvis: the heaviest body that belongs to no side.
    #[inline]
    #[must_use]
    pub fn trunk(&self) -> Option<BodyId> {
        self.trunk
    }

    /// The legs; `None` for a missing leg.
    #[inline]
    #[must_use]
    pub fn legs(&self) -> &BySide<Option<Leg>> {
        &self.legs
    }

    /// The feet on which the ground acts, if there are two.
    #[inline]
    #[must_use]
    pub fn feet(&self) -> Option<BySide<BodyId>> {
        self.legs.map(|leg| leg.map(|leg| leg.foot)).both()
    }

    /// The side of a body; `None` for pelvis, trunk and head.
    #[inline]
    #[must_use]
    pub fn body_side(&self, body: BodyId) -> Option<Side> {
        self.body_sides.get(body.index()).copied().flatten()
    }

    /// The side of the joint that a coordinate moves; `None` for pelvis, trunk and head.
    #[inline]
    #[must_use]
    pub fn coordinate_side(&self, id: CoordinateId) -> Option<Side> {
        self.coordinate_sides.get(id.index()).copied().flatten()
    }

    /// The movement that a coordinate measures, and its sign.
    #[inline]
    #[must_use]
    pub fn meaning(&self, id: CoordinateId) -> Option<Meaning> {
        self.meanings.get(id.index()).copied().flatten()
    }

    /// Whether any of these coordinates turns the joint of a movement of a leg, or one between that joint and the
    /// pelvis: where such a coordinate is not measured, neither is the direction of the joint's moment.
    #[must_use]
    pub fn is_any_above(&self, coordinates: &[CoordinateId], movement: Movement, side: Side) -> bool {
        let meanings = coordinates.iter().filter_map(|id| self.meaning(*id));
        meanings.into_iter().any(|meaning| meaning.is_above(movement, side))
    }

    /// The coordinate that measures a movement of a side (`None` for pelvis and trunk), with its sign: +1 if the
    /// coordinate increases during the movement, otherwise -1.
    #[must_use]
    pub fn coordinate(&self, movement: Movement, side: Option<Side>) -> Option<(CoordinateId, f64)> {
        let is_it = |meaning: &Meaning| meaning.movement == movement && meaning.side == side;
        let index = self.meanings.iter().position(|meaning| meaning.as_ref().is_some_and(is_it))?;
        Some((CoordinateId(index), self.meanings[index]?.sign))
    }

    /// Estimated soles of a person of a stature [m]: feet of usual proportions under the ankles. Built-in figures have
    /// their own ([`Human::sole`](super::anthropometry::Human::sole)).
    #[must_use]
    pub fn soles(&self, height_m: f64) -> BySide<Option<Sole>> {
        self.legs.map(|leg| leg.map(|leg| Sole::estimated(&leg, height_m)))
    }

    /// The posture in which the anatomy was determined; `None` for a model without legs.
    #[doc(hidden)]
    pub fn neutral(&self) -> Option<&NeutralPosture> {
        self.neutral.as_ref()
    }

    fn thigh_and_shank_m(&self) -> Option<f64> {
        let legs: Vec<f64> = self.legs.values().flatten().map(|leg| leg.thigh_and_shank_m).collect();
        (!legs.is_empty()).then(|| mean(&legs))
    }
}

impl Model {
    /// A joint of a leg and its axes, for the rotations `world_from_body` of the bodies. `None` if there is no such
    /// leg.
    #[must_use]
    pub fn leg_joint(&self, joint: LegJoint, side: Side, rotation: impl Fn(BodyId) -> Mat3) -> Option<LegJointAxes> {
        let anatomy = self.anatomy();
        let leg = anatomy.legs[side].as_ref()?;
        if let Some(systems) = &leg.systems {
            let system = &systems[joint as usize];
            return Some(LegJointAxes { body: system.joint, on_distal: system.on_distal, axes: system.axes(rotation) });
        }
        let neutral = anatomy.neutral.as_ref()?;
        let (body, distal) = match joint {
            LegJoint::Hip => (leg.hip, leg.thigh),
            LegJoint::Knee => (leg.knee, leg.shank),
            LegJoint::Ankle => (leg.ankle, leg.foot),
        };
        let turned = rotation(distal) * neutral.poses[distal.index()].rotation.transpose() * neutral.axes;
        let parent = |id: &BodyId| self.bodies[id.index()].joint.parent;
        let carries = std::iter::successors(Some(distal), parent).any(|ancestor| ancestor == body);
        let on_distal = if carries { 1.0 } else { -1.0 };
        Some(LegJointAxes { body, on_distal, axes: [0, 1, 2].map(|k| turned.column(k).into()) })
    }

    /// Stature and leg length, estimated from thigh and shank, or from the mass of a model without legs.
    #[must_use]
    pub fn stature(&self) -> Stature {
        Stature::estimated(self.anatomy.thigh_and_shank_m(), self.mass())
    }
}

/// Rounds the axes of the body to the world axes if they are close: hips of models are rarely exactly level.
fn nearest_axes(axes: &Mat3) -> Mat3 {
    /// Cosine of 25 degrees.
    const NEAR: f64 = 0.9;
    let nearest = axes.map(|x| if x.abs() > NEAR { x.signum() } else { 0.0 });
    if (nearest.abs().sum() - 3.0).abs() < 0.5 { nearest } else { *axes }
}

/// Zero if it is in the range, otherwise the default value.
fn neutral_value(coordinate: &Coordinate) -> f64 {
    /// Ranges that end at zero may miss it by rounding [rad or m].
    const SLACK: f64 = 1e-6;
    let has_zero = coordinate.range.is_none_or(|[low, high]| low <= SLACK && high >= -SLACK);
    if has_zero { 0.0 } else { coordinate.default_value }
}

/// Side of each coordinate: the side of the body that it moves, otherwise the side in its name.
fn coordinate_sides(model: &Model, body_sides: &[Option<Side>]) -> Vec<Option<Side>> {
    let mut sides: Vec<Option<Side>> = model.coordinates.iter().map(|c| Side::of_name(&c.name)).collect();
    for (body, side) in model.bodies.iter().zip(body_sides).filter(|(_, side)| side.is_some()) {
        for id in body.joint.coordinates() {
            sides[id.index()] = *side;
        }
    }
    sides
}

/// The heaviest body without side, other than the pelvis.
#[inline]
fn trunk(tree: &Tree<'_>, pelvis: BodyId, oriented: &Oriented, sides: &[Option<Side>]) -> Option<BodyId> {
    let in_leg = |body: &BodyId| oriented.legs.values().flatten().any(|leg| leg.bodies.contains(body));
    let bodies = (0..tree.bodies.len()).map(BodyId);
    let upper = bodies.filter(|body| *body != pelvis && sides[body.index()].is_none() && !in_leg(body));
    let mass = |body: &BodyId| tree.bodies[body.index()].inertia.mass();
    let joined = upper.filter(|body| mass(body) > 0.0 && tree.path(pelvis, *body).is_some());
    joined.max_by(|a, b| mass(a).total_cmp(&mass(b)))
}

fn leg(tree: &Tree<'_>, chain: &LegChain, axes: &Mat3) -> Leg {
    let [hip, knee, ankle, end] = chain.groups;
    let joint = |group: usize, next: usize| {
        let joints = chain.bodies[group..=next].windows(2).map(|pair| tree.joint_between(pair[0], pair[1]));
        let moves = |body: &BodyId| !tree.bodies[body.index()].joint.coordinates().is_empty();
        let first = tree.joint_between(chain.bodies[group], chain.bodies[group + 1]);
        let mut joints = joints;
        joints.find(moves).unwrap_or(first)
    };
    let [hip, knee_joint, ankle_joint] = [joint(hip, knee), joint(knee, ankle), joint(ankle, end)];
    let center = |body: BodyId| tree.posture.joint_center(body);
    let foot = chain.bodies[end];
    let world_from_foot = tree.posture.poses[foot.index()];
    Leg {
        thigh: chain.bodies[knee],
        shank: chain.bodies[ankle],
        foot,
        toes: chain.bodies.get(end + 1).copied(),
        hip,
        knee: knee_joint,
        ankle: ankle_joint,
        ankle_in_foot: world_from_foot.inverse().place(center(ankle_joint)),
        foot_axes: foot_axes(axes, &world_from_foot),
        thigh_and_shank_m: (center(hip) - center(knee_joint)).norm()
            + (center(knee_joint) - center(ankle_joint)).norm(),
        systems: None,
    }
}
