//! The archive: a list of its entries at its end, each with the place of its bytes.

use super::{MAX_ENTRIES, MAX_UNPACKED};
use crate::error::{Error, quoted};
use miniz_oxide::inflate::decompress_to_vec_with_limit;

const LOCAL: [u8; 4] = *b"PK\x03\x04";
const CENTRAL: [u8; 4] = *b"PK\x01\x02";
const END: [u8; 4] = *b"PK\x05\x06";
/// Bytes of these records without their names.
const LOCAL_BYTES: usize = 30;
const CENTRAL_BYTES: usize = 46;
const END_BYTES: usize = 22;
/// Longest comment after the last record.
const MAX_COMMENT: usize = 0xffff;
const STORED: u16 = 0;
const DEFLATED: u16 = 8;

/// A file in the archive.
#[derive(Debug)]
pub(super) struct Entry {
    pub(super) name: String,
    method: u16,
    crc: u32,
    packed: usize,
    pub(super) unpacked: usize,
    /// Place of its local record.
    pub(super) offset: usize,
}

/// A required part of the bytes.
fn part(bytes: &[u8], offset: usize, count: usize) -> Result<&[u8], Error> {
    offset
        .checked_add(count)
        .and_then(|end| bytes.get(offset..end))
        .ok_or_else(|| Error::CutOff { offset: bytes.len(), expected: format!("{count} bytes from byte {offset}") })
}

fn u16_at(bytes: &[u8], at: usize) -> u16 {
    u16::from_le_bytes([bytes[at], bytes[at + 1]])
}

fn u32_at(bytes: &[u8], at: usize) -> u32 {
    u32::from_le_bytes([bytes[at], bytes[at + 1], bytes[at + 2], bytes[at + 3]])
}

fn size_at(bytes: &[u8], at: usize) -> usize {
    usize::try_from(u32_at(bytes, at)).unwrap_or(usize::MAX)
}

/// The entries of the archive.
pub(super) fn entries(bytes: &[u8]) -> Result<Vec<Entry>, Error> {
    const EXPECTED: &str = "a ZIP archive of NumPy arrays (.npz)";
    if bytes.is_empty() {
        return Err(Error::Empty { expected: EXPECTED });
    }
    if bytes.get(..4) != Some(&LOCAL) && bytes.get(..4) != Some(&END) {
        let found = bytes.iter().take(4).map(|byte| format!("{byte:02x}")).collect::<Vec<_>>().join(" ");
        return Err(Error::Byte { offset: 0, found: format!("the bytes {found}"), expected: EXPECTED.to_owned() });
    }
    let first = bytes.len().saturating_sub(END_BYTES + MAX_COMMENT);
    let end = (first..=bytes.len().saturating_sub(END_BYTES)).rev().find(|at| bytes[*at..].starts_with(&END));
    let end = end.ok_or_else(|| Error::CutOff { offset: bytes.len(), expected: "the list of entries".to_owned() })?;
    let record = part(bytes, end, END_BYTES)?;
    let (count, mut offset) = (usize::from(u16_at(record, 10)), size_at(record, 16));
    if count > MAX_ENTRIES {
        let found = format!("{count} entries");
        return Err(Error::Byte { offset: end, found, expected: format!("at most {MAX_ENTRIES}") });
    }
    let mut found = Vec::new();
    let mut total = 0_usize;
    for _ in 0..count {
        let record = part(bytes, offset, CENTRAL_BYTES)?;
        if record[..4] != CENTRAL {
            let expected = "a record of the list of entries. Is the file damaged?".to_owned();
            return Err(Error::Byte { offset, found: format!("{:02x?}", &record[..4]), expected });
        }
        let [name, extra, comment] = [28, 30, 32].map(|at| usize::from(u16_at(record, at)));
        let text = part(bytes, offset + CENTRAL_BYTES, name)?;
        let entry = Entry {
            name: String::from_utf8_lossy(text).into_owned(),
            method: u16_at(record, 10),
            crc: u32_at(record, 16),
            packed: size_at(record, 20),
            unpacked: size_at(record, 24),
            offset: size_at(record, 42),
        };
        total = total.saturating_add(entry.unpacked);
        if total > MAX_UNPACKED {
            let found = format!("{total} bytes when `{}` is unpacked", entry.name);
            return Err(Error::Byte { offset, found, expected: format!("at most {MAX_UNPACKED}") });
        }
        offset += CENTRAL_BYTES + name + extra + comment;
        found.push(entry);
    }
    Ok(found)
}

