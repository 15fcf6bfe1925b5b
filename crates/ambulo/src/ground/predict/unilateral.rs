//! What the ground can do at all: it pushes and does not pull, and along the ground it pushes no harder than friction lets it.

use super::Known;
use super::loads::FootLoads;
use crate::model::{BySide, Side};
use crate::spatial::Vec3;

/// Friction that no shoe on a floor exceeds: walking needs 0.2 to 0.4, rubber on dry floor gives up to about 1.
const MOST_FRICTION: f64 = 1.0;

/// Nothing pulls a foot down: what would pull is taken from the other foot, if it stands. Forces along the ground stay inside Coulomb's
/// cone. Where the share of the feet is known it decides.
pub(super) fn keep_on_the_ground(feet: &mut BySide<FootLoads>, up: Vec3, known: &Known) {
    for frame in 0..feet.right.force.len() {
        let BySide { right, left } = feet.as_ref().map(|foot| foot.force[frame].dot(&up));
        let vertical = match known.right_share_at(frame) {
            Some(share) => {
                let whole = known.total_at(frame).map_or(right + left, |total| total.force.dot(&up));
                BySide { right: share * whole, left: (1.0 - share) * whole }
            }
            None => BySide { right: pushed(right, left), left: pushed(left, right) },
        };
        for side in Side::BOTH {
            let (foot, vertical) = (&mut feet[side], vertical[side]);
            foot.force[frame] = inside_the_cone(foot.force[frame], vertical, up);
            if vertical <= 0.0 {
                foot.free_moment[frame] = 0.0;
            }
        }
    }
}

/// The upward force of a foot beside the other's: never below zero, less what the other one would pull.
fn pushed(own: f64, other: f64) -> f64 {
    if own > 0.0 { (own + other.min(0.0)).max(0.0) } else { 0.0 }
}

/// The force with another vertical part, its level part no more than friction allows.
fn inside_the_cone(force: Vec3, vertical: f64, up: Vec3) -> Vec3 {
    let level = force - up * force.dot(&up);
    let most = MOST_FRICTION * vertical.max(0.0);
    let share = if level.norm() > most { most / level.norm() } else { 1.0 };
    level * share + up * vertical
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_pull_is_taken_from_the_foot_that_pushes() {
        assert!(pushed(-30.0, 700.0).abs() < 1e-12);
        assert!((pushed(700.0, -30.0) - 670.0).abs() < 1e-12);
        assert!((pushed(300.0, 400.0) - 300.0).abs() < 1e-12);
        assert!(pushed(-3.0, -4.0).abs() < 1e-12 && pushed(3.0, -4.0).abs() < 1e-12);
    }

    #[test]
    fn the_ground_pushes_along_itself_no_harder_than_friction_lets_it() {
        let up = Vec3::y();
        let kept = inside_the_cone(Vec3::new(30.0, 100.0, 40.0), 100.0, up);
        assert!((kept - Vec3::new(30.0, 100.0, 40.0)).norm() < 1e-12);
        let limited = inside_the_cone(Vec3::new(30.0, 100.0, 40.0), 25.0, up);
        assert!((limited - Vec3::new(15.0, 25.0, 20.0)).norm() < 1e-12);
        assert!(inside_the_cone(Vec3::new(5.0, -9.0, 0.0), 0.0, up).norm() < 1e-12);
    }
}
