//! Points that a function goes through.

/// Points with strictly rising abscissae.
#[derive(Debug, Clone, PartialEq)]
pub struct Knots {
    x: Vec<f64>,
    y: Vec<f64>,
}

impl Knots {
    /// As many ordinates as strictly rising, finite abscissae, at least one; `None` otherwise.
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

    /// Index of the last knot at or before x; 0 before all of them.
    pub(super) fn before(&self, x: f64) -> usize {
        self.x.partition_point(|&knot| knot <= x).saturating_sub(1)
    }
}
