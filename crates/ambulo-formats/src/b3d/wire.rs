//! Protocol Buffers on the wire: the few rules that the schema of `.b3d` needs.
//!
//! A message is a sequence of fields. Each begins with a varint, `8 number + type`: type 0 is a varint, 1 are eight
//! bytes, 2 is a length and that many bytes, 5 are four bytes. A repeated number is one field of type 2 with all values
//! (packed), or one field per value. By hand, because a crate with generated code takes longer to compile than this
//! file takes to read, and would read the fields that are not needed too.
//!
//! Source: protobuf.dev/programming-guides/encoding.

use crate::error::Error;

/// The content of a field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Content<'b> {
    Varint(u64),
    Eight([u8; 8]),
    Bytes(&'b [u8]),
    Four([u8; 4]),
}

/// A field of a message.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Field<'b> {
    pub(super) number: u64,
    pub(super) content: Content<'b>,
    /// Place of the content in the file.
    pub(super) offset: usize,
}

/// The fields of a message, in order.
#[derive(Debug, Clone)]
pub(super) struct Message<'b> {
    bytes: &'b [u8],
    next: usize,
    /// Place of the message in the file.
    start: usize,
}

impl<'b> Message<'b> {
    pub(super) fn new(bytes: &'b [u8], start: usize) -> Message<'b> {
        Message { bytes, next: 0, start }
    }

    fn offset(&self) -> usize {
        self.start + self.next
    }

    fn take(&mut self, count: usize) -> Result<&'b [u8], Error> {
        let rest = &self.bytes[self.next..];
        let taken = rest.get(..count).ok_or_else(|| Error::Byte {
            offset: self.offset(),
            found: format!("a field of {count} bytes in {} bytes", rest.len()),
            expected: "a field inside its message. Is the file damaged?".to_owned(),
        })?;
        self.next += count;
        Ok(taken)
    }

    fn varint(&mut self) -> Result<u64, Error> {
        let offset = self.offset();
        let mut value = 0;
        for shift in (0..64).step_by(7) {
            let [byte] = *self.take(1)? else { break };
            value |= u64::from(byte & 0x7f) << shift;
            if byte < 0x80 {
                return Ok(value);
            }
        }
        Err(Error::Byte {
            offset,
            found: "a whole number of more than ten bytes".to_owned(),
            expected: "a varint of Protocol Buffers. Is this a .b3d file?".to_owned(),
        })
    }

    fn field(&mut self) -> Result<Field<'b>, Error> {
        let at = self.offset();
        let key = self.varint()?;
        let place = self.offset();
        let content = match key & 7 {
            0 => Content::Varint(self.varint()?),
            1 => Content::Eight(copied(self.take(8)?)),
            2 => {
                let length = self.varint()?;
                Content::Bytes(self.take(usize::try_from(length).unwrap_or(usize::MAX))?)
            }
            5 => Content::Four(copied(self.take(4)?)),
            other => {
                return Err(Error::Byte {
                    offset: at,
                    found: format!("a field of type {other}"),
                    expected: "a field of type 0, 1, 2 or 5. Is this a .b3d file?".to_owned(),
                });
            }
        };
        let offset = match content {
            Content::Bytes(bytes) => self.offset() - bytes.len(),
            _ => place,
        };
        let number = key >> 3;
        if number == 0 {
            return Err(Error::Byte {
                offset: at,
                found: "a field with the number 0".to_owned(),
                expected: "fields that are counted from 1. Is the file damaged?".to_owned(),
            });
        }
        Ok(Field { number, content, offset })
    }
}

impl<'b> Iterator for Message<'b> {
    type Item = Result<Field<'b>, Error>;

    /// The next field; zeros up to the end of the slot of a frame are no field.
    fn next(&mut self) -> Option<Result<Field<'b>, Error>> {
        if self.bytes[self.next..].iter().all(|byte| *byte == 0) {
            return None;
        }
        let field = self.field();
        if field.is_err() {
            self.next = self.bytes.len();
        }
        Some(field)
    }
}

impl<'b> Field<'b> {
    fn wrong(&self, expected: &str) -> Error {
        let found = match self.content {
            Content::Varint(_) => "a whole number".to_owned(),
            Content::Eight(_) => "eight bytes".to_owned(),
            Content::Four(_) => "four bytes".to_owned(),
            Content::Bytes(bytes) => format!("{} bytes", bytes.len()),
        };
        Error::Byte {
            offset: self.offset,
            found: format!("{found} in field {}", self.number),
            expected: expected.into(),
        }
    }

