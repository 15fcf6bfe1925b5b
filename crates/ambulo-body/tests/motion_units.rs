//! Units of the channels.

use ambulo_body::internals::{INCH_M, KILOPOND_N, POUND_N, moment_nm};

#[test]
fn moments_are_read_however_they_are_spelled() {
    let same = |unit: &str, expected: f64| {
        let found = moment_nm(unit).unwrap_or(f64::NAN);
        assert!((found - expected).abs() < 1e-12, "{unit}: {found}");
    };
    for unit in ["Nmm", "N.mm", "N-mm", "N*mm", "ntmm", "Newton mm", "nmm"] {
        same(unit, 1e-3);
    }
    for unit in ["Nm", "N.m", "N m", "Newton-meters"] {
        same(unit, 1.0);
    }
    same("in-lb", INCH_M * POUND_N);
    same("kgf cm", KILOPOND_N * 0.01);
    for unit in ["", "N", "V", "mm", "d.u.", "nt", "\u{b5}Nm"] {
        assert_eq!(moment_nm(unit), None, "{unit}");
    }
}
