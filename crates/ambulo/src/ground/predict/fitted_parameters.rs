//! Parameters of the estimate: standard deviations and lengths, dimensionless or in seconds.

use super::deviation_calibration::{DeviationCalibration, DeviationScaling};
use super::stance_errors::{ErrorsByTraits, StanceCurve, StanceErrors};

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
                0.0, 0.00407, 0.00218, -0.00087, -0.00257, 0.00206, 0.00177, -0.00161, 3e-5, 0.00377, 0.00185, 0.00059,
                0.00628, -0.00515, 0.0,
            ]),
            StanceCurve([
                0.0, -0.00569, -0.00978, 0.00255, 0.00358, -0.0068, -0.00026, 0.00976, 0.00684, -0.01648, 0.00253,
                0.02386, -0.00841, -0.01392, 0.0,
            ]),
            StanceCurve([
                0.0, 0.0087, 0.01724, 0.01583, 0.00063, -0.00409, -0.00439, -0.00372, 0.00257, 0.00379, 0.00226,
                -0.00239, 0.00592, 0.01191, -0.0,
            ]),
        ],
        center: [
            StanceCurve([
                -0.00101, -0.0049, -0.00582, -0.0037, -0.00292, -0.00826, -0.01066, -0.0009, 0.00251, -0.00072,
                -0.00848, -0.00929, -0.00239, 0.00468, 0.00299,
            ]),
            StanceCurve::NONE,
        ],
    },
    changes: [
        [StanceCurve::NONE; 3],
        [
            StanceCurve([
                0.0, -0.06484, -0.08899, -0.06379, -0.06936, -0.07472, 0.00788, 0.00078, -0.00948, -0.01559, 0.02075,
                0.03132, 0.02159, 0.05549, 0.0,
            ]),
            StanceCurve([
                0.0, -0.06089, -0.09752, -0.079, -0.04364, -0.00921, 0.04134, 0.02459, -0.00602, -0.03282, -0.02113,
                -0.01773, 0.00894, 0.05169, 0.0,
            ]),
            StanceCurve::NONE,
        ],
        [
            StanceCurve::NONE,
            StanceCurve::NONE,
            StanceCurve([
                0.0, -0.00386, -0.00278, -0.00056, -0.00144, -0.0012, -0.00222, -0.00172, 0.00137, -0.00095, -0.00722,
                -0.00476, 0.00428, 0.00535, -0.0,
            ]),
        ],
    ],
};

/// Calibration from the errors of subjects whose laboratory was left out.
const CALIBRATION: DeviationCalibration = DeviationCalibration {
    force: [
        [
            DeviationScaling { factor: 1.75, floor: 0.00938 },
            DeviationScaling { factor: 1.32, floor: 0.00546 },
            DeviationScaling { factor: 1.28, floor: 0.0 },
            DeviationScaling { factor: 0.3, floor: 0.0134 },
            DeviationScaling { factor: 0.33, floor: 0.0267 },
        ],
        [
            DeviationScaling { factor: 2.22, floor: 0.0678 },
            DeviationScaling { factor: 1.12, floor: 0.0138 },
            DeviationScaling { factor: 1.19, floor: 0.00787 },
            DeviationScaling { factor: 1.01, floor: 0.0275 },
            DeviationScaling { factor: 1.05, floor: 0.0494 },
        ],
        [
            DeviationScaling { factor: 1.28, floor: 0.00751 },
            DeviationScaling { factor: 0.3, floor: 0.0 },
            DeviationScaling { factor: 0.3, floor: 0.0 },
            DeviationScaling { factor: 0.99, floor: 0.00335 },
            DeviationScaling { factor: 0.643, floor: 0.0 },
        ],
    ],
    center: [DeviationScaling { factor: 0.3, floor: 0.017 }, DeviationScaling { factor: 0.3, floor: 0.00943 }],
    free_moment: DeviationScaling { factor: 0.752, floor: 0.00295 },
    of_misfit: 0.5,
    of_center_misfit: 0.4,
    of_sideways: 0.1,
    of_haste: [1.0, 1.0, 0.7],
    of_smoothed: 0.3,
};
