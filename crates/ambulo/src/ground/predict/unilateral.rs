//! Limits of contact: the ground does not pull, and tangential forces stay inside the friction cone.

use super::Prescribed;
use super::loads::FootLoads;
use crate::model::{BySide, Side};
use crate::spatial::Vec3;

/// Largest coefficient of friction: walking needs 0.2 to 0.4, rubber on a dry floor reaches about 1.
const MOST_FRICTION: f64 = 1.0;

/// Removes negative vertical forces and subtracts them from the other foot, if it is on the ground; limits tangential
/// forces to the friction cone. A prescribed share of the feet determines the vertical forces.
pub(super) fn enforce_unilateral_contact(feet: &mut BySide<FootLoads>, up: Vec3, prescribed: &Prescribed) {
    for frame in 0..feet.right.force.len() {
        let BySide { right, left } = feet.as_ref().map(|foot| foot.force[frame].dot(&up));
        let vertical = match prescribed.right_share_at(frame) {
            Some(share) => {
                let whole = prescribed.total_at(frame).map_or(right + left, |total| total.force.dot(&up));
                BySide { right: share * whole, left: (1.0 - share) * whole }
            }
            None => BySide { right: unilateral_share(right, left), left: unilateral_share(left, right) },
        };
        for side in Side::BOTH {
            let (foot, vertical) = (&mut feet[side], vertical[side]);
            foot.force[frame] = within_friction_cone(foot.force[frame], vertical, up);
            if vertical <= 0.0 {
                foot.free_moment[frame] = 0.0;
            }
        }
    }
}

/// Vertical force of a foot: not below zero, reduced by the pull of the other one.
pub fn unilateral_share(own: f64, other: f64) -> f64 {
    if own > 0.0 { (own + other.min(0.0)).max(0.0) } else { 0.0 }
}

/// The force with a new vertical part, and its horizontal part within the friction cone.
pub fn within_friction_cone(force: Vec3, vertical: f64, up: Vec3) -> Vec3 {
    let level = force - up * force.dot(&up);
    let most = MOST_FRICTION * vertical.max(0.0);
    let share = if level.norm() > most { most / level.norm() } else { 1.0 };
    level * share + up * vertical
}
