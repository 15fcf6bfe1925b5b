//! How curves run between their knots.

use super::request::Pelvis;

/// A way to interpolate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Style {
    /// Knots at extremes and velocity peaks that carry angle, velocity and acceleration.
    Knots,
    /// The paper's: sub-cycles between extremes, velocity and acceleration zero at their bounds, linear laws.
    Paper1997,
}

impl Style {
    /// What the style does with pelvis and trunk unless told otherwise: the paper holds the trunk at a constant angle.
    #[must_use]
    pub fn pelvis(self) -> Pelvis {
        match self {
            Style::Knots => Pelvis::Moving,
            Style::Paper1997 => Pelvis::Vertical,
        }
    }

    /// Names in files and on the command line.
    pub const WORDS: [(&'static str, Style); 2] = [("knots", Style::Knots), ("1997", Style::Paper1997)];

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Style::Knots => "knots",
            Style::Paper1997 => "1997",
        }
    }
}
