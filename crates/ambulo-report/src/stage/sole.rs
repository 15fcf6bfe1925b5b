//! How far estimated soles are moved up or down.
//!
//! They are moved so that they touch the floor while ground forces load the foot: the height of the ankle differs by a
//! few centimetres between models.

use super::{ForceRole, Stage};
use ambulo::model::Side;
use ambulo::numerics::quantiles;

/// Share of body weight above which a foot is certainly in stance.
const ENOUGH: f64 = 0.2;
/// Soles are not moved further than this [m]: a larger gap is another error, which should be visible.
const MOST_SUNK: f64 = 0.04;

/// Distance by which the estimated soles of both feet are lowered to touch the floor: the median over all instants in
/// which a fifth of the weight is on the foot, at most [`MOST_SUNK`].
pub(super) fn sunk(stage: &Stage) -> [f64; 2] {
    Side::BOTH.map(|side| {
        let force = stage.forces.iter().find(|force| force.side == Some(side) && force.role == ForceRole::Main);
        let carries = |instant: &usize| force.is_some_and(|f| f.force[*instant].y > ENOUGH * stage.weight_n);
        let lowest = |instant: usize| {
            let soles = stage.contacts.iter().filter(|contact| contact.side == Some(side));
            let heights = soles.map(|contact| stage.bodies[contact.body].path.place(instant, contact.place).y);
            heights.min_by(f64::total_cmp)
        };
        let heights = (0..stage.grid.frames).filter(carries).filter_map(lowest);
        let median = quantiles(heights, [0.5]).map_or(0.0, |[height]| height - stage.floor_m);
        median.clamp(-MOST_SUNK, MOST_SUNK)
    })
}
