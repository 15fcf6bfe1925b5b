//! One array: a magic word, a header in the syntax of Python, and the elements.

use super::zip::Entry;
use super::{Array, Data, MAX_TEXTS};
use crate::error::{Error, quoted};

const MAGIC: &[u8] = b"\x93NUMPY";
/// The header ends so that the elements begin at a multiple of this.
const ALIGNED: usize = 64;

/// How the elements are written.
#[derive(Debug, Clone, Copy)]
struct Kind {
    letter: char,
    bytes: usize,
    is_big: bool,
}

/// Longest header that is read; NumPy pads the usual one to 128 bytes.
pub(super) const MAX_HEADER: usize = 1 << 16;

/// The header of an array: all but its elements.
pub(super) struct Header {
    shape: Vec<usize>,
    /// The type as the file describes it.
    description: String,
    /// `None` for objects, structures and others.
    kind: Option<Kind>,
    is_columns: bool,
    /// Number of elements; the shape of an array without a known kind may have any.
    count: usize,
    /// Bytes of the header.
    end: usize,
}

fn wrong(entry: &Entry, found: &str, expected: &str) -> Error {
    let found = format!("{found} in {}", quoted(&entry.name));
    Error::Byte { offset: entry.offset, found, expected: expected.to_owned() }
}

impl Header {
    /// Reads the header from the first bytes of an entry, and compares the size of the entry with its shape.
    pub(super) fn read(bytes: &[u8], entry: &Entry) -> Result<Header, Error> {
        let no_array = || wrong(entry, "no header of an array", "a NumPy array of version 1, 2 or 3");
        let version = *bytes.strip_prefix(MAGIC).and_then(|rest| rest.first()).ok_or_else(no_array)?;
        let (start, length): (usize, usize) = match (version, bytes.get(8..12)) {
            (1, Some([a, b, ..])) => (10, usize::from(u16::from_le_bytes([*a, *b]))),
            (2 | 3, Some([a, b, c, d])) => {
                (12, usize::try_from(u32::from_le_bytes([*a, *b, *c, *d])).unwrap_or(usize::MAX))
            }
            _ => return Err(no_array()),
        };
        let end = start.checked_add(length).filter(|end| *end <= bytes.len()).ok_or_else(no_array)?;
        let header = String::from_utf8_lossy(&bytes[start..end]);
        let description = value(&header, "descr").unwrap_or_default();
        let expected = "descr, fortran_order and shape";
        let unreadable = || wrong(entry, &format!("the header {}", quoted(&header)), expected);
        let shape = shape(value(&header, "shape").ok_or_else(unreadable)?).ok_or_else(unreadable)?;
        let is_columns = value(&header, "fortran_order").ok_or_else(unreadable)?.starts_with("True");
        let count = shape.iter().try_fold(1_usize, |count, length| count.checked_mul(*length));
        let kind = kind(description);
        if let Some(kind) = kind {
            let bytes = entry.unpacked.saturating_sub(end);
            if count.and_then(|count| count.checked_mul(kind.bytes)) != Some(bytes) {
                let found = format!("{bytes} bytes of elements of the shape {shape:?}");
                return Err(wrong(entry, &found, "as many as the shape"));
            }
        }
        let description = description.trim_matches(['\'', '"']).to_owned();
        Ok(Header { shape, description, kind, is_columns, count: count.unwrap_or(0), end })
    }

    /// Number of elements that are read.
    pub(super) fn elements(&self) -> usize {
        if self.kind.is_some() { self.count } else { 0 }
    }

    /// The array without its elements.
    pub(super) fn without_elements(self) -> Array {
        let Header { shape, description, kind, .. } = self;
        let is_text = |kind: &Kind| matches!(kind.letter, 'S' | 'U');
        let data = match kind {
            Some(kind) if !is_text(&kind) => Data::Numbers(Vec::new()),
            Some(_) | None => Data::Other(description),
        };
        Array { shape, data }
    }

    /// The array with its elements, from all bytes of the entry.
    pub(super) fn read_elements(self, bytes: &[u8]) -> Array {
        let Header { shape, description, kind, is_columns, count, end } = self;
        let Some(kind) = kind else { return Array { shape, data: Data::Other(description) } };
        let elements = bytes.get(end..).unwrap_or_default().chunks_exact(kind.bytes);
        let data = match kind.letter {
            'S' | 'U' if elements.len() > MAX_TEXTS => Data::Other(description),
            'S' | 'U' => match (elements.map(|element| text(kind, element)).collect::<Vec<_>>(), count) {
                (mut one, 1) => Data::Text(one.pop().unwrap_or_default()),
                (texts, _) => Data::Texts { kind: description, texts: ordered(texts, &shape, is_columns) },
            },
            _ => Data::Numbers(ordered(elements.map(|element| number(kind, element)).collect(), &shape, is_columns)),
        };
        Array { shape, data }
    }
}

/// The text after `'key':` up to the comma that ends it.
fn value<'h>(header: &'h str, key: &str) -> Option<&'h str> {
    let at = header.find(&format!("'{key}'"))? + key.len() + 2;
    let rest = header[at..].trim_start().strip_prefix(':')?.trim_start();
    let end = match rest.starts_with(['(', '[']) {
        true => rest.find([')', ']'])? + 1,
        false => rest.find([',', '}'])?,
    };
    Some(rest[..end].trim())
}

