//! Finds the loads in a force table by the names of its columns.

use ambulo::internals::{load_columns, with_axis_last};
use ambulo::model::Side;
use ambulo_formats::table::Table;

/// Key, side, force, point and moment of the loads in a table with these names, each for x, y and z at the place of
/// `*`.
fn found(names: &[&str]) -> Vec<(String, Option<Side>, bool, bool)> {
    let axes = names.iter().flat_map(|name| ["x", "y", "z"].map(|axis| name.replace('*', axis)));
    let columns = std::iter::once("time".to_owned()).chain(axes).map(|name| (name, vec![0.0, 1.0])).collect();
    let table = Table::new("loads", columns).unwrap();
    let table = with_axis_last(&table).unwrap_or(table);
    load_columns(&table).into_iter().map(|l| (l.key, l.side, l.point.is_some(), l.moment.is_some())).collect()
}

#[test]
fn the_side_or_number_of_a_load_may_follow_the_axis() {
    let whole = |key: &str, side| (key.to_owned(), side, true, true);
    let loads = found(&["ground_force_v*_r", "ground_force_p*_r", "ground_torque_*_r"]);
    assert_eq!(loads, [whole("r", Some(Side::Right))]);
    let loads = found(&["F*1", "P*1", "M*1", "F*2", "P*2", "M*2"]);
    assert_eq!(loads, [whole("1", None), whole("2", None)]);
    let loads = found(&["Force_L_*", "Center_of_Pressure_L_*", "Torque_L_*"]);
    assert_eq!(loads, [whole("l", Some(Side::Left))]);
    // Forces and moments of a plate about its own origin have no known place.
    assert_eq!(found(&["F*1", "M*1"]), []);
    // Columns of something else are no loads.
    assert_eq!(found(&["pelvis_t*", "head_*"]), []);
}
