//! Draws figures as SVG for papers and reports, without a browser.

pub(crate) mod axes;
mod chart;
mod cycle_figures;
mod cycle_panel;
mod gait_figure;
pub(crate) mod moving_picture;
mod paper_figure;
mod scene_figures;
pub(crate) mod session_panels;
pub(crate) mod sheet;
pub(crate) mod svg;
mod time_figures;

pub use chart::{CURVE_COLORS, Chart, ChartAxis, ChartCurve, ChartPanel, CurveForm, PALE};
#[doc(hidden)]
pub use cycle_figures::CycleFigures;
pub use gait_figure::gait_figure;
pub(crate) use moving_picture::{moving_picture, moving_speed};
pub(crate) use paper_figure::paper_figure;
pub use scene_figures::SceneCurves;
pub(crate) use session_panels::{LineLook, PanelArea, PanelLine, ProfileBars, ProfileFigure, SessionPanel};
pub(crate) use time_figures::{PredictedMotion, prediction_figure, residual_figure};

use ambulo::model::Side;

/// A figure could not be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the figure `{name}` could not be drawn: {reason}")]
pub struct FigureError {
    /// Name of the figure.
    pub name: &'static str,
    /// The cause.
    pub reason: String,
}

/// A part of a cycle in which a motion is not feasible.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// The infeasible quantity of `cycles.csv`, or `None` if feet or the whole body are concerned.
    pub quantity: Option<String>,
    /// The foot whose cycle it is.
    pub side: Side,
    /// Number of the cycle of this foot, from 1.
    pub cycle: usize,
    /// Start and end [% of the cycle].
    pub percent: [f64; 2],
}
