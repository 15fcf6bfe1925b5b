//! The polynomial of degree five between two ends with given value, slope and curvature.
//!
//! On u in [0, 1], with ends (a₀, s₀, c₀) and (a₁, s₁, c₁) and Δ = a₁ - a₀:
//!
//! ```text
//! h(u) = a₀ + s₀ u + ½ c₀ u² + d₃ u³ + d₄ u⁴ + d₅ u⁵
//! d₃ =  10 Δ - 6 s₀ - 4 s₁ - 3/2 c₀ + ½ c₁
//! d₄ = -15 Δ + 8 s₀ + 7 s₁ + 3/2 c₀ -   c₁
//! d₅ =   6 Δ - 3 s₀ - 3 s₁ -   ½ c₀ + ½ c₁
//! ```
//!
//! With s = c = 0 at both ends it is the paper's interpolation a₀ + Δ (10 u³ - 15 u⁴ + 6 u⁵), whose slope 30 Δ u² (1 -
//! u)² does not change its sign (Faure, Debunne, Cani-Gascuel, Multon 1997, section 2.2).
//!
//! Pinned by: tests/gait_curves.rs.

use super::jet::Jet;

/// An end of a polynomial: value, slope and curvature with respect to u.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct End {
    /// Value.
    pub value: Jet,
    /// First derivative.
    pub slope: Jet,
    /// Second derivative.
    pub curvature: Jet,
}

/// h(u) between two ends; all arguments may change in time.
#[must_use]
pub fn quintic(from: End, to: End, u: Jet) -> Jet {
    Polynomial::between(from, to).at(u)
}

/// The coefficients of h, from a₀ to d₅.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Polynomial([Jet; 6]);

impl Polynomial {
    pub(super) fn between(from: End, to: End) -> Polynomial {
        let (a0, s0, c0) = (from.value, from.slope, from.curvature);
        let (s1, c1) = (to.slope, to.curvature);
        let delta = to.value - a0;
        let d3 = delta * 10.0 - s0 * 6.0 - s1 * 4.0 - c0 * 1.5 + c1 * 0.5;
        let d4 = delta * -15.0 + s0 * 8.0 + s1 * 7.0 + c0 * 1.5 - c1;
        let d5 = delta * 6.0 - s0 * 3.0 - s1 * 3.0 - c0 * 0.5 + c1 * 0.5;
        Polynomial([a0, s0, c0 * 0.5, d3, d4, d5])
    }

    #[inline]
    pub(super) fn at(&self, u: Jet) -> Jet {
        let [a0, s0, c0, d3, d4, d5] = self.0;
        ((((d5 * u + d4) * u + d3) * u + c0) * u + s0) * u + a0
    }
}
