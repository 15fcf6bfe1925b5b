//! Calibrates the standard deviations of the prediction with measured errors.
//!
//!   σ² = (k σ_estimate)² + floor²
//!
//! The estimate assumes independent evidence and exact models; k and the floor correct its deviation, component by component, by the
//! errors relative to force plates. Leave-one-out across subjects, by `cargo xtask fit-ground` (docs/measured/GROUND_FIT.md).

/// Factor k and floor for the standard deviation of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviationScaling {
    /// Factor k of the estimated deviation.
    pub factor: f64,
    /// Floor of the deviation: body weights for a force, m for a centre of pressure, body weights × m for a free moment.
    pub floor: f64,
}

impl DeviationScaling {
    /// Leaves the estimated deviation unchanged.
    pub const UNSCALED: DeviationScaling = DeviationScaling { factor: 1.0, floor: 0.0 };

    /// Calibrated variance of a component from the estimated one, both in its unit squared; `unit` is the size of a floor of 1.
    #[must_use]
    pub fn variance(&self, estimated: f64, unit: f64) -> f64 {
        self.factor.powi(2) * estimated + (self.floor * unit).powi(2)
    }
}

/// Calibration of all components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviationCalibration {
    /// Force forward, up, sideways.
    pub force: [DeviationScaling; 3],
    /// Centre of pressure along and across the foot.
    pub center: [DeviationScaling; 2],
    /// Free moment.
    pub free_moment: DeviationScaling,
}

impl DeviationCalibration {
    /// Leaves the estimated deviations unchanged.
    pub const UNSCALED: DeviationCalibration = DeviationCalibration {
        force: [DeviationScaling::UNSCALED; 3],
        center: [DeviationScaling::UNSCALED; 2],
        free_moment: DeviationScaling::UNSCALED,
    };
}

impl Default for DeviationCalibration {
    fn default() -> DeviationCalibration {
        DeviationCalibration::UNSCALED
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_factor_multiplies_the_deviation_and_a_floor_is_added_in_squares() {
        let spread = DeviationScaling { factor: 2.0, floor: 0.03 };
        let deviation = spread.variance(1.5_f64.powi(2), 100.0).sqrt();
        assert!((deviation - (9.0_f64 + 9.0).sqrt()).abs() < 1e-12, "{deviation}");
        assert!((DeviationScaling::UNSCALED.variance(4.0, 100.0) - 4.0).abs() < 1e-12);
    }
}
