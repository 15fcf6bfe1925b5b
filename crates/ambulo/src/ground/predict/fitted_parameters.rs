//! Parameters of the estimate: standard deviations and lengths, dimensionless or in seconds.

use super::deviation_calibration::{DeviationCalibration, DeviationScaling};

/// Fitted parameters of the estimate, from recordings with force plates by `cargo xtask fit-ground`; docs/measured/GROUND_FIT.md has
/// their leave-one-out errors and sensitivities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedParameters {
    /// Cut-off frequency of the low-pass filter through which motion and forces are compared [Hz]: above it are skin motion and noise.
    /// Both sides are filtered, so that the cut-off frequency of the motion has little effect.
    pub bandwidth_hz: f64,
    /// Noise of the total force from motion: forward, up, sideways [body weights].
    pub force_noise: [f64; 3],
    /// Noise of the moment about the mass centre: about forward, up, sideways [body weights × m].
    pub moment_noise: [f64; 3],
    /// Standard deviations of the prior, as a multiple of those between people: forward, up.
    pub spread: [f64; 2],
    /// Standard deviation of the lateral force [body weights].
    pub sideways_spread: f64,
    /// Lateral force / vertical force, divided by lateral distance / height of the mass centre.
    pub sideways_lever: f64,
    /// Peak of the outward force just after foot strike [body weights].
    pub strike_push: f64,
    /// Shortest time in which the curves deviate, in √(L/g): forward, up, sideways.
    pub detail: [f64; 3],
    /// Standard deviation of the centre of pressure from its expected path: along and across the foot [m at a stature of 1.75 m].
    pub center_spread: [f64; 2],
    /// Standard deviation of the free moment of a foot [body weights × m].
    pub free_moment_spread: f64,
    /// Lean of the shank at which the centre of pressure is half-way from heel to ball, and width of the transition [rad].
    pub center_lean: [f64; 2],
    /// Where the centre of pressure begins behind the rear of the sole, and where it ends from ball (0) to tip (1) [stature, 1].
    pub center_ends: [f64; 2],
    /// Lateral distance of the centre of pressure from the middle of the foot [stature].
    pub center_outwards: f64,
    /// Calibration of the standard deviations with measured errors.
    pub calibration: DeviationCalibration,
}

impl Default for FittedParameters {
    fn default() -> FittedParameters {
        FittedParameters {
            bandwidth_hz: 6.27,
            force_noise: [0.0198, 0.0171, 0.0163],
            moment_noise: [0.0136, 0.00869, 0.0241],
            spread: [0.77, 1.05],
            sideways_spread: 0.0539,
            sideways_lever: 0.593,
            strike_push: 0.0349,
            detail: [0.458, 0.351, 0.452],
            center_spread: [0.0113, 0.0123],
            free_moment_spread: 0.00324,
            center_lean: [0.0933, 0.115],
            center_ends: [0.0154, 0.418],
            center_outwards: 0.00297,
            calibration: DeviationCalibration {
                force: [
                    DeviationScaling { factor: 0.787, floor: 0.0195 },
                    DeviationScaling { factor: 1.57, floor: 0.034 },
                    DeviationScaling { factor: 1.07, floor: 0.00402 },
                ],
                center: [
                    DeviationScaling { factor: 1.92, floor: 0.00566 },
                    DeviationScaling { factor: 0.89, floor: 0.00414 },
                ],
                free_moment: DeviationScaling { factor: 1.21, floor: 0.00117 },
            },
        }
    }
}
