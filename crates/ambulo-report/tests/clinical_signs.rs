//! Every row of "Signs in panels" in docs/CONVENTIONS.md, against the signs of movements above it and the factors of
//! the panels.

use ambulo::findings::Findings;
use ambulo::model::{Model, Side};
use ambulo_report::internals::{ClinicalGroup, ClinicalNames, ClinicalQuantity, clinical_quantities};
use std::collections::BTreeSet;

const LAW: &str = include_str!("../../../docs/CONVENTIONS.md");
/// Coordinates that the table of movements lacks: the built-in planar figure has none of them. Moments of the ankle's
/// reaction have no coordinate.
const ELSEWHERE: [&str; 5] =
    ["knee_adduction", "knee_rotation", "subtalar_angle", "ankle_inversion_moment", "ankle_rotation_moment"];
/// Body mass [kg] of the rows, for factors of moments and powers.
const MASS_KG: f64 = 50.0;

fn table(header: &str) -> Vec<Vec<String>> {
    let rows = LAW.lines().skip_while(|line| *line != header).skip(2).take_while(|line| line.starts_with('|'));
    let cells =
        |line: &str| line.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`').to_owned()).collect();
    rows.map(cells).collect()
}

/// Whether a cell states plus.
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
    clinical_quantities(&ClinicalNames::usual(), |_| true)
}

/// Whether a coordinate grows during a movement, by the table of movements.
fn during(movement: &str, coordinate: &str) -> bool {
    let movements = table("| movement | side | coordinate | sign | point | moves |");
    let row = movements.iter().find(|row| row[0] == movement && row[2] == coordinate);
    plus(&row.unwrap_or_else(|| panic!("no movement `{movement}` of `{coordinate}`"))[3])
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
            let coordinate = &quantity.coordinates[side];
            if moves && !ELSEWHERE.iter().any(|stem| coordinate.starts_with(stem)) {
                assert_eq!(in_file, during(&row[2], coordinate), "{row:?}");
            }
            let factor = quantity.factor(MASS_KG, side);
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

/// The demo's body with knees that count flexion.
fn flexion_positive() -> Model {
    let model = demo();
    let mut bodies = model.bodies().to_vec();
    for body in bodies.iter_mut().filter(|body| body.name.starts_with("tibia")) {
        body.joint.rotations.iter_mut().for_each(|axis| axis.direction = -axis.direction);
    }
    Model::new("flexion", model.gravity(), bodies, model.coordinates().to_vec(), Vec::new()).unwrap()
}

fn demo() -> Model {
    let bytes = include_bytes!("../../ambulo-cli/tests/recording/figure.osim");
    Model::from_osim(bytes, &mut Findings::default()).unwrap()
}

#[test]
fn a_knee_that_counts_flexion_positive_shows_the_same_signs() {
    let of = |model: &Model, id: &str| {
        let names = ClinicalNames::of_model(model);
        clinical_quantities(&names, |_| true).into_iter().find(|q| q.id == id).unwrap()
    };
    let (extension, flexion) = (demo(), flexion_positive());
    for side in Side::BOTH {
        let factor = |model: &Model, id: &str| of(model, id).factor(1.0, side);
        assert!(factor(&extension, "knee_flexion_angle") < 0.0 && factor(&flexion, "knee_flexion_angle") > 0.0);
        // An extensor moment drives the coordinate up in the one and down in the other.
        assert!(factor(&extension, "knee_flexion_moment") > 0.0 && factor(&flexion, "knee_flexion_moment") < 0.0);
        // Power has no such sign.
        assert!(factor(&extension, "knee_flexion_power") > 0.0 && factor(&flexion, "knee_flexion_power") > 0.0);
    }
}

#[test]
fn quantities_that_a_model_lacks_are_not_there_and_other_names_are_known() {
    let names = ClinicalNames::usual();
    let planar = clinical_quantities(&names, |name| ["hip_flexion_angle", "ankle_angle_moment"].contains(&name));
    let found: Vec<_> = planar.iter().map(|q| (q.id, q.columns.right.as_str())).collect();
    let expected = [("hip_flexion_angle", "hip_flexion_angle"), ("ankle_dorsiflexion_moment", "ankle_angle_moment")];
    assert_eq!(found, expected);
    assert!(clinical_quantities(&names, |_| false).is_empty());
    // A model may name its coordinates as it likes.
    let model = demo();
    let mut coordinates = model.coordinates().to_vec();
    for coordinate in &mut coordinates {
        coordinate.name =
            coordinate.name.replace("ankle_angle", "ankle_flex").replace("hip_adduction", "Hueftadduktion");
    }
    let other = Model::new("other", model.gravity(), model.bodies().to_vec(), coordinates, Vec::new()).unwrap();
    let of = |id: &str| {
        clinical_quantities(&ClinicalNames::of_model(&other), |_| true).into_iter().find(|q| q.id == id).unwrap()
    };
    assert_eq!(of("ankle_dorsiflexion_power").columns.left, "ankle_flex_power");
    assert_eq!(of("hip_adduction_angle").coordinates.left, "Hueftadduktion_l");
    // Without a model the sign of the knee angle is unknown.
    assert!(
        !clinical_quantities(&ClinicalNames::without_model(), |_| true)
            .iter()
            .any(|q| q.id.starts_with("knee_flexion"))
    );
}
