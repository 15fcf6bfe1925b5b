//! Stores the series of numbers of a page: quantised to 16 bits, coded as differences, compressed.
//!
//! The number x becomes q = round((x - low) / step) with step = (high - low) / 65534, so that the drawn value differs
//! from x by half a step at most. 65535 marks a gap. Differences of neighbouring q (modulo 65536, over all series in
//! turn) are written as bytes, the low ones of all numbers before the high ones, which compress better than pairs; zlib
//! (RFC 1950), then base64.

use super::contract::Series;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// Largest q that encodes a number.
const HIGHEST: u16 = 65_534;
/// The value of q that marks a gap.
const NONE: u16 = 65_535;
/// Compression level of zlib, 0 to 10: higher levels shrink files by less than 1 %.
const LEVEL: u8 = 8;

/// Collects the numbers of a page.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Block {
    numbers: Vec<u16>,
}

impl Block {
    /// Adds a series; values that are not finite become gaps.
    pub fn add(&mut self, values: &[f64]) -> Series {
        let finite = values.iter().copied().filter(|x| x.is_finite());
        let (low, high) = finite.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        let low = if low.is_finite() { low } else { 0.0 };
        let step = if high > low { (high - low) / f64::from(HIGHEST) } else { 0.0 };
        let at = self.numbers.len();
        self.numbers.extend(values.iter().map(|&x| quantised(x, low, step)));
        Series { at, count: values.len(), low, step }
    }

    /// The block as base64 text.
    #[doc(hidden)] // for tests
    #[must_use]
    pub fn encode(&self) -> String {
        let mut last = 0_u16;
        let differences: Vec<[u8; 2]> = self
            .numbers
            .iter()
            .map(|&q| {
                let difference = q.wrapping_sub(last);
                last = q;
                difference.to_le_bytes()
            })
            .collect();
        let planes = [0, 1].into_iter().flat_map(|plane| differences.iter().map(move |pair| pair[plane]));
        STANDARD.encode(miniz_oxide::deflate::compress_to_vec_zlib(&planes.collect::<Vec<u8>>(), LEVEL))
    }
}

fn quantised(x: f64, low: f64, step: f64) -> u16 {
    match x.is_finite() {
        false => NONE,
        true if step > 0.0 => (((x - low) / step).round() as u16).min(HIGHEST),
        true => 0,
    }
}
