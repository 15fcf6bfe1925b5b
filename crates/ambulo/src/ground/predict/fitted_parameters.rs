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
                0.0, 0.00389, 0.00191, -0.00115, -0.00276, 0.00198, 0.00185, -0.00148, 0.00012, 0.00382, 0.00185,
                0.00058, 0.00635, -0.00497, 0.0,
            ]),
            StanceCurve([
                0.0, -0.00536, -0.00931, 0.00306, 0.00387, -0.00676, -0.00062, 0.00937, 0.0068, -0.01619, 0.00276,
                0.02379, -0.00859, -0.01406, 0.0,
            ]),
            StanceCurve([
                0.0, 0.0092, 0.01781, 0.01627, 0.00083, -0.00416, -0.00464, -0.00373, 0.00273, 0.00372, 0.00199,
                -0.0023, 0.00671, 0.01288, -0.0,
            ]),
        ],
        center: [
            StanceCurve([
                -0.00102, -0.00498, -0.00594, -0.00386, -0.00313, -0.00854, -0.01103, -0.00124, 0.00234, -0.00067,
                -0.00826, -0.00898, -0.0021, 0.00497, 0.00305,
            ]),
            StanceCurve::NONE,
        ],
    },
    changes: [
        [StanceCurve::NONE; 3],
        [
            StanceCurve([
                0.0, -0.06223, -0.0853, -0.05986, -0.06704, -0.07338, 0.00657, -0.00153, -0.01035, -0.0146, 0.02106,
                0.03056, 0.02102, 0.05533, 0.0,
            ]),
            StanceCurve([
                0.0, -0.05846, -0.09499, -0.07696, -0.04254, -0.00937, 0.03952, 0.02277, -0.00634, -0.03157, -0.02019,
                -0.01781, 0.00863, 0.0516, 0.0,
            ]),
            StanceCurve::NONE,
        ],
        [
            StanceCurve::NONE,
            StanceCurve::NONE,
            StanceCurve([
                0.0, -0.00359, -0.00234, -0.00014, -0.00114, -0.00103, -0.00225, -0.00176, 0.0014, -0.00097, -0.00724,
                -0.00466, 0.00443, 0.00545, -0.0,
            ]),
        ],
    ],
};

/// Calibration from the errors of subjects whose laboratory was left out.
const CALIBRATION: DeviationCalibration = DeviationCalibration {
    force: [
        [
            DeviationScaling { factor: 1.72, floor: 0.00921 },
            DeviationScaling { factor: 1.42, floor: 0.00181 },
            DeviationScaling { factor: 1.16, floor: 0.00355 },
            DeviationScaling { factor: 0.3, floor: 0.0134 },
            DeviationScaling { factor: 0.438, floor: 0.0264 },
        ],
        [
            DeviationScaling { factor: 1.36, floor: 0.0861 },
            DeviationScaling { factor: 1.27, floor: 0.0104 },
            DeviationScaling { factor: 1.05, floor: 0.0104 },
            DeviationScaling { factor: 1.65, floor: 0.0196 },
            DeviationScaling { factor: 1.08, floor: 0.0489 },
        ],
        [
            DeviationScaling { factor: 1.29, floor: 0.00763 },
            DeviationScaling { factor: 0.3, floor: 0.0 },
            DeviationScaling { factor: 0.3, floor: 0.0 },
            DeviationScaling { factor: 1.05, floor: 0.00111 },
            DeviationScaling { factor: 0.69, floor: 0.0 },
        ],
    ],
    center: [DeviationScaling { factor: 0.3, floor: 0.0169 }, DeviationScaling { factor: 0.3, floor: 0.0094 }],
    free_moment: DeviationScaling { factor: 1.29, floor: 0.000342 },
    of_misfit: 0.5,
    of_center_misfit: 0.4,
    of_sideways: 0.1,
    of_haste: [1.0, 1.0, 0.7],
    of_smoothed: 0.3,
};
