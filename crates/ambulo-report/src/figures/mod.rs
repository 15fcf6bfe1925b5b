//! Figures as SVG for papers and reports, made without a browser.

mod axes;
mod cycle_figures;
mod cycle_panel;
mod sheet;
mod svg;
mod time_figures;

pub use cycle_figures::CycleFigures;
pub use time_figures::{prediction_figure, residual_figure};

use super::plot::FigureError;
use ambulo::model::Side;

/// A part of a cycle in which a motion is not feasible.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// What is not: a quantity of `cycles.csv`, or `None` for what concerns feet and body as a whole.
    pub quantity: Option<String>,
    /// The foot whose cycle it is.
    pub side: Side,
    /// Number of the cycle of this foot, from 1.
    pub cycle: usize,
    /// From where to where [% of the cycle].
    pub percent: [f64; 2],
}
