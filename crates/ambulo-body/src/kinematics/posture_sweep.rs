//! One posture of a model: the motion of every body, and how each coordinate moves the bodies beyond its joint.
//!
//! The subtree of a body moves as a rigid body while a coordinate of its joint changes. For a joint with the axes aₖ
//! (rotations) and eᵢ (translations) of `kinematics::sweep`, per unit rate of the coordinate q,
//!
//!   ω = Σ aₖ dθₖ/dq                         v = Σ eᵢ ddᵢ/dq          at the joint centre
//!
//! and for a joint whose speeds are angular velocities, per unit of each speed: ω is an axis of F. The generalised
//! force of a force f with the moment n about the joint centre is ω · n + v · f, as in `dynamics::inverse`.

use super::body_motion::BodyMotion;
use super::plan::Plan;
use super::sweep::{self, Scratch};
use super::trajectory::Posture;
use crate::model::{BodyId, CoordinateId, Model};
use crate::spatial::{Twist, Vec3};
use std::ops::Range;

/// Motion of the bodies beyond a joint per unit of a generalised speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointMotion {
    /// The coordinate to which the speed belongs.
    pub coordinate: CoordinateId,
    /// Angular velocity, and velocity at the joint centre, in world axes, per unit of the speed.
    pub twist: Twist,
}

/// The bodies and joints of a model in one posture. Made once; [`PostureSweep::update`] allocates nothing.
#[derive(Debug, Clone)]
pub struct PostureSweep {
    plan: Plan,
    scratch: Scratch<1>,
    bodies: Vec<BodyMotion>,
    joint_centers: Vec<Vec3>,
    motions: Vec<JointMotion>,
    /// Of each body in `motions`.
    ranges: Vec<Range<usize>>,
}

impl PostureSweep {
    /// Memory for a model, with all coordinates at zero.
    #[must_use]
    pub fn new(model: &Model) -> PostureSweep {
        let plan = Plan::new(model);
        let scratch = Scratch::new(&plan);
        let mut motions = Vec::new();
        let mut ranges = Vec::new();
        for body in model.bodies() {
            let first = motions.len();
            let still = |coordinate| JointMotion { coordinate, twist: Twist::ZERO };
            motions.extend(body.joint.coordinates().into_iter().map(still));
            ranges.push(first..motions.len());
        }
        let bodies = Vec::with_capacity(model.bodies().len());
        let joint_centers = Vec::with_capacity(model.bodies().len());
        let mut made = PostureSweep { plan, scratch, bodies, joint_centers, motions, ranges };
        let zeros = vec![0.0; model.coordinates().len()];
        made.update(Posture { q: &zeros, qd: &zeros, qdd: &zeros });
        made
    }

    /// Computes everything for another posture.
    ///
    /// # Panics
    /// If the length of a slice of `posture` differs from the number of coordinates.
    pub fn update(&mut self, posture: Posture<'_>) {
        let PostureSweep { plan, scratch, bodies, joint_centers, motions, ranges } = self;
        scratch.load_posture(posture);
        sweep::forward(plan, scratch);
        bodies.clear();
        bodies.extend((0..plan.segments.len()).map(|i| scratch.body_motion(plan, BodyId(i), 0)));
        joint_centers.clear();
        joint_centers.extend(scratch.states[1..].iter().map(|s| s.center.lane(0) - s.to_center.lane(0)));
        for (i, range) in ranges.iter().enumerate() {
            for motion in &mut motions[range.clone()] {
                motion.twist = scratch.unit_twist(plan, i, motion.coordinate.index());
            }
        }
    }

    /// The motion of each body, in the order of the model.
    #[inline]
    #[must_use]
    pub fn bodies(&self) -> &[BodyMotion] {
        &self.bodies
    }

    /// Centre of the joint that carries each body, in the world [m]: the origin of the joint frame on the body.
    #[inline]
    #[must_use]
    pub fn joint_centers(&self) -> &[Vec3] {
        &self.joint_centers
    }

    /// What the coordinates of the joint of a body do, in the order of [`crate::model::Joint::coordinates`].
    #[inline]
    #[must_use]
    pub fn joint_motions(&self, body: BodyId) -> &[JointMotion] {
        &self.motions[self.ranges[body.index()].clone()]
    }
}

impl Scratch<1> {
    /// Motion beyond the joint of a body per unit of the generalised speed of a coordinate, after `forward`.
    fn unit_twist(&self, plan: &Plan, body: usize, coordinate: usize) -> Twist {
        let segment = &plan.segments[body];
        let direction = |k: usize| self.axes.direction[k].lane(0) * self.axes.slope[k].0[0];
        let along = |axes: &Range<usize>| -> Vec3 {
            axes.clone().filter(|&k| plan.axes[k].source.coordinate() == Some(coordinate)).map(direction).sum()
        };
        let mut twist = Twist { angular: Vec3::zeros(), linear: along(&segment.translations) };
        let Some(spherical) = &segment.spherical else {
            twist.angular = along(&segment.rotations);
            if let Some(length) = segment.arc {
                twist.linear += sweep::arc_velocity(length, body, self, twist.angular);
            }
            return twist;
        };
        let Some(axis) = spherical.coordinates.iter().position(|&own| own == coordinate) else { return twist };
        let frame = self.joint_frames[body].lane(0);
        twist.angular = frame.column(axis).into_owned();
        if let Some(radii) = spherical.radii {
            // ṗ = radii * (w × n) in F, with n the z axis of M.
            let normal = self.states[body + 1].rotation.lane(0).column(2).into_owned();
            let slide = frame.transpose() * twist.angular.cross(&normal);
            twist.linear += frame * radii.component_mul(&slide);
        }
        twist
    }
}
