//! OpenSim storage: a header that ends with `endheader`, a line of names, then rows of numbers.

use super::Table;
use super::content::Content;
use super::csv::empty_cells;
use super::lines::{Line, Lines, counted, duplicate, expected_number, is_time, number};
use crate::content;
use crate::error::{Error, Remark, quoted};
use crate::plain_text::{Layout, PlainText, separator_behind};
use std::io::{self, Write};

/// A header is ten lines long; some programs add a few dozen lines of comments.
pub(super) const MAX_HEADER_LINES: usize = 4096;

pub(super) const ENDHEADER: &str = "endheader";

/// Reads a `.mot` or `.sto` file.
pub(super) fn read(bytes: &[u8]) -> Result<(Table, Vec<Remark>), Error> {
    let text = PlainText::of(bytes).with_tabs(layout);
    read_text(&text.bytes, text.remarks).map_err(|error| error.or_other_content(bytes, content::STORAGE))
}

/// The line of names is the one behind `endheader`, or without that the first one that begins with `time`.
fn layout(lines: &[&str]) -> Option<Layout> {
    let is_end = |line: &&str| line.trim_matches([' ', ',', ';', '\t', '"']).eq_ignore_ascii_case(ENDHEADER);
    let end = lines.iter().position(is_end).map_or(0, |end| end + 1);
    let of_names =
        |(k, line): (usize, &&str)| Some(Layout { separator: separator_behind(line, is_time)?, last_header_line: k });
    let filled = |(_, line): &(usize, &&str)| end == 0 || !line.trim().is_empty();
    let mut candidates = lines.iter().enumerate().skip(end).filter(filled);
    if end > 0 { candidates.next().and_then(of_names) } else { candidates.find_map(of_names) }
}

fn read_text(bytes: &[u8], mut remarks: Vec<Remark>) -> Result<(Table, Vec<Remark>), Error> {
    let mut lines = Lines::new(bytes, "an OpenSim storage file: a header that ends with `endheader`, names, rows")?;
    let header = read_header(&mut lines, &mut remarks)?;
    let (label_line, names) = read_names(&mut lines)?;
    let width = names.len();
    let mut table =
        Table { name: header.name, in_degrees: header.in_degrees, names, data: vec![vec![]; width], lines: vec![] };
    let empty = read_rows(&mut lines, &mut table, header.rows)?;
    remarks.extend(empty_cells(empty));
    if let Some(stated) = header.columns.filter(|&stated| stated != width) {
        let message = format!("the header states {}, the file has {width}; read {width}", counted(stated, "column"));
        remarks.push(Remark::of_line(label_line, message));
    }
    if let Some(stated) = header.rows.filter(|&stated| stated != table.rows()) {
        remarks.push(Remark::of_file(row_count_message(stated, table.rows(), &lines)));
    }
    Ok((table, remarks))
}

fn row_count_message(stated: usize, rows: usize, lines: &Lines<'_>) -> String {
    let cut = if rows < stated && !lines.last_is_ended() {
        "; the last line has no line end, so its last number may be truncated"
    } else {
        ""
    };
    format!("the header states {}, the file has {rows}; read {rows}{cut}", counted(stated, "row"))
}

#[derive(Default)]
struct Header {
    name: String,
    in_degrees: Option<bool>,
    /// "Angles are in degrees.", which files before version 1 have in place of a key.
    angles_in_degrees: Option<bool>,
    rows: Option<usize>,
    columns: Option<usize>,
    /// `datacolumns` or `datarows`, which only SIMM writes. Its angles are in degrees (OpenSim reads them so).
    is_of_simm: bool,
}

fn read_header(lines: &mut Lines<'_>, remarks: &mut Vec<Remark>) -> Result<Header, Error> {
    let mut header = Header::default();
    let mut first = true;
    for _ in 0..MAX_HEADER_LINES {
        let before = lines.clone();
        let Some(line) = lines.next_line()? else {
            return Err(lines.truncated(format!("a line `{ENDHEADER}` that closes the header")));
        };
        let text = line.text.trim();
        let is_end = text.eq_ignore_ascii_case(ENDHEADER);
        if !is_end && are_names(&line, lines)? {
            let message = format!("no line `{ENDHEADER}` above the names of the columns; they were read as such");
            remarks.push(Remark::of_line(line.number, message));
            *lines = before;
        }
        if is_end || remarks.last().is_some_and(|remark| remark.line == Some(line.number)) {
            settle_degrees(&mut header, remarks);
            return Ok(header);
        }
        if text.is_empty() {
            continue;
        }
        let known = header.take(&line, remarks)?;
        if first && !known {
            header.name = text.to_owned();
        }
        first = false;
    }
    let expected = format!("a line `{ENDHEADER}` among the first {MAX_HEADER_LINES} lines");
    Err(Error::Line { line: MAX_HEADER_LINES, found: "a header without end".into(), expected })
}

