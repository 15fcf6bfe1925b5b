//! The expected centre of pressure of feet that stand: from the total wrench of the ground, not from the lean of the
//! shank.
//!
//! The zero-moment point is where the total force pierces the ground so that no moment about a horizontal axis remains
//! (Vukobratović, Borovac 2004, Int J Humanoid Robotics 1:157-173). With the total force F and moment M about a point
//! at height h above the origin, up n:
//!
//!   z = h n + n × M / (n · F)
//!
//! Under one foot it is the centre of pressure. Two feet share it: their centres of pressure lie at the same share s of
//! the length of both soles, and the load w of the right foot divides the line between them, w R(s) + (1 - w) L(s) = z.
//! These are two equations in s and w.

use super::geometry::FootPlace;
use crate::model::BySide;
use crate::spatial::{Vec3, Wrench};

/// Load below which the moment of the feet does not show the place of the load [body weights].
const LEAST_LOAD: f64 = 0.2;
/// The two equations are solved in turn; each turn at least halves the error where the feet point in similar
/// directions.
const TURNS: usize = 20;

/// The zero-moment point of a wrench about the world's origin, on the ground at a height [m]; `None` where the feet
/// carry little.
pub fn zero_moment_point(total: &Wrench, height_m: f64, up: Vec3, weight_n: f64) -> Option<Vec3> {
    let vertical = total.force.dot(&up);
    let moment = total.moment - (up * height_m).cross(&total.force);
    (vertical > LEAST_LOAD * weight_n).then(|| up * height_m + up.cross(&moment) / vertical)
}

/// Place of the centres of pressure along both soles, from rear (0) to tip (1), with which together they give the
/// zero-moment point.
pub fn share_along_soles(feet: BySide<&FootPlace>, point: Vec3, up: Vec3) -> f64 {
    let level = |v: Vec3| v - up * v.dot(&up);
    let rear = feet.map(|foot| level(foot.sole[0]));
    let length = feet.map(|foot| level(foot.sole[2] - foot.sole[0]));
    let point = level(point);
    let (mut share, mut on_right) = (0.5, 0.5);
    for _ in 0..TURNS {
        let origin = rear.right * on_right + rear.left * (1.0 - on_right);
        let along = length.right * on_right + length.left * (1.0 - on_right);
        share = projected(point - origin, along);
        let at = BySide::from_fn(|side| rear[side] + length[side] * share);
        on_right = projected(point - at.left, at.right - at.left);
    }
    share
}

/// The share of `along` that is nearest to `v`, from 0 to 1.
fn projected(v: Vec3, along: Vec3) -> f64 {
    (v.dot(&along) / along.norm_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0)
}
