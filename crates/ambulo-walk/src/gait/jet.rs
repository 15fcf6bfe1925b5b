//! A number with its first two derivatives in time.
//!
//! Products and powers carry the derivatives by Leibniz' rule and the chain rule:
//!
//! ```text
//! (a b)''   = a'' b + 2 a' b' + a b''
//! f(x)''    = f''(x) x'² + f'(x) x''
//! ```
//!
//! Curves that are evaluated in this arithmetic give angle, angular velocity and angular acceleration at once, exact to
//! rounding, also while the speed changes. Pinned by: tests/gait_curves.rs.

use std::ops::{Add, AddAssign, Mul, Neg, Sub};

use crate::numerics::elementary::{powf, sin_cos};

/// A number with two time derivatives: x [unit], x' [unit/s], x'' [unit/s²].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Jet {
    /// The number itself [unit].
    pub value: f64,
    /// First derivative [unit/s].
    pub rate: f64,
    /// Second derivative [unit/s²].
    pub acceleration: f64,
}

impl Jet {
    /// The constant zero.
    pub const ZERO: Jet = Jet::constant(0.0);

    /// A constant.
    #[must_use]
    pub const fn constant(value: f64) -> Jet {
        Jet { value, rate: 0.0, acceleration: 0.0 }
    }

    /// A number with its derivatives.
    #[must_use]
    pub const fn new(value: f64, rate: f64, acceleration: f64) -> Jet {
        Jet { value, rate, acceleration }
    }

    /// f(x), from f and its two derivatives at `self.value`.
    #[must_use]
    pub fn through(self, [f, df, ddf]: [f64; 3]) -> Jet {
        Jet { value: f, rate: df * self.rate, acceleration: ddf * self.rate * self.rate + df * self.acceleration }
    }

    /// xᵖ for x > 0.
    #[must_use]
    pub fn power(self, p: f64) -> Jet {
        let value = powf(self.value, p);
        let slope = p * value / self.value;
        self.through([value, slope, (p - 1.0) * slope / self.value])
    }

    /// 1/x for x ≠ 0.
    #[must_use]
    pub fn reciprocal(self) -> Jet {
        let value = 1.0 / self.value;
        self.through([value, -value * value, 2.0 * value * value * value])
    }

    /// Sine and cosine of an angle [rad].
    #[must_use]
    pub fn sin_cos(self) -> (Jet, Jet) {
        let (sin, cos) = sin_cos(self.value);
        (self.through([sin, cos, -sin]), self.through([cos, -sin, -cos]))
    }
}

impl Add for Jet {
    type Output = Jet;
    fn add(self, other: Jet) -> Jet {
        Jet {
            value: self.value + other.value,
            rate: self.rate + other.rate,
            acceleration: self.acceleration + other.acceleration,
        }
    }
}

impl AddAssign for Jet {
    fn add_assign(&mut self, other: Jet) {
        *self = *self + other;
    }
}

impl Sub for Jet {
    type Output = Jet;
    fn sub(self, other: Jet) -> Jet {
        self + -other
    }
}

impl Neg for Jet {
    type Output = Jet;
    fn neg(self) -> Jet {
        Jet { value: -self.value, rate: -self.rate, acceleration: -self.acceleration }
    }
}

impl Mul for Jet {
    type Output = Jet;
    fn mul(self, other: Jet) -> Jet {
        Jet {
            value: self.value * other.value,
            rate: self.rate * other.value + self.value * other.rate,
            acceleration: self.acceleration * other.value
                + 2.0 * self.rate * other.rate
                + self.value * other.acceleration,
        }
    }
}

impl Mul<f64> for Jet {
    type Output = Jet;
    fn mul(self, factor: f64) -> Jet {
        Jet { value: self.value * factor, rate: self.rate * factor, acceleration: self.acceleration * factor }
    }
}

impl Add<f64> for Jet {
    type Output = Jet;
    fn add(self, constant: f64) -> Jet {
        Jet { value: self.value + constant, ..self }
    }
}

impl Sub<f64> for Jet {
    type Output = Jet;
    fn sub(self, constant: f64) -> Jet {
        self + -constant
    }
}
