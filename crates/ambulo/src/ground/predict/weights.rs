//! How much each piece of evidence counts: standard deviations and lengths, all of them dimensionless or in seconds.

use super::calibration::{Calibration, Spread};

/// The numbers of the estimator that no law gives, fitted on the recordings with plates by `cargo xtask fit-ground`; docs/measured/GROUND_FIT.md has
/// them, how they fare on subjects who were left out, and what changes when one is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Low-pass below which motion and forces are compared [Hz]: what lies above is skin, markers and noise. Both sides go through it,
    /// so that the motion's own cut-off hardly matters.
    pub bandwidth_hz: f64,
    /// Noise of the total force from motion: forward, up, sideways [body weights].
    pub force_noise: [f64; 3],
    /// Noise of the moment about the mass centre: about forward, up, sideways [body weights × m].
    pub moment_noise: [f64; 3],
    /// Deviations of the feet's curves, as a multiple of those between people: forward, up.
    pub spread: [f64; 2],
    /// Deviation of the sideways force [body weights].
    pub sideways_spread: f64,
    /// Sideways force over vertical force, as a share of the lever to the mass centre over its height.
    pub sideways_lever: f64,
    /// Outward push of a foot just after its strike, at its height [body weights].
    pub strike_push: f64,
    /// Least time in which the curves deviate, in leg times √(L/g): forward, up, sideways.
    pub detail: [f64; 3],
    /// How far the centre of pressure may be off its path: along and across the foot [m at a stature of 1.75 m].
    pub center_spread: [f64; 2],
    /// Free moment of a foot [body weights × m].
    pub free_moment_spread: f64,
    /// Lean of the shank at which the centre of pressure is half-way from heel to ball, and the lean over which it goes [rad].
    pub center_lean: [f64; 2],
    /// Where the centre of pressure begins behind the rear of the sole, and where it ends from ball (0) to tip (1) [stature, 1].
    pub center_ends: [f64; 2],
    /// How far the centre of pressure lies outwards of the middle of the foot [stature].
    pub center_outwards: f64,
    /// How far predictions are off in truth, against what the equations say.
    pub calibration: Calibration,
}

impl Default for Weights {
    fn default() -> Weights {
        Weights {
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
            calibration: Calibration {
                force: [
                    Spread { factor: 0.787, floor: 0.0195 },
                    Spread { factor: 1.57, floor: 0.034 },
                    Spread { factor: 1.07, floor: 0.00402 },
                ],
                center: [Spread { factor: 1.92, floor: 0.00566 }, Spread { factor: 0.89, floor: 0.00414 }],
                free_moment: Spread { factor: 1.21, floor: 0.00117 },
            },
        }
    }
}
