//! The numbers of a page, read back as the viewer does.

use ambulo_report::page::Block;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;

/// The value that marks a gap.
const NONE: u16 = 65_535;

fn decode(text: &str) -> Vec<u16> {
    let bytes = miniz_oxide::inflate::decompress_to_vec_zlib(&STANDARD.decode(text).unwrap()).unwrap();
    let (low, high) = bytes.split_at(bytes.len() / 2);
    let mut last = 0_u16;
    low.iter()
        .zip(high)
        .map(|(&low, &high)| {
            last = last.wrapping_add(u16::from_le_bytes([low, high]));
            last
        })
        .collect()
}

#[test]
fn numbers_come_back_within_half_a_step() {
    let curve: Vec<f64> = (0..500).map(|i| 700.0 * (0.1 * f64::from(i)).sin() - 3.0).collect();
    let mut block = Block::default();
    let before = block.add(&[1.0, f64::NAN, 3.0]);
    let series = block.add(&curve);
    let constant = block.add(&[2.5; 4]);
    let numbers = decode(&block.encode());
    assert_eq!((before.at, series.at, constant.at, numbers.len()), (0, 3, 503, 507));
    assert_eq!(numbers[1], NONE);
    for (x, &q) in curve.iter().zip(&numbers[3..503]) {
        assert!((series.low + series.step * f64::from(q) - x).abs() <= 0.5 * series.step * (1.0 + 1e-9));
    }
    assert!(constant.step.abs() < f64::MIN_POSITIVE && (constant.low - 2.5).abs() < 1e-15);
}

#[test]
fn nothing_finite_is_all_gaps() {
    let mut block = Block::default();
    let series = block.add(&[f64::NAN, f64::INFINITY]);
    assert!(series.low.is_finite() && series.step.is_finite());
    assert_eq!(decode(&block.encode()), [NONE, NONE]);
}
