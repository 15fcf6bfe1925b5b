//! How much each piece of evidence counts: standard deviations and lengths, all of them dimensionless or in seconds.

/// The numbers of the estimator that no law gives. Fitted across the recordings, leave one subject out, by `cargo xtask fit-ground`;
/// docs/GROUND_FORCES.md has the table and what changes when one is changed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Weights {
    /// Low-pass through which the motion shows the forces [Hz]: markers, skin and the motion's own filter.
    pub bandwidth_hz: f64,
    /// Noise of the total force from motion: forward, up, sideways [body weights].
    pub force_noise: [f64; 3],
    /// More of it while a heel strikes: forward, up, sideways [body weights].
    pub impact_noise: [f64; 3],
    /// How long that lasts on both sides of a strike, one standard deviation [s].
    pub impact_s: f64,
    /// Noise of the moment about the mass centre: about forward, up, sideways [body weights × m].
    pub moment_noise: [f64; 3],
    /// Deviations of the feet's curves, as a multiple of those between people: forward, up.
    pub spread: [f64; 2],
    /// Deviation of the sideways force [body weights].
    pub sideways_spread: f64,
    /// Sideways force over vertical force, as a share of the lever to the mass centre over its height.
    pub sideways_lever: f64,
    /// Least time in which the curves deviate, in leg times √(L/g): forward, up, sideways.
    pub detail: [f64; 3],
    /// How far the centre of pressure may be off its path: along and across the foot [m at a stature of 1.75 m].
    pub center_spread: [f64; 2],
    /// How far the model's mass centre may be off [m at a stature of 1.75 m].
    pub mass_center_spread: f64,
    /// Free moment of a foot [body weights × m].
    pub free_moment_spread: f64,
    /// Share of the phase of the vertical curve that follows the stance alone; the rest follows the other foot's events.
    pub own_phase: f64,
    /// Lean of the shank at which the centre of pressure is half-way from heel to ball, and the lean over which it goes [rad].
    pub center_lean: [f64; 2],
    /// Where the centre of pressure begins behind the rear of the sole, and where it ends from ball (0) to tip (1) [stature, 1].
    pub center_ends: [f64; 2],
    /// How far the centre of pressure lies outwards of the middle of the foot [stature].
    pub center_outwards: f64,
}

impl Default for Weights {
    fn default() -> Weights {
        Weights {
            bandwidth_hz: 7.0,
            force_noise: [0.023, 0.023, 0.009],
            impact_noise: [0.018, 0.035, 0.005],
            impact_s: 0.03,
            moment_noise: [0.02, 0.008, 0.02],
            spread: [1.1, 1.1],
            sideways_spread: 0.03,
            sideways_lever: 0.6,
            detail: [0.19, 0.30, 0.3],
            center_spread: [0.015, 0.008],
            mass_center_spread: 0.015,
            free_moment_spread: 0.008,
            own_phase: 0.7,
            center_lean: [0.1, 0.087],
            center_ends: [0.0095, 0.8],
            center_outwards: 0.006,
        }
    }
}