fn shape(text: &str) -> Option<Vec<usize>> {
    let inner = text.strip_prefix('(')?.strip_suffix(')')?;
    inner.split(',').map(str::trim).filter(|part| !part.is_empty()).map(|part| part.parse().ok()).collect()
}

/// The kind of numbers or text; `None` for objects, structures and others.
fn kind(description: &str) -> Option<Kind> {
    let plain = description.strip_prefix(['\'', '"'])?.strip_suffix(['\'', '"'])?;
    let order = plain.chars().next().filter(|c| "<>|=".contains(*c));
    let rest = plain.trim_start_matches(['<', '>', '|', '=']);
    let letter = rest.chars().next()?;
    let size: usize = rest.get(1..)?.parse().ok()?;
    let bytes = if letter == 'U' { size.checked_mul(4)? } else { size };
    let is_known = match letter {
        'f' => matches!(size, 2 | 4 | 8),
        'i' | 'u' => matches!(size, 1 | 2 | 4 | 8),
        'b' => size == 1,
        'S' | 'U' => (1..=4096).contains(&size),
        _ => false,
    };
    is_known.then_some(Kind { letter, bytes, is_big: order == Some('>') })
}

fn number(kind: Kind, element: &[u8]) -> f64 {
    let mut eight = [0; 8];
    let bytes = &mut eight[..kind.bytes];
    bytes.copy_from_slice(element);
    if kind.is_big {
        bytes.reverse();
    }
    let unsigned = u64::from_le_bytes(eight);
    let unused = 64 - 8 * kind.bytes as u32;
    match (kind.letter, kind.bytes) {
        ('f', 8) => f64::from_bits(unsigned),
        ('f', 4) => f64::from(f32::from_bits(unsigned as u32)),
        ('f', _) => half(unsigned as u16),
        ('i', _) => ((unsigned << unused) as i64 >> unused) as f64,
        _ => unsigned as f64,
    }
}

/// A number of IEEE 754 in sixteen bits.
fn half(bits: u16) -> f64 {
    let sign = if bits >> 15 == 1 { -1.0 } else { 1.0 };
    let (exponent, fraction) = (i32::from(bits >> 10 & 31), f64::from(bits & 1023) / 1024.0);
    sign * match exponent {
        0 => fraction * 2.0_f64.powi(-14),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        _ => (1.0 + fraction) * 2.0_f64.powi(exponent - 15),
    }
}

/// A text without the zeros that fill it up.
fn text(kind: Kind, element: &[u8]) -> String {
    if kind.letter == 'S' {
        return String::from_utf8_lossy(element).trim_end_matches('\0').to_owned();
    }
    let letter = |four: &[u8]| {
        let mut four = [four[0], four[1], four[2], four[3]];
        if kind.is_big {
            four.reverse();
        }
        char::from_u32(u32::from_le_bytes(four)).unwrap_or(char::REPLACEMENT_CHARACTER)
    };
    element.chunks_exact(4).map(letter).collect::<String>().trim_end_matches('\0').to_owned()
}

/// Elements with their last axis first; `is_columns` if their first axis runs first.
fn ordered<T: Clone>(elements: Vec<T>, shape: &[usize], is_columns: bool) -> Vec<T> {
    if !is_columns {
        return elements;
    }
    let mut index = vec![0; shape.len()];
    let mut rows = Vec::with_capacity(elements.len());
    for _ in 0..elements.len() {
        let place = index.iter().zip(shape).rev().fold(0, |place, (i, length)| place * length + i);
        rows.push(elements[place].clone());
        for axis in (0..shape.len()).rev() {
            index[axis] += 1;
            if index[axis] < shape[axis] {
                break;
            }
            index[axis] = 0;
        }
    }
    rows
}

pub(super) fn write(name: &str, array: &Array) -> Result<Vec<u8>, Error> {
    let refused = |found: String, expected: &str| Err(Error::Record { found, expected: expected.to_owned() });
    let (description, elements): (String, Vec<u8>) = match &array.data {
        Data::Numbers(numbers) => ("<f8".to_owned(), numbers.iter().flat_map(|number| number.to_le_bytes()).collect()),
        Data::Text(text) => {
            let letters: Vec<u8> = text.chars().flat_map(|letter| (letter as u32).to_le_bytes()).collect();
            (format!("<U{}", letters.len() / 4), letters)
        }
        Data::Texts { kind, .. } | Data::Other(kind) => {
            return refused(format!("`{name}` of the type `{kind}`"), "numbers or a text");
        }
    };
    let count = array.shape.iter().try_fold(1_usize, |count, length| count.checked_mul(*length));
    let is_whole = match &array.data {
        Data::Numbers(numbers) => count == Some(numbers.len()),
        _ => count == Some(1) && !elements.is_empty(),
    };
    if !is_whole {
        return refused(format!("`{name}` of the shape {:?} with other elements", array.shape), "as many as the shape");
    }
    let lengths: String = array.shape.iter().map(|length| format!("{length},")).collect();
    let mut header = format!("{{'descr': '{description}', 'fortran_order': False, 'shape': ({lengths}), }}");
    let used = MAGIC.len() + 4 + header.len() + 1;
    header += &" ".repeat(used.next_multiple_of(ALIGNED) - used);
    header.push('\n');
    let Ok(length) = u16::try_from(header.len()) else {
        return refused(format!("`{name}` with {} axes", array.shape.len()), "fewer axes");
    };
    Ok([MAGIC, &[1, 0], &length.to_le_bytes(), header.as_bytes(), &elements].concat())
}
