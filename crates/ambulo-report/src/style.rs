//! Colours, lines and fonts of page and figures: `data/report/style.json`, which the viewer also reads.

use ambulo::model::Side;
use serde::Deserialize;
use std::sync::LazyLock;

const STYLE: &str = include_str!("../data/report/style.json");

/// A colour on light and on dark background, as `#RRGGBB`.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Color {
    /// On white.
    pub color: String,
    /// On dark ground.
    pub dark: String,
}

/// A line: colour and dashes.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Line {
    /// On white.
    pub color: String,
    /// On dark ground.
    pub dark: String,
    /// Lengths of dashes and gaps, in widths of the mean's line; none if the line is solid.
    pub dash: Vec<f64>,
}

/// The grey of normative bands.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Fill {
    /// On white.
    pub color: String,
    /// On dark ground.
    pub dark: String,
    /// 0 to 1.
    pub opacity: f64,
}

/// Widths of lines [pt].
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct LineWidths {
    pub mean: f64,
    pub cycle: f64,
    pub zero: f64,
    pub grid: f64,
    pub axis: f64,
    pub tick: f64,
    pub infeasible: f64,
}

/// Letters: family and sizes [pt].
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Font {
    pub family: String,
    pub title_pt: f64,
    pub panel_pt: f64,
    pub label_pt: f64,
    pub tick_pt: f64,
    pub note_pt: f64,
}

/// Widths of figures [mm].
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Widths {
    /// Width of one column of a journal.
    pub one_column: f64,
    /// Width of two columns.
    pub two_columns: f64,
}

/// The contents of the file.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
#[expect(missing_docs, reason = "the names are sufficient")]
pub struct Style {
    /// Note for readers of the file.
    pub note: String,
    pub right: Line,
    pub left: Line,
    /// Normative bands.
    pub(crate) band: Fill,
    /// Opacity of bands of uncertainty, which have the colour of their line.
    pub uncertainty_opacity: f64,
    pub(crate) infeasible: Color,
    /// Measured forces shown with a prediction.
    pub(crate) measured: Color,
    pub(crate) text: Color,
    /// Axes, notes, zero lines.
    pub(crate) quiet: Color,
    pub(crate) grid: Color,
    /// The background.
    pub(crate) paper: Color,
    /// One line per session if several are compared.
    pub sessions: Vec<Line>,
    pub(crate) lines_pt: LineWidths,
    /// Opacity of the line of a single cycle.
    pub cycle_opacity: f64,
    pub(crate) font: Font,
    pub(crate) widths_mm: Widths,
}

impl Style {
    /// The line of a side.
    #[must_use]
    pub fn side(&self, side: Side) -> &Line {
        match side {
            Side::Right => &self.right,
            Side::Left => &self.left,
        }
    }
}

/// The style of the crate.
///
/// # Errors
/// None; a test reads the file.
pub fn style() -> Result<&'static Style, &'static serde_json::Error> {
    static READ: LazyLock<Result<Style, serde_json::Error>> = LazyLock::new(|| serde_json::from_str(STYLE));
    READ.as_ref()
}
