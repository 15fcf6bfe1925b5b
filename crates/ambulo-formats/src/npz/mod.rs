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

use crate::error::Error;

/// Largest size of all arrays together once they are unpacked [bytes].
pub const MAX_UNPACKED: usize = 1 << 30;
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
        let mut npz = Npz::default();
        for entry in zip::entries(bytes)? {
            if let Some(name) = entry.name.strip_suffix(".npy") {
                let array = npy::read(&zip::content(bytes, &entry)?, &entry)?;
                npz.arrays.push((name.to_owned(), array));
            }
        }
        Ok(npz)
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
