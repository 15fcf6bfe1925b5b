//! Finds the pelvis and the legs in the tree of bodies from the positions of the joints in the neutral posture.
//!
//! A leg is a chain of three groups of joints: hip, knee and ankle, each below the previous one. Joints that are close
//! together are one group: a hip of three hinges, or ankle and subtalar joint. The lowest body of the model is at the
//! end of one leg. The other leg ends in the lowest body whose path from there rises to the height of the hips. The
//! pelvis is the body between the two highest joints of that path.

use super::BodyId;
use crate::model::posture::ModelPosture;
use crate::model::{Body, BySide};
use crate::spatial::Vec3;

/// Joints closer to each other than this share of the leg length are one group: 0.075 from ankle to subtalar joint in
/// Gait2392, 0.16 from ankle to the ball of the foot in the built-in figure.
const GROUP: f64 = 0.11;
/// Smallest height of the hips above the feet, as a share of the height of the model.
const LEAST_HIP_HEIGHT: f64 = 0.25;
/// Largest height difference of the lower ends of two legs, as a share of the height of the hips.
const LEVEL: f64 = 0.25;
/// Smallest length of thigh and shank, as a share of the leg length.
const LEAST_SEGMENT: f64 = 0.25;
/// Joints less than this share of the height of the hips below the highest one count as equally high.
const AS_HIGH: f64 = 0.05;

/// The tree of bodies of a model in its neutral posture.
pub(super) struct Tree<'a> {
    pub(super) bodies: &'a [Body],
    pub(super) posture: &'a ModelPosture<'a>,
    pub(super) up: Vec3,
}

/// A chain of bodies from the pelvis to the toes, with the groups of its joints.
#[derive(Debug, Clone)]
pub(super) struct LegChain {
    /// Bodies of the leg from the pelvis on. Joint i is between bodies i and i + 1.
    pub(super) bodies: Vec<BodyId>,
    /// First joint of hip, knee and ankle, and the first one beyond the ankle.
    pub(super) groups: [usize; 4],
    /// Height of the hip above the lowest point of the chain [m].
    pub(super) length: f64,
}

/// The pelvis and one or two legs, without sides.
pub(super) struct LowerBody {
    pub(super) pelvis: BodyId,
    pub(super) legs: Vec<LegChain>,
}

