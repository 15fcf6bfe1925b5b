//! The joint coordinate systems of hip, knee and ankle: the axes about which moments of three planes are given.
//!
//! | axis | fixed in | direction |
//! |---|---|---|
//! | e₁ | proximal segment | the joint's own axis of flexion in the neutral posture, to the right |
//! | e₃ | distal segment | the joint's own axis of internal rotation, otherwise its long axis, up |
//! | e₂ = e₃ × e₁ / ∣e₃ × e₁∣ | neither: it floats | forward |
//!
//! The long axis of the thigh goes from the knee to the hip, the long axis of the shank from the ankle to the knee. The
//! foot has the long axis of the shank in the neutral posture. The axes come from the joints, so that the directions of
//! a model's frames do not matter; a joint that does not flex has the axis of the body to the right.
//!
//! Source: Grood, Suntay 1983 (knee), Wu 2002 (hip and ankle; unverified).
//! Not handled: legs that move in the sagittal plane only. Where their joints lie sideways is not known, so they have
//! no moments of the other planes.
//! Pinned by: tests/joint_moments.rs

use super::legs::{LegChain, Tree};
use super::movement::{Meaning, Movement, Planes, planes_of_leg};
use crate::model::{BodyId, Side};
use crate::spatial::{Mat3, Vec3};

/// Places of the axes in a joint's planes: floating axis (forward), long axis (up), flexion axis (to the right).
const FLOATING: usize = 0;
const LONG: usize = 1;
const FLEXION: usize = 2;

/// The axes of a joint of a leg.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct JointSystem {
    /// The body whose joint to its parent is this joint.
    pub(crate) joint: BodyId,
    /// +1 if that joint acts on the distal segment, -1 in a tree whose root is the foot.
    pub(crate) on_distal: f64,
    proximal: BodyId,
    distal: BodyId,
    /// e₁ in the frame of the proximal segment.
    flexion: Vec3,
    /// e₃ in the frame of the distal segment.
    long: Vec3,
    /// The movements about the three axes, and their signs.
    pub(crate) planes: Planes,
}

/// A joint of a leg.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum LegJoint {
    /// The hip.
    Hip,
    /// The knee.
    Knee,
    /// The ankle.
    Ankle,
}

impl LegJoint {
    /// All joints, from the hip down.
    pub const ALL: [LegJoint; 3] = [LegJoint::Hip, LegJoint::Knee, LegJoint::Ankle];
}

/// Which wrench acts in a joint of a leg, and in which axes it is read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LegJointAxes {
    /// The body whose joint to its parent is this joint.
    pub body: BodyId,
    /// +1 if the wrench of the parent on this body acts on the distal segment, -1 in a tree whose root is the foot.
    pub on_distal: f64,
    /// Forward, up and to the right in the world: axes e₂, e₃ and e₁ of the joint coordinate system. A leg that moves
    /// in the sagittal plane only has the axes of the neutral posture, fixed in the distal segment.
    pub axes: [Vec3; 3],
}

impl JointSystem {
    /// e₂, e₃ and e₁ in the world, for the rotations `world_from_body` of the bodies: forward, up and to the right.
    #[inline]
    pub(crate) fn axes(&self, rotation: impl Fn(BodyId) -> Mat3) -> [Vec3; 3] {
        let flexion = rotation(self.proximal) * self.flexion;
        let long = rotation(self.distal) * self.long;
        let floating = long.cross(&flexion).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::zeros);
        [floating, long, flexion]
    }

    /// The systems of hip, knee and ankle; `None` for a leg that moves in the sagittal plane only.
    pub(super) fn of_leg(
        tree: &Tree<'_>,
        chain: &LegChain,
        side: Side,
        body_axes: &Mat3,
        meanings: &[Option<Meaning>],
    ) -> Option<[JointSystem; 3]> {
        let [hip, knee, ankle, end] = chain.groups;
        let found = Finder { tree, chain, body_axes, meanings };
        found.own_axis(hip, knee, Movement::HipAdduction, FLOATING)?;
        let place =
            |group: usize| tree.posture.joint_center(tree.joint_between(chain.bodies[group], chain.bodies[group + 1]));
        let [thigh, shank] = [place(hip) - place(knee), place(knee) - place(ankle)];
        let planes = planes_of_leg(side);
        Some([
            found.system([hip, knee], thigh, planes[0]),
            found.system([knee, ankle], shank, planes[1]),
            found.system([ankle, end], shank, planes[2]),
        ])
    }
}

/// Finds the axes of the joints of a leg in the neutral posture.
struct Finder<'a> {
    tree: &'a Tree<'a>,
    chain: &'a LegChain,
    body_axes: &'a Mat3,
    meanings: &'a [Option<Meaning>],
}

impl Finder<'_> {
    /// The system of the joints between two places of the chain; `long` is the long axis of the distal segment, up.
    fn system(&self, [from, to]: [usize; 2], long: Vec3, planes: Planes) -> JointSystem {
        let [proximal, distal] = [self.chain.bodies[from], self.chain.bodies[to]];
        let own = |axis: usize| planes[axis].and_then(|(movement, _)| self.own_axis(from, to, movement, axis));
        let along = |axis: usize| -> Vec3 { self.body_axes.column(axis).into() };
        let flexion = own(FLEXION).unwrap_or_else(|| along(FLEXION));
        let line = || long.try_normalize(f64::MIN_POSITIVE).unwrap_or_else(|| along(LONG));
        let long = own(LONG).unwrap_or_else(line);
        let in_body = |body: BodyId, axis: Vec3| self.tree.posture.poses[body.index()].rotation.transpose() * axis;
        let (joint, on_distal) = self.moving_joint(from, to);
        JointSystem {
            joint,
            on_distal,
            proximal,
            distal,
            flexion: in_body(proximal, flexion),
            long: in_body(distal, long),
            planes,
        }
    }

    /// The joints between two places of the chain, and whether each acts on the distal one of its bodies.
    fn joints(&self, from: usize, to: usize) -> impl Iterator<Item = (BodyId, f64)> + use<'_> {
        self.chain.bodies[from..=to].windows(2).map(|pair| {
            let joint = self.tree.joint_between(pair[0], pair[1]);
            (joint, if joint == pair[1] { 1.0 } else { -1.0 })
        })
    }

    /// The first joint that moves, otherwise the first one.
    fn moving_joint(&self, from: usize, to: usize) -> (BodyId, f64) {
        let moves = |(body, _): &(BodyId, f64)| !self.tree.bodies[body.index()].joint.coordinates().is_empty();
        let first = self.joints(from, to).find(moves).or_else(|| self.joints(from, to).next());
        first.unwrap_or((self.chain.bodies[to], 1.0))
    }

    /// The world axis of the coordinate that measures a movement, in the direction of an axis of the body.
    fn own_axis(&self, from: usize, to: usize, movement: Movement, axis: usize) -> Option<Vec3> {
        self.joints(from, to).find_map(|(body, _)| {
            let mut coordinates = self.tree.bodies[body.index()].joint.coordinates().into_iter();
            let id =
                coordinates.find(|id| self.meanings[id.index()].is_some_and(|found| found.movement == movement))?;
            let turn: Vec3 = self.tree.posture.slopes(body, id)[0].try_normalize(f64::MIN_POSITIVE)?;
            Some(turn * turn.dot(&self.body_axes.column(axis)).signum())
        })
    }
}
