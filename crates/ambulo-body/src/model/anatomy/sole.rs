//! Soles of the feet, and stature, from a built-in figure or from usual proportions.

use super::Leg;
use crate::model::anthropometry::dimensions::{ANKLE_HEIGHT, FOOT_LENGTH, FOOT_WIDTH, HEEL_TO_ANKLE, HEEL_TO_BALL};
use crate::model::anthropometry::{ContactSphere, SpherePart};
use crate::model::{BodyId, Side};
use crate::numerics::elementary::cbrt;
use crate::spatial::{Mat3, Pose, Vec3};

/// Length of thigh and shank of a model, joint centre to joint centre, divided by stature: Gait2392 and Rajagopal's
/// model, scaled to subjects of known stature, have 0.488 and 0.470, Drillis and Contini 0.491.
const THIGH_AND_SHANK: f64 = 0.48;
/// Mass [kg] and stature [m] of a man: for a model without legs, stature scales with the cube root of mass.
const REFERENCE: (f64, f64) = (72.6, 1.80);
/// Axes of the frame of a foot closer than this to forward and up are used instead (cosine of 25°).
const ALONG_AXIS: f64 = 0.9;

/// Stature and leg length of a person.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stature {
    /// Stature [m].
    pub height_m: f64,
    /// Leg length: hip to ground in standing [m].
    pub leg_length_m: f64,
}

impl Stature {
    /// Estimates the stature from the mean length of thigh and shank together [m], or without legs from the mass [kg].
    pub(super) fn estimated(thigh_and_shank_m: Option<f64>, mass_kg: f64) -> Stature {
        let (height_m, leg) = match thigh_and_shank_m {
            Some(leg) => (leg / THIGH_AND_SHANK, leg),
            None => {
                let height = REFERENCE.1 * cbrt(mass_kg / REFERENCE.0);
                (height, THIGH_AND_SHANK * height)
            }
        };
        Stature { height_m, leg_length_m: leg + ANKLE_HEIGHT * height_m }
    }
}

/// The sole of one foot: three points along its middle. Points within `half_width` of the line through them, seen from
/// above, are on the sole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sole {
    /// Rear, ball and tip, half a width inside the ends of the foot.
    pub points: [SolePoint; 3],
    /// Half the width of the foot [m].
    pub half_width: f64,
}

/// A point of a sole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolePoint {
    /// The body that it is fixed to.
    pub body: BodyId,
    /// Position in the frame of that body [m].
    pub place: Vec3,
}

impl Sole {
    /// Computes the sole from heel, ball and toe spheres; it ends where the outermost spheres end.
    #[must_use]
    pub fn of_spheres(spheres: &[ContactSphere], side: Side, half_width: f64) -> Option<Sole> {
        let first = |part: SpherePart| spheres.iter().find(|sphere| sphere.side == side && sphere.part == part);
        let (heel, ball, toe) = (first(SpherePart::Heel)?, first(SpherePart::Ball)?, first(SpherePart::Toes)?);
        let under = |sphere: &ContactSphere, forward: f64| SolePoint {
            body: sphere.body,
            place: sphere.center + Vec3::new(forward, -sphere.radius, 0.0),
        };
        let points = [under(heel, half_width - heel.radius), under(ball, 0.0), under(toe, toe.radius - half_width)];
        Some(Sole { points, half_width })
    }

    /// Estimates the sole of a foot of usual proportions under the ankle, for a stature [m].
    pub(super) fn estimated(leg: &Leg, height_m: f64) -> Sole {
        let (length, half_width) = (FOOT_LENGTH * height_m, 0.5 * FOOT_WIDTH * height_m);
        let [ahead, up] = leg.foot_axes;
        let point = |from_heel: f64| SolePoint {
            body: leg.foot,
            place: leg.ankle_in_foot + (ahead * (from_heel - HEEL_TO_ANKLE * length) + up * (-ANKLE_HEIGHT * height_m)),
        };
        let points = [point(half_width), point(HEEL_TO_BALL * length), point(length - half_width)];
        Sole { points, half_width }
    }
}

/// Forward and up in the frame of a foot, rounded to the axes of the frame if they are close.
pub(super) fn foot_axes(axes: &Mat3, world_from_foot: &Pose) -> [Vec3; 2] {
    let in_foot = world_from_foot.rotation.transpose() * axes;
    let directions = [0, 1].map(|k| -> Vec3 { in_foot.column(k).into() });
    let own = directions.map(|direction| {
        let main = direction.iamax();
        let mut axis = Vec3::zeros();
        axis[main] = direction[main].signum();
        axis
    });
    let near = own.iter().zip(&directions).all(|(axis, direction)| axis.dot(direction) > ALONG_AXIS);
    if near { own } else { directions }
}