impl Tree<'_> {
    fn ids(&self) -> impl Iterator<Item = BodyId> + use<> {
        (0..self.bodies.len()).map(BodyId)
    }

    fn parent(&self, body: BodyId) -> Option<BodyId> {
        self.bodies[body.index()].joint.parent
    }

    /// The body whose joint to its parent is the one between two neighbours.
    pub(super) fn joint_between(&self, a: BodyId, b: BodyId) -> BodyId {
        if self.parent(a) == Some(b) { a } else { b }
    }

    fn joint_height(&self, body: BodyId) -> f64 {
        self.posture.joint_center(body).dot(&self.up)
    }

    /// Height of the lower of joint and mass centre of a body [m].
    fn low(&self, body: BodyId) -> f64 {
        let joint = self.joint_height(body);
        let has_mass = self.bodies[body.index()].inertia.mass() > 0.0;
        if has_mass { joint.min(self.posture.mass_center(body).dot(&self.up)) } else { joint }
    }

    fn lowest(&self, mut bodies: impl Iterator<Item = BodyId>) -> f64 {
        bodies.by_ref().map(|body| self.low(body)).fold(f64::INFINITY, f64::min)
    }

    /// A body and its ancestors up to the root.
    fn ancestry(&self, body: BodyId) -> Vec<BodyId> {
        std::iter::successors(Some(body), |body| self.parent(*body)).collect()
    }

    /// The bodies from one to another, both included; `None` if they are connected only through ground.
    pub(super) fn path(&self, from: BodyId, to: BodyId) -> Option<Vec<BodyId>> {
        let (up, down) = (self.ancestry(from), self.ancestry(to));
        let meets = up.iter().position(|body| down.contains(body))?;
        let turn = down.iter().position(|body| *body == up[meets])?;
        Some(up[..=meets].iter().chain(down[..turn].iter().rev()).copied().collect())
    }

    /// Bodies on the far side of a neighbour, seen from a body.
    pub(super) fn beyond(&self, body: BodyId, neighbour: BodyId) -> Vec<BodyId> {
        let is_beyond = |other: &BodyId| self.path(body, *other).is_some_and(|path| path.get(1) == Some(&neighbour));
        self.ids().filter(is_beyond).collect()
    }

    fn neighbours(&self, body: BodyId) -> impl Iterator<Item = BodyId> {
        let children = self.ids().filter(move |other| self.parent(*other) == Some(body));
        children.chain(self.parent(body))
    }

    /// The chain of a leg from the hip on; `bodies` begins with the pelvis. `None` if its joints are not the joints of
    /// a leg.
    fn chain(&self, mut bodies: Vec<BodyId>) -> Option<LegChain> {
        let joints: Vec<BodyId> = bodies.windows(2).map(|pair| self.joint_between(pair[0], pair[1])).collect();
        let centers: Vec<Vec3> = joints.iter().map(|joint| self.posture.joint_center(*joint)).collect();
        let height = |i: usize| centers[i].dot(&self.up);
        let length = if centers.is_empty() { 0.0 } else { height(0) - self.lowest(bodies[1..].iter().copied()) };
        let mut starts = vec![0];
        for i in 1..centers.len() {
            if (centers[i] - centers[starts[starts.len() - 1]]).norm() > GROUP * length {
                starts.push(i);
            }
        }
        let [hip, knee, ankle] = *starts.get(..3)? else { return None };
        let end = starts.get(3).copied().unwrap_or(centers.len());
        let long_enough = |from: usize, to: usize| height(from) - height(to) > LEAST_SEGMENT * length;
        if !(length > 0.0 && long_enough(hip, knee) && long_enough(knee, ankle)) {
            return None;
        }
        if bodies.len() == end + 1 {
            bodies.extend(self.toes(bodies[end - 1], bodies[end], centers[ankle], GROUP * length));
        }
        Some(LegChain { bodies, groups: [hip, knee, ankle, end], length })
    }

    /// The toes: the lowest neighbour of a foot whose joint is not part of the ankle.
    fn toes(&self, before: BodyId, foot: BodyId, ankle: Vec3, apart: f64) -> Option<BodyId> {
        let joint = |body: BodyId| self.posture.joint_center(self.joint_between(foot, body));
        let is_toes = |body: &BodyId| *body != before && (joint(*body) - ankle).norm() > apart;
        self.neighbours(foot).filter(is_toes).min_by(|a, b| self.low(*a).total_cmp(&self.low(*b)))
    }

    /// Finds pelvis and legs; `None` if the model does not stand on one or two legs.
    pub(super) fn lower(&self) -> Option<LowerBody> {
        let first = self.ids().min_by(|a, b| self.low(*a).total_cmp(&self.low(*b)))?;
        let lower = self.two_legs(first).or_else(|| self.one_leg(first))?;
        let of_legs: Vec<BodyId> = lower.legs.iter().flat_map(|leg| self.beyond(lower.pelvis, leg.bodies[1])).collect();
        let (floor, length) = (self.low(first), lower.legs[0].length);
        let others = self.lowest(self.ids().filter(|body| !of_legs.contains(body)));
        (others > floor + LEVEL * length).then_some(lower)
    }

    fn two_legs(&self, first: BodyId) -> Option<LowerBody> {
        let top = self.ids().map(|body| self.joint_height(body)).fold(f64::NEG_INFINITY, f64::max);
        let floor = self.low(first);
        let is_other_foot = |path: &Vec<BodyId>| {
            let joints = path.windows(2).map(|pair| self.joint_height(self.joint_between(pair[0], pair[1])));
            let rise = joints.fold(f64::NEG_INFINITY, f64::max) - floor;
            let end = path[path.len() - 1];
            rise > LEAST_HIP_HEIGHT * (top - floor) && self.low(end) - floor < LEVEL * rise
        };
        let paths = self.ids().filter_map(|body| self.path(first, body)).filter(is_other_foot);
        let low_end = |path: &Vec<BodyId>| self.low(path[path.len() - 1]);
        let path = paths.min_by(|a, b| low_end(a).total_cmp(&low_end(b)))?;
        let at = self.pelvis_on(&path, floor)?;
        let legs = [path[..=at].iter().rev().copied().collect(), path[at..].to_vec()];
        let legs: Vec<LegChain> = legs.into_iter().map(|bodies| self.chain(bodies)).collect::<Option<_>>()?;
        Some(LowerBody { pelvis: path[at], legs })
    }

    /// Index of the pelvis on a path from foot to foot: the body between the highest joints; of several, the one
    /// between the joints furthest apart.
    fn pelvis_on(&self, path: &[BodyId], floor: f64) -> Option<usize> {
        let joints: Vec<BodyId> = path.windows(2).map(|pair| self.joint_between(pair[0], pair[1])).collect();
        let height = |i: usize| self.joint_height(joints[i - 1]).min(self.joint_height(joints[i]));
        let best = (1..joints.len()).map(height).fold(f64::NEG_INFINITY, f64::max);
        let apart = |i: usize| {
            let distance = (self.posture.joint_center(joints[i - 1]) - self.posture.joint_center(joints[i])).norm();
            [distance, self.bodies[path[i].index()].inertia.mass()]
        };
        let high = (1..joints.len()).filter(|i| height(*i) > best - AS_HIGH * (best - floor));
        high.max_by(|a, b| {
            let ([a, mass_a], [b, mass_b]) = (apart(*a), apart(*b));
            a.total_cmp(&b).then(mass_a.total_cmp(&mass_b))
        })
    }

    /// The only leg, from its foot.
    fn one_leg(&self, foot: BodyId) -> Option<LowerBody> {
        let mut path = self.ancestry(foot);
        path.reverse();
        (0..path.len()).find_map(|at| {
            let leg = self.chain(path[at..].to_vec())?;
            Some(LowerBody { pelvis: path[at], legs: vec![leg] })
        })
    }

    /// Horizontal vector from the ankle to the front of the foot [m]: to the toe joint, otherwise to the mass centre of
    /// the foot.
    pub(super) fn ahead(&self, leg: &LegChain) -> Vec3 {
        let [_, _, ankle, end] = leg.groups;
        let joint = |i: usize| self.posture.joint_center(self.joint_between(leg.bodies[i], leg.bodies[i + 1]));
        let front = if end + 1 < leg.bodies.len() { joint(end) } else { self.posture.mass_center(leg.bodies[end]) };
        level(front - joint(ankle), self.up)
    }

    /// Hip centre of a leg [m].
    pub(super) fn hip(&self, leg: &LegChain) -> Vec3 {
        self.posture.joint_center(self.joint_between(leg.bodies[0], leg.bodies[1]))
    }
}

/// The horizontal part of a vector.
pub(super) fn level(v: Vec3, up: Vec3) -> Vec3 {
    v - up * v.dot(&up)
}

/// Legs by side.
pub(super) type Legs = BySide<Option<LegChain>>;
