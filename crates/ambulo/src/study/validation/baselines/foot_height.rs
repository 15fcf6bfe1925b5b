//! The weight of the body, divided between the feet by their heights.
//!
//!   F_i = m g w_i / Σ w      w_i = exp(-(h_i - h₀) / λ)
//!
//! | code           | symbol | unit | meaning |
//! |----------------|--------|------|---|
//! | `heights`      | h_i    | m    | mean height of heel, toe and ankle |
//! | `floor`        | h₀     | m    | 5th percentile of the heights of both feet over the recording; lower feet have w 1 |
//! | [`HEIGHT_M`]   | λ      | m    | 0.08 |
//!
//! There is no fore-aft and no lateral force, no flight and no acceleration. The force acts in the middle of heel, toe
//! and ankle. Source: monomech 0.15.24 (PyPI, MIT licence), `external.py`, `estimate_grf`.

use super::{AppliedForce, BaselineInput, FootPoints, at_height};
use crate::model::{BySide, Side};
use crate::numerics::elementary::exp;
use crate::numerics::sort_numbers;
use crate::spatial::Vec3;

/// λ [m].
pub const HEIGHT_M: f64 = 0.08;
/// Percentile of the heights of the feet that is the floor.
const FLOOR_PERCENTILE: f64 = 0.05;

/// Shares of the weight on the right and the left foot, by their heights above the floor [m].
#[must_use]
pub fn shares(heights: BySide<f64>) -> BySide<f64> {
    let weights = heights.map(|height| exp(-height.max(0.0) / HEIGHT_M));
    let sum: f64 = Side::BOTH.iter().map(|side| weights[*side]).sum();
    weights.map(|weight| if sum > 0.0 { weight / sum } else { 0.5 })
}

pub(super) fn forces(input: &BaselineInput<'_>, places: &BySide<Vec<FootPoints>>) -> BySide<AppliedForce> {
    let (model, up) = (input.model, input.model.up());
    let weight = up * (model.mass() * model.gravity().norm());
    let middle = |foot: &FootPoints| (foot.sole[0] + foot.sole[2] + foot.ankle) / 3.0;
    let middles = BySide::from_fn(|side| places[side].iter().map(middle).collect::<Vec<Vec3>>());
    let heights = BySide::from_fn(|side| middles[side].iter().map(|middle| middle.dot(&up)).collect::<Vec<f64>>());
    let floor = percentile(heights.right.iter().chain(&heights.left).copied().collect(), FLOOR_PERCENTILE);
    let surface_m = input.footfalls.falls.first().map_or(0.0, |fall| fall.floor_height_m);
    let frames = middles.right.len();
    let share = |side: Side, i: usize| shares(BySide::from_fn(|side| heights[side][i] - floor))[side];
    BySide::from_fn(|side| AppliedForce {
        force: (0..frames).map(|i| weight * share(side, i)).collect(),
        point: middles[side].iter().map(|middle| at_height(*middle, up, surface_m)).collect(),
    })
}

/// A percentile with linear interpolation between the values; 0 without values.
fn percentile(mut values: Vec<f64>, share: f64) -> f64 {
    sort_numbers(&mut values);
    let place = share * values.len().saturating_sub(1) as f64;
    let (below, part) = (place.floor() as usize, place.fract());
    let above = (below + 1).min(values.len().saturating_sub(1));
    match (values.get(below), values.get(above)) {
        (Some(low), Some(high)) => low + part * (high - low),
        _ => 0.0,
    }
}
