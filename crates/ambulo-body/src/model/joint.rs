//! Joints between a body and its parent.
//!
//! Every joint is a chain of at most three rotations and three translations, as OpenSim's `SpatialTransform`:
//! with F the joint frame on the parent and M the one on the child,
//!
//!   R_FM = R(a₁, θ₁) R(a₂, θ₂) R(a₃, θ₃)      each axis fixed in the frame rotated by the previous ones
//!   p_FM = d₁ a₄ + d₂ a₅ + d₃ a₆               axes fixed in F
//!
//! where each θ [rad] and d [m] is a function of at most one coordinate. Pin, slider, universal, ball, gimbal, planar
//! and free joints are special cases; the ellipsoid joint and the arc of constant curvature add a translation that
//! follows the rotation.

use super::{BodyId, CoordinateId, Function};
use crate::spatial::{Pose, Vec3};

/// A joint between a body and its parent.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Name of the joint.
    pub name: String,
    /// The parent; `None` is ground.
    pub parent: Option<BodyId>,
    /// Joint frame F on the parent: `parent_from_joint`.
    pub parent_from_joint: Pose,
    /// Joint frame M on the child: `child_from_joint`.
    pub child_from_joint: Pose,
    /// Rotations in the order in which they are applied, at most three.
    pub rotations: Vec<JointAxis>,
    /// Translations along axes of F, at most three.
    pub translations: Vec<JointAxis>,
    /// The generalised speeds to which the generalised forces belong.
    pub speeds: JointSpeeds,
}

/// One axis of a joint, with the displacement of the child about or along it.
#[derive(Debug, Clone, PartialEq)]
pub struct JointAxis {
    /// Unit direction.
    pub direction: Vec3,
    /// Angle [rad] or distance [m].
    pub displacement: Displacement,
}

/// Displacement about or along an axis.
#[derive(Debug, Clone, PartialEq)]
pub enum Displacement {
    /// Constant.
    Fixed(f64),
    /// A function of a coordinate.
    Follows(CoordinateId, Function),
}

/// Generalised speeds of a joint. Its generalised forces are dual to them: force times speed is power.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum JointSpeeds {
    /// The rates of the coordinates: the forces are moments about and forces along each axis.
    Rates,
    /// The angular velocity of M in F, in axes of F, for the rotations (OpenSim's ball and free joints, whose
    /// coordinates are body-fixed X-Y-Z angles but whose speeds are the angular velocity).
    AngularVelocity,
    /// As `AngularVelocity`, with the origin of M on an ellipsoid with these half axes [m]: p = radii * z_M.
    Ellipsoid(Vec3),
    /// As `Rates`, with the origin of M at the end of an arc of this length [m], which starts along the y axis of F and
    /// ends along the y axis of M.
    Arc(f64),
}

impl Joint {
    /// Coordinates of this joint, in the order of its axes, each once.
    #[must_use]
    pub fn coordinates(&self) -> Vec<CoordinateId> {
        let mut list = Vec::new();
        for axis in self.rotations.iter().chain(&self.translations) {
            if let Displacement::Follows(id, _) = &axis.displacement
                && !list.contains(id)
            {
                list.push(*id);
            }
        }
        list
    }
}
