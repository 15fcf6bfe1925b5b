//! Turns names of quantities in the files into readable names.

use crate::clinical::{ClinicalGroup, ClinicalQuantity};
use crate::page::contract::Table;
use ambulo::model::Side;

/// Endings of names and the group of their quantities.
const ENDINGS: [(&str, ClinicalGroup); 2] = [("_moment", ClinicalGroup::Moments), ("_power", ClinicalGroup::Powers)];

/// `left knee flexion moment` for `knee_angle_l_moment`, `left knee flexion` for `knee_angle_l`, `right friction` for
/// `friction_r`.
pub fn in_words(name: &str, quantities: &[ClinicalQuantity]) -> String {
    if let Some((quantity, side)) = known(name, quantities) {
        let title = quantity.title.to_lowercase();
        return side.map_or_else(|| title.clone(), |side| format!("{side} {title}"));
    }
    match Side::split_name(name) {
        Some((side, stem)) => format!("{side} {}", stem.replace('_', " ")),
        None => name.replace('_', " "),
    }
}

/// The quantity of a name, with its side: a moment or power of a coordinate, otherwise the angle of the coordinate.
pub(super) fn known<'a>(
    name: &str,
    quantities: &'a [ClinicalQuantity],
) -> Option<(&'a ClinicalQuantity, Option<Side>)> {
    let ending = ENDINGS.iter().find_map(|(ending, group)| Some((name.strip_suffix(ending)?, *group)));
    let (coordinate, group) = ending.unwrap_or((name, ClinicalGroup::Kinematics));
    quantities.iter().filter(|quantity| quantity.group == group).find_map(|quantity| {
        let (side, _) = quantity.coordinates.iter().find(|(_, own)| *own == coordinate)?;
        Some((quantity, (!quantity.central).then_some(side)))
    })
}

/// Replaces the names in a column of a table by readable ones.
pub(super) fn reword(table: &mut Table, column: usize, quantities: &[ClinicalQuantity]) {
    for cell in table.rows.iter_mut().filter_map(|row| row.get_mut(column)) {
        cell.text = in_words(&cell.text, quantities);
    }
}
