//! Draws the picture of docs/measured/WALK_BANDS.md: nine curves of free walking with the normative bands.

use super::curve::QUANTITIES;
use super::cycle::Cycle;
use crate::normative::Band;
use ambulo_report::figures::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm};

/// Width of the picture [mm] and height of one panel [pt].
const WIDTH_MM: f64 = 178.0;
const HEIGHT: f64 = 88.0;
const BAND: &str = "#D9D9D9";

/// Angles, moments, forces and forward speed over a cycle; the speed has no normative band.
pub(super) fn free(cycle: &Cycle, people: &[Band; 8]) -> Result<String, String> {
    let quantity = QUANTITIES.map(|quantity| {
        let i = quantity.index();
        panel([quantity.name(), quantity.axis()], &cycle.curves[i], Some(&people[i]))
    });
    let speed = panel(["speed of the centre of mass", "m/s"], &cycle.curves[8], None);
    let chart = Chart {
        name: "walk_bands_free",
        title: "Free walking".to_owned(),
        caption: String::new(),
        width_mm: WIDTH_MM,
        columns: 3,
        panel_height_pt: HEIGHT,
        panels: quantity.into_iter().chain([speed]).collect(),
        notes: Vec::new(),
    };
    chart.svg().map_err(|e| e.to_string())
}

fn panel([title, unit]: [&str; 2], curve: &[f64], band: Option<&Band>) -> ChartPanel {
    let edge = |sign: f64| -> Vec<f64> {
        let band = band.into_iter().flat_map(|band| band.mean.iter().zip(&band.sd));
        band.map(|(mean, sd)| mean + sign * 2.0 * sd).collect()
    };
    let mut outline = over_cycle(&edge(1.0));
    outline.extend(over_cycle(&edge(-1.0)).into_iter().rev());
    let drawn = |name: &str, color, form, points| ChartCurve { name: name.to_owned(), color, form, points };
    let mut curves = Vec::new();
    if let Some(band) = band {
        curves.push(drawn("children, mean ± 2 SD", BAND, CurveForm::Area, outline));
        curves.push(drawn("children, mean", CURVE_COLORS[4], CurveForm::Thin, over_cycle(&band.mean)));
    }
    curves.push(drawn("Ambulo, gait \u{201c}free\u{201d}", CURVE_COLORS[0], CurveForm::Line, over_cycle(curve)));
    ChartPanel {
        title: title.to_owned(),
        abscissa: ChartAxis { range: Some([0.0, 100.0]), ..ChartAxis::labelled("gait cycle (%)") },
        ordinate: ChartAxis::labelled(unit),
        curves,
        ..ChartPanel::default()
    }
}

/// Percent of the cycle and value of samples at equal distances.
fn over_cycle(values: &[f64]) -> Vec<[f64; 2]> {
    let last = values.len().saturating_sub(1).max(1) as f64;
    values.iter().enumerate().map(|(i, value)| [100.0 * i as f64 / last, *value]).collect()
}