/// Whether a line has the names of columns: it begins with `time`, and numbers follow.
fn are_names(line: &Line<'_>, rest: &Lines<'_>) -> Result<bool, Error> {
    let names = cells_of(&line.text);
    let Some(next) = rest.clone().next_filled()? else { return Ok(false) };
    let row = cells_of(&next.text);
    Ok(names.len() > 1
        && is_time(names[0])
        && row.len() == names.len()
        && row.iter().all(|cell| number(cell).is_some()))
}

/// Cells between tabs, or words if there are no tabs.
fn cells_of(text: &str) -> Vec<&str> {
    let text = text.trim();
    if text.contains('\t') { text.split('\t').map(str::trim).collect() } else { text.split_whitespace().collect() }
}

fn settle_degrees(header: &mut Header, remarks: &mut Vec<Remark>) {
    let (Some(key), Some(sentence)) = (header.in_degrees, header.angles_in_degrees) else {
        header.in_degrees = header.in_degrees.or(header.angles_in_degrees);
        if header.is_of_simm && header.in_degrees.is_none() {
            header.in_degrees = Some(true);
        }
        return;
    };
    if key != sentence {
        let unit = |degrees| if degrees { "degrees" } else { "radians" };
        let message = format!(
            "`inDegrees` states {}, but the header also has \"Angles are in {}.\"; `inDegrees` was used",
            unit(key),
            unit(sentence)
        );
        remarks.push(Remark::of_file(message));
    }
}

impl Header {
    /// Reads one line; returns false for a line without a known key.
    fn take(&mut self, line: &Line<'_>, remarks: &mut Vec<Remark>) -> Result<bool, Error> {
        let (key, value) = split_key(&line.text);
        let key_word = key.to_ascii_lowercase();
        self.is_of_simm |= matches!(key_word.as_str(), "datacolumns" | "datarows");
        match key_word.as_str() {
            "name" => self.name = value.to_owned(),
            "nrows" | "nr" | "datarows" => self.rows = Some(count(line, key, value)?),
            "ncolumns" | "nc" | "datacolumns" => self.columns = Some(count(line, key, value)?),
            "indegrees" => self.in_degrees = Some(yes_or_no(line, value)?),
            "datatype" => check_data_type(line, value)?,
            "version" => remarks.extend(unknown_version(line, value)),
            "angles" => self.angles_in_degrees = angles_sentence(&line.text).or(self.angles_in_degrees),
            "opensimversion" | "range" => {}
            _ => return Ok(false),
        }
        Ok(true)
    }
}

/// `nRows=5`, `nRows = 5` and `datarows 5` in key and value.
pub(super) fn split_key(text: &str) -> (&str, &str) {
    let separator = |c: char| c.is_whitespace() || c == '=';
    let text = text.trim();
    match text.find(separator) {
        Some(end) => (&text[..end], text[end..].trim_start_matches(separator)),
        None => (text, ""),
    }
}

fn count(line: &Line<'_>, key: &str, value: &str) -> Result<usize, Error> {
    value.parse().map_err(|_| line.error(format!("{key} {}", quoted(value)), "a whole number of rows or columns"))
}

fn yes_or_no(line: &Line<'_>, value: &str) -> Result<bool, Error> {
    match value.trim_matches(['"', '\'']).to_ascii_lowercase().as_str() {
        "yes" | "y" | "true" | "1" => Ok(true),
        "no" | "n" | "false" | "0" => Ok(false),
        _ => Err(line.error(format!("inDegrees {}", quoted(value)), "`inDegrees=yes` or `inDegrees=no`")),
    }
}

fn check_data_type(line: &Line<'_>, value: &str) -> Result<(), Error> {
    if value.eq_ignore_ascii_case("double") {
        return Ok(());
    }
    let expected = "`DataType=double`, one number per cell; export the table flattened, with one column per component";
    Err(line.error(format!("DataType {}", quoted(value)), expected))
}

fn unknown_version(line: &Line<'_>, value: &str) -> Option<Remark> {
    if value.parse().is_ok_and(|version: u32| version <= 3) {
        return None;
    }
    let message =
        format!("storage version {}; the known versions are 1 to 3; it was read as one of them", quoted(value));
    Some(Remark::of_line(line.number, message))
}

fn angles_sentence(text: &str) -> Option<bool> {
    match text.trim().trim_end_matches('.').to_ascii_lowercase().as_str() {
        "angles are in degrees" => Some(true),
        "angles are in radians" => Some(false),
        _ => None,
    }
}

/// The line of names, with its number.
pub(super) fn read_names(lines: &mut Lines<'_>) -> Result<(usize, Vec<String>), Error> {
    let Some(line) = lines.next_filled()? else {
        return Err(lines.truncated("a line of column names and rows of numbers"));
    };
    let Some(first_row) = lines.clone().next_filled()? else {
        return Err(lines.truncated("rows of numbers below the column names"));
    };
    let names = split_names(&line.text, &first_row.text);
    match names.first() {
        Some(first) if is_time(first) => {}
        first => {
            let found = format!("the first column {}", quoted(first.map_or("", |name| name)));
            return Err(line.error(found, "a first column `time`"));
        }
    }
    if let Some(twice) = duplicate(names.iter().map(String::as_str)) {
        return Err(line.error(format!("two columns {}", quoted(twice)), "column names that differ"));
    }
    Ok((line.number, names))
}

