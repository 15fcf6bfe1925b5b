//! Numbers in the formats of the three kinds of processor: Intel, DEC (VAX) and SGI (MIPS).
//!
//! | processor | 16-bit words | 32-bit reals |
//! |---|---|---|
//! | Intel | low byte first | IEEE 754, low byte first |
//! | DEC | low byte first | VAX F: (-1)^s · (0.5 + m/2^24) · 2^(e-128), the high 16 bits before the low ones |
//! | SGI | high byte first | IEEE 754, high byte first |
//!
//! Source: C3D user guide (c3d.org), "Parameter section header" and "Floating-point format" (unverified in detail);
//! the six files Eb015 of c3d.org's samples, which hold one recording in all encodings, agree.

/// The kind of processor that wrote a file's numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Processor {
    /// Low byte first, IEEE 754; nearly every current file.
    Intel,
    /// Low byte first, VAX F reals.
    Dec,
    /// High byte first, IEEE 754.
    Sgi,
}

/// Hidden bit of a 24-bit significand.
const HIDDEN: u32 = 1 << 23;
/// 2^(e - 128 - 24) is the weight of a VAX F significand's last bit.
const VAX_SHIFT: i32 = 128 + 24;

impl Processor {
    /// All three.
    pub const ALL: [Processor; 3] = [Processor::Intel, Processor::Dec, Processor::Sgi];

    /// The fourth byte of the parameter section: 84, 85, 86.
    pub(crate) fn code(self) -> u8 {
        match self {
            Processor::Intel => 84,
            Processor::Dec => 85,
            Processor::Sgi => 86,
        }
    }

    /// The processor with this code.
    pub(crate) fn of_code(code: u8) -> Option<Processor> {
        Processor::ALL.into_iter().find(|processor| processor.code() == code)
    }

    /// An unsigned 16-bit word.
    #[inline]
    pub(crate) fn u16(self, bytes: [u8; 2]) -> u16 {
        match self {
            Processor::Intel | Processor::Dec => u16::from_le_bytes(bytes),
            Processor::Sgi => u16::from_be_bytes(bytes),
        }
    }

    /// A signed 16-bit word.
    #[inline]
    pub(crate) fn i16(self, bytes: [u8; 2]) -> i16 {
        self.u16(bytes).cast_signed()
    }

    /// A 32-bit real. A VAX "reserved operand" is not-a-number.
    #[inline]
    pub(crate) fn f32(self, bytes: [u8; 4]) -> f32 {
        match self {
            Processor::Intel => f32::from_le_bytes(bytes),
            Processor::Dec => vax_real(u32::from_le_bytes([bytes[2], bytes[3], bytes[0], bytes[1]])),
            Processor::Sgi => f32::from_be_bytes(bytes),
        }
    }

    /// The bytes of a 16-bit word.
    pub(crate) fn u16_bytes(self, word: u16) -> [u8; 2] {
        match self {
            Processor::Intel | Processor::Dec => word.to_le_bytes(),
            Processor::Sgi => word.to_be_bytes(),
        }
    }

    /// The bytes of a 32-bit real; `None` if this processor has no such number.
    pub(crate) fn f32_bytes(self, value: f32) -> Option<[u8; 4]> {
        match self {
            Processor::Intel => Some(value.to_le_bytes()),
            Processor::Dec => vax_bits(value).map(|bits| {
                let [b0, b1, b2, b3] = bits.to_le_bytes();
                [b2, b3, b0, b1]
            }),
            Processor::Sgi => Some(value.to_be_bytes()),
        }
    }
}

/// Value of VAX F bits in the order sign, 8 bits of exponent, 23 bits of significand.
fn vax_real(bits: u32) -> f32 {
    let exponent = (bits >> 23) & 0xff;
    let negative = bits >> 31 == 1;
    if exponent == 0 {
        return if negative { f32::NAN } else { 0.0 };
    }
    let significand = f64::from(HIDDEN | (bits & (HIDDEN - 1)));
    let size = significand * 2f64.powi(exponent.cast_signed() - VAX_SHIFT);
    let value = if negative { -size } else { size };
    value as f32
}

/// The VAX F bits of a number; zero if it is too small, `None` if it is too large, infinite or not-a-number.
fn vax_bits(value: f32) -> Option<u32> {
    if !value.is_finite() {
        return None;
    }
    // As a double every such number has a hidden bit: 1.m · 2^(e-1023) is 0.1m · 2^(f-128) with f = e - 1023 + 129.
    let bits = f64::from(value).to_bits();
    let exponent = ((bits >> 52) & 0x7ff) as i32 - 1023 + 129;
    let significand = (bits >> 29) as u32 & (HIDDEN - 1);
    let sign = (bits >> 63) as u32;
    match exponent {
        ..1 => Some(0),
        1..=255 => Some(sign << 31 | exponent.cast_unsigned() << 23 | significand),
        _ => None,
    }
}

/// Bytes of a file and the processor that wrote them. Offsets count from the start of the file.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Words<'a> {
    pub(crate) bytes: &'a [u8],
    pub(crate) processor: Processor,
}

impl Words<'_> {
    pub(crate) fn u8(self, offset: usize) -> Option<u8> {
        self.bytes.get(offset).copied()
    }

    #[inline]
    pub(crate) fn u16(self, offset: usize) -> Option<u16> {
        self.array(offset).map(|bytes| self.processor.u16(bytes))
    }

    #[inline]
    pub(crate) fn i16(self, offset: usize) -> Option<i16> {
        self.array(offset).map(|bytes| self.processor.i16(bytes))
    }

    #[inline]
    pub(crate) fn f32(self, offset: usize) -> Option<f32> {
        self.array(offset).map(|bytes| self.processor.f32(bytes))
    }

    /// `N` bytes in the order of the file.
    #[inline]
    pub(crate) fn array<const N: usize>(self, offset: usize) -> Option<[u8; N]> {
        self.bytes.get(offset..)?.first_chunk().copied()
    }
}
