//! The anatomical movement that each coordinate measures, and its sign.
//!
//! A coordinate rotates one body relative to another about an axis ω (per unit rate, in the neutral posture). In the
//! axes of the body (forward, up, right), the largest component of ω determines the plane, and its sign the direction:
//!
//! | joint (far body relative to near body) | about forward (frontal) | about up (transverse) | about right (sagittal) |
//! |---|---|---|---|
//! | pelvis relative to the world | right side down | right side forward | posterior tilt |
//! | trunk relative to the pelvis | bends to the right | right side forward | extension |
//! | right hip | adduction | internal rotation | flexion |
//! | right knee | adduction | internal rotation | extension |
//! | right ankle | inversion | internal rotation | dorsiflexion |
//! | right toes | - | - | extension |
//!
//! On the left, the signs of the frontal and the transverse plane are reversed.

use super::axes::Oriented;
use super::legs::Tree;
use crate::model::posture::ModelPosture;
use crate::model::{BodyId, Coordinate, CoordinateId, Drive, Side};
use crate::spatial::Vec3;

/// Smallest share of an axis along the normal of its plane.
const LEAST_SHARE: f64 = 0.5;
/// The same for toes, whose axis is oblique.
const LEAST_SHARE_OF_TOES: f64 = 0.3;

/// A clinical movement, positive in the direction of its description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Movement {
    /// Anterior tilt of the pelvis.
    PelvicTilt,
    /// Right side of the pelvis up.
    PelvicObliquity,
    /// Right side of the pelvis forward.
    PelvicRotation,
    /// Pelvis forward [m].
    PelvisForward,
    /// Pelvis up [m].
    PelvisUp,
    /// Pelvis to the right [m].
    PelvisRight,
    /// Flexion of the hip: thigh forward.
    HipFlexion,
    /// Adduction of the hip: thigh towards the middle.
    HipAdduction,
    /// Internal rotation of the hip.
    HipRotation,
    /// Flexion of the knee: shank backward.
    KneeFlexion,
    /// Adduction of the knee (varus): shank towards the middle.
    KneeAdduction,
    /// Internal rotation of the knee.
    KneeRotation,
    /// Dorsiflexion of the ankle: toes up.
    AnkleDorsiflexion,
    /// Inversion of the foot: sole towards the middle.
    SubtalarInversion,
    /// Internal rotation of the foot: toes towards the middle.
    FootRotation,
    /// Extension of the toes: toes up.
    ToeExtension,
    /// Forward lean of the trunk relative to the pelvis.
    TrunkLean,
    /// Right side of the trunk up, relative to the pelvis.
    TrunkObliquity,
    /// Right side of the trunk forward, relative to the pelvis.
    TrunkRotation,
}

impl Movement {
    /// The last movement of the same joint of a leg; the movements of a leg follow each other from the hip down.
    fn last_of_joint(self) -> Movement {
        [HIP, KNEE, ANKLE, TOES]
            .iter()
            .map(|planes| planes.iter().flatten().map(|(movement, _)| *movement))
            .find(|movements| movements.clone().any(|movement| movement == self))
            .and_then(Iterator::max)
            .unwrap_or(self)
    }
}

/// The movement that a coordinate measures, and its sign.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Meaning {
    /// The movement.
    pub movement: Movement,
    /// The side of a leg's coordinate; `None` for pelvis and trunk.
    pub side: Option<Side>,
    /// +1 if the coordinate increases during the movement, -1 if it decreases.
    pub sign: f64,
}

/// The movements of a joint about the axes forward, up and right, each with the sign of a rotation about the axis.
pub(crate) type Planes = [Option<(Movement, f64)>; 3];

const PELVIS: Planes = [
    Some((Movement::PelvicObliquity, -1.0)),
    Some((Movement::PelvicRotation, 1.0)),
    Some((Movement::PelvicTilt, -1.0)),
];
const TRUNK: Planes =
    [Some((Movement::TrunkObliquity, -1.0)), Some((Movement::TrunkRotation, 1.0)), Some((Movement::TrunkLean, -1.0))];
// Right leg.
const HIP: Planes =
    [Some((Movement::HipAdduction, 1.0)), Some((Movement::HipRotation, 1.0)), Some((Movement::HipFlexion, 1.0))];
const KNEE: Planes =
    [Some((Movement::KneeAdduction, 1.0)), Some((Movement::KneeRotation, 1.0)), Some((Movement::KneeFlexion, -1.0))];
const ANKLE: Planes = [
    Some((Movement::SubtalarInversion, 1.0)),
    Some((Movement::FootRotation, 1.0)),
    Some((Movement::AnkleDorsiflexion, 1.0)),
];
const TOES: Planes = [None, None, Some((Movement::ToeExtension, 1.0))];
const PELVIS_SHIFTS: Planes =
    [Some((Movement::PelvisForward, 1.0)), Some((Movement::PelvisUp, 1.0)), Some((Movement::PelvisRight, 1.0))];

/// The movements of a joint on a side.
fn of_side([frontal, transverse, sagittal]: Planes, side: Side) -> Planes {
    let turned = |entry: Option<(Movement, f64)>| entry.map(|(movement, sign)| (movement, -sign));
    match side {
        Side::Right => [frontal, transverse, sagittal],
        Side::Left => [turned(frontal), turned(transverse), sagittal],
    }
}

