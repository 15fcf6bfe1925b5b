//! Comma-separated values: a header row, then numbers.

use super::Table;
use super::content::Content;
use super::lines::{Line, Lines, counted, duplicate, expected_number, is_time, number};
use super::units::Units;
use crate::content;
use crate::error::{Error, Remark, quoted};
use crate::plain_text::decode;
use crate::plain_text::{PlainText, has_decimal_commas};
use ::csv::{ByteRecord, QuoteStyle, ReaderBuilder, Trim, WriterBuilder};
use std::borrow::Cow;
use std::io::{self, Write};

/// Reads a CSV file whose cells are separated by commas, semicolons or tabs, whichever the header row has most of.
pub(super) fn read(bytes: &[u8]) -> Result<(Table, Vec<Remark>), Error> {
    let text = PlainText::of(bytes);
    read_text(&text.bytes, text.remarks).map_err(|error| error.or_other_content(bytes, content::CSV))
}

fn read_text(bytes: &[u8], mut remarks: Vec<Remark>) -> Result<(Table, Vec<Remark>), Error> {
    let mut lines = Lines::new(bytes, "a header row of column names, then rows of numbers")?;
    let bytes = with_line_feeds(bytes);
    let (header, above) = header_row(&mut lines)?;
    let separator = delimiter(&header)?;
    let body = decode(&bytes[..bytes.len().min(HEAD_BYTES)]);
    let has_commas = separator != b',' && has_decimal_commas(body.lines().skip(above + 1), char::from(separator));
    if has_commas {
        remarks.push(Remark::of_file("numbers have a decimal comma; they were read with it"));
    }
    let mut reader = ReaderBuilder::new()
        .delimiter(separator)
        .has_headers(false)
        .flexible(true)
        .trim(Trim::All)
        .from_reader(&*bytes);
    let mut record = ByteRecord::new();
    while next_record(&mut reader, &mut record)? && line_of(&record, &bytes) <= above {}
    let named = line_of(&record, &bytes);
    let names = read_names(&record, named)?;
    let data = vec![vec![]; names.len()];
    let mut table = Table { name: String::new(), in_degrees: None, names, data, lines: vec![] };
    let (mut gaps, mut units) = (0, None);
    while next_record(&mut reader, &mut record)? {
        let line = line_of(&record, &bytes);
        if table.rows() == 0 && units.is_none() && record.len() == table.names.len() {
            units = Units::of_row(record.iter().map(|cell| std::str::from_utf8(cell).unwrap_or("\u{fffd}")));
            if units.is_some() {
                let message = "the row below the names has units; the numbers are in these units";
                remarks.push(Remark::of_line(line, message));
                continue;
            }
        }
        gaps += read_row(&record, line, has_commas, &mut table)?;
    }
    if table.rows() == 0 {
        return Err(lines.truncated("rows of numbers below the column names"));
    }
    if let Some(units) = units {
        units.apply(&mut table);
    }
    gaps -= without_unnamed(&mut table, named)?;
    remarks.extend(empty_cells(gaps));
    Ok((table, remarks))
}

/// Number of bytes of a file that are searched for its decimal mark.
const HEAD_BYTES: usize = 1 << 18;

/// The row of column names, and the number of lines above it: comments, and the line `sep=;` of Excel.
fn header_row(lines: &mut Lines<'_>) -> Result<(String, usize), Error> {
    let mut above = 0;
    while let Some(line) = lines.next_filled()? {
        let text = line.text.trim_matches(['"', ' ']);
        let is_of_excel = text.len() == "sep=;".len() && text.to_ascii_lowercase().starts_with("sep=");
        if !(is_of_excel || text.starts_with('#')) || starts_with_numbers(lines)? {
            return Ok((line.text.into_owned(), above));
        }
        above = line.number;
    }
    Ok((String::new(), above))
}

/// Whether the next line begins with a number: the line above it then has the names, also behind a `#`.
fn starts_with_numbers(lines: &Lines<'_>) -> Result<bool, Error> {
    let next = lines.clone().next_filled()?;
    let is_number =
        |line: &Line<'_>| line.text.split([',', ';', '\t']).next().is_some_and(|cell| number(cell.trim()).is_some());
    Ok(next.as_ref().is_some_and(is_number))
}

/// Removes columns without a name: of cells that are empty, because rows end with a separator, and a first one that
/// counts the rows, as pandas writes it. Returns the number of these empty cells.
fn without_unnamed(table: &mut Table, line: usize) -> Result<usize, Error> {
    let counts =
        |values: &[f64]| values.iter().enumerate().all(|(row, value)| (value - values[0] - row as f64).abs() < 1e-9);
    let mut empty = 0;
    for k in (0..table.names.len()).rev().filter(|k| table.names[*k].is_empty()).collect::<Vec<_>>() {
        let values = &table.data[k];
        let is_empty = values.iter().all(|value| value.is_nan());
        if !(is_empty || (k == 0 && counts(values))) {
            let found = format!("no name for column {}", k + 1);
            return Err(Error::Line { line, found, expected: "a name for every column".into() });
        }
        empty += if is_empty { values.len() } else { 0 };
        table.names.remove(k);
        table.data.remove(k);
    }
    Ok(empty)
}

/// The remark on empty cells.
pub(super) fn empty_cells(gaps: usize) -> Option<Remark> {
    let message = match gaps {
        0 => return None,
        1 => "1 cell is empty; it was read as not-a-number".into(),
        _ => format!("{gaps} cells are empty; they were read as not-a-number"),
    };
    Some(Remark::of_file(message))
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

/// The names; some may be empty.
fn read_names(record: &ByteRecord, line: usize) -> Result<Vec<String>, Error> {
    let mut names: Vec<String> = record.iter().map(|cell| unguarded(&one_line(&decode(cell))).to_owned()).collect();
    if let Some(time) =
        names.first().and_then(|name| name.strip_prefix('#')).map(str::trim).filter(|name| is_time(name))
    {
        names[0] = time.to_owned();
    }
    let fail = |found, expected: &str| Err(Error::Line { line, found, expected: expected.into() });
    if names.iter().all(|name| name.is_empty() || number(name).is_some()) {
        return fail(quoted(&names.join(",")), "a header row of column names");
    }
    if let Some(twice) = duplicate(names.iter().map(String::as_str).filter(|name| !name.is_empty())) {
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
fn read_row(record: &ByteRecord, line: usize, has_commas: bool, table: &mut Table) -> Result<usize, Error> {
    if record.len() != table.data.len() {
        let is_odd = record.len() > table.data.len() && table.data.len() > 1;
        let hint = if is_odd { " (a decimal comma splits a number in two)" } else { "" };
        let expected = format!("{}, one a column{hint}", table.data.len());
        return Err(Error::Line { line, found: counted(record.len(), "cell"), expected });
    }
    let mut gaps = 0;
    for (column, cell) in table.data.iter_mut().zip(record) {
        let word = std::str::from_utf8(cell).unwrap_or("\u{fffd}");
        gaps += usize::from(word.is_empty());
        let value = if ["", "-", "."].contains(&word) { Some(f64::NAN) } else { number(word) };
        let value = value.or_else(|| has_commas.then(|| number(&word.replacen(',', ".", 1)))?);
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
