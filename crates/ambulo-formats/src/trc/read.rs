//! Reading TRC.

use super::{LengthUnit, Marker, Trc};
use crate::content;
use crate::error::{Error, Remark, quoted};
use crate::plain_text::{Layout, PlainText, separator_behind};
use crate::table::lines::{Line, Lines, counted, duplicate, expected_number, is_time, number};

const FIRST_WORD: &str = "PathFileType";
/// Words above the column of frame numbers, without regard to case.
const FRAME_WORDS: [&str; 5] = ["Frame#", "Frame", "Frames", "Frame #", "#"];

pub(super) fn read(bytes: &[u8]) -> Result<(Trc, Vec<Remark>), Error> {
    let text = PlainText::of(bytes).with_tabs(layout);
    read_text(&text.bytes, text.remarks).map_err(|error| error.or_other_content(bytes, content::TRC))
}

/// The first line shows the separator; rows of numbers begin below the fourth one.
fn layout(lines: &[&str]) -> Option<Layout> {
    let mut filled = lines.iter().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let is_first = |cell: &str| cell.eq_ignore_ascii_case(FIRST_WORD);
    let separator = separator_behind(filled.next()?.1, is_first)?;
    Some(Layout { separator, last_header_line: filled.nth(2)?.0 })
}

fn read_text(bytes: &[u8], mut remarks: Vec<Remark>) -> Result<(Trc, Vec<Remark>), Error> {
    let mut lines = Lines::new(bytes, "a TRC file, which begins with `PathFileType`")?;
    let name = read_path_line(&mut lines)?;
    let header = read_header(&mut lines)?;
    let (names, places) = read_names(&mut lines, header.markers, &mut remarks)?;
    let room = room(bytes, header.frames, names.len());
    let marker = |name| Marker { name, positions_m: Vec::with_capacity(room) };
    let markers = names.into_iter().map(marker).collect();
    let Header { rate_hz, unit, orig_start_frame, .. } = header;
    let (frames, times) = (Vec::with_capacity(room), Vec::with_capacity(room));
    let mut trc = Trc { name, rate_hz, unit, orig_start_frame, frames, times, markers };
    let oddities = read_frames(&mut lines, &mut trc, &places, header.frames)?;
    remarks.extend(oddities.remarks());
    if let Some(stated) = header.frames.filter(|&stated| stated != trc.times.len()) {
        remarks.push(Remark::of_file(frame_count_message(stated, trc.times.len(), &lines)));
    }
    Ok((trc, remarks))
}

/// Number of frames to make room for: as stated, but no more than the file can contain; vectors that grow leave as much
/// memory unused.
fn room(bytes: &[u8], stated: Option<usize>, markers: usize) -> usize {
    let shortest_line = "1\t0".len() + markers * "\t0\t0\t0".len() + 1;
    stated.unwrap_or(0).min(bytes.len() / shortest_line)
}

fn frame_count_message(stated: usize, frames: usize, lines: &Lines<'_>) -> String {
    let cut = if frames < stated && !lines.last_is_ended() {
        "; the last line has no line end, so its last number may be truncated"
    } else {
        ""
    };
    format!("NumFrames states {stated}, the file has {frames}; read {frames}{cut}")
}

/// Reads the first line; returns the text after `(X/Y/Z)`.
fn read_path_line(lines: &mut Lines<'_>) -> Result<String, Error> {
    let line = lines.next_filled()?.ok_or_else(|| lines.truncated(FIRST_WORD))?;
    let first = line.text.split_whitespace().next().unwrap_or_default();
    if !first.eq_ignore_ascii_case(FIRST_WORD) {
        return Err(line.error(quoted(&line.text), format!("`{FIRST_WORD}`, as a TRC file begins")));
    }
    Ok(line.text.split_once("(X/Y/Z)").map_or("", |(_, name)| name).trim().to_owned())
}

struct Header {
    rate_hz: f64,
    unit: LengthUnit,
    orig_start_frame: i64,
    frames: Option<usize>,
    markers: Option<usize>,
}

