//! Numbers of the page's tables.

use super::super::timing::Timing;

/// Three digits and the unit that suits: 12.4 us, 1.93 ms, 2.31 s.
pub(super) fn time(us: f64) -> String {
    let (value, unit) = scaled(us);
    format!("{} {unit}", digits(us * value))
}

/// `12.3 .. 12.6 us`: tenth and ninetieth percentile.
pub(super) fn spread(timing: &Timing) -> String {
    timing.spread.map_or_else(String::new, |[p10, p90, _]| range(p10, p90))
}

/// Two times in the unit that suits the larger.
pub(super) fn range(p10: f64, p90: f64) -> String {
    let (value, unit) = scaled(p90);
    format!("{} .. {} {unit}", digits(p10 * value), digits(p90 * value))
}

fn scaled(us: f64) -> (f64, &'static str) {
    match us {
        us if us < 999.5 => (1.0, "us"),
        us if us < 999_500.0 => (1e-3, "ms"),
        _ => (1e-6, "s"),
    }
}

/// Three digits, without an exponent where it can be avoided.
fn digits(value: f64) -> String {
    match value.abs() {
        size if size >= 99.95 => format!("{value:.0}"),
        size if size >= 9.995 => format!("{value:.1}"),
        _ => format!("{value:.2}"),
    }
}

/// Two digits, for errors: 1.1e-14.
pub(super) fn small(value: f64) -> String {
    if value == 0.0 { "0".to_owned() } else { format!("{value:.1e}") }
}

/// The same for what may not have been a number.
pub(super) fn small_or_none(value: Option<f64>) -> String {
    value.map_or_else(|| "not finite".to_owned(), small)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_have_the_unit_that_suits() {
        let texts = [12.414, 999.4, 1933.0, 2.3e6, 0.5].map(time);
        assert_eq!(texts, ["12.4 us", "999 us", "1.93 ms", "2.30 s", "0.50 us"]);
        assert_eq!(range(12.31, 12.58), "12.3 .. 12.6 us");
    }
}
