//! How far predictions are off in truth, against what the equations say.
//!
//!   σ² = (k σ_equations)² + floor²
//!
//! The equations take every piece of evidence for independent and every model for true; k and the floor are what plates say of that,
//! component by component. Found across subjects, leave one subject out, by `cargo xtask fit-ground` (docs/measured/GROUND_FIT.md).

/// Factor and floor of the standard deviation of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Multiple of what the equations say.
    pub factor: f64,
    /// Least deviation: body weights for a force, m for a centre of pressure, body weights × m for a free moment.
    pub floor: f64,
}

impl Spread {
    /// What the equations say, unchanged.
    pub const RAW: Spread = Spread { factor: 1.0, floor: 0.0 };

    /// The variance of a component from that of the equations, both in its unit squared; `unit` is what a floor of 1 means.
    #[must_use]
    pub fn variance(&self, of_equations: f64, unit: f64) -> f64 {
        self.factor.powi(2) * of_equations + (self.floor * unit).powi(2)
    }
}

/// Standard deviations of what is predicted, component by component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Calibration {
    /// Force forward, up, sideways.
    pub force: [Spread; 3],
    /// Centre of pressure along and across the foot.
    pub center: [Spread; 2],
    /// Free moment.
    pub free_moment: Spread,
}

impl Calibration {
    /// What the equations say, unchanged.
    pub const RAW: Calibration =
        Calibration { force: [Spread::RAW; 3], center: [Spread::RAW; 2], free_moment: Spread::RAW };
}

impl Default for Calibration {
    fn default() -> Calibration {
        Calibration::RAW
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_multiplies_the_deviation_and_a_floor_is_added_in_squares() {
        let spread = Spread { factor: 2.0, floor: 0.03 };
        let deviation = spread.variance(1.5_f64.powi(2), 100.0).sqrt();
        assert!((deviation - (9.0_f64 + 9.0).sqrt()).abs() < 1e-12, "{deviation}");
        assert!((Spread::RAW.variance(4.0, 100.0) - 4.0).abs() < 1e-12);
    }
}
