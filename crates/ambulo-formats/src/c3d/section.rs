//! The parameter section as bytes: a chain of records, each a group or a parameter.
//!
//! ```text
//! length of name (negative: locked), number (negative: a group, else the group it belongs to), name,
//! offset to the next record (counted from this word; 0: the last), then
//!   group:     length of description, description
//!   parameter: type (-1 text, 1 byte, 2 integer, 4 real), number of dimensions, dimensions, values,
//!              length of description, description
//! ```
//!
//! The offset is unsigned, so a chain only goes forwards and ends with the file at the latest.
//! Source: C3D user guide (c3d.org), "The parameter section".

use super::header::BLOCK;
use super::parameters::{Group, Parameter, Parameters, Values};
use super::words::{Processor, Words};
use crate::error::{Error, Remark};

/// Bytes before the first record: two unused, the number of blocks, the processor.
pub(super) const SECTION_HEADER: usize = 4;

/// The processor that wrote the file: the fourth byte of the section.
pub(super) fn processor(bytes: &[u8], start: usize, remarks: &mut Vec<Remark>) -> Result<Processor, Error> {
    let Some(&code) = bytes.get(start + 3) else {
        let expected = format!("a parameter section at byte {start}");
        return Err(Error::CutOff { offset: bytes.len(), expected });
    };
    if let Some(processor) = Processor::of_code(code) {
        return Ok(processor);
    }
    // The header's block of the data is small and not zero; in the wrong byte order it is at least 256.
    let low_first = bytes[17] <= bytes[16];
    let processor = if low_first { Processor::Intel } else { Processor::Sgi };
    let message = format!("byte {}: processor {code} is not 84, 85 or 86; read as {processor:?}", start + 3);
    remarks.push(Remark::of_file(message));
    Ok(processor)
}

/// A record of the section before it is sorted into its group.
struct Record {
    offset: usize,
    group: u8,
    content: Content,
}

enum Content {
    Group(Group),
    Parameter(Parameter),
}

/// First byte after the stated number of blocks.
pub(super) fn end(words: Words<'_>, start: usize) -> usize {
    start + usize::from(words.u8(start + 2).unwrap_or(0)) * BLOCK
}

/// The whole section. `data_block` is the block of the data stated in the header.
pub(super) fn read(
    words: Words<'_>,
    start: usize,
    data_block: u16,
    remarks: &mut Vec<Remark>,
) -> Result<Parameters, Error> {
    let data = usize::from(data_block).saturating_sub(1) * BLOCK;
    let end = end(words, start).max(data);
    let mut reader = Reader { words, at: start + SECTION_HEADER, end, closed: false };
    let mut records = Vec::new();
    while let Some(record) = reader.record(remarks)? {
        records.push(record);
    }
    Ok(gather(records, remarks))
}

/// Follows the chain of records.
struct Reader<'a> {
    words: Words<'a>,
    at: usize,
    /// First byte after the section.
    end: usize,
    /// Whether the last record was marked as the last.
    closed: bool,
}

