//! The strength of a muscle in a posture: its active force along the tendon at activation 1, on a rigid tendon.
//!
//! With the length L and the lengthening speed L̇ of the path, tendon slack length lₛ, optimal fibre length l₀, width
//! h = l₀ sin α₀ of the fixed parallelogram:
//!
//!   l = √((L - lₛ)² + h²)     cos α = (L - lₛ) / l     l̇ = L̇ cos α
//!   F = F_max f(l / l₀) g(l̇ / (v_max l₀)) cos α′
//!
//! α′ = α with [`Pennation::Right`]. OpenSim 4.6 gives the pennation model of `Millard2012EquilibriumMuscle` the
//! normalised fibre length where it expects metres, so that sin α′ = h / (l / l₀): practically no pennation.
//! [`Pennation::AsOpenSim`] repeats that for Millard's muscles. A fibre at its least length has no active force; the
//! least length is the greater of h / sin α_max and, for Millard's curves, the least active length.
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `length`, `speed` | L, L̇ | m, m/s |
//!
//! Source: the call of OpenSim's `StaticOptimizationTarget::prepareToOptimize`
//! (`calcInextensibleTendonActiveFiberForce`); MuscleFixedWidthPennationModel.cpp.
//! Not handled: compliant tendons; passive force.
//! Pinned by: tests/strength.rs

use crate::curves::ForceCurves;
use crate::set::{MuscleCurves, MuscleParameters};
use ambulo_body::numerics::elementary::{sin, sin_cos};
use serde::Deserialize;

/// Least fibre length of a muscle without pennation [optimal fibre lengths], as in OpenSim.
const LEAST_LENGTH: f64 = 0.01;

/// Whose pennation reduces the active force of Millard's muscles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub enum Pennation {
    /// As OpenSim 4.6 computes it: see the [module](self).
    #[default]
    #[serde(rename = "opensim")]
    AsOpenSim,
    /// The angle between fibres and tendon.
    #[serde(rename = "exact")]
    Right,
}

impl Pennation {
    /// The rules with their names.
    pub const ALL: [(&'static str, Pennation); 2] = [("opensim", Pennation::AsOpenSim), ("exact", Pennation::Right)];
}

/// What the strength of one muscle depends on, prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct Strength {
    max_force: f64,
    optimal_length: f64,
    slack_length: f64,
    /// Greatest velocity [m/s].
    max_velocity: f64,
    /// h, the width of the parallelogram [m].
    width: f64,
    /// Sine and cosine of the greatest pennation.
    most_pennation: (f64, f64),
    /// Least fibre length, and its component along the tendon [m].
    least: [f64; 2],
    normalised_pennation: bool,
}

impl Strength {
    /// Prepares a muscle with its [`ForceCurves`].
    #[must_use]
    pub fn new(parameters: &MuscleParameters, curves: &ForceCurves, pennation: Pennation) -> Strength {
        let optimal_length = parameters.optimal_fiber_length;
        let width = optimal_length * sin(parameters.pennation_at_optimal);
        let most_pennation = sin_cos(parameters.max_pennation);
        let pennated = if width > 0.0 { width / most_pennation.0 } else { LEAST_LENGTH * optimal_length };
        let least = pennated.max(curves.least_active_length() * optimal_length);
        let is_millard = matches!(parameters.curves, MuscleCurves::Millard2012(_));
        Strength {
            max_force: parameters.max_isometric_force,
            optimal_length,
            slack_length: parameters.tendon_slack_length,
            max_velocity: parameters.max_contraction_velocity * optimal_length,
            width,
            most_pennation,
            least: [least, (least * least - width * width).max(0.0).sqrt()],
            normalised_pennation: is_millard && pennation == Pennation::AsOpenSim,
        }
    }

    /// Fibre length [m] at a length of the path [m].
    #[inline]
    #[must_use]
    pub fn fiber_length(&self, length: f64) -> f64 {
        let along = length - self.slack_length;
        if along < self.least[1] { self.least[0] } else { (along * along + self.width * self.width).sqrt() }
    }

    /// Active force along the tendon [N] at an activation, for a length [m] and a lengthening speed [m/s] of the path.
    /// Static optimisation takes activation 1 and scales linearly.
    #[inline]
    #[must_use]
    pub fn force(&self, curves: &ForceCurves, length: f64, speed: f64, activation: f64) -> f64 {
        let fiber = self.fiber_length(length);
        if fiber <= self.least[0] {
            return 0.0;
        }
        let cosine = (length - self.slack_length) / fiber;
        let normalised = fiber / self.optimal_length;
        let velocity = speed * cosine / self.max_velocity;
        let cosine = if self.normalised_pennation { self.cosine_of(normalised) } else { cosine };
        self.max_force * activation * curves.active(normalised) * curves.velocity(velocity, activation) * cosine
    }

    /// Cosine of the pennation of a fibre of this length, limited by the greatest pennation.
    fn cosine_of(&self, fiber: f64) -> f64 {
        if self.width <= 0.0 {
            return 1.0;
        }
        let sine = self.width / fiber;
        let (most_sine, least_cosine) = self.most_pennation;
        if fiber > self.least[0] && sine < most_sine { (1.0 - sine * sine).sqrt() } else { least_cosine }
    }
}
