//! Draws the picture of docs/measured/PHYSICAL_WALK.md: what harmonics of the torques keep, and which pushes are
//! survived.

use super::{PHASES, Results};
use ambulo_report::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm};

/// Width of the picture [mm] and height of the axes [pt].
const WIDTH_MM: f64 = 178.0;
const HEIGHT: f64 = 120.0;

pub(super) fn svg(results: &Results) -> Result<String, String> {
    let of_harmonics = |value: &dyn Fn(usize) -> f64| -> Vec<[f64; 2]> {
        results.harmonics.iter().enumerate().map(|(k, (count, ..))| [*count as f64, value(k)]).collect()
    };
    let kept = ["hip", "knee", "ankle"].iter().enumerate().map(|(joint, name)| {
        curve(name, CURVE_COLORS[joint], of_harmonics(&|k| 100.0 * results.harmonics[k].1[joint]))
    });
    let apart = of_harmonics(&|k| results.harmonics[k].2.apart.to_degrees());
    let survived = |pushes: &[(f64, usize)]| -> Vec<[f64; 2]> {
        let share = |(force, survived): &(f64, usize)| [*force, 100.0 * *survived as f64 / PHASES as f64];
        let mut points: Vec<[f64; 2]> = pushes.iter().map(share).collect();
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
        points
    };
    let pushes = [
        curve("usual gains", CURVE_COLORS[0], survived(&results.pushes)),
        curve("tuned gains", CURVE_COLORS[1], survived(&results.tuned.pushes)),
    ];
    let panels = vec![
        panel("variance of torques kept", ["harmonics", "%"], kept.collect()),
        panel(
            "hips, knees, ankles against the plan",
            ["harmonics", "deg RMS"],
            vec![curve("", CURVE_COLORS[0], apart)],
        ),
        panel("pushes survived", ["force on the trunk (N)", "%"], pushes.into()),
    ];
    let chart = Chart {
        name: "physical_walk",
        title: "Walking under own torques".to_owned(),
        caption: String::new(),
        width_mm: WIDTH_MM,
        columns: 3,
        panel_height_pt: HEIGHT,
        panels,
        notes: Vec::new(),
    };
    chart.svg().map_err(|e| e.to_string())
}

fn curve(name: &str, color: &'static str, points: Vec<[f64; 2]>) -> ChartCurve {
    ChartCurve { name: name.to_owned(), color, form: CurveForm::DottedLine, points }
}

fn panel(title: &str, [across, up]: [&str; 2], curves: Vec<ChartCurve>) -> ChartPanel {
    ChartPanel {
        title: title.to_owned(),
        abscissa: ChartAxis::labelled(across),
        ordinate: ChartAxis::labelled(up),
        curves,
        ..ChartPanel::default()
    }
}
