//! Parameters of the estimate: standard deviations and lengths, dimensionless or in seconds.

use super::deviation_calibration::{DeviationCalibration, DeviationScaling};
use super::stance_errors::{StanceCurve, StanceErrors};

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
    /// Mean errors of the estimate in walking, which are taken off.
    pub errors: StanceErrors,
    /// Calibration of the standard deviations with measured errors.
    pub calibration: DeviationCalibration,
}

impl Default for FittedParameters {
    fn default() -> FittedParameters {
        FittedParameters {
            bandwidth_hz: 7.32,
            force_noise: [0.023, 0.0213, 0.0184],
            moment_noise: [0.0111, 0.00887, 0.0225],
            spread: [0.785, 0.778],
            sideways_spread: 0.0442,
            sideways_lever: 0.616,
            strike_push: 0.0444,
            detail: [0.406, 0.332, 0.454],
            center_spread: [0.0141, 0.0133],
            free_moment_spread: 0.00286,
            center_lean: [0.0904, 0.125],
            center_ends: [0.0166, 0.403],
            center_outwards: 0.000559,
            errors: ERRORS,
            calibration: CALIBRATION,
        }
    }
}

/// The mean errors that people and laboratories left out have, too.
const ERRORS: StanceErrors = StanceErrors {
    force: [
        StanceCurve::NONE,
        StanceCurve::NONE,
        StanceCurve([
            0.00023, 0.00708, 0.01609, 0.0168, -0.00189, -0.00484, -0.00424, -0.0048, 0.00184, 0.00125, 0.00337,
            -0.00017, 0.00105, 0.00711, -0.00331,
        ]),
    ],
    center: [
        StanceCurve([
            -0.00081, -0.00404, -0.00473, -0.00244, -0.00158, -0.00749, -0.01096, -0.00014, 0.00344, 2e-05, -0.00772,
            -0.00745, -0.00029, 0.00668, 0.00427,
        ]),
        StanceCurve::NONE,
    ],
};

/// From the errors of people whose laboratory was left out.
const CALIBRATION: DeviationCalibration = DeviationCalibration {
    force: [
        [
            DeviationScaling { factor: 1.35, floor: 0.0113 },
            DeviationScaling { factor: 0.405, floor: 0.0143 },
            DeviationScaling { factor: 0.918, floor: 0.0109 },
            DeviationScaling { factor: 1.32, floor: 0.00569 },
            DeviationScaling { factor: 1.46, floor: 0.00558 },
        ],
        [
            DeviationScaling { factor: 2.82, floor: 0.0453 },
            DeviationScaling { factor: 1.62, floor: 0.0313 },
            DeviationScaling { factor: 1.63, floor: 0.0168 },
            DeviationScaling { factor: 1.61, floor: 0.0358 },
            DeviationScaling { factor: 1.25, floor: 0.0681 },
        ],
        [
            DeviationScaling { factor: 1.62, floor: 0.00164 },
            DeviationScaling { factor: 1.58, floor: 0.0 },
            DeviationScaling { factor: 0.471, floor: 0.00418 },
            DeviationScaling { factor: 1.88, floor: 0.00146 },
            DeviationScaling { factor: 0.832, floor: 0.00439 },
        ],
    ],
    center: [DeviationScaling { factor: 1.23, floor: 0.00572 }, DeviationScaling { factor: 0.876, floor: 0.00269 }],
    free_moment: DeviationScaling { factor: 0.923, floor: 0.00256 },
};
