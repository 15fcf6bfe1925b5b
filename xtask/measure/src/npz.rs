//! Reads NumPy `.npz` archives: a ZIP file of `.npy` arrays, stored or deflated.
//!
//! The reference data of other engines (`frames.npz`, `tau_pinocchio.npz`) have this format; see `peers`.
//!
//! | code      | meaning                                                                     |
//! |-----------|-----------------------------------------------------------------------------|
//! | `descr`   | NumPy's name of the element type: `<f8` is a little-endian 8-byte float     |
//! | `fortran` | true when the file contains columns one after the other (last index slowest)   |
//! | `shape`   | length of each dimension; empty for a single value                          |
//!
//! Source: NumPy Enhancement Proposal 1 and `numpy/lib/format.py` (versions 1.0, 2.0, 3.0 of the header).
//! Not handled: big-endian, complex, structured and object arrays. Each is an error that names the type found.

use std::collections::BTreeMap;
use std::fs::File;
use std::io::Read;
use std::path::Path;

/// First six bytes of every `.npy` file.
const MAGIC: &[u8] = b"\x93NUMPY";

/// One array of the archive. The values are in row-major order (last index fastest), whatever the file had.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Array {
    /// Length of each dimension.
    pub(crate) shape: Vec<usize>,
    /// The elements, `shape.iter().product()` of them.
    pub(crate) values: Values,
}

/// Elements of an [`Array`].
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Values {
    /// Floating-point and whole numbers, as `f64`.
    Numbers(Vec<f64>),
    /// Unicode strings (`<U..`), without the padding NumPy stores.
    Text(Vec<String>),
}

impl Array {
    /// The numbers, or an error that states the array holds text.
    pub(crate) fn numbers(&self) -> Result<&[f64], String> {
        match &self.values {
            Values::Numbers(numbers) => Ok(numbers),
            Values::Text(_) => Err("holds text, expected numbers".to_owned()),
        }
    }

    /// The strings, or an error that states the array holds numbers.
    pub(crate) fn text(&self) -> Result<&[String], String> {
        match &self.values {
            Values::Text(text) => Ok(text),
            Values::Numbers(_) => Err("holds numbers, expected text".to_owned()),
        }
    }
}

/// Every array of the archive at `path`, by name without `.npy`.
pub(crate) fn read(path: &Path) -> Result<BTreeMap<String, Array>, String> {
    let at = path.display();
    let file = File::open(path).map_err(|e| format!("{at}: cannot open: {e}"))?;
    let mut archive = zip::ZipArchive::new(file).map_err(|e| format!("{at}: not a ZIP (.npz) archive: {e}"))?;
    let mut arrays = BTreeMap::new();
    for i in 0..archive.len() {
        let mut member = archive.by_index(i).map_err(|e| format!("{at}: member {i}: {e}"))?;
        let name = member.name().map_err(|e| format!("{at}: member {i}: {e}"))?;
        let name = name.strip_suffix(".npy").unwrap_or(&name).to_owned();
        let mut bytes = Vec::new();
        member.read_to_end(&mut bytes).map_err(|e| format!("{at}: array `{name}`: cannot read: {e}"))?;
        let array = parse_npy(&bytes).map_err(|e| format!("{at}: array `{name}`: {e}"))?;
        arrays.insert(name, array);
    }
    Ok(arrays)
}

/// One `.npy` file: magic, version, header length, header (a Python dictionary as text), elements.
fn parse_npy(bytes: &[u8]) -> Result<Array, String> {
    let (header, data) = split_header(bytes)?;
    let descr = quoted(value_of(header, "descr")?)?;
    let fortran = value_of(header, "fortran_order")?.starts_with("True");
    let shape = parse_shape(value_of(header, "shape")?)?;
    let count = shape.iter().try_fold(1_usize, |product, &n| product.checked_mul(n));
    let count = count.ok_or_else(|| format!("shape {shape:?} has more elements than can be counted"))?;
    let values = match parse_values(descr, data, count)? {
        Values::Numbers(v) => Values::Numbers(row_major(v, &shape, fortran)),
        Values::Text(v) => Values::Text(row_major(v, &shape, fortran)),
    };
    Ok(Array { shape, values })
}

/// The header text and the bytes after it.
fn split_header(bytes: &[u8]) -> Result<(&str, &[u8]), String> {
    let rest = bytes.strip_prefix(MAGIC).ok_or("not a .npy array: it does not begin with \\x93NUMPY")?;
    let (length, rest) = match *rest {
        [1, _, a, b, ref rest @ ..] => (usize::from(u16::from_le_bytes([a, b])), rest),
        [2 | 3, _, a, b, c, d, ref rest @ ..] => (u32::from_le_bytes([a, b, c, d]) as usize, rest),
        [major, minor, ..] if !(1..=3).contains(&major) => {
            return Err(format!("format version {major}.{minor}, expected 1, 2 or 3"));
        }
        _ => return Err("ends inside the header".to_owned()),
    };
    let (header, data) = rest.split_at_checked(length).ok_or("ends inside the header")?;
    let header = std::str::from_utf8(header).map_err(|e| format!("the header is not UTF-8 text: {e}"))?;
    Ok((header, data))
}

