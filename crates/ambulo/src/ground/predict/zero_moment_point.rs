//! The expected centre of pressure of feet that stand: from the total wrench of the ground, not from the lean of the shank.
//!
//! The zero-moment point is where the total force pierces the ground so that no moment about a horizontal axis remains (Vukobratović,
//! Borovac 2004, Int J Humanoid Robotics 1:157-173). With the total force F and moment M about a point at height h above the origin, up n:
//!
//!   z = h n + n × M / (n · F)
//!
//! Under one foot it is the centre of pressure. Two feet share it: their centres of pressure lie at the same share s of the length of both
//! soles, and the load w of the right foot divides the line between them, w R(s) + (1 - w) L(s) = z. These are two equations in s and w.

use super::geometry::FootPlace;
use crate::model::BySide;
use crate::spatial::{Vec3, Wrench};

/// Below this share of the body weight the feet carry too little for their moment to show where [body weights].
const LEAST_LOAD: f64 = 0.2;
/// The two equations are solved in turn; each turn at least halves the error where the feet point in similar directions.
const TURNS: usize = 20;

/// The zero-moment point of a wrench about the world's origin, on the ground at a height [m]; `None` where the feet carry little.
pub(super) fn zero_moment_point(total: &Wrench, height_m: f64, up: Vec3, weight_n: f64) -> Option<Vec3> {
    let vertical = total.force.dot(&up);
    let moment = total.moment - (up * height_m).cross(&total.force);
    (vertical > LEAST_LOAD * weight_n).then(|| up * height_m + up.cross(&moment) / vertical)
}

/// How far along both soles the centres of pressure lie, from rear (0) to tip (1), so that together they give the zero-moment point.
pub(super) fn share_along_soles(feet: BySide<&FootPlace>, point: Vec3, up: Vec3) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_through_the_zero_moment_point_has_no_horizontal_moment() {
        let up = Vec3::y();
        let (place, force) = (Vec3::new(0.3, 0.1, -0.2), Vec3::new(40.0, 700.0, -25.0));
        let free_moment = up * 3.0;
        let total = Wrench { force, moment: place.cross(&force) + free_moment };
        let found = zero_moment_point(&total, 0.1, up, 700.0).unwrap();
        assert!((found - place).norm() < 1e-12, "{found:?}");
        assert!(zero_moment_point(&total, 0.1, up, 7000.0).is_none());
    }

    #[test]
    fn two_feet_share_the_point() {
        let up = Vec3::y();
        let foot = |x: f64, z: f64, turned: f64| FootPlace {
            sole: [
                Vec3::new(x, 0.0, z),
                Vec3::new(x + 0.18, 0.0, z + turned),
                Vec3::new(x + 0.25, 0.0, z + 1.4 * turned),
            ],
            shank: None,
        };
        let feet = BySide { right: foot(0.1, 0.12, 0.03), left: foot(-0.05, -0.1, -0.02) };
        for (share, on_right) in [(0.4, 0.5), (0.7, 0.2), (0.15, 0.9)] {
            let at = |foot: &FootPlace| foot.sole[0] + (foot.sole[2] - foot.sole[0]) * share;
            let point = at(&feet.right) * on_right + at(&feet.left) * (1.0 - on_right);
            let found = share_along_soles(feet.as_ref(), point, up);
            assert!((found - share).abs() < 1e-6, "{found} {share}");
        }
    }
}