impl Reader<'_> {
    /// The next record; `None` at the end of the chain.
    fn record(&mut self, remarks: &mut Vec<Remark>) -> Result<Option<Record>, Error> {
        let offset = self.at;
        if self.closed {
            return Ok(None);
        }
        if offset >= self.end {
            let message = format!("the parameter section ends at byte {offset} without the zero that should close it");
            remarks.push(Remark::of_file(message));
            return Ok(None);
        }
        let length = self.byte("the length of a name")?.cast_signed();
        if length == 0 {
            return Ok(None);
        }
        let number = self.byte("the number of a group")?.cast_signed();
        let name = self.name(offset, usize::from(length.unsigned_abs()))?;
        let (link_at, stated) = (self.at, self.word(&name)?);
        let link = usize::from(self.link(stated, number < 0));
        let next = if link == 0 { self.end } else { link_at + link };
        if next > self.end {
            return Err(self.beyond(offset, &name, next));
        }
        let order = self.words.processor;
        if link != usize::from(stated) {
            self.words.processor = self.order_of_numbers(order);
            let message = format!(
                "byte {link_at}: the record of `{name}` states {stated} bytes and has {link}; its length was read in \
                 the other byte order"
            );
            remarks.push(Remark::of_file(message));
        }
        if number == 0 {
            return Err(Error::Byte {
                offset: offset + 1,
                found: format!("`{name}` in group 0"),
                expected: "groups numbered from 1; the parameter section is damaged".into(),
            });
        }
        let locked = length < 0;
        let content = if number < 0 {
            let description = self.description(next)?;
            Content::Group(Group { name, description, locked, parameters: vec![] })
        } else {
            Content::Parameter(self.parameter(name, locked, next)?)
        };
        self.words.processor = order;
        self.at = next;
        self.closed = link == 0;
        Ok(Some(Record { offset, group: number.unsigned_abs(), content }))
    }

    /// The length of a record. Programs for another processor write it in their own byte order when they change a
    /// record: then the stated length does not fit the content, and with exchanged bytes it does.
    fn link(&self, stated: u16, is_group: bool) -> u16 {
        let swapped = stated.swap_bytes();
        let is_content = |link: u16| self.content_bytes(is_group).is_some_and(|bytes| bytes == usize::from(link));
        if stated != 0 && !is_content(stated) && is_content(swapped) { swapped } else { stated }
    }

    /// Bytes of a record from its length to the end of its description, by its own content; `None` if it has none.
    fn content_bytes(&self, is_group: bool) -> Option<usize> {
        const LINK: usize = 2;
        let mut at = self.at;
        if !is_group {
            at += self.values()?.1;
        }
        Some(at + 1 + usize::from(self.words.u8(at)?) + LINK - self.at)
    }

    /// The type of the values of a parameter that begins here, and the bytes to their end.
    fn values(&self) -> Option<(i8, usize)> {
        let kind = self.words.u8(self.at)?.cast_signed();
        let rank = usize::from(self.words.u8(self.at + 1)?);
        let lengths = self.words.bytes.get(self.at + 2..self.at + 2 + rank)?;
        let dimensions: Vec<usize> = lengths.iter().copied().map(usize::from).collect();
        Some((kind, 2 + rank + size(kind, width(kind)?, &dimensions)?))
    }

    /// The byte order of the values of a record whose length is in the other order than `order`: the order in which
    /// they are usual numbers, or else the order of the length.
    fn order_of_numbers(&self, order: Processor) -> Processor {
        let other = if order == Processor::Sgi { Processor::Intel } else { Processor::Sgi };
        let Some((kind, end)) = self.values() else { return order };
        let rank = usize::from(self.words.u8(self.at + 1).unwrap_or(0));
        let bytes = self.words.bytes.get(self.at + 2 + rank..self.at + end).unwrap_or_default();
        // Counts and numbers of channels are small. Reals of the wrong order have any exponent.
        let is_usual = |processor: Processor| match kind {
            2 => bytes.as_chunks().0.iter().all(|word| processor.i16(*word).unsigned_abs() < 256),
            4 => bytes
                .as_chunks()
                .0
                .iter()
                .map(|word| processor.f32(*word).abs())
                .all(|x| x == 0.0 || (1e-9..1e9).contains(&x)),
            _ => true,
        };
        if !is_usual(other) && is_usual(order) { order } else { other }
    }

    fn parameter(&mut self, name: String, locked: bool, next: usize) -> Result<Parameter, Error> {
        let kind = self.byte(&name)?.cast_signed();
        let rank = usize::from(self.byte(&name)?);
        let mut dimensions = Vec::with_capacity(rank);
        for _ in 0..rank {
            dimensions.push(usize::from(self.byte(&name)?));
        }
        let Some(width) = width(kind) else { return Err(self.wrong_type(&name, kind)) };
        let room = next.saturating_sub(self.at);
        let size = size(kind, width, &dimensions).filter(|&size| size <= room);
        let Some(size) = size else {
            return Err(Error::Byte {
                offset: self.at,
                found: format!("`{name}` of shape {} in a record with {room} bytes left", shape_text(&dimensions)),
                expected: "as many values as the record has room for".into(),
            });
        };
        let Some(bytes) = self.words.bytes.get(self.at..self.at + size) else {
            return Err(self.cut(&format!("the {size} bytes of `{name}`")));
        };
        self.at += size;
        let values = values(kind, &dimensions, bytes, self.words.processor);
        if kind == -1 && !dimensions.is_empty() {
            dimensions.remove(0);
        }
        let description = self.description(next)?;
        Ok(Parameter { name, description, locked, dimensions, values })
    }

    /// The description, which some programs omit.
    fn description(&mut self, next: usize) -> Result<String, Error> {
        if self.at >= next {
            return Ok(String::new());
        }
        let length = usize::from(self.byte("the length of a description")?);
        let end = (self.at + length).min(next);
        match self.words.bytes.get(self.at..end) {
            Some(bytes) => Ok(text(bytes)),
            None => Err(self.cut(&format!("a description of {length} bytes"))),
        }
    }

    fn name(&mut self, offset: usize, length: usize) -> Result<String, Error> {
        let Some(bytes) = self.words.bytes.get(self.at..self.at + length) else {
            return Err(self.cut(&format!("a name of {length} bytes")));
        };
        // Zeros at the end are padding, as blanks are.
        let filled = bytes.iter().rposition(|&byte| byte != 0).map_or(0, |last| last + 1);
        if filled == 0 || bytes[..filled].iter().any(u8::is_ascii_control) {
            return Err(Error::Byte {
                offset,
                found: format!("a parameter's name with unprintable characters, `{}`", bytes.escape_ascii()),
                expected: "letters and digits; the parameter section is damaged or was overwritten".into(),
            });
        }
        self.at += length;
        Ok(text(bytes))
    }

    fn byte(&mut self, what: &str) -> Result<u8, Error> {
        let byte = self.words.u8(self.at).ok_or_else(|| self.cut(what))?;
        self.at += 1;
        Ok(byte)
    }

    fn word(&mut self, name: &str) -> Result<u16, Error> {
        let word = self.words.u16(self.at).ok_or_else(|| self.cut(&format!("the offset after `{name}`")))?;
        self.at += 2;
        Ok(word)
    }

    fn cut(&self, what: &str) -> Error {
        let expected = format!("{what} at byte {} of the parameter section", self.at);
        Error::CutOff { offset: self.words.bytes.len(), expected }
    }

    fn wrong_type(&self, name: &str, kind: i8) -> Error {
        let expected = "type -1 (text), 1 (byte), 2 (integer) or 4 (real)".into();
        Error::Byte { offset: self.at, found: format!("`{name}` of type {kind}"), expected }
    }

    fn beyond(&self, offset: usize, name: &str, next: usize) -> Error {
        Error::Byte {
            offset,
            found: format!("`{name}`, whose record extends to byte {next}"),
            expected: format!("records within the parameter section, which ends at byte {}; it is damaged", self.end),
        }
    }
}