/// Text behind `'key':` in the header's dictionary, up to its end.
fn value_of<'h>(header: &'h str, key: &str) -> Result<&'h str, String> {
    let quoted_key = format!("'{key}':");
    let found =
        header.split_once(&quoted_key).ok_or_else(|| format!("the header has no {quoted_key} in {header:?}"))?;
    Ok(found.1.trim_start())
}

/// The text between the quotes that `value` begins with.
fn quoted(value: &str) -> Result<&str, String> {
    let inside = value.strip_prefix('\'').and_then(|v| v.split_once('\''));
    inside.map(|(text, _)| text).ok_or_else(|| "the element type is structured, expected one plain type".to_owned())
}

/// `(1000, 31)`, `(31,)` or `()` at the beginning of `value`.
fn parse_shape(value: &str) -> Result<Vec<usize>, String> {
    let inside = value.strip_prefix('(').and_then(|v| v.split_once(')'));
    let (inside, _) = inside.ok_or_else(|| format!("the shape is not a tuple: {value:?}"))?;
    let lengths = inside.split(',').map(str::trim).filter(|n| !n.is_empty());
    lengths.map(|n| n.parse().map_err(|e| format!("shape ({inside}): `{n}`: {e}"))).collect()
}

/// `count` elements of type `descr`.
fn parse_values(descr: &str, data: &[u8], count: usize) -> Result<Values, String> {
    Ok(match descr {
        "<f8" => Values::Numbers(fixed(data, count, f64::from_le_bytes)?),
        "<f4" => Values::Numbers(fixed(data, count, |b| f64::from(f32::from_le_bytes(b)))?),
        "<i8" => Values::Numbers(fixed(data, count, |b| i64::from_le_bytes(b) as f64)?),
        "<i4" => Values::Numbers(fixed(data, count, |b| f64::from(i32::from_le_bytes(b)))?),
        _ => match descr.strip_prefix("<U").and_then(|n| n.parse().ok()) {
            Some(length) => Values::Text(strings(data, count, length)?),
            None => return Err(format!("element type `{descr}`, expected <f8, <f4, <i8, <i4 or <U..")),
        },
    })
}

/// `count` elements of `N` bytes each.
fn fixed<const N: usize>(data: &[u8], count: usize, decode: impl Fn([u8; N]) -> f64) -> Result<Vec<f64>, String> {
    check_length(data, count, N)?;
    Ok(data.as_chunks::<N>().0.iter().map(|bytes| decode(*bytes)).collect())
}

/// `count` strings of `length` code points of 4 bytes; shorter ones are padded with zeros at the end.
fn strings(data: &[u8], count: usize, length: usize) -> Result<Vec<String>, String> {
    let size = length.checked_mul(4).ok_or_else(|| format!("strings of {length} characters are too long"))?;
    check_length(data, count, size)?;
    if size == 0 {
        return Ok(vec![String::new(); count]);
    }
    data.chunks_exact(size)
        .enumerate()
        .map(|(i, bytes)| string(bytes).map_err(|e| format!("string {i}: {e}")))
        .collect()
}

fn string(bytes: &[u8]) -> Result<String, String> {
    let text: Result<String, String> = (bytes.as_chunks::<4>().0.iter())
        .map(|code| u32::from_le_bytes(*code))
        .map(|code| char::from_u32(code).ok_or_else(|| format!("{code:#x} is not a Unicode character")))
        .collect();
    text.map(|t| t.trim_end_matches('\0').to_owned())
}

fn check_length(data: &[u8], count: usize, size: usize) -> Result<(), String> {
    match count.checked_mul(size) {
        Some(expected) if expected == data.len() => Ok(()),
        _ => Err(format!("{} bytes of data, expected {count} elements of {size} bytes", data.len())),
    }
}

/// Reorders column-major `values` so that the last index runs fastest.
fn row_major<T: Clone>(values: Vec<T>, shape: &[usize], fortran: bool) -> Vec<T> {
    if !fortran || shape.len() < 2 {
        return values;
    }
    (0..values.len()).map(|i| values[column_major_offset(i, shape)].clone()).collect()
}