/// The line of keys and the line of values below it.
fn read_header(lines: &mut Lines<'_>) -> Result<Header, Error> {
    let keys = lines.next_filled()?.ok_or_else(|| lines.truncated("a line of keys: DataRate, CameraRate, ..."))?;
    let values =
        lines.next_filled()?.ok_or_else(|| lines.truncated("a line of values: data rate, camera rate, ..."))?;
    let pairs = pair(&keys, &values)?;
    let value = |key: &str| pairs.iter().find(|(k, _)| k.eq_ignore_ascii_case(key)).map(|&(_, value)| value);
    let need = |key: &str| value(key).ok_or_else(|| keys.error(quoted(&keys.text), format!("a key `{key}`")));
    let rate = need("DataRate")?;
    let whole = |key: &str| value(key).map(|text| count(&values, key, text)).transpose();
    Ok(Header {
        rate_hz: number(rate).filter(|rate| rate.is_finite() && *rate > 0.0).ok_or_else(|| {
            values.error(format!("DataRate {}", quoted(rate)), "a frame rate in Hz, a finite number above zero")
        })?,
        unit: read_unit(&values, value("Units").unwrap_or_default(), &keys)?,
        orig_start_frame: value("OrigDataStartFrame")
            .map_or(Some(1), integer)
            .ok_or_else(|| values.error(quoted(&values.text), "a whole number for OrigDataStartFrame"))?,
        frames: whole("NumFrames")?,
        markers: whole("NumMarkers")?,
    })
}

/// Values are separated by white space, or by tabs if one of them is empty.
fn pair<'l>(keys: &'l Line<'_>, values: &'l Line<'_>) -> Result<Vec<(&'l str, &'l str)>, Error> {
    let names: Vec<&str> = keys.text.split_whitespace().collect();
    let words: Vec<&str> = values.text.split_whitespace().collect();
    if words.len() == names.len() {
        return Ok(names.into_iter().zip(words).collect());
    }
    let cells: Vec<&str> = values.text.split('\t').map(str::trim).collect();
    let spare_is_empty = cells.iter().skip(names.len()).all(|cell| cell.is_empty());
    if cells.len() < names.len() || !spare_is_empty || words.len() > names.len() {
        return Err(
            values.error(counted(words.len(), "value"), format!("{}, one per key of the line above", names.len()))
        );
    }
    Ok(names.into_iter().zip(cells).filter(|(_, value)| !value.is_empty()).collect())
}

fn read_unit(line: &Line<'_>, symbol: &str, keys: &Line<'_>) -> Result<LengthUnit, Error> {
    if symbol.is_empty() && !keys.text.split_whitespace().any(|key| key.eq_ignore_ascii_case("Units")) {
        return Err(keys.error(quoted(&keys.text), "a key `Units`"));
    }
    let word = symbol.trim_matches(['[', ']', '(', ')', '"', '.']).to_lowercase();
    let is_named = |unit: &LengthUnit| match unit {
        LengthUnit::Millimetre => ["millimeter", "millimeters", "millimetre", "millimetres"].contains(&word.as_str()),
        LengthUnit::Centimetre => ["centimeter", "centimeters", "centimetre", "centimetres"].contains(&word.as_str()),
        LengthUnit::Metre => ["meter", "meters", "metre", "metres"].contains(&word.as_str()),
    };
    LengthUnit::ALL
        .into_iter()
        .find(|unit| unit.symbol() == word || is_named(unit))
        .ok_or_else(|| line.error(format!("Units {}", quoted(symbol)), "`mm`, `cm` or `m`"))
}

fn count(line: &Line<'_>, key: &str, text: &str) -> Result<usize, Error> {
    let value = integer(text).and_then(|value| usize::try_from(value).ok());
    value.ok_or_else(|| line.error(format!("{key} {}", quoted(text)), "a whole number"))
}

/// A whole number, also when written `12.0`.
fn integer(text: &str) -> Option<i64> {
    let whole =
        text.split_once('.').filter(|(_, tail)| tail.bytes().all(|b| b == b'0')).map_or(text, |(whole, _)| whole);
    whole.parse().ok()
}

