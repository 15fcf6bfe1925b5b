//! The page of a motion that is arriving.

use ambulo::model::anthropometry::{Build, SegmentTable};
use ambulo_report::page::live_page;
use ambulo_results::stream_columns;
use serde_json::Value;

#[test]
fn the_page_names_the_columns_of_arrows_and_curves() {
    let build = Build { table: SegmentTable::DeLevaMale, mass: 75.0, height: 1.75, toe_joint: false };
    let model = build.human().unwrap().model;
    let columns = stream_columns(&model);
    let html = live_page(&model, &columns, 200.0, 70.0).unwrap();
    assert!(html.contains("connect-src 'self'"));
    let (_, after) = html.split_once("id=\"ambulo-live\">").unwrap();
    let live: Value = serde_json::from_str(after.split_once("</script>").unwrap().0).unwrap();
    let name = |column: &Value| columns[usize::try_from(column.as_u64().unwrap()).unwrap()].0.as_str();
    let panels = live["panels"].as_array().unwrap();
    let titles: Vec<&str> = panels.iter().map(|panel| panel["title"].as_str().unwrap()).collect();
    let expected = ["Ground force, up", "Ground force, forward", "Hip flexion moment", "Knee moment", "Ankle moment"];
    assert_eq!(titles, expected);
    for curve in panels.iter().flat_map(|panel| panel["curves"].as_array().unwrap()) {
        let name = name(&curve["column"]);
        assert_eq!(name.contains("_r_"), curve["side"] == "r", "{name}");
        assert_eq!(!curve["sd"].is_null(), name.starts_with("ground_force"), "{name}");
    }
    let [right, left] = &live["forces"].as_array().unwrap()[..] else { panic!("{live}") };
    assert_eq!(name(&right["force"][1]), "ground_force_r_vy");
    assert_eq!(name(&left["point"][2]), "ground_force_l_pz");
}