/// Position in a column-major file of the element with index `row_major` in row-major order.
fn column_major_offset(row_major: usize, shape: &[usize]) -> usize {
    let (mut left, mut index) = (row_major, vec![0; shape.len()]);
    for axis in (0..shape.len()).rev() {
        index[axis] = left % shape[axis];
        left /= shape[axis];
    }
    index.iter().zip(shape).rev().fold(0, |offset, (i, n)| offset * n + i)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::Write;
    use std::path::PathBuf;
    use zip::CompressionMethod::{Deflated, Stored};

    fn npy(descr: &str, fortran: &str, shape: &str, data: &[u8]) -> Vec<u8> {
        let header = format!("{{'descr': '{descr}', 'fortran_order': {fortran}, 'shape': {shape}, }}\n");
        let length = u16::try_from(header.len()).unwrap().to_le_bytes();
        [MAGIC, &[1, 0], &length, header.as_bytes(), data].concat()
    }

    fn floats(values: &[f64]) -> Vec<u8> {
        values.iter().flat_map(|v| v.to_le_bytes()).collect()
    }

    fn archive(file: &str, method: zip::CompressionMethod, members: &[(&str, Vec<u8>)]) -> PathBuf {
        let path = std::env::temp_dir().join(format!("xtask-npz-{}-{file}", std::process::id()));
        let mut writer = zip::ZipWriter::new(File::create(&path).unwrap());
        for (name, bytes) in members {
            writer.start_file(*name, zip::write::SimpleFileOptions::default().compression_method(method)).unwrap();
            writer.write_all(bytes).unwrap();
        }
        writer.finish().unwrap();
        path
    }

    #[test]
    fn stored_and_deflated_archives_give_the_same_arrays() {
        let q = npy("<f8", "False", "(2, 3)", &floats(&[1.0, 2.0, 3.0, 4.0, 5.0, -6.5]));
        let names: Vec<u8> = "hip\0kneé".chars().flat_map(|c| u32::from(c).to_le_bytes()).collect();
        let members = [("q.npy", q), ("names.npy", npy("<U4", "False", "(2,)", &names))];
        for (file, method) in [("stored.npz", Stored), ("deflated.npz", Deflated)] {
            let path = archive(file, method, &members);
            let arrays = read(&path).unwrap();
            std::fs::remove_file(path).unwrap();
            assert_eq!(arrays["q"].shape, [2, 3]);
            assert_eq!(arrays["q"].numbers().unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, -6.5]);
            assert_eq!(arrays["names"].text().unwrap(), ["hip", "kneé"]);
            assert_eq!(arrays["q"].text().unwrap_err(), "holds numbers, expected text");
        }
    }

    #[test]
    fn column_major_files_come_out_row_major() {
        let array = parse_npy(&npy("<f8", "True", "(2, 3)", &floats(&[1.0, 4.0, 2.0, 5.0, 3.0, 6.0]))).unwrap();
        assert_eq!(array.numbers().unwrap(), [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        let cube: Vec<f64> = (0..24_u8).map(f64::from).collect();
        let array = parse_npy(&npy("<f8", "True", "(2, 3, 4)", &floats(&cube))).unwrap();
        let at = |i: usize, j: usize, k: usize| array.numbers().unwrap()[(i * 3 + j) * 4 + k];
        for (i, j, k) in [(0, 0, 0), (1, 0, 0), (0, 2, 1), (1, 2, 3)] {
            assert!((at(i, j, k) - cube[i + 2 * (j + 3 * k)]).abs() < f64::EPSILON);
        }
    }

    #[test]
    fn whole_numbers_single_values_and_empty_arrays_are_read() {
        let four = parse_npy(&npy("<i4", "False", "()", &4_i32.to_le_bytes())).unwrap();
        assert_eq!((four.shape.len(), four.numbers().unwrap()), (0, &[4.0][..]));
        assert!(parse_npy(&npy("<f8", "True", "(0, 3)", &[])).unwrap().numbers().unwrap().is_empty());
    }

    #[test]
    fn errors_name_what_was_found_and_what_was_expected() {
        let message = |bytes: &[u8]| parse_npy(bytes).unwrap_err();
        let q = npy("<f8", "False", "(2,)", &floats(&[1.0, 2.0]));
        assert_eq!(message(&q[..q.len() - 1]), "15 bytes of data, expected 2 elements of 8 bytes");
        assert_eq!(message(&q[..20]), "ends inside the header");
        assert_eq!(message(b"PK"), "not a .npy array: it does not begin with \\x93NUMPY");
        assert_eq!(message(b"\x93NUMPY\x07\x00\x00\x00"), "format version 7.0, expected 1, 2 or 3");
        let complex = npy("<c16", "False", "(1,)", &[0; 16]);
        assert_eq!(message(&complex), "element type `<c16`, expected <f8, <f4, <i8, <i4 or <U..");
        let huge = npy("<f8", "False", "(18446744073709551615, 3)", &[]);
        assert_eq!(message(&huge), "shape [18446744073709551615, 3] has more elements than can be counted");
        let bad = npy("<U1", "False", "(1,)", &0xD800_u32.to_le_bytes());
        assert_eq!(message(&bad), "string 0: 0xd800 is not a Unicode character");
    }

    #[test]
    fn every_truncation_is_an_error_and_never_a_panic() {
        let q = npy("<f8", "True", "(2, 2)", &floats(&[1.0, 2.0, 3.0, 4.0]));
        for end in 0..q.len() {
            assert!(parse_npy(&q[..end]).is_err(), "first {end} bytes were accepted");
        }
    }

    #[test]
    fn files_that_are_no_archive_are_named() {
        let path = std::env::temp_dir().join(format!("xtask-npz-{}-none.npz", std::process::id()));
        std::fs::write(&path, "time\tknee\n").unwrap();
        let message = read(&path).unwrap_err();
        std::fs::remove_file(&path).unwrap();
        assert!(message.contains("none.npz: not a ZIP (.npz) archive"), "{message}");
        assert!(read(&path).unwrap_err().contains("cannot open"));
    }
}
