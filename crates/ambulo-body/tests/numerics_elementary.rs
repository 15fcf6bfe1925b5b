//! Elementary functions with the same bits on every platform.

use ambulo_body::numerics::elementary::{
    acos, asin, atan, atan2, cbrt, cos, exp, hypot, ln, ln_1p, log10, powf, powi, sin, sin_cos, tan, tanh,
};
use std::f64::consts::PI;

type Function = fn(f64) -> f64;
type Function2 = fn(f64, f64) -> f64;

/// Distance of two numbers in units in the last place of the second.
fn ulps(found: f64, expected: f64) -> f64 {
    let ulp = f64::from_bits(expected.abs().to_bits() + 1) - expected.abs();
    (found - expected).abs() / ulp
}

/// Computed with 60 digits by mpmath 1.3.0, rounded to the nearest number.
const REFERENCE: [(Function, [(f64, f64); 4]); 12] = [
    (
        sin,
        [
            (8.2478, 0.9234506223158732),
            (-6.4734, -0.18906971988123894),
            (-8.5749, -0.7511998557105217),
            (8.9754, 0.4344053365733748),
        ],
    ),
    (
        cos,
        [
            (-5.6834, 0.8254568205727852),
            (-6.8293, 0.8545488827118327),
            (2.7256, -0.9147156417685965),
            (-2.7784, -0.9347673661817452),
        ],
    ),
    (
        tan,
        [
            (1.1687, 2.3514668441043782),
            (-0.8048, -1.0395764959815283),
            (1.3785, 5.136049991704471),
            (-0.5416, -0.601606618345836),
        ],
    ),
    (
        asin,
        [
            (0.2023, 0.20370591329290702),
            (0.8642, 1.0435582059439104),
            (0.3705, 0.37954727315005615),
            (0.8477, 1.0116344257526622),
        ],
    ),
    (
        acos,
        [
            (0.4162, 1.1415341862911923),
            (-0.9031, 2.6977307888899995),
            (0.7627, 0.703318721764705),
            (0.1791, 1.3907247432359995),
        ],
    ),
    (
        atan,
        [
            (-2.2718, -1.1561389986379735),
            (-3.7184, -1.3080793771713703),
            (4.1977, 1.3369296913895607),
            (0.9939, 0.7823388419825772),
        ],
    ),
    (
        exp,
        [
            (3.4497, 31.49094360843122),
            (-0.6512, 0.521419697551558),
            (4.0298, 56.249660190021615),
            (-5.8422, 0.002902450206275562),
        ],
    ),
    (
        ln,
        [
            (62.8577, 4.140873441454075),
            (55.1131, 4.009387437447204),
            (23.2644, 3.146924295151025),
            (86.105, 4.455567481756863),
        ],
    ),
    (
        ln_1p,
        [
            (0.9436, 0.6645419235496108),
            (3.7085, 1.549369385967981),
            (4.7323, 1.7461168463493189),
            (2.9402, 1.371231483442845),
        ],
    ),
    (
        log10,
        [
            (12.8087, 1.1075050539073519),
            (74.2721, 1.8708257035105682),
            (60.0784, 1.7787183580769406),
            (16.6607, 1.221693244354732),
        ],
    ),
    (
        tanh,
        [
            (-2.7052, -0.9911000775096739),
            (0.1909, 0.1886143351706699),
            (-2.8064, -0.9927248947889397),
            (2.5505, 0.9878924372292784),
        ],
    ),
    (
        cbrt,
        [
            (0.3768, 0.7222767436376807),
            (1.0387, 1.012737078050604),
            (-5.4335, -1.758031114374182),
            (9.66, 2.129735689833288),
        ],
    ),
];

/// Arguments and value.
type Point = ([f64; 2], f64);

const REFERENCE2: [(Function2, [Point; 4]); 3] = [
    (
        atan2,
        [
            ([4.1646, -1.9269], 2.004149290299704),
            ([-1.2622, 0.8259], -0.9913805966284003),
            ([-2.0268, 0.9563], -1.1299396370736776),
            ([0.4312, -0.6653], 2.566534084451229),
        ],
    ),
    (
        hypot,
        [
            ([1.7324, 0.2824], 1.7552662248217505),
            ([-4.1189, 4.9648], 6.45093607548548),
            ([-1.443, -0.6824], 1.5962201477239912),
            ([-0.972, 4.295], 4.403613175563903),
        ],
    ),
    (
        powf,
        [
            ([4.5216, 0.1199], 1.1983109493045148),
            ([0.9934, -4.0343], 1.0270746703863867),
            ([3.955, -3.286], 0.010908791495644955),
            ([0.4663, -1.5086], 3.1611954941853786),
        ],
    ),
];

