//! Where the mass centre and the soles are, and how the shanks lean, in every frame.

use crate::ground::sole::{Sole, joint_center, moved_by};
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::{BodyId, Model, Side};
use crate::spatial::Vec3;

/// One foot at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct FootPlace {
    /// Rear, ball and tip of the sole [m].
    pub(super) sole: [Vec3; 3],
    /// From ankle to knee, unit length; `None` where the model has no such joints.
    pub(super) shank: Option<Vec3>,
}

/// What the forces act on, one entry a frame.
#[derive(Debug, Clone)]
pub(super) struct Geometry {
    /// Place [m] and velocity [m/s] of the mass centre.
    pub(super) center: Vec<Vec3>,
    pub(super) velocity: Vec<Vec3>,
    /// Right and left foot.
    pub(super) feet: [Vec<FootPlace>; 2],
}

impl Geometry {
    pub(super) fn new(model: &Model, trajectory: &Trajectory, soles: &[Sole; 2]) -> Geometry {
        let frames = trajectory.grid().frames;
        let shanks = Side::BOTH.map(|side| Shank::of(model, side));
        let masses: Vec<f64> = model.bodies().iter().map(|body| body.inertia.mass()).collect();
        let whole: f64 = masses.iter().sum();
        let feet = || Vec::with_capacity(frames);
        let mut out = Geometry {
            center: Vec::with_capacity(frames),
            velocity: Vec::with_capacity(frames),
            feet: [feet(), feet()],
        };
        each_body_motion(model, trajectory, |_, bodies| {
            let (mut center, mut velocity) = (Vec3::zeros(), Vec3::zeros());
            for (body, mass) in bodies.iter().zip(&masses) {
                center += body.center * *mass;
                velocity += body.twist.linear * *mass;
            }
            out.center.push(center / whole);
            out.velocity.push(velocity / whole);
            for ((foot, sole), shank) in out.feet.iter_mut().zip(soles).zip(&shanks) {
                let place = |point: &crate::ground::sole::SolePoint| bodies[point.body.index()].pose.place(point.place);
                let shank = shank.map(|s| {
                    (joint_center(model, bodies, s.knee) - joint_center(model, bodies, s.ankle))
                        .try_normalize(f64::MIN_POSITIVE)
                        .unwrap_or_else(Vec3::y)
                });
                foot.push(FootPlace {
                    sole: [place(&sole.points[0]), place(&sole.points[1]), place(&sole.points[2])],
                    shank,
                });
            }
        });
        out
    }
}

/// The bodies whose joint centres are knee and ankle.
#[derive(Debug, Clone, Copy)]
struct Shank {
    knee: BodyId,
    ankle: BodyId,
}

impl Shank {
    fn of(model: &Model, side: Side) -> Option<Shank> {
        let body = |stem: &str| moved_by(model, &format!("{stem}_{}", side.letter()));
        Some(Shank { knee: body("knee_angle")?, ankle: body("ankle_angle")? })
    }
}
