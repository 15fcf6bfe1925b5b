//! Parameters of the estimate: standard deviations and lengths, dimensionless or in seconds.

use super::deviation_calibration::{DeviationCalibration, DeviationScaling};
use super::stance_errors::{ErrorsByTraits, StanceCurve, StanceErrors};
use super::stance_traits::TRAITS;

/// Fitted parameters of the estimate, from recordings with force plates by `cargo xtask fit-ground`;
/// docs/measured/GROUND_FIT.md has their leave-one-out errors and sensitivities.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FittedParameters {
    /// Cut-off frequency of the low-pass filter through which motion and forces are compared [Hz]: above it are skin
    /// motion and noise. Both sides are filtered, so that the cut-off frequency of the motion has little effect.
    pub bandwidth_hz: f64,
    /// Noise of the total force from motion: forward, up, sideways [body weights].
    pub force_noise: [f64; 3],
    /// Noise of the moment about the mass centre: about forward, up, sideways [body weights × m].
    pub moment_noise: [f64; 3],
    /// Standard deviations of the prior, as a multiple of those between subjects: forward, up.
    pub spread: [f64; 2],
    /// Standard deviation of the lateral force [body weights].
    pub sideways_spread: f64,
    /// Lateral force / vertical force, divided by lateral distance / height of the mass centre.
    pub sideways_lever: f64,
    /// Peak of the outward force just after foot strike [body weights].
    pub strike_push: f64,
    /// Shortest time in which the curves deviate, in √(L/g): forward, up, sideways.
    pub detail: [f64; 3],
    /// Standard deviation of the centre of pressure from its expected path: along and across the foot [m at a stature
    /// of 1.75 m].
    pub center_spread: [f64; 2],
    /// Standard deviation of the free moment of a foot [body weights × m].
    pub free_moment_spread: f64,
    /// Lean of the shank at which the centre of pressure is half-way from heel to ball, and width of the transition
    /// [rad].
    pub center_lean: [f64; 2],
    /// Where the centre of pressure begins behind the rear of the sole, and where it ends from ball (0) to tip (1)
    /// [stature, 1].
    pub center_ends: [f64; 2],
    /// Lateral distance of the centre of pressure from the middle of the foot [stature].
    pub center_outwards: f64,
    /// Mean errors of the estimate in walking, which are taken off.
    pub errors: ErrorsByTraits,
    /// Calibration of the standard deviations with measured errors.
    pub calibration: DeviationCalibration,
}

impl FittedParameters {
    /// A checksum of these parameters: FNV-1a of their digits.
    #[must_use]
    pub fn fingerprint(&self) -> u64 {
        checksum(&format!("{self:?}"))
    }
}

/// FNV-1a of the bytes of a text.
#[must_use]
pub fn checksum(text: &str) -> u64 {
    const BASIS: u64 = 0xcbf2_9ce4_8422_2325;
    const PRIME: u64 = 0x0100_0000_01b3;
    text.bytes().fold(BASIS, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(PRIME))
}

impl Default for FittedParameters {
    fn default() -> FittedParameters {
        FittedParameters {
            bandwidth_hz: 7.62,
            force_noise: [0.0203, 0.0239, 0.018],
            moment_noise: [0.0132, 0.011, 0.0145],
            spread: [0.742, 0.809],
            sideways_spread: 0.0427,
            sideways_lever: 0.627,
            strike_push: 0.0374,
            detail: [0.408, 0.4, 0.418],
            center_spread: [0.0127, 0.0104],
            free_moment_spread: 0.0037,
            center_lean: [0.0832, 0.127],
            center_ends: [0.0144, 0.431],
            center_outwards: 0.00282,
            errors: ERRORS,
            calibration: CALIBRATION,
        }
    }
}

/// Mean errors that also occur in subjects and laboratories left out.
const ERRORS: ErrorsByTraits = ErrorsByTraits {
    usual: StanceErrors {
        force: [
            StanceCurve([
                0.0, 0.00424, 0.00349, -0.00038, -0.00253, 0.00358, 0.00531, -0.00169, -0.00319, -0.00161, -0.00415,
                -0.00115, 0.01123, -0.00427, -0.0,
            ]),
            StanceCurve([
                0.0, -0.01417, -0.01072, -0.0049, 0.00205, -0.00018, 0.00254, 0.00526, 0.00538, -0.0181, -0.00552,
                0.01293, -0.00017, -0.01225, 0.0,
            ]),
            StanceCurve([
                0.0, 0.01102, 0.02073, 0.01821, -0.0002, -0.0032, -0.00308, -0.00376, 0.00298, 0.00393, 0.00566,
                0.00268, 0.00481, 0.00917, -0.0,
            ]),
        ],
        center: [
            StanceCurve([
                -0.00101, -0.00495, -0.00591, -0.00378, -0.00298, -0.00833, -0.01073, -0.00099, 0.00242, -0.00077,
                -0.00851, -0.00928, -0.00241, 0.00466, 0.003,
            ]),
            StanceCurve::NONE,
        ],
    },
    changes: [[StanceCurve::NONE; TRAITS]; 3],
};

/// Calibration from the errors of subjects whose laboratory was left out.
const CALIBRATION: DeviationCalibration = DeviationCalibration {
    force: [
        [
            DeviationScaling { factor: 0.954, floor: 0.0127 },
            DeviationScaling { factor: 0.459, floor: 0.0 },
            DeviationScaling { factor: 0.344, floor: 0.0 },
            DeviationScaling { factor: 0.926, floor: 0.0104 },
            DeviationScaling { factor: 1.23, floor: 0.00534 },
        ],
        [
            DeviationScaling { factor: 2.26, floor: 0.0559 },
            DeviationScaling { factor: 0.3, floor: 0.0326 },
            DeviationScaling { factor: 1.68, floor: 0.0027 },
            DeviationScaling { factor: 1.6, floor: 0.027 },
            DeviationScaling { factor: 1.6, floor: 0.0423 },
        ],
        [
            DeviationScaling { factor: 0.5, floor: 0.0146 },
            DeviationScaling { factor: 1.05, floor: 0.00375 },
            DeviationScaling { factor: 0.3, floor: 0.0 },
            DeviationScaling { factor: 1.0, floor: 0.01 },
            DeviationScaling { factor: 0.556, floor: 0.00266 },
        ],
    ],
    center: [DeviationScaling { factor: 0.848, floor: 0.00444 }, DeviationScaling { factor: 0.596, floor: 0.00207 }],
    free_moment: DeviationScaling { factor: 0.684, floor: 0.0025 },
    of_misfit: 0.5,
    of_center_misfit: 0.4,
    of_sideways: 0.1,
    of_haste: [1.0, 1.0, 0.7],
    of_smoothed: 0.3,
};
