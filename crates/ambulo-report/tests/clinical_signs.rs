//! Every row of "Signs in panels" in docs/CONVENTIONS.md, against the signs of movements above it and the factors of the panels.

use ambulo::model::Side;
use ambulo_report::clinical::{ClinicalGroup, ClinicalQuantity, clinical_quantities, knee_flexion_sign};
use std::collections::BTreeSet;

const LAW: &str = include_str!("../../../docs/CONVENTIONS.md");
/// Coordinates that the table of movements lacks: the built-in planar figure has none of them.
const ELSEWHERE: [&str; 3] = ["knee_adduction", "knee_rotation", "subtalar_angle"];
/// Body mass [kg] of the rows, for factors of moments and powers.
const MASS_KG: f64 = 50.0;

fn table(header: &str) -> Vec<Vec<String>> {
    let rows = LAW.lines().skip_while(|line| *line != header).skip(2).take_while(|line| line.starts_with('|'));
    let cells =
        |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`').to_owned()).collect();
    rows.map(cells).collect()
}

/// Whether a cell says plus.
fn plus(cell: &str) -> bool {
    assert!(["+", "-"].contains(&cell), "{cell}");
    cell == "+"
}

fn sides(word: &str) -> Vec<Side> {
    match word {
        "right" => vec![Side::Right],
        "left" => vec![Side::Left],
        _ => Side::BOTH.to_vec(),
    }
}

fn all() -> Vec<ClinicalQuantity> {
    clinical_quantities(|name| !name.contains("knee_flexion") && !name.contains("abduction"))
}

/// Whether a coordinate grows during a movement, by the table of movements.
fn during(movement: &str, coordinate: &str, side: Side) -> bool {
    let movements = table("| movement | side | coordinate | sign | point | moves |");
    let sided = format!("{coordinate}_{}", side.letter());
    let fits = |row: &&Vec<String>| row[0] == movement && (row[2] == sided || row[2] == coordinate);
    let row =
        movements.iter().find(fits).unwrap_or_else(|| panic!("no movement `{movement}` of `{coordinate}`, {side}"));
    plus(&row[3])
}

#[test]
fn every_panel_has_the_sign_of_its_row() {
    let rows = table("| quantity | side | movement | file | shown |");
    let mut seen = BTreeSet::new();
    for row in &rows {
        let quantity = all().into_iter().find(|q| q.id == row[0]).unwrap_or_else(|| panic!("no quantity {}", row[0]));
        for side in sides(&row[1]) {
            let in_file = plus(&row[3]);
            let moves = matches!(quantity.group, ClinicalGroup::Kinematics | ClinicalGroup::Moments);
            if moves && !ELSEWHERE.contains(&quantity.coordinate) {
                assert_eq!(in_file, during(&row[2], quantity.coordinate, side), "{row:?}");
            }
            let factor = quantity.factor(MASS_KG, side, -1.0);
            assert_eq!((factor > 0.0) == in_file, plus(&row[4]), "{row:?}, {side}: factor {factor}");
            let size = match quantity.group {
                ClinicalGroup::Moments | ClinicalGroup::Powers => 1.0 / MASS_KG,
                _ => 1.0,
            };
            assert!((factor.abs() - size).abs() < 1e-15, "{row:?}: {factor}");
            seen.insert((quantity.id, side.letter()));
        }
    }
    let expected: BTreeSet<_> = all().iter().flat_map(|q| Side::BOTH.map(|side| (q.id, side.letter()))).collect();
    assert_eq!(seen, expected, "every quantity has a row for both sides");
}

#[test]
fn a_knee_that_counts_flexion_positive_shows_the_same_signs() {
    let gait2392 = knee_flexion_sign(&[3.0, -20.0, -60.0]);
    let rajagopal = knee_flexion_sign(&[-3.0, 20.0, 60.0]);
    let find = |id: &str| all().into_iter().find(|q| q.id == id).unwrap();
    for side in Side::BOTH {
        let (angle, moment) = (find("knee_flexion_angle"), find("knee_flexion_moment"));
        assert!(angle.factor(1.0, side, gait2392) * -60.0 > 0.0 && angle.factor(1.0, side, rajagopal) * 60.0 > 0.0);
        // An extensor moment drives the coordinate up in the one and down in the other.
        assert!(moment.factor(1.0, side, gait2392) > 0.0 && moment.factor(1.0, side, rajagopal) < 0.0);
        // Power has no such sign.
        let power = find("knee_flexion_power");
        assert!(power.factor(1.0, side, gait2392) > 0.0 && power.factor(1.0, side, rajagopal) > 0.0);
    }
}

#[test]
fn quantities_that_a_model_lacks_are_not_there_and_other_names_are_known() {
    let planar = clinical_quantities(|name| ["hip_flexion_angle", "ankle_flexion_moment"].contains(&name));
    let found: Vec<_> = planar.iter().map(|q| (q.id, q.column.as_str())).collect();
    let expected = [("hip_flexion_angle", "hip_flexion_angle"), ("ankle_dorsiflexion_moment", "ankle_flexion_moment")];
    assert_eq!(found, expected);
    let abduction = clinical_quantities(|name| name == "hip_abduction_angle").remove(0);
    assert!(abduction.id == "hip_adduction_angle" && abduction.factor(1.0, Side::Left, -1.0) < 0.0);
    assert!(clinical_quantities(|_| false).is_empty());
}