/// The line of marker names and the line of X1 Y1 Z1 below it.
fn read_names(
    lines: &mut Lines<'_>,
    stated: Option<usize>,
    remarks: &mut Vec<Remark>,
) -> Result<(Vec<String>, Vec<usize>), Error> {
    let line = lines.next_filled()?.ok_or_else(|| lines.truncated("a line `Frame#`, `Time` and marker names"))?;
    let mut words = words(&line.text);
    let is = |word: Option<&&str>, wanted: &str| word.is_some_and(|w| w.eq_ignore_ascii_case(wanted));
    let is_one_of = |word: Option<&&str>, wanted: &[&str]| wanted.iter().any(|wanted| is(word, wanted));
    if !is_one_of(words.first(), &FRAME_WORDS) || !words.get(1).is_some_and(|word| is_time(word)) {
        return Err(line.error(quoted(&line.text), "`Frame#`, `Time`, then marker names"));
    }
    let names: Vec<String> = words.drain(2..).map(str::to_owned).collect();
    if names.is_empty() {
        return Err(line.error("no marker names", "`Frame#`, `Time`, then marker names"));
    }
    if let Some(twice) = duplicate(names.iter().map(String::as_str)) {
        return Err(line.error(format!("two markers {}", quoted(twice)), "marker names that differ"));
    }
    let places = read_axes(lines, names.len(), remarks)?;
    if let Some(stated) = stated.filter(|&stated| stated != names.len()) {
        let message = format!("NumMarkers states {stated}, the file names {}; read {0}", names.len());
        remarks.push(Remark::of_line(line.number, message));
    }
    Ok((names, places))
}

/// Non-empty cells separated by tabs, which may contain spaces; words if there is no tab.
fn words(text: &str) -> Vec<&str> {
    if text.contains('\t') {
        return text.split('\t').map(str::trim).filter(|cell| !cell.is_empty()).collect();
    }
    text.split_whitespace().collect()
}

/// Checks the line X1 Y1 Z1, which some programs omit; returns the places of its cells, if it is separated by tabs.
fn read_axes(lines: &mut Lines<'_>, markers: usize, remarks: &mut Vec<Remark>) -> Result<Vec<usize>, Error> {
    let before = lines.clone();
    let line = lines.next_filled()?.ok_or_else(|| lines.truncated("a line X1 Y1 Z1 X2 ..."))?;
    let mut start = line.text.split_whitespace().take(2);
    if start.next().is_some_and(|word| integer(word).is_some())
        && start.next().is_some_and(|word| number(word).is_some())
    {
        let message = "no line X1 Y1 Z1 below the names of the markers; three columns were read for each";
        remarks.push(Remark::of_line(line.number, message));
        *lines = before;
        return Ok(Vec::new());
    }
    let axes: Vec<&str> = line.text.split_whitespace().collect();
    let expected = || format!("X, Y, Z for each of {}", counted(markers, "named marker"));
    if axes.len() != 3 * markers {
        return Err(line.error(counted(axes.len(), "axis name"), expected()));
    }
    let odd = axes
        .iter()
        .zip(["x", "y", "z"].iter().cycle())
        .find(|(word, axis)| !word.get(..1).is_some_and(|letter| letter.eq_ignore_ascii_case(axis)));
    if let Some((word, _)) = odd {
        return Err(line.error(quoted(word), expected()));
    }
    let filled = |(place, cell): (usize, &str)| (!cell.trim().is_empty()).then_some(place);
    let places: Vec<usize> = line.text.split('\t').enumerate().filter_map(filled).collect();
    Ok(if places.len() == 3 * markers { places } else { Vec::new() })
}

/// Unusual values in the frames, counted for remarks.
#[derive(Default)]
struct Oddities {
    partial: Count,
    zero: Count,
    impossible: Count,
}

#[derive(Default)]
struct Count {
    number: usize,
    /// Line and marker of the first one.
    first: Option<(usize, String)>,
}

impl Count {
    fn add(&mut self, line: usize, marker: &str) {
        self.number += 1;
        self.first.get_or_insert_with(|| (line, marker.to_owned()));
    }

    fn remark(&self, what: &str) -> Option<Remark> {
        let (line, marker) = self.first.as_ref()?;
        let message = format!("{} {what} (first: marker {})", counted(self.number, "position"), quoted(marker));
        Some(Remark::of_line(*line, message))
    }
}

impl Oddities {
    fn remarks(&self) -> impl Iterator<Item = Remark> {
        let partial = self.partial.remark("with one or two empty cells; read as a gap");
        let zero = self.zero.remark("exactly 0 0 0, which some programs write for a gap");
        let impossible = self.impossible.remark("with an infinite number; read as a gap");
        partial.into_iter().chain(zero).chain(impossible)
    }
}

