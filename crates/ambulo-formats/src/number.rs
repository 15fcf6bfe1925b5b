//! Numbers as text.

use std::fmt::Write as _;

/// Writes numbers as `{:?}` does: the shortest text that reads back as the same bits, with an exponent for very large and small.
#[derive(Default)]
pub(crate) struct NumberText {
    digits: zmij::Buffer,
    /// Of a number whose exponent the library writes in another form.
    text: String,
}

impl NumberText {
    /// The text of a number, valid until the next one.
    pub(crate) fn of(&mut self, number: f64) -> &str {
        // These have no exponent in either form.
        if number == 0.0 || (1e-4..1e16).contains(&number.abs()) {
            return self.digits.format_finite(number);
        }
        self.text.clear();
        // A `String` takes any text.
        let _ = write!(self.text, "{number:?}");
        &self.text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check(number: f64) {
        assert_eq!(NumberText::default().of(number), format!("{number:?}"));
    }

    #[test]
    fn numbers_at_the_ends_of_each_form_are_written_as_the_standard_library_does() {
        let ends = [0.0, 1e-5, 1e-4, 1.0, 0.1, 1e15, 1e16, 1e17, 5e-324, f64::MAX, f64::MIN_POSITIVE, 1.0 / 3.0, 123.0];
        for number in ends.into_iter().flat_map(|x| [x, x.next_down(), x.next_up(), 0.999 * x]) {
            check(number);
            check(-number);
        }
        [f64::NAN, f64::INFINITY, f64::NEG_INFINITY].into_iter().for_each(check);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(4000))]

        #[test]
        fn any_number_is_written_as_the_standard_library_does(bits in any::<u64>(), near_one in -1e3..1e3_f64) {
            check(f64::from_bits(bits));
            check(near_one);
        }
    }
}
