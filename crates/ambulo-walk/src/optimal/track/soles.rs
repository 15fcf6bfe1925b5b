//! Spheres under the feet of any model, at the heights that the recorded motion shows.
//!
//! Soles of models are estimates, and a foot without a joint at the toes pushes its tip into the ground at the end of
//! stance. Each pair of spheres is therefore moved along the height of the foot until the lowest positions of its
//! stances are slightly below the floor.

use super::{FootGuide, TrackError};
use crate::contact::HuntCrossley;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::model::anatomy::{Leg, Sole};
use crate::model::anthropometry::{ContactSphere, SpherePart};
use crate::model::{BySide, Model, Side};
use crate::motion::TimeGrid;
use crate::numerics::quantiles;
use crate::spatial::Vec3;

/// Radius of a sphere, as a share of half the width of the foot.
const RADIUS: f64 = 0.6;
/// Breadth of the heel, as a share of the width of the foot, as in [`super::super::soles_with_width`].
const HEEL: f64 = 0.7;
/// Share of the stances in which a sphere is at its lowest.
const LOWEST: f64 = 0.1;
/// Load of a sphere in its lowest position [body weights].
const LOAD: f64 = 0.25;
/// A stance with fewer frames than this shows no height.
const FEW: usize = 5;
/// Largest distance by which spheres are moved [m]; a larger one means that the sole of the model is not where the foot
/// was.
const MOST_M: f64 = 0.08;
/// Spheres of one foot: a pair at each of the three points of a sole.
pub(super) const PER_FOOT: usize = 2 * SpherePart::OF_FOOT.len();

/// The spheres of both feet: right, then left; of each foot heel, ball and toe, each medial, then lateral.
pub(super) fn spheres(
    model: &Model,
    trajectory: &Trajectory,
    feet: &BySide<FootGuide>,
    floor_m: f64,
    shoes: &HuntCrossley,
) -> Result<Soles, TrackError> {
    let legs = model.anatomy().legs();
    let no_feet = || TrackError::NoFeet { model: model.name().to_owned() };
    let mut spheres = Vec::new();
    for (side, foot) in feet.iter() {
        let leg = legs[side].as_ref().ok_or_else(no_feet)?;
        spheres.extend(of_foot(leg, &foot.sole, side));
    }
    let heights = heights(model, trajectory, &spheres, floor_m);
    let depth = depth_m(model, &spheres, shoes);
    for (side, foot) in feet.iter() {
        let up = legs[side].as_ref().ok_or_else(no_feet)?.foot_axes()[1];
        let stance = in_stance(foot, trajectory.grid());
        let first = if side == Side::Right { 0 } else { PER_FOOT };
        for pair in (first..first + PER_FOOT).step_by(2) {
            let both: Vec<f64> = stance.iter().map(|&k| 0.5 * (heights[pair][k] + heights[pair + 1][k])).collect();
            let Some(lowest) = lowest(both) else { continue };
            let lift = -depth - lowest;
            if lift.abs() > MOST_M {
                return Err(TrackError::SoleOffFloor {
                    side,
                    sphere: spheres[pair].name.clone(),
                    distance_m: lift.abs(),
                });
            }
            for sphere in &mut spheres[pair..pair + 2] {
                sphere.center += up * lift;
            }
        }
    }
    let heights = self::heights(model, trajectory, &spheres, floor_m);
    Ok(Soles { spheres, heights })
}

/// Spheres, and the height of the lowest point of each above the floor in each frame [m].
pub(super) struct Soles {
    pub(super) spheres: Vec<ContactSphere>,
    pub(super) heights: Vec<Vec<f64>>,
}

/// Spheres at the three points of a sole, on both of its edges. Spheres of heel and tip touch the ends of the foot.
fn of_foot(leg: &Leg, sole: &Sole, side: Side) -> Vec<ContactSphere> {
    let [ahead, up] = leg.foot_axes();
    let right = ahead.cross(&up);
    let radius = RADIUS * sole.half_width;
    let to_end = [radius - sole.half_width, 0.0, sole.half_width - radius];
    let mut spheres = Vec::new();
    for ((point, (part, stem)), shift) in sole.points.iter().zip(SpherePart::OF_FOOT).zip(to_end) {
        let half = sole.half_width * if part == SpherePart::Heel { HEEL } else { 1.0 };
        let aside = (half - radius).max(0.4 * half);
        for (edge, sign) in [("medial", -1.0), ("lateral", 1.0)] {
            let outwards = if side == Side::Right { sign } else { -sign };
            let center = point.place + ahead * shift + up * radius + right * (outwards * aside);
            let name = format!("{stem}_{}_{edge}", side.letter());
            spheres.push(ContactSphere { name, part, side, body: point.body, center, radius });
        }
    }
    spheres
}

/// Height of the lowest point of each sphere above the floor in each frame [m].
fn heights(model: &Model, trajectory: &Trajectory, spheres: &[ContactSphere], floor_m: f64) -> Vec<Vec<f64>> {
    let mut heights = vec![Vec::with_capacity(trajectory.grid().frames); spheres.len()];
    each_body_motion(model, trajectory, |_, bodies| {
        for (heights, sphere) in heights.iter_mut().zip(spheres) {
            heights.push(bodies[sphere.body.index()].pose.place(sphere.center).y - sphere.radius - floor_m);
        }
    });
    heights
}

/// Depth of a sphere that carries the load of its lowest position [m].
fn depth_m(model: &Model, spheres: &[ContactSphere], shoes: &HuntCrossley) -> f64 {
    let load = LOAD * model.mass() * model.gravity().norm();
    let radius = spheres.first().map_or(0.03, |sphere| sphere.radius);
    let carries = |depth: f64| shoes.force_with_slopes(radius, depth, 0.0, Vec3::zeros()).force.y;
    let (mut low, mut high) = (0.0, radius);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if carries(middle) < load { low = middle } else { high = middle }
    }
    low
}

/// Frames in the stances of a foot.
pub(super) fn in_stance(foot: &FootGuide, grid: TimeGrid) -> Vec<usize> {
    let inside = |k: &usize| foot.stances_s.iter().any(|[from, to]| (*from..=*to).contains(&grid.time(*k)));
    (0..grid.frames).filter(inside).collect()
}

/// The height that a share [`LOWEST`] of the heights is below.
fn lowest(heights: Vec<f64>) -> Option<f64> {
    let has_enough = heights.len() >= FEW;
    quantiles(heights, [LOWEST]).filter(|_| has_enough).map(|[lowest]| lowest)
}
