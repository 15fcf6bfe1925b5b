//! C3D files put together byte by byte, without the crate's writer: Intel numbers, one record after the other.

const BLOCK: usize = 512;

/// A file under construction. Word numbers of the header count from 1, as the format's description does.
#[derive(Debug, Clone)]
pub(crate) struct File {
    pub(crate) header: Vec<u8>,
    pub(crate) records: Vec<u8>,
    pub(crate) data: Vec<u8>,
    /// Bytes are added so that the file ends with a block.
    pub(crate) padded: bool,
}

impl File {
    /// Header of these counts, groups POINT, ANALOG and TRIAL, no parameters, no data.
    pub(crate) fn new(points: u16, frames: u16, channels: u16, samples: u16, scale: f32) -> File {
        let mut file = File { header: vec![0; BLOCK], records: vec![], data: vec![], padded: true };
        file.header[..2].copy_from_slice(&[2, 0x50]);
        file.word(2, points).word(3, channels * samples).word(4, 1).word(5, frames).word(10, samples);
        file.real(7, scale).real(11, 100.0);
        for (name, number) in [("POINT", 1), ("ANALOG", 2), ("TRIAL", 3), ("FORCE_PLATFORM", 4), ("EVENT", 5)] {
            file.group(name, number);
        }
        file
    }

    /// A real file of one point with these fourth values, at 1 2 3 in every frame.
    pub(crate) fn with_words(words: &[f32]) -> File {
        let mut file = File::new(1, words.len() as u16, 0, 0, -0.5);
        for &word in words {
            file.reals(&[1.0, 2.0, 3.0, word]);
        }
        file
    }

    pub(crate) fn word(&mut self, number: usize, value: u16) -> &mut File {
        self.header[2 * (number - 1)..2 * number].copy_from_slice(&value.to_le_bytes());
        self
    }

    pub(crate) fn real(&mut self, number: usize, value: f32) -> &mut File {
        self.header[2 * (number - 1)..2 * (number + 1)].copy_from_slice(&value.to_le_bytes());
        self
    }

    pub(crate) fn reals(&mut self, values: &[f32]) -> &mut File {
        self.data.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self
    }

    pub(crate) fn integers(&mut self, values: &[i16]) -> &mut File {
        self.data.extend(values.iter().flat_map(|value| value.to_le_bytes()));
        self
    }

    pub(crate) fn group(&mut self, name: &str, number: i8) -> &mut File {
        self.record(name, -number, &[0])
    }

    /// A parameter of this type and shape.
    pub(crate) fn parameter(&mut self, group: i8, name: &str, kind: i8, shape: &[u8], values: &[u8]) -> &mut File {
        let mut body = vec![kind.cast_unsigned(), shape.len() as u8];
        body.extend(shape);
        body.extend(values);
        body.push(0);
        self.record(name, group, &body)
    }

    pub(crate) fn integer(&mut self, group: i8, name: &str, shape: &[u8], values: &[i16]) -> &mut File {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.parameter(group, name, 2, shape, &bytes)
    }

    pub(crate) fn float(&mut self, group: i8, name: &str, shape: &[u8], values: &[f32]) -> &mut File {
        let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.parameter(group, name, 4, shape, &bytes)
    }

    /// Texts of one width.
    pub(crate) fn texts(&mut self, group: i8, name: &str, texts: &[&str]) -> &mut File {
        let width = texts.iter().map(|text| text.len()).max().unwrap_or(0);
        let bytes: Vec<u8> = texts.iter().flat_map(|text| format!("{text:width$}").into_bytes()).collect();
        self.parameter(group, name, -1, &[width as u8, texts.len() as u8], &bytes)
    }

    /// A record whose offset leads to its end.
    pub(crate) fn record(&mut self, name: &str, number: i8, body: &[u8]) -> &mut File {
        self.linked(name.len() as i8, name.as_bytes(), number, body.len() as u16 + 2, body)
    }

    /// A record with any offset.
    pub(crate) fn linked(&mut self, length: i8, name: &[u8], number: i8, offset: u16, body: &[u8]) -> &mut File {
        self.records.extend([length.cast_unsigned(), number.cast_unsigned()]);
        self.records.extend(name);
        self.records.extend(offset.to_le_bytes());
        self.records.extend(body);
        self
    }

    /// The whole file; the data follow the last block of parameters.
    pub(crate) fn bytes(&self) -> Vec<u8> {
        let blocks = (4 + self.records.len() + 2).div_ceil(BLOCK);
        let mut bytes = self.header.clone();
        bytes[16..18].copy_from_slice(&(blocks as u16 + 2).to_le_bytes());
        bytes.extend([1, 0x50, blocks as u8, 84]);
        bytes.extend(&self.records);
        bytes.resize(BLOCK * (1 + blocks), 0);
        bytes.extend(&self.data);
        if self.padded {
            bytes.resize(bytes.len().next_multiple_of(BLOCK), 0);
        }
        bytes
    }
}