/// Names are separated by tabs and may contain spaces, if that gives as many names as the first row has numbers, or
/// cells; otherwise they are separated by any white space.
fn split_names(text: &str, first_row: &str) -> Vec<String> {
    let between_tabs: Vec<&str> = text.split('\t').map(str::trim).filter(|name| !name.is_empty()).collect();
    let words = first_row.split_ascii_whitespace().count();
    let cells = first_row.split('\t').count();
    if between_tabs.len() == words || (cells > words && between_tabs.len() == cells) {
        return between_tabs.into_iter().map(str::to_owned).collect();
    }
    text.split_whitespace().map(str::to_owned).collect()
}

/// Reads all rows; returns the number of empty cells.
fn read_rows(lines: &mut Lines<'_>, table: &mut Table, stated: Option<usize>) -> Result<usize, Error> {
    let mut empty = 0;
    while let Some(line) = lines.next_filled()? {
        let is_unended = lines.is_at_end() && !lines.last_is_ended();
        let row = match read_row(&line, &mut table.data) {
            Err(error) if !is_unended => read_cells(&line, table).ok_or(error),
            read => read.map(|()| 0),
        };
        match row {
            Ok(count) => empty += count,
            Err(error) => {
                let may_miss = stated.is_none_or(|stated| table.lines.len() < stated);
                let cut = may_miss && lines.is_at_end() && is_cut(&line, table.data.len(), lines.last_is_ended());
                let expected = || format!("the rest of a row of {} numbers", table.data.len());
                return Err(if cut { lines.truncated(expected()) } else { error });
            }
        }
        table.lines.push(line.number);
    }
    Ok(empty)
}

/// Reads a row with empty cells between its tabs; returns their number. `None` if the cells do not fit the table.
fn read_cells(line: &Line<'_>, table: &mut Table) -> Option<usize> {
    let (rows, width) = (table.lines.len(), table.data.len());
    let mut cells: Vec<&str> = line.text.split('\t').map(str::trim).collect();
    while cells.len() > width && cells.last().is_some_and(|cell| cell.is_empty()) {
        cells.pop();
    }
    let value = |cell: &&str| if cell.is_empty() { Some(f64::NAN) } else { number(cell) };
    let values: Vec<f64> = cells.iter().map(value).collect::<Option<_>>()?;
    let empty = cells.iter().filter(|cell| cell.is_empty()).count();
    if values.len() != width || empty == 0 {
        return None;
    }
    for (column, value) in table.data.iter_mut().zip(values) {
        column.truncate(rows);
        column.push(value);
    }
    Some(empty)
}

/// Whether the file is truncated in this row: numbers are missing, or the last one is incomplete.
fn is_cut(line: &Line<'_>, width: usize, ended: bool) -> bool {
    let words = || line.text.split_ascii_whitespace();
    let count = words().count();
    let whole = words().filter(|word| number(word).is_some()).count();
    let last_is_broken = !ended && words().last().is_some_and(|word| number(word).is_none());
    (count < width && whole == count) || (count <= width && whole + 1 == count && last_is_broken)
}

fn read_row(line: &Line<'_>, columns: &mut [Vec<f64>]) -> Result<(), Error> {
    let mut words = line.text.split_ascii_whitespace();
    let mut filled = 0;
    for (column, word) in columns.iter_mut().zip(&mut words) {
        column.push(number(word).ok_or_else(|| line.error(quoted(word), expected_number(word)))?);
        filled += 1;
    }
    let extra = words.count();
    if filled < columns.len() || extra > 0 {
        let expected = format!("{}, one a column", columns.len());
        return Err(line.error(counted(filled + extra, "number"), expected));
    }
    Ok(())
}

/// Writes version 1, tab separated.
pub(super) fn write(table: &Content<'_>, out: &mut dyn Write) -> io::Result<()> {
    let degrees = match table.in_degrees {
        Some(true) => "inDegrees=yes\n",
        Some(false) => "inDegrees=no\n",
        None => "",
    };
    let (name, names) = (name_line(table.name), table.names.join("\t"));
    let (rows, columns) = (table.rows, table.names.len());
    write!(out, "{name}version=1\nnRows={rows}\nnColumns={columns}\n{degrees}{ENDHEADER}\n{names}\n")?;
    table.write_numbers('\t', out)
}

/// The name is the first line, unless a reader could take it for something else.
fn name_line(name: &str) -> String {
    let name: String = name.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let name = name.trim().trim_start_matches(|c: char| c.is_whitespace() || c == '=');
    let (key, _) = split_key(name);
    let line = Line { number: 1, text: key.into() };
    let is_key = name.contains('=') || !matches!(Header::default().take(&line, &mut Vec::new()), Ok(false));
    match name {
        "" => String::new(),
        _ if is_key || name.eq_ignore_ascii_case(ENDHEADER) => format!("name={name}\n"),
        _ => format!("{name}\n"),
    }
}
