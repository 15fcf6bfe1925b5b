//! Charts: curves can be read back from the file, legends are drawn once if all panels share them, scales are equal if
//! requested.

use crate::svg_reader::{Figure, curves};
use ambulo_report::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm};

fn curve(name: &str, color: usize, points: &[[f64; 2]]) -> ChartCurve {
    ChartCurve { name: name.to_owned(), color: CURVE_COLORS[color], form: CurveForm::Line, points: points.to_vec() }
}

fn panel(title: &str, curves: Vec<ChartCurve>) -> ChartPanel {
    ChartPanel {
        title: title.to_owned(),
        abscissa: ChartAxis::labelled("time (s)"),
        ordinate: ChartAxis::labelled("force (N)"),
        curves,
        ..ChartPanel::default()
    }
}

fn chart(panels: Vec<ChartPanel>) -> Chart {
    Chart {
        name: "chart",
        title: "Title".to_owned(),
        caption: String::new(),
        width_mm: 178.0,
        columns: 1,
        panel_height_pt: 100.0,
        panels,
        notes: Vec::new(),
    }
}

const RISING: [[f64; 2]; 3] = [[0.0, -3.0], [1.0, 2.0], [4.0, 11.5]];

#[test]
fn curves_can_be_read_back_from_the_file() {
    let svg = chart(vec![panel("forces", vec![curve("heel", 0, &RISING)])]).svg().unwrap();
    let read = curves(&svg);
    assert_eq!(read.len(), 1);
    assert_eq!(read[0].0, "heel");
    for (found, expected) in read[0].1.iter().zip(RISING) {
        let [x, y] = [found[0] - expected[0], found[1] - expected[1]];
        assert!(x.abs() < 1e-3 && y.abs() < 2e-3, "{found:?} instead of {expected:?}");
    }
}

#[test]
fn panels_with_the_same_curves_share_one_legend_and_others_have_their_own() {
    let count = |svg: &str, name: &str| svg.matches(&format!(">{name}</text>")).count();
    let shared = [["a", "b"], ["a", "b"]]
        .map(|names| panel("same", names.into_iter().enumerate().map(|(k, name)| curve(name, k, &RISING)).collect()));
    let svg = chart(shared.into()).svg().unwrap();
    assert_eq!((count(&svg, "a"), count(&svg, "b")), (1, 1));
    // The same name in another colour is another curve.
    let own = [0, 1].map(|color| panel("own", vec![curve("a", color, &RISING)]));
    assert_eq!(count(&chart(own.into()).svg().unwrap(), "a"), 2);
}

#[test]
fn panels_to_scale_have_the_same_unit_along_both_axes() {
    let wide = ChartPanel { to_scale: true, ..panel("wide", vec![curve("", 0, &RISING)]) };
    let flat = ChartPanel { to_scale: true, ..panel("flat", vec![curve("", 0, &[[0.0, 0.0], [9.0, 1.0]])]) };
    let figure = Figure::read(&chart(vec![wide, flat]).svg().unwrap());
    for panel in &figure.panels {
        let [left, top, right, bottom] = panel.place;
        let unit = [(right - left) / (panel.along[1] - panel.along[0]), (bottom - top) / (panel.up[1] - panel.up[0])];
        assert!((unit[0] / unit[1] - 1.0).abs() < 1e-6, "{}: {unit:?}", panel.id);
    }
}

#[test]
fn given_ticks_replace_round_numbers() {
    let powers = [1.0, 2.0, 3.0].map(|power: f64| (power, format!("{}", 10.0_f64.powf(power))));
    let mut panel = panel("errors", vec![curve("", 0, &[[1.0, 0.0], [3.0, 1.0]])]);
    panel.abscissa.ticks = powers.into();
    let figure = Figure::read(&chart(vec![panel]).svg().unwrap());
    let labels: Vec<&String> = figure.texts.iter().filter(|text| text.starts_with("10")).collect();
    assert_eq!(labels, ["10", "100", "1000"]);
}

#[test]
fn an_infeasible_part_is_red_and_named() {
    let marked = ChartPanel { infeasible: vec![[1.0, 2.0]], ..panel("forces", vec![curve("heel", 0, &RISING)]) };
    let figure = Figure::read(&chart(vec![marked]).svg().unwrap());
    assert!(figure.texts.iter().any(|text| text == "red: not feasible"), "{:?}", figure.texts);
}

#[test]
fn a_chart_without_numbers_is_still_a_file() {
    for points in [&[] as &[[f64; 2]], &[[f64::NAN, f64::NAN]], &[[2.0, 5.0]]] {
        let svg = chart(vec![panel("empty", vec![curve("nothing", 0, points)])]).svg().unwrap();
        assert!(!svg.contains("NaN") && Figure::read(&svg).panels.len() == 1, "{points:?}");
    }
}
