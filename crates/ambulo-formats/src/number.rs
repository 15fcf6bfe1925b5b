//! Numbers as text.

use std::fmt::Write as _;

/// Writes numbers in the forms of the standard library: the shortest text that reads back as the same bits.
///
/// Of two shortest texts that are equally near, the one with an even last digit is written, as Python does; the
/// standard library writes the larger. So `1248465378177203.25` becomes `1248465378177203.2`.
///
/// ```
/// use ambulo_formats::number::NumberText;
///
/// let mut text = NumberText::default();
/// assert_eq!(text.of(3.0), "3.0");
/// assert_eq!(text.of(1e300), "1e300");
/// assert_eq!(text.plain(3.0), "3");
/// ```
#[derive(Default)]
pub struct NumberText {
    digits: zmij::Buffer,
    /// Text of a number whose exponent the library writes in another form.
    text: String,
}

impl NumberText {
    /// The text of a number in the form of `{:?}`, with a decimal point, and with an exponent for very large and small
    /// ones. Valid until the next one.
    pub fn of(&mut self, number: f64) -> &str {
        if has_no_exponent(number) {
            return self.digits.format_finite(number);
        }
        self.text.clear();
        // A `String` takes any text.
        let _ = write!(self.text, "{number:?}");
        &self.text
    }

    /// The text of a number in the form of `{}`: a whole number has no point, and no number has an exponent. Valid
    /// until the next one.
    pub fn plain(&mut self, number: f64) -> &str {
        if has_no_exponent(number) {
            let text = self.digits.format_finite(number);
            return text.strip_suffix(".0").unwrap_or(text);
        }
        self.text.clear();
        // As above.
        let _ = write!(self.text, "{number}");
        &self.text
    }
}

/// Whether a number has no exponent in any of the forms.
fn has_no_exponent(number: f64) -> bool {
    number == 0.0 || (1e-4..1e16).contains(&number.abs())
}
