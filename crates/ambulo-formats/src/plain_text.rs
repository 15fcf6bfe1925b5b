//! Text as the readers of tables expect it: UTF-8, tabs between cells, a point in numbers.
//!
//! Spreadsheets save a table of another program with their own separators. What they write is unambiguous if the
//! separator follows the first word of the format, and if a comma in numbers can only be a decimal comma. The
//! lines of the text keep their numbers.

use crate::error::Remark;
use memchr::memchr2;
use std::borrow::Cow;

/// Number of bytes of a table that are searched for its separators.
const HEAD_BYTES: usize = 1 << 18;

/// The text of a table, and what was unusual in it.
pub(crate) struct PlainText<'a> {
    pub(crate) bytes: Cow<'a, [u8]>,
    pub(crate) remarks: Vec<Remark>,
}

/// UTF-16 as UTF-8, with or without a byte-order mark; anything else as it is.
pub(crate) fn utf8(bytes: &[u8]) -> Cow<'_, [u8]> {
    let decoded = |bytes: &[u8], unit: fn([u8; 2]) -> u16| {
        let units: Vec<u16> = bytes.as_chunks().0.iter().map(|pair| unit(*pair)).collect();
        Cow::Owned(String::from_utf16_lossy(&units).into_bytes())
    };
    match bytes {
        [0xff, 0xfe, rest @ ..] => decoded(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => decoded(rest, u16::from_be_bytes),
        [first, 0, second, 0, ..] if is_letter(*first) && is_letter(*second) => decoded(bytes, u16::from_le_bytes),
        [0, first, 0, second, ..] if is_letter(*first) && is_letter(*second) => decoded(bytes, u16::from_be_bytes),
        _ => Cow::Borrowed(bytes),
    }
}

/// Bytes as UTF-8 text, with a byte-order mark removed; anything else is read as Latin-1, as old programs wrote it.
pub(crate) fn decode(bytes: &[u8]) -> String {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}

fn is_letter(byte: u8) -> bool {
    byte.is_ascii_graphic() || byte.is_ascii_whitespace()
}

impl<'a> PlainText<'a> {
    /// Text in UTF-8, otherwise as it is.
    pub(crate) fn of(bytes: &'a [u8]) -> PlainText<'a> {
        let bytes = utf8(bytes);
        let remark = || Remark::of_file("the text is UTF-16; it was read as such");
        let remarks = if matches!(bytes, Cow::Owned(_)) { vec![remark()] } else { Vec::new() };
        PlainText { bytes, remarks }
    }

    /// Text with tabs between its cells. `layout` finds in the first lines the separator of cells, and the line
    /// behind which there are only numbers.
    pub(crate) fn with_tabs(mut self, layout: impl Fn(&[&str]) -> Option<Layout>) -> PlainText<'a> {
        let head = decode(&self.bytes[..self.bytes.len().min(HEAD_BYTES)]);
        let head: Vec<&str> = lines(&head).collect();
        let Some(Layout { separator, last_header_line }) = layout(&head) else { return self };
        let numbers = head.iter().skip(last_header_line + 1).copied();
        let has_commas = separator != ',' && has_decimal_commas(numbers, separator);
        let is_quoted = head[last_header_line].trim_start().starts_with('"');
        if (separator == '\t' || separator == ' ') && !has_commas && !is_quoted {
            return self;
        }
        let text = decode(&self.bytes);
        let mut rows: Vec<String> = lines(&text).map(|line| in_tabs(line, separator, has_commas)).collect();
        // A last line without an end may be cut.
        if text.ends_with(['\n', '\r']) {
            rows.push(String::new());
        }
        self.remarks.extend(remark(separator, has_commas));
        self.bytes = Cow::Owned(rows.join("\n").into_bytes());
        self
    }
}

/// Layout of a table, from its first lines.
pub(crate) struct Layout {
    /// Separator of cells.
    pub(crate) separator: char,
    /// Number of the last line of the header, counted from 0.
    pub(crate) last_header_line: usize,
}

/// The separator after the first cell of a line, which `is_first` recognises.
pub(crate) fn separator_behind(line: &str, is_first: impl Fn(&str) -> bool) -> Option<char> {
    let line = line.trim_start_matches('\u{feff}');
    let place = line.find([',', ';', '\t'])?;
    let first = line[..place].trim_matches(|c: char| c == '"' || c.is_whitespace());
    line[place..].chars().next().filter(|_| is_first(first))
}

fn remark(separator: char, has_commas: bool) -> Option<Remark> {
    let name = match separator {
        ',' => "the separator of the cells is a comma",
        ';' => "the separator of the cells is a semicolon",
        _ => "",
    };
    let message = match (name, has_commas) {
        ("", false) => return None,
        ("", true) => "numbers have a decimal comma; they were read with it".to_owned(),
        (name, false) => format!("{name} in place of a tab; the file was read with it"),
        (name, true) => format!("{name} in place of a tab, and numbers have a decimal comma; both were read"),
    };
    Some(Remark::of_file(message))
}

/// The lines of a text that end with LF, CRLF or a lone CR.
fn lines(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = Some(text).filter(|text| !text.is_empty());
    std::iter::from_fn(move || {
        let text = rest?;
        let end = memchr2(b'\n', b'\r', text.as_bytes()).unwrap_or(text.len());
        let (line, after) = text.split_at(end);
        let after = after.strip_prefix("\r\n").or_else(|| after.get(1..)).unwrap_or_default();
        rest = Some(after).filter(|after| !after.is_empty());
        Some(line)
    })
}

/// The cells of a line; a separator inside quotes is part of a cell.
pub(crate) fn cells(line: &str, separator: char) -> impl Iterator<Item = &str> {
    let mut is_quoted = false;
    line.split(move |c: char| {
        is_quoted ^= c == '"';
        c == separator && !is_quoted
    })
    .map(|cell| cell.trim_matches(|c: char| c == '"' || c.is_whitespace()))
}

fn in_tabs(line: &str, separator: char, has_commas: bool) -> String {
    let cell = |cell| if has_commas && is_with_comma(cell) { cell.replacen(',', ".", 1) } else { cell.to_owned() };
    let cells: Vec<String> = cells(line, separator).map(cell).collect();
    cells.join(if separator == ' ' { " " } else { "\t" })
}

/// Whether the only comma of a word is between the digits of a number.
fn is_with_comma(word: &str) -> bool {
    word.matches(',').count() == 1 && !word.contains('.') && word.replacen(',', ".", 1).parse::<f64>().is_ok()
}

/// Whether commas in the numbers of these lines are decimal commas: no number has a point, and the commas cannot all
/// divide thousands, which have three digits behind each and no zero in front.
pub(crate) fn has_decimal_commas<'l>(lines: impl Iterator<Item = &'l str>, separator: char) -> bool {
    let (mut with_comma, mut is_decimal) = (false, false);
    for cell in lines.flat_map(|line| cells(line, separator)) {
        if is_with_comma(cell) {
            with_comma = true;
            is_decimal |= !may_be_thousands(cell);
        } else if cell.contains('.') && cell.parse::<f64>().is_ok() {
            return false;
        }
    }
    with_comma && is_decimal
}

fn may_be_thousands(word: &str) -> bool {
    let Some((whole, rest)) = word.trim_start_matches(['-', '+']).split_once(',') else { return false };
    (1..=3).contains(&whole.len()) && !whole.starts_with('0') && rest.len() == 3
}
