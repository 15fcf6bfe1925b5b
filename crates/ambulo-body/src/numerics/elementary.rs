//! Elementary functions with the same bits on every platform.
//!
//! `f64::sin`, `f64::exp` and the like of the standard library belong to the platform: the C library of Linux even
//! chooses between variants by processor, and a browser, Windows and macOS have others. Their last bits differ, and a
//! solver that ends when its steps are small then ends elsewhere. These functions are compiled from one source, without
//! fused multiply-add, so a result depends on its input alone. Sums, products, quotients and `sqrt` are exact to the
//! last bit by the standard (IEEE 754) and need no function here. `powi` with a literal exponent is products in a fixed
//! order, so it needs none either.
//!
//! Source: the crate `libm`, a translation of the mathematical libraries of FreeBSD and musl (its feature `arch`, which
//! takes instructions of the processor, changes only correctly rounded functions); sine and cosine are in
//! `numerics::sin_cos`. Errors are below 1 unit in the last place; errors of [`powi`] grow with the exponent.
//! `clippy.toml` forbids the functions of the standard library.
//! Pinned by: tests/numerics_elementary.rs, with values of 50 digits, and a checksum of the bits of all functions.

use super::sin_cos::sin_cos_of;

/// Range of x² + y² in which [`hypot`] needs no scaling.
const SAFE: std::ops::Range<f64> = 1e-280..1e280;

/// Sine and cosine of an angle \[rad\].
#[inline]
#[must_use]
pub fn sin_cos(x: f64) -> (f64, f64) {
    sin_cos_of(x)
}

/// Sine of an angle \[rad\].
#[inline]
#[must_use]
pub fn sin(x: f64) -> f64 {
    sin_cos_of(x).0
}

/// Cosine of an angle \[rad\].
#[inline]
#[must_use]
pub fn cos(x: f64) -> f64 {
    sin_cos_of(x).1
}

/// Tangent of an angle \[rad\].
#[inline]
#[must_use]
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Angle of a sine, -π/2 to π/2 \[rad\]; not a number beyond ±1.
#[inline]
#[must_use]
pub fn asin(x: f64) -> f64 {
    libm::asin(x)
}

/// Angle of a cosine, 0 to π \[rad\]; not a number beyond ±1.
#[inline]
#[must_use]
pub fn acos(x: f64) -> f64 {
    libm::acos(x)
}

/// Angle of a tangent, -π/2 to π/2 \[rad\].
#[inline]
#[must_use]
pub fn atan(x: f64) -> f64 {
    libm::atan(x)
}

/// Angle of the point (x, y) from the x axis, -π to π \[rad\].
#[inline]
#[must_use]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// eˣ.
#[inline]
#[must_use]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// Natural logarithm.
#[inline]
#[must_use]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// ln (1 + x), exact for small x.
#[inline]
#[must_use]
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// Decimal logarithm.
#[inline]
#[must_use]
pub fn log10(x: f64) -> f64 {
    libm::log10(x)
}

/// Hyperbolic tangent.
#[inline]
#[must_use]
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// Cube root.
#[inline]
#[must_use]
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// xʸ.
#[inline]
#[must_use]
pub fn powf(x: f64, y: f64) -> f64 {
    libm::pow(x, y)
}

/// √(x² + y²) without overflow.
#[inline]
#[must_use]
pub fn hypot(x: f64, y: f64) -> f64 {
    let square = x * x + y * y;
    if SAFE.contains(&square) { square.sqrt() } else { libm::hypot(x, y) }
}

/// xⁿ by products, for a computed exponent. (The result of the standard library changes when the compiler knows both
/// numbers.)
#[inline]
#[must_use]
pub fn powi(x: f64, n: i32) -> f64 {
    let (mut product, mut square, mut rest) = (1.0, x, n.unsigned_abs());
    while rest > 0 {
        if rest & 1 == 1 {
            product *= square;
        }
        square *= square;
        rest /= 2;
    }
    if n < 0 { 1.0 / product } else { product }
}
