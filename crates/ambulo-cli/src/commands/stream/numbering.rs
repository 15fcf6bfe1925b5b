//! Order of frames by their numbers: missing, repeated and late frames, and new sequences.

/// Number of last frames that are remembered, to distinguish a repeated frame from a late one.
const REMEMBERED: u64 = 64;

/// Place of a frame in its sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The expected frame.
    Next,
    /// This number of frames before it are missing.
    After(u64),
    /// The frame was received before.
    Doubled,
    /// A later frame was already used.
    Late,
    /// The sender started a new sequence.
    Anew,
}

/// The received numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct Numbering {
    /// The greatest received number; `None` before the first frame.
    last: Option<u64>,
    /// Received numbers among the [`REMEMBERED`] ones up to the last, one bit each; the last number in the lowest bit.
    came: u64,
}

impl Numbering {
    /// The number that follows the last one.
    pub(super) fn expected(&self) -> u64 {
        self.last.map_or(0, |last| last.saturating_add(1))
    }

    /// Adds a number. A number that is more than `far` before the expected one begins a new sequence.
    pub fn place(&mut self, number: u64, far: u64) -> Place {
        let Some(last) = self.last else {
            self.begin(number);
            return Place::Next;
        };
        if number > last {
            let places = number - last;
            self.came = self.came.checked_shl(u32::try_from(places).unwrap_or(u32::MAX)).unwrap_or(0) | 1;
            self.last = Some(number);
            return if places == 1 { Place::Next } else { Place::After(places - 1) };
        }
        let back = last - number;
        match back {
            _ if back >= far => {
                self.begin(number);
                Place::Anew
            }
            _ if back < REMEMBERED && self.came & (1 << back) != 0 => Place::Doubled,
            _ => {
                self.came |= if back < REMEMBERED { 1 << back } else { 0 };
                Place::Late
            }
        }
    }

    fn begin(&mut self, number: u64) {
        *self = Numbering { last: Some(number), came: 1 };
    }
}