/// The movements of hip, knee and ankle on a side.
pub(super) fn planes_of_leg(side: Side) -> [Planes; 3] {
    [HIP, KNEE, ANKLE].map(|planes| of_side(planes, side))
}

impl Meaning {
    /// Whether a coordinate turns the joint of a movement of a leg, or one between that joint and the pelvis.
    pub(super) fn is_above(self, movement: Movement, side: Side) -> bool {
        let joints = Movement::HipFlexion..=movement.last_of_joint();
        self.side == Some(side) && joints.contains(&self.movement)
    }
}

/// A coordinate and the axis of its motion: forward, up and right.
struct Axis {
    id: CoordinateId,
    direction: Vec3,
}

/// Determines the meanings of all coordinates.
pub(super) struct Meanings<'a> {
    tree: &'a Tree<'a>,
    coordinates: &'a [Coordinate],
    oriented: &'a Oriented,
    pub(super) found: Vec<Option<Meaning>>,
}

impl<'a> Meanings<'a> {
    pub(super) fn find(
        tree: &'a Tree<'a>,
        coordinates: &'a [Coordinate],
        oriented: &'a Oriented,
        [pelvis, trunk]: [Option<BodyId>; 2],
    ) -> Vec<Option<Meaning>> {
        let mut meanings = Meanings { tree, coordinates, oriented, found: vec![None; coordinates.len()] };
        if let Some(pelvis) = pelvis {
            meanings.root(pelvis);
            meanings.trunk(trunk.and_then(|trunk| tree.path(pelvis, trunk)));
        }
        for (side, leg) in oriented.legs.iter() {
            let Some(leg) = leg else { continue };
            let [hip, knee, ankle, end] = leg.groups;
            let toes = leg.bodies.len().min(end + 2) - 1;
            for (joints, planes) in [(hip..knee, HIP), (knee..ankle, KNEE), (ankle..end, ANKLE), (end..toes, TOES)] {
                let least = if planes == TOES { LEAST_SHARE_OF_TOES } else { LEAST_SHARE };
                let axes = meanings.turns(&leg.bodies[joints.start..=joints.end]);
                meanings.assign(axes, of_side(planes, side), Some(side), least);
            }
        }
        meanings.found
    }

    /// Rotations and translations of the pelvis in the world, if the pelvis is the root of the tree.
    fn root(&mut self, pelvis: BodyId) {
        if self.tree.bodies[pelvis.index()].joint.parent.is_none() {
            let [turns, shifts] = self.slopes(pelvis, 1.0);
            self.assign(turns, PELVIS, None, LEAST_SHARE);
            self.assign(shifts, PELVIS_SHIFTS, None, LEAST_SHARE);
        }
    }

    /// Movements of the trunk, if each has a single coordinate: a spine of several free joints has none.
    fn trunk(&mut self, path: Option<Vec<BodyId>>) {
        let mut axes = self.turns(&path.unwrap_or_default());
        let planes: Vec<usize> = axes.iter().map(|axis| axis.direction.iamax()).collect();
        let mut planes_left = planes.iter();
        axes.retain(|_| planes_left.next().is_some_and(|plane| planes.iter().filter(|p| *p == plane).count() == 1));
        self.assign(axes, TRUNK, None, LEAST_SHARE);
    }

    /// Axes of the coordinates that rotate the distal bodies of a chain relative to the proximal ones.
    fn turns(&self, chain: &[BodyId]) -> Vec<Axis> {
        let joints = chain.windows(2).flat_map(|pair| {
            let joint = self.tree.joint_between(pair[0], pair[1]);
            let [turns, _] = self.slopes(joint, if joint == pair[1] { 1.0 } else { -1.0 });
            turns
        });
        joints.collect()
    }

    /// Axes of rotations and of translations of one joint.
    fn slopes(&self, body: BodyId, sign: f64) -> [Vec<Axis>; 2] {
        let mut axes = [Vec::new(), Vec::new()];
        for id in self.tree.bodies[body.index()].joint.coordinates() {
            if matches!(self.coordinates[id.index()].drive, Drive::Coupled(..)) {
                continue;
            }
            let slopes: [Vec3; 2] = ModelPosture::slopes(self.tree.posture, body, id);
            let turn = self.local(slopes[0] * sign);
            let kind = usize::from(turn.is_none());
            if let Some(direction) = turn.or_else(|| self.local(slopes[1] * sign)) {
                axes[kind].push(Axis { id, direction });
            }
        }
        axes
    }

    fn local(&self, v: Vec3) -> Option<Vec3> {
        (self.oriented.axes.transpose() * v).try_normalize(1e-6)
    }

    /// Assigns each axis to the nearest plane, the closest pair first.
    fn assign(&mut self, mut axes: Vec<Axis>, mut planes: Planes, side: Option<Side>, least: f64) {
        loop {
            let free = planes.iter().enumerate().filter(|(_, plane)| plane.is_some()).map(|(k, _)| k);
            let pairs =
                free.flat_map(|k| axes.iter().enumerate().map(move |(i, axis)| (i, k, axis.direction[k].abs())));
            // The first of equal pairs.
            let best = pairs.reduce(|best, pair| if pair.2 > best.2 { pair } else { best });
            let Some((i, k, _)) = best.filter(|(_, _, share)| *share >= least) else { return };
            let axis = axes.remove(i);
            if let Some((movement, sign)) = planes[k].take() {
                let sign = sign * axis.direction[k].signum();
                self.found[axis.id.index()] = Some(Meaning { movement, side, sign });
            }
        }
    }
}
