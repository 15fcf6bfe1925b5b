//! Leaves out the panels of constant quantities.

use super::curves::over_time;
use super::results::Results;
use crate::clinical::{ClinicalGroup, ClinicalQuantity, moves};
use ambulo::model::{Drive, Side};

/// Splits quantities into changing and constant ones. If all quantities of a group are constant, all are shown.
pub(super) fn divided(
    results: &Results,
    quantities: &[ClinicalQuantity],
) -> (Vec<ClinicalQuantity>, Vec<ClinicalQuantity>) {
    let moving: Vec<bool> = quantities.iter().map(|quantity| is_moving(results, quantity)).collect();
    let moves = |group: ClinicalGroup| quantities.iter().zip(&moving).any(|(q, moving)| q.group == group && *moving);
    let (mut shown, mut still) = (Vec::new(), Vec::new());
    for (quantity, moving) in quantities.iter().zip(&moving) {
        let list = if *moving || !moves(quantity.group) { &mut shown } else { &mut still };
        list.push(quantity.clone());
    }
    (shown, still)
}

fn is_moving(results: &Results, quantity: &ClinicalQuantity) -> bool {
    let mut cycles = results.curves.iter().filter(|curve| quantity.has_column(&curve.quantity));
    let in_cycles = cycles.any(|curve| moves(curve.unit, &curve.values));
    in_cycles || Side::BOTH.into_iter().any(|side| moves_over_time(results, quantity, side))
}

fn moves_over_time(results: &Results, quantity: &ClinicalQuantity, side: Side) -> bool {
    let Some((_, _, Some(values))) = over_time(results, quantity, side) else { return false };
    match quantity.group {
        ClinicalGroup::Ground => {
            let weights: Vec<f64> = values.iter().map(|force| force / results.weight_n).collect();
            moves(quantity.unit, &weights)
        }
        _ => moves(quantity.unit, values),
    }
}

/// Phrases such as `subtalar inversion (locked in the model)`; moments and powers of a joint already listed are left
/// out.
pub(super) fn words(results: &Results, still: &[ClinicalQuantity]) -> Vec<String> {
    let is_angle = |quantity: &ClinicalQuantity| quantity.group == ClinicalGroup::Kinematics;
    let is_named = |quantity: &&ClinicalQuantity| {
        is_angle(quantity) || !still.iter().any(|other| is_angle(other) && other.coordinates == quantity.coordinates)
    };
    let words = |quantity: &ClinicalQuantity| {
        let why = match quantity.group {
            ClinicalGroup::Kinematics if is_locked(results, quantity) => "locked in the model",
            ClinicalGroup::Kinematics => "does not move",
            ClinicalGroup::Ground => "the body moves in a plane",
            ClinicalGroup::Moments | ClinicalGroup::Powers => "constant",
        };
        format!("{} ({why})", quantity.title.to_lowercase())
    };
    still.iter().filter(is_named).map(words).collect()
}

fn is_locked(results: &Results, quantity: &ClinicalQuantity) -> bool {
    let Some((_, model)) = &results.body else { return false };
    let is_it = |name: &String| quantity.coordinates.values().any(|coordinate| coordinate == name);
    let mut coordinates = model.coordinates().iter().filter(|coordinate| is_it(&coordinate.name));
    coordinates.any(|coordinate| matches!(coordinate.drive, Drive::Locked))
}
