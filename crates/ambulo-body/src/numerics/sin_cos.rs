//! Sine and cosine of many angles at once.
//!
//! The scalar sine and cosine of a mathematical library take longer than all other arithmetic of a frame, and cannot be
//! vectorised. Here every step is free of branches, so that the loop over a slice becomes vector code. One angle alone
//! is computed in the same way.
//!
//! x = k π/2 + r with |r| ≤ π/4 (Cody and Waite: π/2 in three parts of 33 bits, so that k times the first two is exact
//! for |k| < 2²⁰); then the polynomials of the FreeBSD math library (msun `k_sin.c`, `k_cos.c`, `e_rem_pio2.c`; Sun
//! Microsystems 1993), and the quadrant k mod 4 swaps them and sets the signs.
//! Error: below 1 unit in the last place of 1 for |x| ≤ 10⁵ rad (tested); larger angles use the crate `libm`.

#![expect(clippy::excessive_precision, reason = "the constants are quoted as their source prints them")]

use std::f64::consts::FRAC_2_PI;

const PI_2_HIGH: f64 = 1.570_796_326_734_125_614_17e+00;
const PI_2_MIDDLE: f64 = 6.077_100_506_303_965_976_60e-11;
const PI_2_LOW: f64 = 2.022_266_248_795_950_631_54e-21;
/// Adding 1.5 · 2⁵² rounds to an integer, which is then in the low bits.
const ROUND: f64 = 6_755_399_441_055_744.0;
/// Largest angle [rad] for which the reduction above is accurate enough.
const LARGEST: f64 = 1e5;

const S: [f64; 6] = [
    -1.666_666_666_666_663_243_48e-01,
    8.333_333_333_322_489_461_24e-03,
    -1.984_126_982_985_794_931_34e-04,
    2.755_731_370_707_006_767_89e-06,
    -2.505_076_025_340_686_341_95e-08,
    1.589_690_995_211_550_102_21e-10,
];
const C: [f64; 6] = [
    4.166_666_666_666_660_190_37e-02,
    -1.388_888_888_887_410_957_49e-03,
    2.480_158_728_947_672_941_78e-05,
    -2.755_731_435_139_066_330_35e-07,
    2.087_572_321_298_174_827_90e-09,
    -1.135_964_755_778_819_482_65e-11,
];

/// `sin[i]`, `cos[i]` of `angle[i]` [rad]; the three slices have the same length.
#[inline(always)]
pub fn sin_cos(angle: &[f64], sin: &mut [f64], cos: &mut [f64]) {
    let n = angle.len().min(sin.len()).min(cos.len());
    let (angle, sin, cos) = (&angle[..n], &mut sin[..n], &mut cos[..n]);
    let mut all_small = true;
    for i in 0..n {
        all_small &= angle[i].abs() <= LARGEST;
        (sin[i], cos[i]) = sin_cos_small(angle[i]);
    }
    if !all_small {
        for i in 0..n {
            (sin[i], cos[i]) = libm::sincos(angle[i]);
        }
    }
}

/// Sine and cosine of one angle [rad], with the bits of the slices except that the sine of -0 is -0.
#[inline]
pub(super) fn sin_cos_of(x: f64) -> (f64, f64) {
    if x.abs() <= LARGEST && x != 0.0 { sin_cos_small(x) } else { libm::sincos(x) }
}

#[inline(always)]
fn sin_cos_small(x: f64) -> (f64, f64) {
    let shifted = x * FRAC_2_PI + ROUND;
    let quadrant = shifted.to_bits();
    let k = shifted - ROUND;
    let r = ((x - k * PI_2_HIGH) - k * PI_2_MIDDLE) - k * PI_2_LOW;
    let z = r * r;
    let sin = r + r * z * (S[0] + z * (S[1] + z * (S[2] + z * (S[3] + z * (S[4] + z * S[5])))));
    let half = 0.5 * z;
    let tail = z * z * (C[0] + z * (C[1] + z * (C[2] + z * (C[3] + z * (C[4] + z * C[5])))));
    let head = 1.0 - half;
    let cos = head + (((1.0 - head) - half) + tail);
    let swap = 0_u64.wrapping_sub(quadrant & 1);
    let (s, c) = (sin.to_bits(), cos.to_bits());
    let sin_sign = (quadrant & 2) << 62;
    let cos_sign = (quadrant.wrapping_add(1) & 2) << 62;
    let sin = ((s & !swap) | (c & swap)) ^ sin_sign;
    let cos = ((c & !swap) | (s & swap)) ^ cos_sign;
    (f64::from_bits(sin), f64::from_bits(cos))
}
