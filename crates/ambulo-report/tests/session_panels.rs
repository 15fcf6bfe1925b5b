//! Scales of the panels of a session.

use ambulo_report::internals::{LineLook, PanelLine, SessionFigure, SessionPanel};

fn panel(values: Vec<f64>) -> SessionPanel {
    let look = LineLook { color: "#000000".to_owned(), width: 1.0, opacity: 1.0, dash: Vec::new() };
    SessionPanel {
        id: "knee_flexion_angle",
        title: "Knee flexion",
        unit: "deg",
        directions: ["flexion", "extension"],
        scale: [-20.0, 80.0],
        band: None,
        areas: Vec::new(),
        lines: vec![PanelLine { values, look, role: "cycle" }],
        foot_offs: [Vec::new(), Vec::new()],
        legend: Vec::new(),
    }
}

#[test]
fn a_scale_is_fixed_until_a_curve_leaves_it_and_grows_by_whole_steps() {
    for (values, expected) in [
        ([0.0, 60.0], "[-20.0, 80.0]"),
        // Less than a hundredth of the range.
        ([-20.9, 80.9], "[-20.0, 80.0]"),
        ([0.0, 92.0], "[-20.0, 100.0]"),
        ([-24.0, f64::NAN], "[-30.0, 80.0]"),
    ] {
        assert_eq!(format!("{:?}", panel(values.to_vec()).range()), expected);
    }
    let figure = |values: Vec<f64>| SessionFigure {
        name: "test",
        title: "Angles".to_owned(),
        caption: String::new(),
        panels: vec![panel(values)],
        legend: Vec::new(),
        notes: Vec::new(),
    };
    assert!(!figure(vec![0.0, 60.0]).svg().unwrap().contains("Scale larger"));
    assert!(figure(vec![0.0, 92.0]).svg().unwrap().contains("Scale larger than usual"), "the figure says so");
}
