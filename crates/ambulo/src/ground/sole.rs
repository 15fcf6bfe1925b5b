//! The sole of a foot: three points along its middle, from a built figure's spheres or from a person's proportions.

use crate::kinematics::{BodyMotion, Posture, body_motion};
use crate::model::anthropometry::ContactSphere;
use crate::model::anthropometry::foot::{ANKLE_HEIGHT, FOOT_LENGTH, FOOT_WIDTH, HEEL_TO_ANKLE, HEEL_TO_BALL};
use crate::model::{BodyId, Model, Side};
use crate::spatial::Vec3;

/// Thigh and shank of a model, joint centre to joint centre, over stature: Gait2392 and Rajagopal's model as scaled to people of known
/// stature have 0.488 and 0.470, Drillis and Contini 0.491.
const THIGH_AND_SHANK: f64 = 0.48;
/// Stature of a man of 72.6 kg [m]: where a model has no legs, stature goes with the cube root of mass.
const REFERENCE: (f64, f64) = (72.6, 1.80);

/// How tall a person is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stature {
    /// From head to heel [m].
    pub height_m: f64,
    /// Hip to ground, standing [m].
    pub leg_length_m: f64,
}

/// The sole of one foot: three points along its middle. What lies within `half_width` of the line through them, seen from above,
/// is on the sole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sole {
    /// Rear, ball and tip, half a width inside the ends of the foot.
    pub points: [SolePoint; 3],
    /// Half the breadth of the foot [m].
    pub half_width: f64,
}

/// A point under a foot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolePoint {
    /// The body that it is fixed to.
    pub body: BodyId,
    /// Place in that body's frame [m].
    pub place: Vec3,
}

impl Sole {
    /// Heel and toe spheres; the ends of the sole are those of the outermost spheres.
    #[must_use]
    pub fn of_spheres(spheres: &[ContactSphere], side: Side, half_width: f64) -> Option<Sole> {
        let of_side = || spheres.iter().filter(|s| s.side == side);
        let named = |stem: &str| of_side().find(|s| s.name.starts_with(stem));
        let (heel, ball, toe) = (named("heel")?, named("ball")?, named("toe")?);
        let under = |sphere: &ContactSphere, forward: f64| SolePoint {
            body: sphere.body,
            place: sphere.center + Vec3::new(forward, -sphere.radius, 0.0),
        };
        let points = [under(heel, half_width - heel.radius), under(ball, 0.0), under(toe, toe.radius - half_width)];
        Some(Sole { points, half_width })
    }

    /// A foot of usual proportions under the ankle, along x of the body `calcn_s`.
    #[must_use]
    pub fn estimated(model: &Model, bodies: &[BodyMotion], side: Side, height: f64) -> Option<Sole> {
        let body = model.body(&format!("calcn_{}", side.letter()))?;
        let shank_end = moved_by(model, &format!("ankle_angle_{}", side.letter()))?;
        let ankle = joint_center(model, bodies, shank_end);
        let ankle = bodies[body.index()].pose.inverse().place(ankle);
        let (length, half_width) = (FOOT_LENGTH * height, 0.5 * FOOT_WIDTH * height);
        let point = |from_heel: f64| SolePoint {
            body,
            place: ankle + Vec3::new(from_heel - HEEL_TO_ANKLE * length, -ANKLE_HEIGHT * height, 0.0),
        };
        let points = [point(half_width), point(HEEL_TO_BALL * length), point(length - half_width)];
        Some(Sole { points, half_width })
    }
}

/// The place nearest to `place` on a sole whose points are at `points`, seen along `up`; its height stays.
pub(crate) fn nearest_on_sole(points: &[Vec3; 3], half_width: f64, place: Vec3, up: Vec3) -> Vec3 {
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

impl Stature {
    /// From thigh and shank of a model whose legs have coordinates of the usual names, else from its mass.
    #[must_use]
    pub fn of_model(model: &Model, bodies: &[BodyMotion]) -> Stature {
        let thigh_and_shank = |side: Side| {
            let [hip, knee, ankle] = ["hip_flexion", "knee_angle", "ankle_angle"].map(|stem| {
                moved_by(model, &format!("{stem}_{}", side.letter())).map(|b| joint_center(model, bodies, b))
            });
            Some((hip? - knee?).norm() + (knee? - ankle?).norm())
        };
        let legs: Vec<f64> = Side::BOTH.into_iter().filter_map(thigh_and_shank).collect();
        let (height_m, leg) = if legs.is_empty() {
            let height = REFERENCE.1 * (model.mass() / REFERENCE.0).cbrt();
            (height, THIGH_AND_SHANK * height)
        } else {
            let leg = legs.iter().sum::<f64>() / legs.len() as f64;
            (leg / THIGH_AND_SHANK, leg)
        };
        Stature { height_m, leg_length_m: leg + ANKLE_HEIGHT * height_m }
    }
}

/// Bodies with every coordinate at its default.
#[must_use]
pub fn at_rest(model: &Model) -> Vec<BodyMotion> {
    let q: Vec<f64> = model.coordinates().iter().map(|c| c.default_value).collect();
    let rest = vec![0.0; q.len()];
    body_motion(model, Posture { q: &q, qd: &rest, qdd: &rest })
}

/// The body whose joint a coordinate moves.
pub(super) fn moved_by(model: &Model, coordinate: &str) -> Option<BodyId> {
    let id = model.coordinate(coordinate)?;
    model.body_ids().find(|body| model.bodies()[body.index()].joint.coordinates().contains(&id))
}

pub(super) fn joint_center(model: &Model, bodies: &[BodyMotion], body: BodyId) -> Vec3 {
    bodies[body.index()].pose.place(model.bodies()[body.index()].joint.child_from_joint.translation)
}
