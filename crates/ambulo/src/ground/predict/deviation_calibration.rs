//! Calibrates the standard deviations of the prediction with measured errors.
//!
//!   σ² = ((k σ_estimate)² + floor² + (a m_F)² + (b F_side)²) w²    of a force, w = (1 + h haste) (1 + s)
//!   σ² = (k σ_estimate)² + floor² + (c m_P)²                  of a centre of pressure
//!
//! The estimate assumes independent evidence and exact models; k and the floor correct its deviation, component by
//! component, by the errors relative to force plates. For forces they depend on the elapsed share of the stance,
//! because the strike is known worst: one pair for each fifth, linear between their middles. Fitted to subjects whose
//! laboratory was left out, by `cargo xtask fit-ground` (docs/measured/GROUND_FIT.md).
//!
//! h widens the deviation in fast walking, where strikes differ more from person to person: haste is the trait of
//! [`super::stance_traits`], 0 up to V* = 0.45. s widens that of the vertical force where the motion was smoothed
//! before it was recorded ([`super::evidence_filter`]), 0 elsewhere. The last terms come from the trial itself. m_F and
//! m_P are what the estimate leaves of the force and of the moment that the motion requires ([`super::misfit`]): motion
//! that contradicts itself, because markers are missing or because it is fast, gives larger errors. F_side is the
//! sideways force, for the force forward and sideways: in a turn both depend on the direction of the foot's path. a and
//! b were chosen by the likelihood of the errors of all subjects, among 0, 0.3, 0.5, 0.8 and 0, 0.06, 0.1, 0.14. c is
//! the least share, among 0, 0.2, 0.3, 0.4, 0.5, with which deviations calibrated on walks with all markers hold more
//! than 85 % of the same walks without the markers above the pelvis (the last table of the page).

/// Factor k and floor for the standard deviation of one component.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviationScaling {
    /// Factor k of the estimated deviation.
    pub factor: f64,
    /// Floor of the deviation: body weights for a force, m for a centre of pressure, body weights × m for a free
    /// moment.
    pub floor: f64,
}

impl DeviationScaling {
    /// Leaves the estimated deviation unchanged.
    pub const UNSCALED: DeviationScaling = DeviationScaling { factor: 1.0, floor: 0.0 };

    /// Calibrated variance of a component from the estimated one, both in its unit squared; `unit` is the size of a
    /// floor of 1.
    #[must_use]
    pub fn variance(&self, estimated: f64, unit: f64) -> f64 {
        self.factor.powi(2) * estimated + (self.floor * unit).powi(2)
    }
}

/// Factors and floors of a component in each fifth of a stance.
pub type ByFifth = [DeviationScaling; 5];

/// Factor and floor at an elapsed share of the stance: one value per fifth, linear between the middles of the fifths.
#[must_use]
pub fn scaling_at(fifths: &ByFifth, phase: f64) -> DeviationScaling {
    let place = (5.0 * phase - 0.5).clamp(0.0, 4.0);
    let k = (place as usize).min(3);
    let mix =
        |of: fn(&DeviationScaling) -> f64| of(&fifths[k]) + (of(&fifths[k + 1]) - of(&fifths[k])) * (place - k as f64);
    DeviationScaling { factor: mix(|s| s.factor), floor: mix(|s| s.floor) }
}

/// Difference of the estimate from the required wrench, root mean square over a stance (`misfit`).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Misfit {
    /// Forward, up and to the right [N].
    pub force: [f64; 3],
    /// As a distance of the centre of pressure, along and across the foot [m].
    pub center: [f64; 2],
}

/// Calibration of all components.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeviationCalibration {
    /// Force forward, up, sideways.
    pub force: [ByFifth; 3],
    /// Centre of pressure along and across the foot.
    pub center: [DeviationScaling; 2],
    /// Free moment.
    pub free_moment: DeviationScaling,
    /// a: share of what the estimate leaves of the required force in a stance.
    pub of_misfit: f64,
    /// c: share of what the estimate leaves of the required moment, as a distance of the centre of pressure.
    pub of_center_misfit: f64,
    /// b: share of the sideways force, forward and sideways.
    pub of_sideways: f64,
    /// h: how much wider the deviations of the forces forward, up and sideways are for each unit of haste.
    pub of_haste: [f64; 3],
    /// s: how much wider the deviation of the vertical force is for a motion that was smoothed before.
    pub of_smoothed: f64,
}

impl DeviationCalibration {
    /// Leaves the estimated deviations unchanged.
    pub const UNSCALED: DeviationCalibration = DeviationCalibration {
        force: [[DeviationScaling::UNSCALED; 5]; 3],
        center: [DeviationScaling::UNSCALED; 2],
        free_moment: DeviationScaling::UNSCALED,
        of_misfit: 0.0,
        of_center_misfit: 0.0,
        of_sideways: 0.0,
        of_haste: [0.0; 3],
        of_smoothed: 0.0,
    };

    /// Variance of the force forward (0), up (1) or sideways (2) that the trial itself shows [N²]; `sideways` is F_side
    /// [N].
    #[doc(hidden)] // for tests
    pub fn of_trial(&self, axis: usize, misfit: &Misfit, sideways: f64) -> f64 {
        let of_sideways = if axis == UP { 0.0 } else { self.of_sideways };
        (self.of_misfit * misfit.force[axis]).powi(2) + (of_sideways * sideways).powi(2)
    }

    /// w: by which factor the deviation of the force forward (0), up (1) or sideways (2) is wider than usual.
    #[must_use]
    pub fn widening(&self, axis: usize, haste: f64, is_smoothed: bool) -> f64 {
        let of_smoothed = if axis == UP && is_smoothed { self.of_smoothed } else { 0.0 };
        (1.0 + self.of_haste[axis] * haste) * (1.0 + of_smoothed)
    }

    /// Variance of the centre of pressure from the trial, along (0) or across the foot (1) [m²].
    #[doc(hidden)] // for tests
    pub fn center_of_trial(&self, axis: usize, misfit: &Misfit) -> f64 {
        (self.of_center_misfit * misfit.center[axis]).powi(2)
    }
}

/// Index of the upward force.
const UP: usize = 1;

impl Default for DeviationCalibration {
    fn default() -> DeviationCalibration {
        DeviationCalibration::UNSCALED
    }
}
