//! Points of an interpolating function.

/// Points with strictly increasing abscissae.
#[derive(Debug, Clone, PartialEq)]
pub struct Knots {
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Knots {
    /// Checks the points: finite, strictly increasing abscissae, one ordinate each, at least one point; `None`
    /// otherwise.
    #[must_use]
    pub fn new(x: Vec<f64>, y: Vec<f64>) -> Option<Knots> {
        let finite = x.iter().chain(&y).all(|v| v.is_finite());
        let rising = x.windows(2).all(|w| w[0] < w[1]);
        (finite && rising && !x.is_empty() && x.len() == y.len()).then_some(Knots { x, y })
    }

    /// Abscissae.
    #[must_use]
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Ordinates.
    #[must_use]
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// Index of the last knot at or before x; 0 before all knots.
    pub(super) fn before(&self, x: f64) -> usize {
        self.x.partition_point(|&knot| knot <= x).saturating_sub(1)
    }
}
