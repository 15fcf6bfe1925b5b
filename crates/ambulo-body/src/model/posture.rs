//! Poses of all bodies of a model at given coordinates, and the motion of a body per unit rate of a coordinate.
//!
//! For the few postures that describe a model (its neutral one). Motions are computed by
//! [`kinematics`](crate::kinematics), which processes many frames at once.

use super::arc;
use super::{BodyId, CoordinateId, Displacement, Drive, Joint, JointAxis, JointSpeeds, Model};
use crate::spatial::{Mat3, Pose, Vec3, rotation_about};

impl JointAxis {
    /// Displacement along or about the axis [rad or m] and its derivative by a coordinate.
    fn at(&self, q: &[f64], by: Option<CoordinateId>) -> (f64, f64) {
        match &self.displacement {
            Displacement::Fixed(value) => (*value, 0.0),
            Displacement::Follows(id, function) => {
                let [value, slope, ..] = function.at(q[id.index()]);
                (value, if by == Some(*id) { slope } else { 0.0 })
            }
        }
    }
}

impl Joint {
    /// `parent_from_child` at these coordinates of the model.
    #[doc(hidden)]
    pub fn parent_from_child(&self, q: &[f64]) -> Pose {
        let mut rotation = Mat3::identity();
        for axis in &self.rotations {
            rotation *= rotation_about(axis.direction, axis.at(q, None).0);
        }
        let mut translation: Vec3 = self.translations.iter().map(|axis| axis.direction * axis.at(q, None).0).sum();
        if let JointSpeeds::Ellipsoid(radii) = self.speeds {
            translation += radii.component_mul(&rotation.column(2));
        }
        if let JointSpeeds::Arc(length) = self.speeds {
            translation += arc::end(length, rotation.column(1).into_owned());
        }
        self.parent_from_joint * Pose { rotation, translation } * self.child_from_joint.inverse()
    }

    /// Angular velocity and velocity of the joint frame of the child per unit rate of a coordinate, in the axes of the
    /// parent.
    #[doc(hidden)]
    pub fn slopes(&self, q: &[f64], id: CoordinateId) -> [Vec3; 2] {
        let (mut turned, mut angular) = (Mat3::identity(), Vec3::zeros());
        for axis in &self.rotations {
            let (angle, slope) = axis.at(q, Some(id));
            angular += turned * axis.direction * slope;
            turned *= rotation_about(axis.direction, angle);
        }
        let mut linear: Vec3 = self.translations.iter().map(|axis| axis.direction * axis.at(q, Some(id)).1).sum();
        let sliding = |axis: usize| turned.column(axis).into_owned();
        match self.speeds {
            JointSpeeds::Ellipsoid(radii) => linear += radii.component_mul(&angular.cross(&sliding(2))),
            JointSpeeds::Arc(length) => linear += arc::slide(length, sliding(1), angular.cross(&sliding(1))),
            JointSpeeds::Rates | JointSpeeds::AngularVelocity => {}
        }
        [angular, linear].map(|v| self.parent_from_joint.rotation * v)
    }
}

impl Model {
    /// `world_from_body` of every body at these coordinates, one value for each [rad or m]; coupled ones follow their
    /// leaders.
    #[must_use]
    pub fn poses(&self, coordinates: &[f64]) -> Vec<Pose> {
        ModelPosture::new(self, coordinates.to_vec()).poses
    }

    /// Mass centre at these coordinates, one value for each [rad or m]; coupled ones follow their leaders [m].
    #[must_use]
    pub fn mass_center(&self, coordinates: &[f64]) -> Vec3 {
        let posture = ModelPosture::new(self, coordinates.to_vec());
        let moment = |body: BodyId| self.bodies()[body.index()].inertia.mass() * posture.mass_center(body);
        self.body_ids().map(moment).sum::<Vec3>() / self.mass()
    }
}

/// The poses of all bodies of a model in one posture.
#[derive(Debug, Clone)]
pub(crate) struct ModelPosture<'a> {
    model: &'a Model,
    q: Vec<f64>,
    /// `world_from_body` of every body.
    pub(crate) poses: Vec<Pose>,
}

impl<'a> ModelPosture<'a> {
    /// Computes the poses at these coordinates; coupled ones follow their leaders.
    pub(crate) fn new(model: &'a Model, mut q: Vec<f64>) -> ModelPosture<'a> {
        for (i, coordinate) in model.coordinates().iter().enumerate() {
            if let Drive::Coupled(leader, function) = &coordinate.drive {
                q[i] = function.at(q[leader.index()])[0];
            }
        }
        let mut poses: Vec<Pose> = Vec::with_capacity(model.bodies().len());
        for body in model.bodies() {
            let parent = body.joint.parent.map_or(Pose::IDENTITY, |parent| poses[parent.index()]);
            poses.push(parent * body.joint.parent_from_child(&q));
        }
        ModelPosture { model, q, poses }
    }

    /// Centre of the joint between a body and its parent [m].
    pub(crate) fn joint_center(&self, body: BodyId) -> Vec3 {
        let joint = &self.model.bodies()[body.index()].joint;
        self.poses[body.index()].place(joint.child_from_joint.translation)
    }

    /// Mass centre of a body [m].
    pub(crate) fn mass_center(&self, body: BodyId) -> Vec3 {
        self.poses[body.index()].place(self.model.bodies()[body.index()].inertia.center())
    }

    /// Angular velocity and velocity of a body relative to its parent per unit rate of a coordinate of its joint, in
    /// world axes.
    pub(crate) fn slopes(&self, body: BodyId, id: CoordinateId) -> [Vec3; 2] {
        let joint = &self.model.bodies()[body.index()].joint;
        let parent = joint.parent.map_or_else(Mat3::identity, |parent| self.poses[parent.index()].rotation);
        joint.slopes(&self.q, id).map(|v| parent * v)
    }
}