/// The first unpacked bytes of an entry: at most `count`.
pub(super) fn beginning(bytes: &[u8], entry: &Entry, count: usize) -> Result<Vec<u8>, Error> {
    let packed = packed(bytes, entry)?;
    match entry.method {
        DEFLATED => {
            Ok(decompress_to_vec_with_limit(packed, count.min(entry.unpacked)).unwrap_or_else(|cut| cut.output))
        }
        _ => Ok(packed[..packed.len().min(count)].to_vec()),
    }
}

/// The unpacked bytes of an entry.
pub(super) fn content(bytes: &[u8], entry: &Entry) -> Result<Vec<u8>, Error> {
    let packed = packed(bytes, entry)?;
    let unpacked = match entry.method {
        DEFLATED => decompress_to_vec_with_limit(packed, entry.unpacked)
            .map_err(|e| wrong(entry, format!("{e}"), "deflated bytes. Is the file damaged?"))?,
        _ => packed.to_vec(),
    };
    if unpacked.len() != entry.unpacked || crc32(&unpacked) != entry.crc {
        let found = "bytes with another length or checksum".to_owned();
        return Err(wrong(entry, found, "those of the list. Is the file damaged?"));
    }
    Ok(unpacked)
}

fn wrong(entry: &Entry, found: String, expected: &str) -> Error {
    let found = format!("{found} in {}", quoted(&entry.name));
    Error::Byte { offset: entry.offset, found, expected: expected.to_owned() }
}

/// The packed bytes of an entry.
fn packed<'b>(bytes: &'b [u8], entry: &Entry) -> Result<&'b [u8], Error> {
    let record = part(bytes, entry.offset, LOCAL_BYTES)?;
    if record[..4] != LOCAL {
        return Err(wrong(entry, "no record of an entry".to_owned(), "the entry of the list. Is the file damaged?"));
    }
    if u16_at(record, 6) & 1 == 1 {
        return Err(wrong(entry, "encrypted bytes".to_owned(), "an archive without a password"));
    }
    let start = entry.offset + LOCAL_BYTES + usize::from(u16_at(record, 26)) + usize::from(u16_at(record, 28));
    match entry.method {
        STORED | DEFLATED => part(bytes, start, entry.packed),
        other => Err(wrong(entry, format!("compression by method {other}"), "stored or deflated bytes")),
    }
}

/// An archive of stored files.
pub(super) fn write(files: &[(String, Vec<u8>)]) -> Result<Vec<u8>, Error> {
    let too_large = || Error::Record { found: "more than 4 GB".to_owned(), expected: "a smaller archive".to_owned() };
    let size = |bytes: usize| u32::try_from(bytes).map_err(|_| too_large());
    let (mut out, mut list) = (Vec::new(), Vec::new());
    for (name, content) in files {
        let offset = size(out.len())?;
        let name_length = u16::try_from(name.len()).map_err(|_| too_large())?;
        // Version 2.0, no flags, stored, no time.
        let mut common = vec![20, 0, 0, 0, 0, 0, 0, 0, 0, 0];
        for number in [crc32(content), size(content.len())?, size(content.len())?] {
            common.extend(number.to_le_bytes());
        }
        common.extend(name_length.to_le_bytes());
        common.extend([0, 0]);
        out.extend(LOCAL.iter().chain(&common).chain(name.as_bytes()).chain(content));
        list.extend(CENTRAL.iter().chain(&[20, 0]).chain(&common).chain(&[0; 10]));
        list.extend(offset.to_le_bytes().iter().chain(name.as_bytes()));
    }
    let count = u16::try_from(files.len()).map_err(|_| too_large())?.to_le_bytes();
    let (offset, length) = (size(out.len())?, size(list.len())?);
    out.extend(list.iter().chain(&END).chain(&[0; 4]).chain(&count).chain(&count));
    out.extend(length.to_le_bytes().iter().chain(&offset.to_le_bytes()).chain(&[0, 0]));
    Ok(out)
}

/// The checksum of ZIP: CRC-32 with the polynomial 0xEDB88320.
fn crc32(bytes: &[u8]) -> u32 {
    const TABLE: [u32; 256] = {
        let mut table = [0; 256];
        let mut k = 0;
        while k < 256 {
            let (mut value, mut bit) = (k as u32, 0);
            while bit < 8 {
                value = if value & 1 == 1 { 0xedb8_8320 ^ (value >> 1) } else { value >> 1 };
                bit += 1;
            }
            table[k] = value;
            k += 1;
        }
        table
    };
    !bytes.iter().fold(!0, |crc: u32, byte| TABLE[usize::from(crc as u8 ^ byte)] ^ (crc >> 8))
}