/// A shape for a message: at most eight lengths.
fn shape_text(dimensions: &[usize]) -> String {
    const SHOWN: usize = 8;
    let shown: Vec<String> = dimensions.iter().take(SHOWN).map(usize::to_string).collect();
    let more =
        if dimensions.len() > SHOWN { format!(", ... ({} dimensions)", dimensions.len()) } else { String::new() };
    format!("[{}{more}]", shown.join(", "))
}

/// Bytes of a value of this type.
fn width(kind: i8) -> Option<usize> {
    match kind {
        -1 | 1 => Some(1),
        2 => Some(2),
        4 => Some(4),
        _ => None,
    }
}

/// Bytes of all values; `None` if they cannot fit into a file. Empty texts take no room in the file, but memory.
fn size(kind: i8, width: usize, dimensions: &[usize]) -> Option<usize> {
    const EMPTY_TEXTS: usize = 65535;
    let product = |start, factors: &[usize]| factors.iter().try_fold(start, |size: usize, &n| size.checked_mul(n));
    if kind == -1 && dimensions.first() == Some(&0) {
        return product(1, &dimensions[1..]).filter(|&count| count <= EMPTY_TEXTS).map(|_| 0);
    }
    product(width, dimensions)
}

fn values(kind: i8, dimensions: &[usize], bytes: &[u8], processor: Processor) -> Values {
    match kind {
        -1 => Values::Texts(texts(dimensions, bytes)),
        1 => Values::Bytes(bytes.to_vec()),
        2 => Values::Integers(bytes.as_chunks().0.iter().map(|&word| processor.i16(word)).collect()),
        _ => Values::Reals(bytes.as_chunks().0.iter().map(|&word| processor.f32(word)).collect()),
    }
}

/// Texts of equal width: the first dimension. Texts of width zero are empty.
fn texts(dimensions: &[usize], bytes: &[u8]) -> Vec<String> {
    let (width, count) = match dimensions {
        [] => (1, 1),
        [width, rest @ ..] => (*width, rest.iter().product()),
    };
    if width == 0 {
        return vec![String::new(); count];
    }
    bytes.chunks(width).map(text).collect()
}

/// Text without the blanks and zeros at its end: UTF-8, or else Latin-1, whose characters are the first 256 of Unicode.
pub(super) fn text(bytes: &[u8]) -> String {
    let end = bytes.iter().rposition(|&byte| byte != b' ' && byte != 0).map_or(0, |last| last + 1);
    let bytes = &bytes[..end];
    std::str::from_utf8(bytes).map_or_else(|_| bytes.iter().copied().map(char::from).collect(), str::to_owned)
}

/// Sorts parameters into their groups, which may come later in the file or be missing.
fn gather(records: Vec<Record>, remarks: &mut Vec<Remark>) -> Parameters {
    let mut groups: Vec<(u8, Group)> = Vec::new();
    let mut parameters = Vec::new();
    for Record { offset, group, content } in records {
        match content {
            Content::Group(named) => {
                if let Some((_, first)) = groups.iter().find(|(number, _)| *number == group) {
                    let message = format!(
                        "byte {offset}: group {group} is named `{}` and again `{}`; its parameters are in the first",
                        first.name, named.name
                    );
                    remarks.push(Remark::of_file(message));
                }
                groups.push((group, named));
            }
            Content::Parameter(parameter) => parameters.push((group, parameter)),
        }
    }
    for (group, parameter) in parameters {
        let position = groups.iter().position(|(number, _)| *number == group).unwrap_or_else(|| {
            let message = format!("group {group} has parameters (`{}`) but no name", parameter.name);
            remarks.push(Remark::of_file(message));
            groups.push((group, Group::default()));
            groups.len() - 1
        });
        groups[position].1.parameters.push(parameter);
    }
    Parameters { groups: groups.into_iter().map(|(_, group)| group).collect() }
}
