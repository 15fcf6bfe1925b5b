//! Colours and lines of page and figures.

use ambulo_report::style::style;
use serde_json::Value;

#[test]
fn the_style_is_read_and_tells_the_sides_apart_without_colour() {
    let style = style().unwrap();
    assert!(style.right.dash.is_empty() && !style.left.dash.is_empty());
    let file: Value = serde_json::from_str(include_str!("../data/report/style.json")).unwrap();
    let width = |columns: &str| file["widths_mm"][columns].as_f64().unwrap();
    assert!(width("one_column") < width("two_columns"));
    let named = ["infeasible", "band"].map(|name| file[name]["color"].as_str().unwrap());
    for color in named.into_iter().chain([style.right.color.as_str(), style.left.color.as_str()]) {
        assert!(color.len() == 7 && color.starts_with('#'), "{color}");
    }
}
