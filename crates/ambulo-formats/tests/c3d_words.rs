//! Numbers as each kind of processor writes them.

use ambulo_formats::c3d::Processor;
use ambulo_formats::internals::{real, real_bytes, word};

#[test]
fn one_and_a_half_as_each_processor_writes_it() {
    // VAX: 1.5 = 0.75 * 2^1, exponent 129, significand field 0x400000: 0x40C00000, words swapped.
    let vax = [0xC0, 0x40, 0x00, 0x00];
    assert_eq!(real(Processor::Dec, vax).to_bits(), 1.5f32.to_bits());
    assert_eq!(real_bytes(Processor::Dec, 1.5), Some(vax));
    assert_eq!(real(Processor::Sgi, [0x3F, 0xC0, 0, 0]).to_bits(), 1.5f32.to_bits());
    assert_eq!(real(Processor::Intel, [0, 0, 0xC0, 0x3F]).to_bits(), 1.5f32.to_bits());
    assert_eq!(word(Processor::Sgi, [1, 2]), 258);
    assert_eq!(word(Processor::Dec, [1, 2]), 513);
}

#[test]
fn every_processor_reads_what_it_wrote() {
    for processor in Processor::ALL {
        for value in [0.0, 1.0, -1.0, 0.1, -83.25, 1e-30, 65535.0, 8.5e37, f32::MIN_POSITIVE, f32::MIN_POSITIVE / 2.0] {
            let bytes = real_bytes(processor, value).unwrap();
            assert_eq!(real(processor, bytes).to_bits(), value.to_bits(), "{processor:?} {value}");
        }
    }
}

#[test]
fn vax_has_no_infinity_and_one_zero() {
    assert_eq!(real_bytes(Processor::Dec, f32::INFINITY), None);
    assert_eq!(real_bytes(Processor::Dec, f32::NAN), None);
    assert_eq!(real_bytes(Processor::Dec, 3e38), None);
    assert_eq!(real_bytes(Processor::Dec, -0.0), Some([0; 4]));
    assert_eq!(real_bytes(Processor::Dec, 1e-39), Some([0; 4]));
    assert!(real(Processor::Dec, [0x00, 0x80, 0, 0]).is_nan());
}
