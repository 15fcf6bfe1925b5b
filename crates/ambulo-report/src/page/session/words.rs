//! Names of quantities in the files as a reader has them.

use crate::clinical::{ClinicalGroup, ClinicalQuantity};
use crate::page::contract::Table;
use ambulo::model::Side;

/// Endings of names with what their quantities are.
const ENDINGS: [(&str, ClinicalGroup); 2] = [("_moment", ClinicalGroup::Moments), ("_power", ClinicalGroup::Powers)];

/// `left knee flexion moment` for `knee_angle_l_moment`, `left knee flexion` for `knee_angle_l`, `right friction` for `friction_r`.
pub(super) fn in_words(name: &str, quantities: &[ClinicalQuantity]) -> String {
    let (side, stem) = match Side::split_name(name) {
        Some((side, stem)) => (format!("{side} "), stem),
        None => (String::new(), name.to_owned()),
    };
    let known = known(&stem, quantities);
    let words = known.map_or_else(|| stem.replace('_', " "), |quantity| quantity.title.to_lowercase());
    format!("{side}{words}")
}

/// The quantity that a name without its side belongs to: one with an ending, or else the coordinate's angle.
pub(super) fn known<'a>(stem: &str, quantities: &'a [ClinicalQuantity]) -> Option<&'a ClinicalQuantity> {
    let group = ENDINGS.iter().find(|(ending, _)| stem.ends_with(ending)).map(|(_, group)| *group);
    let column = if group.is_some() { stem.to_owned() } else { format!("{stem}_angle") };
    let group = group.unwrap_or(ClinicalGroup::Kinematics);
    quantities.iter().find(|quantity| quantity.group == group && quantity.column == column)
}

/// Rewords the names in a column of a table.
pub(super) fn reword(table: &mut Table, column: usize, quantities: &[ClinicalQuantity]) {
    for cell in table.rows.iter_mut().filter_map(|row| row.get_mut(column)) {
        cell.text = in_words(&cell.text, quantities);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clinical::clinical_quantities;

    #[test]
    fn names_of_files_become_words() {
        let quantities = clinical_quantities(|_| true);
        for (name, words) in [
            ("knee_angle_l_moment", "left knee flexion moment"),
            ("hip_flexion_r", "right hip flexion"),
            ("ankle_angle_r_power", "right ankle power"),
            ("center_of_pressure_l", "left center of pressure"),
            ("support", "support"),
            ("lumbar_bending_moment", "lumbar bending moment"),
        ] {
            assert_eq!(in_words(name, &quantities), words);
        }
    }
}
