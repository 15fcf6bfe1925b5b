//! Feet that come down forefoot first: while the heel is up, only the ball touches the ground.

use super::geometry::FootPlace;
use crate::numerics::elementary::atan2;
use crate::spatial::Vec3;

/// Slope of the sole up to which the heel may touch the ground, and from which on only the ball does [rad], 5 and 15
/// degrees: soles and heel pads yield by about 1 cm, and the slope of a foot from markers is wrong by several degrees.
const HEEL_UP: [f64; 2] = [0.087, 0.262];

/// When the heel of a foot that comes down forefoot first touches the ground: the first of the places, in order of
/// time, in which it does. `None` for a foot that comes down heel first or flat; the number of places if the heel stays
/// up.
pub fn heel_down(places: &[FootPlace], up: Vec3) -> Option<usize> {
    let is_down = |place: &FootPlace| share_of_ball(place, up) <= 0.0;
    let first = places.iter().position(is_down).unwrap_or(places.len());
    (first > 0).then_some(first)
}

/// A place on the sole, moved forward to the part of it that touches the ground: behind that part nothing carries while
/// the heel is up.
pub(super) fn on_touching_part(place: &FootPlace, center: Vec3, up: Vec3) -> Vec3 {
    let [rear, ball, _] = place.sole;
    let level = |v: Vec3| v - up * v.dot(&up);
    let along = level(ball - rear).try_normalize(f64::MIN_POSITIVE).unwrap_or_else(Vec3::zeros);
    let rearmost = rear + (ball - rear) * share_of_ball(place, up);
    center + along * (rearmost - center).dot(&along).max(0.0)
}

/// How far in front the centre of pressure must at least be because the heel is up: 0 at the heel, 1 under the ball.
pub(super) fn share_of_ball(place: &FootPlace, up: Vec3) -> f64 {
    let [rear, ball, _] = place.sole;
    let along = ball - rear;
    let down = -along.dot(&up);
    let slope = atan2(down, (along + up * down).norm());
    ((slope - HEEL_UP[0]) / (HEEL_UP[1] - HEEL_UP[0])).clamp(0.0, 1.0)
}