fn read_frames(
    lines: &mut Lines<'_>,
    trc: &mut Trc,
    places: &[usize],
    stated: Option<usize>,
) -> Result<Oddities, Error> {
    let mut oddities = Oddities::default();
    let width = 2 + 3 * trc.markers.len();
    while let Some(line) = lines.next_filled()? {
        let cells = cells(&line, width, places);
        let read = cells.and_then(|cells| read_frame(&line, &cells, trc, &mut oddities));
        if let Err(error) = read {
            let may_miss = stated.is_none_or(|stated| trc.times.len() < stated);
            let cut = may_miss && lines.is_at_end() && is_cut(&line, width, lines.last_is_ended());
            return Err(if cut { lines.truncated(format!("the rest of a row of {width} cells")) } else { error });
        }
    }
    if trc.times.is_empty() {
        return Err(lines.truncated("rows of frame, time and positions"));
    }
    Ok(oddities)
}

/// Whether the file is truncated in this row: cells are missing, or the last one is incomplete.
fn is_cut(line: &Line<'_>, width: usize, ended: bool) -> bool {
    let text = &line.text;
    let count = if text.contains('\t') { text.split('\t').count() } else { text.split_ascii_whitespace().count() };
    let last_is_broken = || text.split_ascii_whitespace().last().is_some_and(|word| number(word).is_none());
    count < width || (count == width && !ended && last_is_broken())
}

/// The cells of one row, which may be empty if they are separated by tabs. Tabs after the last column are ignored, and
/// so are empty cells in columns that have no axis above them; `places` are the columns that have one.
fn cells<'l>(line: &'l Line<'_>, width: usize, places: &[usize]) -> Result<Vec<&'l str>, Error> {
    let mut cells: Vec<&str> = match line.text.contains('\t') {
        true => line.text.split('\t').map(str::trim).collect(),
        false => line.text.split_ascii_whitespace().collect(),
    };
    while cells.len() > width && cells.last().is_some_and(|cell| cell.is_empty()) {
        cells.pop();
    }
    let has_places = places.first().is_some_and(|first| *first >= 2);
    let is_surplus = |place: &usize| *place > 1 && !places.contains(place);
    if has_places && cells.len() > width && (0..cells.len()).filter(is_surplus).all(|place| cells[place].is_empty()) {
        cells = (0..cells.len()).filter(|place| !is_surplus(place)).map(|place| cells[place]).collect();
        cells.resize(width, "");
    }
    if cells.len() != width {
        let expected = format!("{width}: frame, time and three per marker, separated by tabs, gaps empty");
        return Err(line.error(counted(cells.len(), "cell"), expected));
    }
    Ok(cells)
}

/// Appends a frame. After an error the record is incomplete and must not be used.
fn read_frame(line: &Line<'_>, cells: &[&str], trc: &mut Trc, oddities: &mut Oddities) -> Result<(), Error> {
    let [frame, time, positions @ ..] = cells else {
        return Err(line.error(counted(cells.len(), "cell"), "frame and time"));
    };
    let frame = integer(frame).ok_or_else(|| line.error(quoted(frame), "a frame number"))?;
    let value = number(time).filter(|time| time.is_finite());
    let value = value.ok_or_else(|| line.error(format!("time {}", quoted(time)), expected_number(time)))?;
    for (marker, triple) in trc.markers.iter_mut().zip(positions.chunks(3)) {
        let mut position = read_position(line, triple)?;
        if position.iter().any(|value| value.is_infinite()) {
            oddities.impossible.add(line.number, &marker.name);
            position = [f64::NAN; 3];
        }
        let empty = triple.iter().filter(|cell| cell.is_empty()).count();
        if empty == 1 || empty == 2 {
            oddities.partial.add(line.number, &marker.name);
        }
        if position.iter().all(|value| value.abs() <= 0.0) {
            oddities.zero.add(line.number, &marker.name);
        }
        marker.positions_m.push(position.map(|value| trc.unit.metres(value)));
    }
    trc.frames.push(frame);
    trc.times.push(value);
    Ok(())
}

/// A position in the file's unit; not-a-number in all three if any cell is empty or not-a-number.
fn read_position(line: &Line<'_>, cells: &[&str]) -> Result<[f64; 3], Error> {
    let mut position = [f64::NAN; 3];
    for (value, cell) in position.iter_mut().zip(cells).filter(|(_, cell)| !cell.is_empty()) {
        *value = number(cell).ok_or_else(|| line.error(quoted(cell), expected_number(cell)))?;
    }
    Ok(if position.iter().any(|value| value.is_nan()) { [f64::NAN; 3] } else { position })
}
