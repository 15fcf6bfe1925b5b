//! Lines and numbers of text files, in all the variants that measurement programs write.
//!
//! Lines end with LF, CRLF or a lone CR and are counted from 1. Nothing is copied unless a line is not UTF-8, and no
//! line may be longer than [`MAX_LINE_BYTES`], so that a file of another kind is rejected early.

use crate::error::{Error, quoted};
use memchr::memchr2;
use std::borrow::Cow;

/// Longest line that is read [bytes]. 300 markers with 17 digits per coordinate take 20 kB.
pub(crate) const MAX_LINE_BYTES: usize = 1 << 20;

/// One line without its end.
#[derive(Debug, Clone)]
pub(crate) struct Line<'a> {
    /// Counted from 1.
    pub(crate) number: usize,
    pub(crate) text: Cow<'a, str>,
}

impl Line<'_> {
    /// An error at this line.
    pub(crate) fn error(&self, found: impl Into<String>, expected: impl Into<String>) -> Error {
        Error::Line { line: self.number, found: found.into(), expected: expected.into() }
    }

    pub(crate) fn is_blank(&self) -> bool {
        self.text.trim().is_empty()
    }
}

/// The lines of a file, one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Lines<'a> {
    rest: &'a [u8],
    number: usize,
    last_is_ended: bool,
}

impl<'a> Lines<'a> {
    /// Refuses an empty file. `expected` states what a valid file begins with.
    pub(crate) fn new(bytes: &'a [u8], expected: &'static str) -> Result<Self, Error> {
        let rest = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        if rest.iter().all(u8::is_ascii_whitespace) {
            return Err(Error::Empty { expected });
        }
        Ok(Lines { rest, number: 0, last_is_ended: matches!(rest.last(), Some(b'\n' | b'\r')) })
    }

    /// The next line, `None` after the last one.
    pub(crate) fn next_line(&mut self) -> Result<Option<Line<'a>>, Error> {
        if self.rest.is_empty() {
            return Ok(None);
        }
        self.number += 1;
        let end = memchr2(b'\n', b'\r', &self.rest[..self.rest.len().min(MAX_LINE_BYTES + 1)]);
        let length = end.unwrap_or(self.rest.len());
        if length > MAX_LINE_BYTES {
            let found = format!("a line of more than {MAX_LINE_BYTES} bytes");
            return Err(Error::Line { line: self.number, found, expected: "a text file with shorter lines".into() });
        }
        let (line, rest) = self.rest.split_at(length);
        self.rest = rest.strip_prefix(b"\r\n").or_else(|| rest.get(1..)).unwrap_or_default();
        Ok(Some(Line { number: self.number, text: decode(line) }))
    }

    /// The next line that is not blank.
    pub(crate) fn next_filled(&mut self) -> Result<Option<Line<'a>>, Error> {
        while let Some(line) = self.next_line()? {
            if !line.is_blank() {
                return Ok(Some(line));
            }
        }
        Ok(None)
    }

    /// Whether only white space is left.
    pub(crate) fn is_at_end(&self) -> bool {
        self.rest.iter().all(u8::is_ascii_whitespace)
    }

    /// Whether the last line has a line end, as most programs write it; a truncated file has none.
    pub(crate) fn last_is_ended(&self) -> bool {
        self.last_is_ended
    }

    /// The error for a file that ends before `expected`.
    pub(crate) fn truncated(&self, expected: impl Into<String>) -> Error {
        Error::Truncated { line: self.number, expected: expected.into() }
    }
}

/// UTF-8; anything else is read as Latin-1, as old programs wrote it.
fn decode(bytes: &[u8]) -> Cow<'_, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    }
}

/// Words for a missing value in lower case: of R, Python, Excel and databases.
const MISSING: [&str; 15] =
    ["na", "n/a", "n.a.", "#n/a", "#na", "null", "none", "nil", "missing", "--", "---", "*", "?", "#value!", "#div/0!"];

/// A number as C, C++, Rust or Microsoft's C write it, including not-a-number and infinity; a word for a missing value
/// is not-a-number.
pub(crate) fn number(word: &str) -> Option<f64> {
    match word.parse::<f64>() {
        Ok(value) if value.is_nan() => Some(f64::NAN),
        Ok(value) => Some(value),
        Err(_) => special(word),
    }
}

/// `-nan(ind)`, `nan(snan)`, `1.#QNAN`, `-1.#IND00`, `1.#INF`: special values as Microsoft's printf writes them.
fn special(word: &str) -> Option<f64> {
    let (sign, size) = match word.strip_prefix('-') {
        Some(size) => (-1.0, size),
        None => (1.0, word.strip_prefix('+').unwrap_or(word)),
    };
    if MISSING.contains(&&*word.to_ascii_lowercase()) {
        return Some(f64::NAN);
    }
    let size = size.to_ascii_lowercase();
    if let Some(tail) = size.strip_prefix("1.#") {
        return match tail.trim_end_matches('0') {
            "inf" => Some(sign * f64::INFINITY),
            "qnan" | "snan" | "ind" | "nan" => Some(f64::NAN),
            _ => None,
        };
    }
    (size.starts_with("nan(") && size.ends_with(')')).then_some(f64::NAN)
}

/// Expected content in place of a word that is not a number.
pub(crate) fn expected_number(word: &str) -> String {
    let with_point = word.replacen(',', ".", 1);
    if word.contains(',') && with_point.parse::<f64>().is_ok() {
        return "a number with a decimal point; the file appears to use a decimal comma; export it with a decimal \
            point"
            .into();
    }
    "a number".into()
}

/// Words above the column of times, without regard to case.
pub(crate) const TIME_WORDS: [&str; 10] =
    ["time", "times", "time(s)", "time (s)", "time[s]", "time [s]", "time_s", "time (sec)", "t", "seconds"];

/// Whether a name belongs to the column of times.
pub(crate) fn is_time(name: &str) -> bool {
    TIME_WORDS.iter().any(|word| name.eq_ignore_ascii_case(word))
}

/// A count in a message: "1 row", "3 rows".
pub(crate) fn counted(count: usize, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

/// The first name that occurs twice.
pub(crate) fn duplicate<'n>(names: impl IntoIterator<Item = &'n str>) -> Option<&'n str> {
    let mut seen = std::collections::BTreeSet::new();
    names.into_iter().find(|&name| !seen.insert(name))
}

/// Rejects a name that cannot be written in a table's header.
pub(crate) fn check_name(name: &str) -> Result<(), Error> {
    let expected = "a name that is not empty, without control characters and without spaces at its ends";
    if name.is_empty() || name.trim() != name || name.chars().any(char::is_control) {
        return Err(Error::Record { found: format!("the name {}", quoted(name)), expected: expected.into() });
    }
    Ok(())
}
