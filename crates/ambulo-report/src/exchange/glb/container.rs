//! The container of a `.glb` file: a header and two chunks, JSON and numbers, each of a multiple of four bytes.

use serde_json::Value;

const MAGIC: &[u8; 4] = b"glTF";
const VERSION: u32 = 2;
const JSON: &[u8; 4] = b"JSON";
const BINARY: &[u8; 4] = b"BIN\0";

/// The whole file.
pub(super) fn file(document: &Value, numbers: &[u8]) -> Result<Vec<u8>, serde_json::Error> {
    let mut text = serde_json::to_vec(document)?;
    pad(&mut text, b' ');
    let mut numbers = numbers.to_vec();
    pad(&mut numbers, 0);
    let length = 12 + 8 + text.len() + 8 + numbers.len();
    let mut file = Vec::with_capacity(length);
    file.extend(MAGIC);
    file.extend(VERSION.to_le_bytes());
    file.extend(size(length));
    for (kind, bytes) in [(JSON, text), (BINARY, numbers)] {
        file.extend(size(bytes.len()));
        file.extend(kind);
        file.extend(bytes);
    }
    Ok(file)
}

fn pad(bytes: &mut Vec<u8>, filler: u8) {
    bytes.resize(bytes.len().next_multiple_of(4), filler);
}

/// Four gigabytes are not reached: instants and shapes are bounded where they are read.
fn size(length: usize) -> [u8; 4] {
    u32::try_from(length).unwrap_or(u32::MAX).to_le_bytes()
}
