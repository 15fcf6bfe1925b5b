//! Scales of the panels of a session.

use ambulo_report::internals::{LineLook, PanelLine, SessionPanel};

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
    assert!(!panel(vec![0.0, 60.0]).is_widened());
    assert!(panel(vec![0.0, 92.0]).is_widened(), "the page says so");
    let svg = panel(vec![0.0, 60.0]).svg("mean").unwrap();
    for known in ["id=\"mean-knee_flexion_angle\"", "Knee flexion", "gait cycle (%)", "flexion"] {
        assert!(svg.contains(known), "{known}");
    }
}
