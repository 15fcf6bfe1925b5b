//! Comma-separated values: a header row, then numbers.

use super::Table;
use super::content::Content;
use super::lines::{Lines, counted, duplicate, expected_number, number};
use crate::error::{Error, Remark, quoted};
use ::csv::{ByteRecord, QuoteStyle, ReaderBuilder, Trim, WriterBuilder};
use std::borrow::Cow;
use std::io::{self, Write};

/// Reads a CSV file whose cells are separated by commas, semicolons or tabs, whichever the header row has most of.
pub(super) fn read(bytes: &[u8]) -> Result<(Table, Vec<Remark>), Error> {
    let mut lines = Lines::new(bytes, "a header row of column names, then rows of numbers")?;
    let header = lines.next_filled()?.map(|line| line.text.into_owned()).unwrap_or_default();
    let bytes = with_line_feeds(bytes);
    let mut reader = ReaderBuilder::new()
        .delimiter(delimiter(&header)?)
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(&*bytes);
    let mut record = ByteRecord::new();
    next_record(&mut reader, &mut record)?;
    let names = read_names(&record, line_of(&record, &bytes))?;
    let data = vec![vec![]; names.len()];
    let mut table = Table { name: String::new(), in_degrees: None, names, data, lines: vec![] };
    let mut gaps = 0;
    while next_record(&mut reader, &mut record)? {
        gaps += read_row(&record, line_of(&record, &bytes), &mut table)?;
    }
    if table.rows() == 0 {
        return Err(lines.truncated("rows of numbers below the column names"));
    }
    Ok((table, gap_remark(gaps).into_iter().collect()))
}

fn gap_remark(gaps: usize) -> Option<Remark> {
    let message = match gaps {
        0 => return None,
        1 => "1 cell is empty; it was read as not-a-number".into(),
        _ => format!("{gaps} cells are empty; they were read as not-a-number"),
    };
    Some(Remark { line: None, message })
}

/// The csv crate counts lines by line feeds, which old Macintosh files do not have.
fn with_line_feeds(bytes: &[u8]) -> Cow<'_, [u8]> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    if bytes.contains(&b'\n') || !bytes.contains(&b'\r') {
        return Cow::Borrowed(bytes);
    }
    Cow::Owned(bytes.iter().map(|&b| if b == b'\r' { b'\n' } else { b }).collect())
}

/// The most frequent separator in the header row, outside quotes.
fn delimiter(header: &str) -> Result<u8, Error> {
    let mut counts = [(b',', 0), (b';', 0), (b'\t', 0)];
    let mut in_quotes = false;
    for byte in header.bytes() {
        in_quotes ^= byte == b'"';
        for (separator, count) in &mut counts {
            *count += usize::from(!in_quotes && byte == *separator);
        }
    }
    if in_quotes {
        let expected = "column names whose quotes are closed on the same line".into();
        return Err(Error::Line { line: 1, found: "an open quote".into(), expected });
    }
    // `rev`, because the last of equals is chosen: a comma before a semicolon before a tab.
    Ok(counts.into_iter().rev().max_by_key(|&(_, count)| count).map_or(b',', |(separator, _)| separator))
}

fn next_record(reader: &mut ::csv::Reader<&[u8]>, record: &mut ByteRecord) -> Result<bool, Error> {
    loop {
        let line = reader.position().line();
        let found = reader.read_byte_record(record).map_err(|error| Error::Line {
            line: usize::try_from(line).unwrap_or(usize::MAX),
            found: error.to_string(),
            expected: "a row of cells".into(),
        })?;
        if !found || record.iter().any(|cell| !cell.is_empty()) {
            return Ok(found);
        }
    }
}

/// Line of the record in the file, counted from 1. The csv crate gives the place where its search for the
/// record began; blank lines may lie between.
fn line_of(record: &ByteRecord, bytes: &[u8]) -> usize {
    let Some(start) = record.position() else { return 1 };
    let whole = |value: u64| usize::try_from(value).unwrap_or(usize::MAX);
    let ahead = bytes.get(whole(start.byte())..).unwrap_or_default();
    let ends = ahead.iter().take_while(|byte| matches!(byte, b'\n' | b'\r'));
    whole(start.line()) + ends.filter(|&&byte| byte == b'\n').count()
}

fn read_names(record: &ByteRecord, line: usize) -> Result<Vec<String>, Error> {
    let names: Vec<String> =
        record.iter().map(|cell| unguarded(&one_line(&crate::xml::decode(cell))).to_owned()).collect();
    let fail = |found, expected: &str| Err(Error::Line { line, found, expected: expected.into() });
    if let Some(empty) = names.iter().position(String::is_empty) {
        return fail(format!("no name for column {}", empty + 1), "a name for every column");
    }
    if names.iter().all(|name| number(name).is_some()) {
        return fail(quoted(&names.join(",")), "a header row of column names");
    }
    if let Some(twice) = duplicate(names.iter().map(String::as_str)) {
        return fail(format!("two columns {}", quoted(twice)), "column names that differ");
    }
    Ok(names)
}

/// The name without blanks and byte order marks at its ends, a blank for each control character: a tab would be taken
/// for a separator.
fn one_line(name: &str) -> String {
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    name.trim_matches(|c: char| c.is_whitespace() || c == '\u{feff}').to_owned()
}

/// Appends a row; returns the number of its empty cells.
fn read_row(record: &ByteRecord, line: usize, table: &mut Table) -> Result<usize, Error> {
    if record.len() != table.data.len() {
        let hint = if record.len() > table.data.len() { " (a decimal comma splits a number in two)" } else { "" };
        let expected = format!("{}, one a column{hint}", table.data.len());
        return Err(Error::Line { line, found: counted(record.len(), "cell"), expected });
    }
    let mut gaps = 0;
    for (column, cell) in table.data.iter_mut().zip(record) {
        let word = std::str::from_utf8(cell).unwrap_or("\u{fffd}");
        gaps += usize::from(word.is_empty());
        let value = if word.is_empty() { Some(f64::NAN) } else { number(word) };
        column.push(value.ok_or_else(|| Error::Line { line, found: quoted(word), expected: expected_number(word) })?);
    }
    table.lines.push(line);
    Ok(gaps)
}

/// Spreadsheets take a cell that begins with one of these for a formula.
const FORMULA: [char; 4] = ['=', '+', '-', '@'];

fn is_formula(name: &str) -> bool {
    name.trim_start_matches('\'').starts_with(FORMULA) && number(name).is_none()
}

/// A name as a cell of a CSV file: with an apostrophe in front if a spreadsheet would take it for a formula.
pub fn guarded(name: &str) -> Cow<'_, str> {
    if is_formula(name) { Cow::Owned(format!("'{name}")) } else { Cow::Borrowed(name) }
}

/// The name in a cell of a CSV file, without the apostrophe of [`guarded`].
pub fn unguarded(cell: &str) -> &str {
    cell.strip_prefix('\'').filter(|name| is_formula(name)).unwrap_or(cell)
}

/// Writes names and numbers, separated by commas.
pub(super) fn write(table: &Content<'_>, out: &mut dyn Write) -> io::Result<()> {
    // A semicolon in a name could be taken for the separator; quotes prevent that.
    let quote = table.names.iter().any(|name| name.contains(';'));
    let style = if quote { QuoteStyle::NonNumeric } else { QuoteStyle::Necessary };
    let mut writer = WriterBuilder::new().quote_style(style).from_writer(&mut *out);
    writer.write_record(table.names.iter().map(|name| guarded(name).into_owned()))?;
    writer.flush()?;
    drop(writer);
    table.write_numbers(',', out)
}
