//! Positions of joints in the bodies that they connect.

use super::part::Part;
use crate::kinematics::{BodyMotion, Posture, body_motion};
use crate::model::anatomy::Leg;
use crate::model::{BodyId, Model, Side};
use crate::spatial::Vec3;

/// A model with every coordinate at its default.
pub(super) struct JointPlaces<'a> {
    pub(super) model: &'a Model,
    pub(super) rest: Vec<BodyMotion>,
}

impl<'a> JointPlaces<'a> {
    pub(super) fn new(model: &'a Model) -> JointPlaces<'a> {
        let q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
        let rest = vec![0.0; q.len()];
        JointPlaces { model, rest: body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest }) }
    }

    /// The part of the person that a body is: from the anatomy of pelvis, trunk and legs, otherwise from its name.
    pub(super) fn part(&self, body: BodyId) -> Part {
        let anatomy = self.model.anatomy();
        // An undivided trunk is pelvis and trunk in one body.
        let central =
            [(anatomy.trunk(), Part::Trunk), (anatomy.pelvis().filter(|_| anatomy.trunk().is_some()), Part::Pelvis)];
        let of_leg = |leg: &Leg| {
            [
                (Some(leg.thigh), Part::Thigh),
                (Some(leg.shank), Part::Shank),
                (Some(leg.foot), Part::Foot),
                (leg.toes, Part::Toes),
                (Some(leg.ankle), Part::Small),
            ]
        };
        let legs = anatomy.legs().values().flatten().flat_map(of_leg);
        let found = central.into_iter().chain(legs).find(|(id, _)| *id == Some(body));
        found.map_or_else(|| Part::of(&self.model.bodies()[body.index()].name), |(_, part)| part)
    }

    pub(super) fn side(&self, body: BodyId) -> Option<Side> {
        self.model.anatomy().body_side(body)
    }

    /// Centre of the joint to the parent of a body, in the frame of the body [m].
    pub(super) fn own(&self, body: BodyId) -> Vec3 {
        self.model.bodies()[body.index()].joint.child_from_joint.translation
    }

    /// Mass centre of a body in its own frame [m].
    pub(super) fn mass_center(&self, body: BodyId) -> Vec3 {
        self.model.bodies()[body.index()].inertia.center()
    }

    pub(super) fn mass(&self, body: BodyId) -> f64 {
        self.model.bodies()[body.index()].inertia.mass()
    }

    /// The children of a body.
    pub(super) fn children(&self, body: BodyId) -> impl Iterator<Item = BodyId> {
        self.model.body_ids().filter(move |id| self.model.bodies()[id.index()].joint.parent == Some(body))
    }

    /// Centre of the joint to the parent of `other`, in the frame of `body` at rest [m].
    pub(super) fn joint_of(&self, other: BodyId, body: BodyId) -> Vec3 {
        self.seen_from(body, self.rest[other.index()].pose.place(self.own(other)))
    }

    /// A point in the world, expressed in the frame of `body` at rest [m].
    pub(super) fn seen_from(&self, body: BodyId, place: Vec3) -> Vec3 {
        self.rest[body.index()].pose.inverse().place(place)
    }

    /// Joints of the children of a body that are this part, in the frame of the body [m].
    pub(super) fn joints_to(&self, body: BodyId, part: Part) -> Vec<Vec3> {
        self.children(body).filter(|id| self.part(*id) == part).map(|id| self.joint_of(id, body)).collect()
    }

    /// The body with this side and part, if there is one.
    pub(super) fn find(&self, part: Part, side: Option<Side>) -> Option<BodyId> {
        self.model.body_ids().find(|id| self.part(*id) == part && self.side(*id) == side)
    }

    /// Unit vector upwards in the frame of a body at rest.
    pub(super) fn up(&self, body: BodyId) -> Vec3 {
        let up = (-self.model.gravity()).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::y);
        self.rest[body.index()].pose.rotation.transpose() * up
    }
}
