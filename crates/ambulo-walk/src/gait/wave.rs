//! A periodic quantity as a mean and a few harmonics that depend on speed.
//!
//! ```text
//! angle = m(V*) + Σ_n a_n(V*) cos(2π n φ) + b_n(V*) sin(2π n φ)
//! ```
//!
//! φ [cycles] is the phase of the foot. A wave of even harmonics is the same in both steps. It is smooth in φ and V*.

use super::jet::Jet;
use super::speed_law::SpeedLaw;
use std::f64::consts::TAU;

/// A harmonic of a wave.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Harmonic {
    /// Periods per cycle.
    pub order: usize,
    /// Factor of the cosine [rad].
    pub cos: SpeedLaw,
    /// Factor of the sine [rad].
    pub sin: SpeedLaw,
}

/// Mean and harmonics of an angle.
#[derive(Debug, Clone, PartialEq)]
pub struct Wave {
    /// Mean over the cycle [rad].
    pub mean: SpeedLaw,
    /// Harmonics.
    pub(crate) harmonics: Vec<Harmonic>,
}

impl Wave {
    /// The angle [rad] with its time derivatives.
    #[must_use]
    pub fn at(&self, phase: Jet, speed: Jet) -> Jet {
        let turn = (phase - phase.value.floor()) * TAU;
        self.harmonics.iter().fold(self.mean.jet(speed), |sum, harmonic| {
            let (sin, cos) = (turn * harmonic.order as f64).sin_cos();
            sum + harmonic.cos.jet(speed) * cos + harmonic.sin.jet(speed) * sin
        })
    }
}
