//! Numbers in messages.

use std::fmt;

/// Shows a number in a message: very large and very small ones with an exponent, not with hundreds of digits.
#[derive(Debug, Clone, Copy)]
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Shown(number) = *self;
        let is_long = number.is_finite() && number.abs() > 0.0 && !(1e-6..1e12).contains(&number.abs());
        if is_long { write!(f, "{number:e}") } else { write!(f, "{number}") }
    }
}
