//! Height of the floor.

use super::{StageBody, StageContact, StageForce, StagePlate};
use ambulo::numerics::sort_numbers;

/// Height of the floor [m]: from the plates, otherwise from the points where forces act, otherwise from the lowest
/// point of the soles, otherwise zero.
pub(super) fn height(
    plates: &[StagePlate],
    forces: &[StageForce],
    bodies: &[StageBody],
    contacts: &[StageContact],
) -> f64 {
    let plates = plates.iter().flat_map(|plate| plate.corners).map(|corner| corner[1]).collect();
    let points = forces.iter().flat_map(|force| &force.point).map(|point| point.y).filter(|y| y.is_finite()).collect();
    median(plates).or_else(|| median(points)).or_else(|| lowest(bodies, contacts)).unwrap_or(0.0)
}

fn median(mut heights: Vec<f64>) -> Option<f64> {
    sort_numbers(&mut heights);
    heights.get(heights.len() / 2).copied()
}

fn lowest(bodies: &[StageBody], contacts: &[StageContact]) -> Option<f64> {
    let heights = contacts.iter().flat_map(|contact| {
        let path = &bodies[contact.body].path;
        (0..path.position.len()).map(|instant| path.place(instant, contact.place).y)
    });
    heights.filter(|y| y.is_finite()).min_by(f64::total_cmp)
}
