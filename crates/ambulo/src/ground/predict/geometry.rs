//! Positions of the mass centre, the soles and the shanks in every frame.

use crate::kinematics::BodyMotion;
use crate::model::anatomy::{Leg, Sole, SolePoint};
use crate::model::{BodyId, BySide, Model, Side};
use crate::spatial::Vec3;

/// Sole and shank of one foot in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FootPlace {
    /// Rear, ball and tip of the sole [m].
    pub sole: [Vec3; 3],
    /// Unit vector from ankle to knee; `None` where the model has no such joints.
    pub shank: Option<Vec3>,
}

/// Mass centre and feet in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::ground) struct GeometryFrame {
    /// Position [m] and velocity [m/s] of the mass centre.
    center: Vec3,
    velocity: Vec3,
    feet: BySide<FootPlace>,
}

impl GeometryFrame {
    /// Computes the geometry from the motion of all bodies.
    pub(in crate::ground) fn of(model: &Model, soles: &BySide<Sole>, bodies: &[BodyMotion]) -> GeometryFrame {
        let (mut center, mut velocity, mut whole) = (Vec3::zeros(), Vec3::zeros(), 0.0);
        for (body, motion) in model.bodies().iter().zip(bodies) {
            let mass = body.inertia.mass();
            center += motion.center * mass;
            velocity += motion.twist.linear * mass;
            whole += mass;
        }
        let legs = model.anatomy().legs();
        let place = |point: &SolePoint| bodies[point.body.index()].pose.place(point.place);
        let foot = |side: Side| FootPlace {
            sole: soles[side].points.each_ref().map(place),
            shank: legs[side].as_ref().map(|leg| shank(model, bodies, leg)),
        };
        GeometryFrame { center: center / whole, velocity: velocity / whole, feet: BySide::from_fn(foot) }
    }
}

/// Mass centre and feet, one entry per frame.
#[derive(Debug, Clone)]
pub(in crate::ground) struct Geometry {
    /// Position [m] and velocity [m/s] of the mass centre.
    pub(super) center: Vec<Vec3>,
    pub(super) velocity: Vec<Vec3>,
    /// Each foot, one entry per frame.
    pub(super) feet: BySide<Vec<FootPlace>>,
}

impl Geometry {
    /// Room for a number of frames.
    pub(in crate::ground) fn with_capacity(frames: usize) -> Geometry {
        let feet = BySide::from_fn(|_| Vec::with_capacity(frames));
        Geometry { center: Vec::with_capacity(frames), velocity: Vec::with_capacity(frames), feet }
    }

    /// Adds the next frame.
    pub(in crate::ground) fn push(&mut self, frame: &GeometryFrame) {
        self.center.push(frame.center);
        self.velocity.push(frame.velocity);
        for (side, place) in frame.feet.iter() {
            self.feet[side].push(*place);
        }
    }
}

/// Unit vector from ankle to knee.
fn shank(model: &Model, bodies: &[BodyMotion], leg: &Leg) -> Vec3 {
    let center = |body: BodyId| {
        let joint = &model.bodies()[body.index()].joint;
        bodies[body.index()].pose.place(joint.child_from_joint.translation)
    };
    (center(leg.knee) - center(leg.ankle)).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::y)
}

/// The point of a sole nearest to `place`, in the horizontal plane; the height of `place` is kept.
pub(super) fn nearest_on_sole(points: &[Vec3; 3], half_width: f64, place: Vec3, up: Vec3) -> Vec3 {
    let level = |v: Vec3| v - up * v.dot(&up);
    let target = level(place);
    let nearest = points.windows(2).map(|ends| {
        let (from, along) = (level(ends[0]), level(ends[1] - ends[0]));
        let share = (target - from).dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE);
        from + along * share.clamp(0.0, 1.0)
    });
    let nearest = nearest.min_by(|a, b| (a - target).norm().total_cmp(&(b - target).norm())).unwrap_or(target);
    let away = target - nearest;
    nearest + away * (half_width / away.norm().max(half_width)) + up * place.dot(&up)
}
