//! The first block of the file: 256 words of 16 bits.
//!
//! | words (from 1) | content |
//! |---|---|
//! | 1 | block of the parameter section; key 0x50 |
//! | 2, 3 | points; analog values per frame, all channels and samples together |
//! | 4, 5 | first and last frame, unsigned |
//! | 6 | longest gap that was filled, in frames |
//! | 7-8 | scale of integer points; negative: the data are reals |
//! | 9, 10 | block of the data; analog samples per channel and frame |
//! | 11-12 | frames per second |
//! | 150-234 | events: key 12345, count, times, flags, labels (see `events`) |
//!
//! Source: C3D user guide (c3d.org), "The header section".

use super::words::{Processor, Words};
use crate::error::Error;

/// Bytes of a block. The header is one block; each other part begins at a block.
pub(super) const BLOCK: usize = 512;
/// Second byte of every C3D file.
pub(super) const KEY: u8 = 0x50;

/// The header's numbers, as in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Header {
    pub(super) points: u16,
    pub(super) analog_words: u16,
    pub(super) first_frame: u16,
    pub(super) last_frame: u16,
    pub(super) longest_gap: u16,
    pub(super) scale: f32,
    pub(super) data_block: u16,
    pub(super) samples_per_frame: u16,
    pub(super) rate_hz: f32,
}

/// Byte at which the parameter section begins.
pub(super) fn parameter_offset(bytes: &[u8]) -> Result<usize, Error> {
    if bytes.is_empty() {
        return Err(Error::Empty { expected: "a C3D file, whose second byte is the key 80 (0x50)" });
    }
    let key = bytes.get(1).copied();
    if key != Some(KEY) {
        let found = key.map_or_else(|| "one byte".to_owned(), |key| format!("key {key}"));
        let expected = "the key 80 (0x50) of a C3D file; the file may have another format".to_owned();
        return Err(Error::Byte { offset: 1, found, expected });
    }
    if bytes.len() < BLOCK {
        let expected = format!("a header of {BLOCK} bytes");
        return Err(Error::CutOff { offset: bytes.len(), expected });
    }
    match bytes[0] {
        0 | 1 => Err(Error::Byte {
            offset: 0,
            found: format!("parameter section in block {}", bytes[0]),
            expected: "block 2 or later, after the header".into(),
        }),
        block => Ok((usize::from(block) - 1) * BLOCK),
    }
}

impl Header {
    /// Reads the first block.
    pub(super) fn read(words: Words<'_>) -> Result<Header, Error> {
        let offset = words.bytes.len();
        let cut = || Error::CutOff { offset, expected: format!("a header of {BLOCK} bytes") };
        let word = |number: usize| words.u16(2 * (number - 1)).ok_or_else(cut);
        let real = |number: usize| words.f32(2 * (number - 1)).ok_or_else(cut);
        Ok(Header {
            points: word(2)?,
            analog_words: word(3)?,
            first_frame: word(4)?,
            last_frame: word(5)?,
            longest_gap: word(6)?,
            scale: real(7)?,
            data_block: word(9)?,
            samples_per_frame: word(10)?,
            rate_hz: real(11)?,
        })
    }

    /// Frames from first to last; `None` if they are in the wrong order.
    pub(super) fn frames(&self) -> Option<usize> {
        (usize::from(self.last_frame) + 1).checked_sub(usize::from(self.first_frame))
    }

    /// The first block's words 1 to 12, the rest zero.
    pub(super) fn write(&self, parameter_block: u8, processor: Processor) -> Option<Vec<u8>> {
        let mut bytes = vec![0; BLOCK];
        bytes[..2].copy_from_slice(&[parameter_block, KEY]);
        let words = [self.points, self.analog_words, self.first_frame, self.last_frame, self.longest_gap];
        for (word, slot) in words.into_iter().zip(bytes[2..12].chunks_exact_mut(2)) {
            slot.copy_from_slice(&processor.u16_bytes(word));
        }
        bytes[12..16].copy_from_slice(&processor.f32_bytes(self.scale)?);
        bytes[16..18].copy_from_slice(&processor.u16_bytes(self.data_block));
        bytes[18..20].copy_from_slice(&processor.u16_bytes(self.samples_per_frame));
        bytes[20..24].copy_from_slice(&processor.f32_bytes(self.rate_hz)?);
        Some(bytes)
    }
}
