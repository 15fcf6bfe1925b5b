//! Draws the figures of the 1997 paper from their numbers.

use super::FigureError;
use super::chart::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm, PALE};
use ambulo_paper::{PaperFigure, PaperPanel, PaperSeries, SeriesKind};

/// Width of a figure with one panel and with several [mm].
const WIDTHS_MM: [f64; 2] = [120.0, 178.0];
/// Height of the axes [pt].
const HEIGHT: f64 = 150.0;
/// Figures with more panels than this have them one below the other.
const MOST_COLUMNS: usize = 3;
/// The number of colours that named lines use in turn.
const COLORS: usize = 5;

/// Draws a figure.
///
/// # Errors
/// A style that cannot be read.
pub(crate) fn paper_figure(figure: &PaperFigure) -> Result<String, FigureError> {
    let count = figure.panels.len();
    let to_scale = figure.panels.iter().any(|panel| panel.to_scale);
    let chart = Chart {
        name: figure.name,
        title: figure.title.clone(),
        caption: String::new(),
        width_mm: if count > 1 || to_scale { WIDTHS_MM[1] } else { WIDTHS_MM[0] },
        columns: if to_scale || count > MOST_COLUMNS { 1 } else { count },
        panel_height_pt: HEIGHT,
        panels: figure.panels.iter().map(panel).collect(),
        notes: Vec::new(),
    };
    chart.svg()
}

fn panel(panel: &PaperPanel) -> ChartPanel {
    let curve = |(series, color): (&PaperSeries, &'static str)| ChartCurve {
        name: series.name.clone(),
        color,
        form: match series.kind {
            SeriesKind::Line => CurveForm::Line,
            SeriesKind::Faint => CurveForm::Thin,
            SeriesKind::Dots => CurveForm::Dots,
        },
        points: series.points.clone(),
    };
    ChartPanel {
        title: panel.title.clone(),
        abscissa: ChartAxis::labelled(panel.x_label),
        ordinate: ChartAxis::labelled(panel.y_label),
        to_scale: panel.to_scale,
        curves: panel.series.iter().zip(colors(panel)).map(curve).collect(),
        infeasible: Vec::new(),
    }
}

/// A colour for each series: named lines take turns, points have the colour of the line before them, faint lines are
/// grey.
fn colors(panel: &PaperPanel) -> Vec<&'static str> {
    let mut next = 0;
    let mut color_of = |series: &PaperSeries| match series.kind {
        SeriesKind::Line if !series.name.is_empty() => {
            next += 1;
            CURVE_COLORS[(next - 1) % COLORS]
        }
        SeriesKind::Line => CURVE_COLORS[0],
        SeriesKind::Faint => PALE,
        SeriesKind::Dots => CURVE_COLORS[next.saturating_sub(1) % COLORS],
    };
    panel.series.iter().map(&mut color_of).collect()
}
