//! The fitted parameters with their plausible ranges, mapped to the unit cube.

use ambulo::ground::predict::{DeviationCalibration, ErrorsByTraits, FittedParameters};

/// A fitted number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Number {
    pub(super) name: &'static str,
    pub(super) unit: &'static str,
    /// Smallest and largest value; on a logarithmic scale if both are positive.
    pub(super) range: [f64; 2],
    field: fn(&mut FittedParameters) -> &mut f64,
}

const fn number(
    name: &'static str,
    unit: &'static str,
    range: [f64; 2],
    field: fn(&mut FittedParameters) -> &mut f64,
) -> Number {
    Number { name, unit, range, field }
}

/// All of them.
pub(super) const NUMBERS: [Number; 23] = [
    number("bandwidth_hz", "Hz", [4.0, 15.0], |w| &mut w.bandwidth_hz),
    number("force_noise forward", "BW", [0.005, 0.08], |w| &mut w.force_noise[0]),
    number("force_noise up", "BW", [0.005, 0.1], |w| &mut w.force_noise[1]),
    number("force_noise sideways", "BW", [0.005, 0.08], |w| &mut w.force_noise[2]),
    number("moment_noise about forward", "BW m", [0.002, 0.1], |w| &mut w.moment_noise[0]),
    number("moment_noise about up", "BW m", [0.002, 0.1], |w| &mut w.moment_noise[1]),
    number("moment_noise about sideways", "BW m", [0.002, 0.1], |w| &mut w.moment_noise[2]),
    number("spread forward", "1", [0.3, 2.0], |w| &mut w.spread[0]),
    number("spread up", "1", [0.3, 2.0], |w| &mut w.spread[1]),
    number("sideways_spread", "BW", [0.015, 0.1], |w| &mut w.sideways_spread),
    number("sideways_lever", "1", [0.3, 1.2], |w| &mut w.sideways_lever),
    number("strike_push", "BW", [0.0, 0.06], |w| &mut w.strike_push),
    number("detail forward", "√(L/g)", [0.2, 0.8], |w| &mut w.detail[0]),
    number("detail up", "√(L/g)", [0.2, 0.8], |w| &mut w.detail[1]),
    number("detail sideways", "√(L/g)", [0.2, 0.8], |w| &mut w.detail[2]),
    number("center_spread along", "m", [0.004, 0.05], |w| &mut w.center_spread[0]),
    number("center_spread across", "m", [0.002, 0.03], |w| &mut w.center_spread[1]),
    number("free_moment_spread", "BW m", [0.001, 0.02], |w| &mut w.free_moment_spread),
    number("center_lean half-way", "rad", [0.02, 0.25], |w| &mut w.center_lean[0]),
    number("center_lean over", "rad", [0.04, 0.4], |w| &mut w.center_lean[1]),
    number("center_ends heel", "stature", [0.0, 0.03], |w| &mut w.center_ends[0]),
    number("center_ends toe", "1", [0.2, 1.0], |w| &mut w.center_ends[1]),
    number("center_outwards", "stature", [-0.005, 0.012], |w| &mut w.center_outwards),
];

impl Number {
    pub(super) fn of(&self, parameters: &FittedParameters) -> f64 {
        *(self.field)(&mut { *parameters })
    }

    pub(super) fn set(&self, parameters: &mut FittedParameters, value: f64) {
        *(self.field)(parameters) = value;
    }

    fn at(&self, place: f64) -> f64 {
        let [least, most] = self.range;
        if least > 0.0 { least * (most / least).powf(place) } else { least + (most - least) * place }
    }
}

/// Parameters at a point of the unit cube, with the estimator's own standard deviations.
pub(super) fn parameters(place: &[f64]) -> FittedParameters {
    let mut parameters = unfitted();
    for (number, place) in NUMBERS.iter().zip(place) {
        number.set(&mut parameters, number.at(*place));
    }
    parameters
}

/// The numbers of the crate without mean errors and calibration.
pub(super) fn unfitted() -> FittedParameters {
    FittedParameters {
        errors: ErrorsByTraits::default(),
        calibration: DeviationCalibration::UNSCALED,
        ..FittedParameters::default()
    }
}

/// Numbers as text: a line of comment, then a line for each laboratory.
pub(super) fn written(fits: &[(&'static str, FittedParameters)]) -> String {
    let line = |(name, fit): &(&'static str, FittedParameters)| {
        let values: Vec<String> = NUMBERS.iter().map(|number| number.of(fit).to_string()).collect();
        format!("{name};{}\n", values.join(";"))
    };
    let names: Vec<&str> = NUMBERS.iter().map(|number| number.name).collect();
    let head = format!("# Made by `cargo xtask fit-ground`; laboratory left out, then {}\n", names.join(", "));
    head + &fits.iter().map(line).collect::<String>()
}

/// The numbers of each laboratory in such a text; lines of another form are left out.
pub(super) fn read(text: &str) -> Vec<(String, FittedParameters)> {
    let of_line = |line: &str| {
        let (name, values) = line.split_once(';')?;
        let values: Vec<f64> = values.split(';').filter_map(|value| value.parse().ok()).collect();
        let mut fit = unfitted();
        let is_whole = values.len() == NUMBERS.len();
        NUMBERS.iter().zip(values).for_each(|(number, value)| number.set(&mut fit, value));
        is_whole.then(|| (name.to_owned(), fit))
    };
    text.lines().filter_map(of_line).collect()
}

/// With three significant digits.
pub(super) fn rounded(mut parameters: FittedParameters) -> FittedParameters {
    for number in &NUMBERS {
        let value = three_digits(number.of(&parameters));
        number.set(&mut parameters, value);
    }
    parameters
}

/// A number with three significant digits.
pub(super) fn three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_reach_the_ends_of_the_ranges_and_the_shipped_numbers_lie_inside() {
        let (low, high) = (parameters(&[0.0; NUMBERS.len()]), parameters(&[1.0; NUMBERS.len()]));
        for number in &NUMBERS {
            let [least, most] = number.range;
            assert!((number.of(&low) - least).abs() < 1e-12 && (number.of(&high) - most).abs() < 1e-12, "{number:?}");
            let shipped = number.of(&FittedParameters::default());
            assert!((least..=most).contains(&shipped), "{}: {shipped}", number.name);
        }
    }

    #[test]
    fn every_number_is_another_field() {
        for (i, number) in NUMBERS.iter().enumerate() {
            let mut changed = FittedParameters::default();
            number.set(&mut changed, 0.123_4);
            for (k, other) in NUMBERS.iter().enumerate() {
                let same = (other.of(&changed) - other.of(&FittedParameters::default())).abs() < 1e-15;
                assert_eq!(same, i != k, "{} against {}", number.name, other.name);
            }
        }
    }

    #[test]
    fn numbers_are_read_as_they_were_written_and_cut_lines_are_left_out() {
        let fit = rounded(parameters(&[0.3; NUMBERS.len()]));
        let text = written(&[("here", fit)]);
        assert_eq!(read(&text), [("here".to_owned(), fit)]);
        assert!(read(&text[..text.len() - 20]).is_empty());
    }

    #[test]
    fn three_digits_are_kept() {
        for (value, expected) in [(0.012_345, 0.012_3), (-7.896, -7.9), (0.0, 0.0)] {
            assert!((three_digits(value) - expected).abs() < 1e-12);
        }
    }
}
