//! Numbers in messages.

use ambulo_body::numerics::Shown;

#[test]
fn only_very_large_and_very_small_numbers_have_an_exponent() {
    let numbers = [0.0, -1.5, 80.0, 1e-308, -1e308, f64::NAN, f64::NEG_INFINITY];
    let shown = numbers.map(|number| Shown(number).to_string());
    assert_eq!(shown, ["0", "-1.5", "80", "1e-308", "-1e308", "NaN", "-inf"]);
}
