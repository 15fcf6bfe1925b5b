//! Poses of all bodies at given coordinates, and how each coordinate turns or shifts the body that it moves.
//!
//! Plain arithmetic for the few postures that describe a model (its neutral one). Motions are computed by
//! [`kinematics`](crate::kinematics), which works on many frames at once.

use super::{BodyId, CoordinateId, Displacement, Drive, Joint, JointAxis, Measure, Model};
use crate::spatial::{Mat3, Pose, Vec3};

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
    fn parent_from_child(&self, q: &[f64]) -> Pose {
        let mut rotation = Mat3::identity();
        for axis in &self.rotations {
            rotation *= turn(axis.direction, axis.at(q, None).0);
        }
        let mut translation: Vec3 = self.translations.iter().map(|axis| axis.direction * axis.at(q, None).0).sum();
        if let Measure::Ellipsoid(radii) = self.measure {
            translation += radii.component_mul(&rotation.column(2));
        }
        self.parent_from_joint * Pose { rotation, translation } * self.child_from_joint.inverse()
    }

    /// Angular velocity and velocity of the child's joint frame per unit of a coordinate's rate, in the axes of the parent.
    fn slopes(&self, q: &[f64], id: CoordinateId) -> [Vec3; 2] {
        let (mut turned, mut angular) = (Mat3::identity(), Vec3::zeros());
        for axis in &self.rotations {
            let (angle, slope) = axis.at(q, Some(id));
            angular += turned * axis.direction * slope;
            turned *= turn(axis.direction, angle);
        }
        let linear: Vec3 = self.translations.iter().map(|axis| axis.direction * axis.at(q, Some(id)).1).sum();
        [angular, linear].map(|v| self.parent_from_joint.rotation * v)
    }
}

fn turn(axis: Vec3, angle: f64) -> Mat3 {
    *nalgebra::Rotation3::from_axis_angle(&nalgebra::Unit::new_unchecked(axis), angle).matrix()
}

/// A model in one posture.
#[derive(Debug, Clone)]
pub(crate) struct PostureOf<'a> {
    model: &'a Model,
    q: Vec<f64>,
    /// `world_from_body` of every body.
    pub(crate) poses: Vec<Pose>,
}

impl<'a> PostureOf<'a> {
    /// At these coordinates; those with couplers follow their leaders.
    pub(crate) fn new(model: &'a Model, mut q: Vec<f64>) -> PostureOf<'a> {
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
        PostureOf { model, q, poses }
    }

    /// Centre of the joint that joins a body to its parent [m].
    pub(crate) fn joint_center(&self, body: BodyId) -> Vec3 {
        let joint = &self.model.bodies()[body.index()].joint;
        self.poses[body.index()].place(joint.child_from_joint.translation)
    }

    /// Mass centre of a body [m].
    pub(crate) fn mass_center(&self, body: BodyId) -> Vec3 {
        self.poses[body.index()].place(self.model.bodies()[body.index()].inertia.center())
    }

    /// Angular velocity and velocity that a coordinate of a body's joint gives it relative to its parent, per unit of the
    /// coordinate's rate, in world axes.
    pub(crate) fn slopes(&self, body: BodyId, id: CoordinateId) -> [Vec3; 2] {
        let joint = &self.model.bodies()[body.index()].joint;
        let parent = joint.parent.map_or_else(Mat3::identity, |parent| self.poses[parent.index()].rotation);
        joint.slopes(&self.q, id).map(|v| parent * v)
    }
}
