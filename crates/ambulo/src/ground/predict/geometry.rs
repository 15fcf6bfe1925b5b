//! Positions of the mass centre, the soles and the shanks in every frame.

use crate::kinematics::{BodyMotion, Trajectory, each_body_motion};
use crate::model::anatomy::{Leg, Sole, SolePoint};
use crate::model::{BodyId, BySide, Model};
use crate::spatial::Vec3;

/// Sole and shank of one foot in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FootPlace {
    /// Rear, ball and tip of the sole [m].
    pub(super) sole: [Vec3; 3],
    /// Unit vector from ankle to knee; `None` where the model has no such joints.
    pub(super) shank: Option<Vec3>,
}

/// Mass centre and feet, one entry per frame.
#[derive(Debug, Clone)]
pub(super) struct Geometry {
    /// Position [m] and velocity [m/s] of the mass centre.
    pub(super) center: Vec<Vec3>,
    pub(super) velocity: Vec<Vec3>,
    /// Each foot, one entry per frame.
    pub(super) feet: BySide<Vec<FootPlace>>,
}

impl Geometry {
    pub(super) fn new(model: &Model, trajectory: &Trajectory, soles: &BySide<Sole>) -> Geometry {
        let frames = trajectory.grid().frames;
        let legs = model.anatomy().legs();
        let masses: Vec<f64> = model.bodies().iter().map(|body| body.inertia.mass()).collect();
        let whole: f64 = masses.iter().sum();
        let feet = || Vec::with_capacity(frames);
        let mut out = Geometry {
            center: Vec::with_capacity(frames),
            velocity: Vec::with_capacity(frames),
            feet: BySide { right: feet(), left: feet() },
        };
        each_body_motion(model, trajectory, |_, bodies| {
            let (mut center, mut velocity) = (Vec3::zeros(), Vec3::zeros());
            for (body, mass) in bodies.iter().zip(&masses) {
                center += body.center * *mass;
                velocity += body.twist.linear * *mass;
            }
            out.center.push(center / whole);
            out.velocity.push(velocity / whole);
            for (side, sole) in soles.iter() {
                let place = |point: &SolePoint| bodies[point.body.index()].pose.place(point.place);
                out.feet[side].push(FootPlace {
                    sole: [place(&sole.points[0]), place(&sole.points[1]), place(&sole.points[2])],
                    shank: legs[side].as_ref().map(|leg| shank(model, bodies, leg)),
                });
            }
        });
        out
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
