//! Units of the channels.

use crate::spatial::STANDARD_GRAVITY;

/// Newtons in a pound-force, exact by definition.
pub const POUND_N: f64 = 4.448_221_615_260_5;
/// Newtons in a kilogram-force, exact by definition.
pub const KILOPOND_N: f64 = STANDARD_GRAVITY;
/// Metres in an inch, exact by definition.
pub const INCH_M: f64 = 0.0254;
/// Metres in a foot, exact by definition.
const FOOT_M: f64 = 0.3048;

/// Newtons of one unit; `None` if it is not a force (volts, bits).
pub(super) fn force_n(unit: &str) -> Option<f64> {
    match plain(unit).as_str() {
        "n" | "nt" | "newton" | "newtons" => Some(1.0),
        "kn" => Some(1000.0),
        "lb" | "lbs" | "lbf" => Some(POUND_N),
        "kg" | "kgf" | "kp" => Some(KILOPOND_N),
        _ => None,
    }
}

/// Metres of one unit; `None` for other words. C3D files often cut `meters` short.
pub(super) fn length_m(unit: &str) -> Option<f64> {
    match plain(unit).as_str() {
        "m" | "mete" | "meter" | "meters" | "metre" | "metres" => Some(1.0),
        "dm" => Some(0.1),
        "cm" => Some(0.01),
        "mm" | "mill" | "millimeter" | "millimeters" => Some(0.001),
        "in" | "inch" | "inches" => Some(INCH_M),
        "ft" | "feet" => Some(FOOT_M),
        _ => None,
    }
}

/// Newton metres of one unit (`Nmm`, `ntmm`, `N.m`, `N-m`, `in-lb`); `None` for other words.
pub fn moment_nm(unit: &str) -> Option<f64> {
    let unit = plain(unit);
    let split = |at: usize| unit.is_char_boundary(at).then(|| unit.split_at(at));
    (1..unit.len()).rev().filter_map(split).find_map(|(left, right)| {
        let force_first = force_n(left).zip(length_m(right));
        let length_first = || length_m(left).zip(force_n(right));
        force_first.or_else(length_first).map(|(a, b)| a * b)
    })
}

/// Letters only, in lower case.
fn plain(unit: &str) -> String {
    unit.chars().filter(|c| c.is_alphabetic()).flat_map(char::to_lowercase).collect()
}
