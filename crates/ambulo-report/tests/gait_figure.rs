//! The figure of a gait: curves of three joints and the spans of their sub-cycles.

use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk};
use ambulo_report::gait_figure;

fn figure(name: &str) -> String {
    gait_figure(&Walk::new(&Gait::named(name).unwrap(), 0.92, &mut Findings::default()).unwrap()).unwrap()
}

/// Texts of a figure in the order of drawing, of several lines or one.
fn texts(svg: &str) -> Vec<String> {
    let parts = svg.split("<text").skip(1);
    parts.map(|part| part.split_once('>').unwrap().1.split("</text>").next().unwrap().trim().to_owned()).collect()
}

#[test]
fn every_gait_has_three_curves_and_the_sub_cycles_of_its_joints() {
    for name in Gait::NAMES {
        let svg = figure(name);
        assert!(svg.starts_with("<svg ") && svg.trim_end().ends_with("</svg>"), "{name}");
        for color in ["#0072B2", "#D55E00", "#009E73"] {
            let curves = svg.lines().filter(|line| line.starts_with("<polyline") && line.contains(color));
            let points = curves.map(|line| line.matches(',').count()).max();
            assert!(points.is_some_and(|points| points > 300), "{name}, {color}: {points:?} points");
        }
        let texts = texts(&svg);
        for word in ["hip", "knee", "ankle", "right foot", "left foot", "E1", "E2", "E3", "F", "stance", "swing"] {
            assert!(texts.iter().any(|text| text == word), "{name} lacks {word}: {texts:?}");
        }
        assert!(texts[0].contains(name), "{texts:?}");
    }
}

#[test]
fn the_same_gait_gives_the_same_bytes() {
    assert_eq!(figure("free"), figure("free"));
    assert_ne!(figure("free"), figure("fast"));
}