    pub(super) fn message(&self) -> Result<Message<'b>, Error> {
        match self.content {
            Content::Bytes(bytes) => Ok(Message::new(bytes, self.offset)),
            _ => Err(self.wrong("a message")),
        }
    }

    pub(super) fn text(&self) -> Result<String, Error> {
        match self.content {
            Content::Bytes(bytes) => Ok(String::from_utf8_lossy(bytes).into_owned()),
            _ => Err(self.wrong("a text")),
        }
    }

    /// A count: a whole number of 32 bits, zero or more.
    pub(super) fn count(&self) -> Result<usize, Error> {
        let count = match self.content {
            Content::Varint(value) => i32::try_from(value).ok().and_then(|value| usize::try_from(value).ok()),
            _ => None,
        };
        count.ok_or_else(|| self.wrong("a count from 0 to 2147483647"))
    }

    pub(super) fn double(&self) -> Result<f64, Error> {
        match self.content {
            Content::Eight(bytes) => Ok(f64::from_le_bytes(bytes)),
            _ => Err(self.wrong("a number of eight bytes")),
        }
    }

    pub(super) fn float(&self) -> Result<f32, Error> {
        match self.content {
            Content::Four(bytes) => Ok(f32::from_le_bytes(bytes)),
            _ => Err(self.wrong("a number of four bytes")),
        }
    }

    /// Adds the numbers of a repeated field, packed or not.
    pub(super) fn doubles_into(&self, all: &mut Vec<f64>) -> Result<(), Error> {
        match self.content {
            Content::Bytes(bytes) if bytes.len() % 8 == 0 => {
                all.extend(bytes.chunks_exact(8).map(|eight| f64::from_le_bytes(copied(eight))));
            }
            _ => all.push(self.double().map_err(|_| self.wrong("numbers of eight bytes"))?),
        }
        Ok(())
    }

    /// Adds the whole numbers of a repeated field, packed or not.
    pub(super) fn varints_into(&self, all: &mut Vec<u64>) -> Result<(), Error> {
        match self.content {
            Content::Varint(value) => all.push(value),
            Content::Bytes(bytes) => {
                let mut packed = Message::new(bytes, self.offset);
                while packed.next < bytes.len() {
                    all.push(packed.varint()?);
                }
            }
            _ => return Err(self.wrong("whole numbers")),
        }
        Ok(())
    }
}

/// Bytes of a known number.
fn copied<const N: usize>(bytes: &[u8]) -> [u8; N] {
    let mut out = [0; N];
    out.copy_from_slice(&bytes[..N]);
    out
}

/// Writes the fields of a message.
#[derive(Debug, Default)]
pub(super) struct Encoder(pub(super) Vec<u8>);

impl Encoder {
    fn varint(&mut self, mut value: u64) {
        while value >= 0x80 {
            self.0.push(value as u8 | 0x80);
            value >>= 7;
        }
        self.0.push(value as u8);
    }

    fn key(&mut self, number: u64, wire_type: u64) {
        self.varint(8 * number + wire_type);
    }

    pub(super) fn count(&mut self, number: u64, value: usize) {
        self.key(number, 0);
        self.varint(value as u64);
    }

    pub(super) fn double(&mut self, number: u64, value: f64) {
        self.key(number, 1);
        self.0.extend(value.to_le_bytes());
    }

    pub(super) fn float(&mut self, number: u64, value: f32) {
        self.key(number, 5);
        self.0.extend(value.to_le_bytes());
    }

    pub(super) fn bytes(&mut self, number: u64, bytes: &[u8]) {
        self.key(number, 2);
        self.varint(bytes.len() as u64);
        self.0.extend(bytes);
    }

    pub(super) fn doubles(&mut self, number: u64, values: impl IntoIterator<Item = f64>) {
        let bytes: Vec<u8> = values.into_iter().flat_map(f64::to_le_bytes).collect();
        self.bytes(number, &bytes);
    }

    pub(super) fn varints(&mut self, number: u64, values: impl IntoIterator<Item = u64>) {
        let mut packed = Encoder::default();
        values.into_iter().for_each(|value| packed.varint(value));
        self.bytes(number, &packed.0);
    }
}