/// Each function with a sweep of its usual range: first value and step.
const SWEEPS: [(Function, Function, [f64; 2]); 12] = [
    (sin, f64::sin, [-40.0, 0.008_17]),
    (cos, f64::cos, [-40.0, 0.008_17]),
    (tan, f64::tan, [-1.5, 0.000_299]),
    (asin, f64::asin, [-1.0, 0.000_199]),
    (acos, f64::acos, [-1.0, 0.000_199]),
    (atan, f64::atan, [-9.0, 0.001_83]),
    (exp, f64::exp, [-60.0, 0.0079]),
    (ln, f64::ln, [0.003, 0.0137]),
    (ln_1p, f64::ln_1p, [-0.9, 0.000_81]),
    (log10, f64::log10, [0.003, 0.0137]),
    (tanh, f64::tanh, [-6.0, 0.0012]),
    (cbrt, f64::cbrt, [-30.0, 0.0061]),
];
const SWEEPS2: [(Function2, Function2); 3] = [(atan2, f64::atan2), (hypot, f64::hypot), (powf, f64::powf)];

fn points() -> impl Iterator<Item = (f64, f64)> {
    (0..10_000).map(|i| (0.003 + 0.0007 * f64::from(i), f64::from(i % 71) * 0.1 - 3.5))
}

#[test]
fn values_agree_with_those_of_sixty_digits() {
    for (function, values) in REFERENCE {
        for (x, expected) in values {
            assert!(ulps(function(x), expected) <= 1.0, "{x}: {} instead of {expected}", function(x));
            assert!(ulps(function(x * 1.000_001), expected) > 1.0, "{x}: another number has the same value");
        }
    }
    for (function, values) in REFERENCE2 {
        for ([x, y], expected) in values {
            assert!(ulps(function(x, y), expected) <= 1.0, "{x}, {y}: {} instead of {expected}", function(x, y));
        }
    }
}

#[test]
fn values_agree_with_the_library_of_the_platform() {
    // Both are wrong by less than one unit in the last place; near a zero, the sine's unit is that of the angle.
    for (k, (own, platform, [first, step])) in SWEEPS.into_iter().enumerate() {
        for x in (0..10_000).map(|i| first + step * f64::from(i)) {
            assert!(ulps(own(x), platform(x)) <= 2.0, "function {k} of {x}: {} and {}", own(x), platform(x));
        }
    }
    for (k, (own, platform)) in SWEEPS2.into_iter().enumerate() {
        for (x, y) in points() {
            assert!(ulps(own(x, y), platform(x, y)) <= 2.0, "function {k} of {x}, {y}");
        }
    }
}

/// Another platform, compiler or version of `libm` that changes one bit of one value changes this number (FNV-1a of all
/// bits).
#[test]
fn the_bits_of_all_functions_are_the_same_on_every_platform() {
    let mut checksum = 0xcbf2_9ce4_8422_2325_u64;
    let mut add = |value: f64| {
        for byte in value.to_bits().to_le_bytes() {
            checksum = (checksum ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    };
    for (own, _, [first, step]) in SWEEPS {
        (0..10_000).for_each(|i| add(own(first + step * f64::from(i))));
    }
    for (own, _) in SWEEPS2 {
        points().for_each(|(x, y)| add(own(x, y)));
    }
    for (x, y) in points() {
        add(powi(x, (4.0 * y) as i32));
        add(sin_cos(1e7 * y).1);
    }
    assert_eq!(format!("{checksum:016x}"), "e0021dac16bb36ea");
}

/// Compares bits, so that -0 is not 0.
fn exactly<const N: usize>(found: [f64; N], expected: [f64; N]) {
    assert_eq!(found.map(f64::to_bits), expected.map(f64::to_bits), "{found:?} instead of {expected:?}");
}

#[test]
fn special_values_are_those_of_the_standard() {
    assert!(sin_cos(f64::NAN).0.is_nan() && cos(f64::INFINITY).is_nan());
    assert!(asin(1.1).is_nan() && acos(-1.1).is_nan() && ln(-1.0).is_nan());
    exactly([sin(-0.0), exp(-800.0), exp(800.0)], [-0.0, 0.0, f64::INFINITY]);
    exactly([ln(0.0), tanh(40.0), hypot(0.0, 0.0)], [f64::NEG_INFINITY, 1.0, 0.0]);
    exactly([atan2(0.0, -1.0), atan2(-0.0, -1.0)], [PI, -PI]);
    exactly([powf(0.0, 0.0), powf(2.0, -2.0), powf(0.0, -1.0)], [1.0, 0.25, f64::INFINITY]);
}

#[test]
fn a_hypotenuse_neither_overflows_nor_vanishes() {
    for scale in [powi(2.0, 700), 1.0, powi(2.0, -700)] {
        exactly([hypot(3.0 * scale, -4.0 * scale)], [5.0 * scale]);
    }
    assert!(hypot(f64::NAN, 1.0).is_nan() && hypot(f64::INFINITY, f64::NAN).is_infinite());
}

#[test]
fn integer_powers_are_products() {
    exactly([powi(3.0, 0), powi(3.0, 1), powi(3.0, 5)], [1.0, 3.0, 243.0]);
    exactly([powi(-2.0, 3), powi(2.0, -3)], [-8.0, 0.125]);
    exactly([powi(2.0, i32::MIN), powi(0.5, i32::MAX), powi(0.0, -1)], [0.0, 0.0, f64::INFINITY]);
    for n in -9..10 {
        let x = 1.1_f64;
        assert!(ulps(powi(x, n), x.powf(f64::from(n))) <= 8.0, "{n}");
    }
}
