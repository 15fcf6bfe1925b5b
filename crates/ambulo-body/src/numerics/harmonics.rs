//! Harmonics of a function of the phase: mean + Σ_k (a_k cos(2π k φ) + b_k sin(2π k φ)).

use std::f64::consts::TAU;

use crate::numerics::elementary::{self, sin_cos};

/// Mean and harmonics of values over whole cycles.
#[derive(Debug, Clone, PartialEq)]
pub struct Harmonics {
    /// Mean of the values.
    pub mean: f64,
    /// a_1, a_2, ...
    pub cosine: Vec<f64>,
    /// b_1, b_2, ...
    pub sine: Vec<f64>,
}

impl Harmonics {
    /// The first `count` harmonics of values at phases [cycles] that divide one or more cycles evenly.
    #[must_use]
    pub fn of(phases: &[f64], values: &[f64], count: usize) -> Harmonics {
        let samples = values.len() as f64;
        let along = |wave: fn(f64) -> f64| {
            let part = |k: usize| {
                let terms = phases.iter().zip(values).map(|(phase, value)| value * wave(TAU * k as f64 * phase));
                2.0 * terms.sum::<f64>() / samples
            };
            (1..=count).map(part).collect()
        };
        Harmonics {
            mean: values.iter().sum::<f64>() / samples,
            cosine: along(elementary::cos),
            sine: along(elementary::sin),
        }
    }

    /// The value at a phase [cycles].
    #[inline]
    #[must_use]
    pub fn at(&self, phase: f64) -> f64 {
        let waves = self.cosine.iter().zip(&self.sine).zip(1..).map(|((cosine, sine), k)| {
            let (sin, cos) = sin_cos(TAU * f64::from(k) * phase);
            cosine * cos + sine * sin
        });
        self.mean + waves.sum::<f64>()
    }

    /// Share of the variance of values that these harmonics represent; 1 for values without variance.
    #[must_use]
    pub fn r_squared(&self, phases: &[f64], values: &[f64]) -> f64 {
        let left: f64 = phases.iter().zip(values).map(|(phase, value)| (value - self.at(*phase)).powi(2)).sum();
        let all: f64 = values.iter().map(|value| (value - self.mean).powi(2)).sum();
        if all > 0.0 { 1.0 - left / all } else { 1.0 }
    }
}
