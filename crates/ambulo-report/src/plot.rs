//! What the figures drawn by the plotting library share: a fine canvas, letters, drawing results.

use plotters::coord::Shift;
use plotters::prelude::*;

/// Why a figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the figure `{name}` could not be drawn: {reason}")]
pub struct FigureError {
    /// Which figure.
    pub name: &'static str,
    /// The plotting library's words.
    pub reason: String,
}

/// The library rounds coordinates to whole pixels, so figures are drawn on a canvas this much larger than they are shown.
pub(super) const FINE: u32 = 4;
/// What is not feasible.
pub(super) const RED: RGBColor = RGBColor(192, 0, 24);
/// Axes and zero lines.
pub(super) const GREY: RGBColor = RGBColor(120, 120, 120);
/// Grids.
pub(super) const GRID: RGBColor = RGBColor(225, 225, 225);
/// Told apart by colour-blind eyes (Okabe and Ito's palette, unverified), black and grey in between.
pub(super) const COLORS: [RGBColor; 8] = [
    RGBColor(0, 114, 178),
    RGBColor(213, 94, 0),
    RGBColor(0, 158, 115),
    RGBColor(204, 121, 167),
    RGBColor(0, 0, 0),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    GREY,
];

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
pub(super) type DrawResult = Result<(), Box<dyn std::error::Error>>;

pub(super) fn font(size: u32) -> TextStyle<'static> {
    ("sans-serif", FINE * size).into_font().color(&RGBColor(40, 40, 40))
}

/// Keeps the fine canvas as the view box and shows it at its real size.
pub(super) fn shown_at(svg: &str, width: u32, height: u32) -> String {
    let fine = format!("width=\"{}\" height=\"{}\" viewBox", FINE * width, FINE * height);
    svg.replacen(&fine, &format!("width=\"{width}\" height=\"{height}\" viewBox"), 1)
}
