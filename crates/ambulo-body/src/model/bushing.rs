//! Springs with dampers between two frames of a model, OpenSim's `BushingForce`.
//!
//! With the body-fixed X-Y-Z angles θ of the second frame in the first, and the place p of its origin there,
//!
//!   f = -(k p + c ṗ)    force on the second body at that origin, in axes of the first frame
//!   u = -(κ θ + γ θ̇)    m = N(θ)ᵀ u, moment on the second body, in axes of the second frame, with θ̇ = N(θ) ω
//!
//! The opposite force and moment act on the first body at the same point.
//!
//! | code                 | symbol  | unit           | meaning                                    |
//! | `stiffness.linear`   | k       | N/m            | along the axes of the first frame          |
//! | `stiffness.angular`  | κ       | N.m/rad        | against each angle                         |
//! | `damping`            | c, γ    | N.s/m, N.m.s/rad | of their rates                           |
//!
//! The angles have no unique value where the second one is a right angle.
//!
//! Source: OpenSim, BushingForce.cpp, which is Simbody's linear bushing; read.
//! Pinned by: tests/bushings.rs, against OpenSim 4.6

use super::BodyId;
use crate::numerics::elementary::{asin, atan2, sin_cos};
use crate::spatial::{Mat3, Pose, Twist, Vec3, Wrench};

/// A spring and a damper between two frames. Inverse dynamics computes their load from the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct Bushing {
    /// Name of the bushing.
    pub name: String,
    /// The two frames.
    pub ends: [BushingEnd; 2],
    /// Stiffness.
    pub stiffness: Resistance,
    /// Damping.
    pub damping: Resistance,
    /// Groups of forces to which it belongs.
    pub groups: Vec<String>,
}

/// A frame to which a bushing is fixed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BushingEnd {
    /// The body; `None` is ground.
    pub body: Option<BodyId>,
    /// The frame in the body, `body_from_frame`.
    pub frame: Pose,
}

/// Resistance about and along three axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Resistance {
    /// Against the body-fixed X-Y-Z angles [N.m/rad], or their rates [N.m.s/rad].
    pub angular: Vec3,
    /// Along the axes of the first frame [N/m], or against the velocity [N.s/m].
    pub linear: Vec3,
}

/// The smallest cosine of the second angle whose rates are computed; nearer to a right angle they have no value.
const LEAST_COSINE: f64 = 1e-9;

/// Force and moment on the second body at the origin of its frame, in world axes, from the poses of both frames in the
/// world and the velocities of their origins.
#[inline]
pub(crate) fn load(stiffness: &Resistance, damping: &Resistance, poses: [Pose; 2], rates: [Twist; 2]) -> Wrench {
    let ([first, second], [slow, fast]) = (poses, rates);
    let apart = second.translation - first.translation;
    let into_first = first.rotation.transpose();
    let place = into_first * apart;
    let velocity = into_first * (fast.linear - slow.velocity_at(apart));
    let spin = second.rotation.transpose() * (fast.angular - slow.angular);
    let angles = body_fixed_angles(&(into_first * second.rotation));
    let by_spin = rates_by_spin(&angles);
    let resist = |stiffness: &Vec3, damping: &Vec3, place: &Vec3, rate: &Vec3| {
        -(stiffness.component_mul(place) + damping.component_mul(rate))
    };
    let force = resist(&stiffness.linear, &damping.linear, &place, &velocity);
    let moment = resist(&stiffness.angular, &damping.angular, &angles, &(by_spin * spin));
    Wrench { moment: second.rotation * (by_spin.transpose() * moment), force: first.rotation * force }
}

/// Body-fixed X-Y-Z angles of a rotation, R = Rx(a) Ry(b) Rz(c) [rad].
fn body_fixed_angles(r: &Mat3) -> Vec3 {
    Vec3::new(atan2(-r.m23, r.m33), asin(r.m13.clamp(-1.0, 1.0)), atan2(-r.m12, r.m11))
}

/// N of the equations: rates of the angles by the angular velocity in axes of the turned frame.
fn rates_by_spin(angles: &Vec3) -> Mat3 {
    let ((sb, cb), (sc, cc)) = (sin_cos(angles.y), sin_cos(angles.z));
    let cb = cb.max(LEAST_COSINE);
    Mat3::new(cc / cb, -sc / cb, 0.0, sc, cc, 0.0, -cc * sb / cb, sc * sb / cb, 1.0)
}
