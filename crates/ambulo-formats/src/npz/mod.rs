//! Archives of NumPy arrays: `.npz`, a ZIP whose entries are `.npy` files, stored or deflated.
//!
//! Numbers of any size and byte order become `f64`, truth values 0 and 1; texts become `String`s. Pickled objects are
//! never unpickled: an entry that holds them is listed as [`Data::Other`].
//!
//! Not handled, and rejected: encrypted archives, archives in several parts or above 4 GB, other methods of
//! compression. Source: numpy.org/doc/stable/reference/generated/numpy.lib.format.html; PKWARE, APPNOTE.TXT, 4.3 and
//! 4.4 (from memory, unverified). Pinned by: tests/arrays_npz.rs

mod npy;
mod zip;

use crate::content;
use crate::error::Error;

/// Largest size of all arrays together once they are unpacked [bytes].
pub const MAX_UNPACKED: usize = 1 << 30;
/// Largest number of numbers in all arrays that are read together; each takes 8 bytes. A quarter of an hour of motion
/// of the SMPL family at 120 Hz has 18 million, the largest of its models 13 million.
pub const MAX_NUMBERS: usize = 1 << 25;
/// Largest number of entries.
pub const MAX_ENTRIES: usize = 4096;
/// Largest number of texts of an array; one with more is [`Data::Other`].
pub const MAX_TEXTS: usize = 65_536;

/// Arrays with their names, in the order of the archive.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Npz {
    /// Name without `.npy`, and the array.
    pub arrays: Vec<(String, Array)>,
}

/// An array.
#[derive(Debug, Clone, PartialEq)]
pub struct Array {
    /// Length along each axis; empty for a single element.
    pub shape: Vec<usize>,
    /// The elements, the last axis first.
    pub data: Data,
}

/// The elements of an array.
#[derive(Debug, Clone, PartialEq)]
pub enum Data {
    /// Numbers.
    Numbers(Vec<f64>),
    /// A single text.
    Text(String),
    /// Several texts, and their type as the file describes it, such as `<U8`.
    Texts {
        /// The type.
        kind: String,
        /// The texts.
        texts: Vec<String>,
    },
    /// Something else: the type as the file describes it, such as `|O` for pickled objects.
    Other(String),
}

impl Array {
    /// The numbers; `None` if the array has others.
    #[must_use]
    pub fn numbers(&self) -> Option<&[f64]> {
        match &self.data {
            Data::Numbers(numbers) => Some(numbers),
            Data::Text(_) | Data::Texts { .. } | Data::Other(_) => None,
        }
    }

    /// The texts of an array that has several; `None` if it has no texts, or a single one.
    #[must_use]
    pub fn texts(&self) -> Option<&[String]> {
        match &self.data {
            Data::Texts { texts, .. } => Some(texts),
            Data::Numbers(_) | Data::Text(_) | Data::Other(_) => None,
        }
    }
}

impl Npz {
    /// Reads an archive.
    ///
    /// # Errors
    /// Bytes that are no archive, entries that are damaged or too large, arrays that are not as long as their shape.
    pub fn read(bytes: &[u8]) -> Result<Npz, Error> {
        Npz::read_named(bytes, |_| true)
    }

    /// Reads some arrays of an archive, and of the others type and shape alone: they have no elements, as if they had
    /// been read by [`Npz::shapes`]. Before anything is unpacked, the size of each array is compared with its shape,
    /// and the size of all wanted ones with [`MAX_NUMBERS`].
    ///
    /// # Errors
    /// As [`Npz::read`].
    pub fn read_named(bytes: &[u8], is_wanted: impl Fn(&str) -> bool) -> Result<Npz, Error> {
        let entries = arrays(bytes)?;
        let wanted = entries.iter().filter(|(name, ..)| is_wanted(name));
        let count = wanted.fold(0_usize, |count, (.., header)| count.saturating_add(header.elements()));
        if count > MAX_NUMBERS {
            let found = format!("{count} numbers in the arrays that are read");
            return Err(Error::Byte { offset: 0, found, expected: format!("at most {MAX_NUMBERS}") });
        }
        let read = |(name, entry, header): (String, zip::Entry, npy::Header)| {
            let is_read = is_wanted(&name) && header.elements() > 0;
            let content = is_read.then(|| zip::content(bytes, &entry)).transpose()?;
            let array = match content {
                Some(content) => header.read_elements(&content),
                None => header.without_elements(),
            };
            Ok((name, array))
        };
        Ok(Npz { arrays: entries.into_iter().map(read).collect::<Result<_, Error>>()? })
    }

    /// The arrays of an archive with type and shape, without their elements.
    ///
    /// # Errors
    /// As [`Npz::read`].
    pub fn shapes(bytes: &[u8]) -> Result<Npz, Error> {
        Npz::read_named(bytes, |_| false)
    }

    /// The names of the arrays of an archive, without reading them.
    ///
    /// # Errors
    /// Bytes that are no archive.
    pub fn names(bytes: &[u8]) -> Result<Vec<String>, Error> {
        let entries = zip::entries(bytes)?;
        Ok(entries.into_iter().filter_map(|entry| Some(entry.name.strip_suffix(".npy")?.to_owned())).collect())
    }

    /// The array with this name.
    #[must_use]
    pub fn array(&self, name: &str) -> Option<&Array> {
        self.arrays.iter().find(|(known, _)| known == name).map(|(_, array)| array)
    }

    /// Writes an archive without compression, which reads back to the same bits.
    ///
    /// # Errors
    /// An array that is not as long as its shape, or has no numbers and no text; names or sizes beyond the format.
    pub fn write(&self) -> Result<Vec<u8>, Error> {
        let files = self.arrays.iter().map(|(name, array)| Ok((format!("{name}.npy"), npy::write(name, array)?)));
        zip::write(&files.collect::<Result<Vec<_>, Error>>()?)
    }
}

/// The arrays of an archive, each with its place and its header.
fn arrays(bytes: &[u8]) -> Result<Vec<(String, zip::Entry, npy::Header)>, Error> {
    let entries = zip::entries(bytes).map_err(|error| error.or_other_content(bytes, content::NPZ))?;
    let named = entries.into_iter().filter_map(|entry| Some((entry.name.strip_suffix(".npy")?.to_owned(), entry)));
    let with_header = |(name, entry): (String, zip::Entry)| {
        let start = zip::beginning(bytes, &entry, npy::MAX_HEADER)?;
        let header = npy::Header::read(&start, &entry)?;
        Ok((name, entry, header))
    };
    named.map(with_header).collect()
}
