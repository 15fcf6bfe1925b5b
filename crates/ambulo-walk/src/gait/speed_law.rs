//! Numbers of a gait as polynomials of dimensionless speed.
//!
//! ```text
//! law(V*) = c₀ + c₁ V* + c₂ V*²,    V* = V / √(g L)
//! ```
//!
//! | code | symbol | unit |
//! |---|---|---|
//! | `speed` | V* | 1 |
//! | L | leg length, hip to floor | m |
//!
//! The laws were fitted between the slowest and the fastest speed of the data. Outside of this range V* changes
//! smoothly into a constant ([`held`]), so that no law is extrapolated far.

use super::jet::Jet;

/// Acceleration of gravity in dimensionless speeds [m/s²].
pub const GRAVITY: f64 = 9.81;

/// A number against dimensionless speed.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct SpeedLaw {
    /// c₀, c₁, c₂.
    pub coefficients: [f64; 3],
}

impl SpeedLaw {
    /// A number that does not depend on speed.
    #[must_use]
    pub const fn constant(value: f64) -> SpeedLaw {
        SpeedLaw { coefficients: [value, 0.0, 0.0] }
    }

    /// The number at a dimensionless speed.
    #[must_use]
    pub fn at(&self, speed: f64) -> f64 {
        let [c0, c1, c2] = self.coefficients;
        (c2 * speed + c1) * speed + c0
    }

    /// The number with its derivatives while speed changes.
    #[must_use]
    pub fn jet(&self, speed: Jet) -> Jet {
        let [_, c1, c2] = self.coefficients;
        speed.through([self.at(speed.value), 2.0 * c2 * speed.value + c1, 2.0 * c2])
    }

    /// The law times a factor.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> SpeedLaw {
        SpeedLaw { coefficients: self.coefficients.map(|c| c * factor) }
    }

    /// The law plus a number.
    #[must_use]
    pub fn plus(&self, number: f64) -> SpeedLaw {
        let [c0, c1, c2] = self.coefficients;
        SpeedLaw { coefficients: [c0 + number, c1, c2] }
    }

    /// Whether the law is a straight line.
    #[must_use]
    pub fn is_linear(&self) -> bool {
        self.coefficients[2].abs() <= 0.0
    }
}

/// The range of speeds on which laws were fitted, and how far they are extrapolated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpeedRange {
    /// Slowest dimensionless speed of the data.
    pub low: f64,
    /// Fastest dimensionless speed of the data.
    pub high: f64,
    /// Largest extrapolation below `low`.
    pub below: f64,
    /// Largest extrapolation above `high`.
    pub above: f64,
}

impl SpeedRange {
    /// V* itself inside the range; outside, it changes into a constant at a distance of `below` or `above`, with three
    /// continuous derivatives.
    ///
    /// With d = (V* - high)/above: the slope falls from 1 to 0 on d in [0, 2] as 1 - (10 v³ - 15 v⁴ + 6 v⁵), v = d/2,
    /// so the integral of the slope is d - 2 (5/2 v⁴ - 3 v⁵ + v⁶), and 1 from d = 2 on.
    #[must_use]
    pub fn held(&self, speed: Jet) -> Jet {
        if speed.value > self.high {
            bent((speed - self.high) * (1.0 / self.above)) * self.above + self.high
        } else if speed.value < self.low {
            bent((speed - self.low) * (-1.0 / self.below)) * -self.below + self.low
        } else {
            speed
        }
    }

    /// Slowest and fastest speed that [`SpeedRange::held`] returns.
    #[must_use]
    pub fn ends(&self) -> [f64; 2] {
        [self.low - self.below, self.high + self.above]
    }
}

fn bent(d: Jet) -> Jet {
    let v = d.value / 2.0;
    if v >= 1.0 {
        return Jet::constant(1.0);
    }
    let value = d.value - 2.0 * v.powi(4) * (2.5 + v * (v - 3.0));
    let slope = 1.0 - v.powi(3) * (10.0 + v * (6.0 * v - 15.0));
    let curvature = -15.0 * v * v * (1.0 - v) * (1.0 - v);
    d.through([value, slope, curvature])
}
