//! What can be wrong with a file, said so that the reader can mend it.

use std::fmt;

/// Why a file could not be read. Every variant says where, what was found and what was allowed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file holds no bytes, or only white space.
    #[error("the file is empty; expected {expected}")]
    Empty {
        /// What a valid file begins with.
        expected: &'static str,
    },
    /// A line of a text table does not read as the format asks.
    #[error("line {line}: found {found}; expected {expected}")]
    Line {
        /// Line number, counted from 1.
        line: usize,
        /// What stands there, shortened.
        found: String,
        /// What the format allows there.
        expected: String,
    },
    /// The file ends before the format says it may.
    #[error("line {line}: the file ends here; expected {expected}. Is it truncated?")]
    Truncated {
        /// Last line that was read, counted from 1.
        line: usize,
        /// What was still to come.
        expected: String,
    },
    /// The text is no well-formed XML.
    #[error("not a readable XML document: {reason}")]
    Xml {
        /// The XML reader's own words, with row and column.
        reason: String,
    },
    /// An element of an XML document does not read as the format asks.
    #[error("line {line}, element <{element}>: found {found}; expected {expected}")]
    Element {
        /// Line of the element's opening tag, counted from 1.
        line: usize,
        /// Tag, with the `name` attribute where there is one.
        element: String,
        /// What stands there, shortened.
        found: String,
        /// What the format allows there.
        expected: String,
    },
    /// A binary file holds something at a place that the format does not allow there.
    #[error("byte {offset}: found {found}; expected {expected}")]
    Byte {
        /// Place in the file, counted from 0.
        offset: usize,
        /// What stands there.
        found: String,
        /// What the format allows there.
        expected: String,
    },
    /// A binary file ends before the format says it may.
    #[error("the file ends after {offset} bytes; expected {expected}. Is it truncated?")]
    CutOff {
        /// Bytes of the file.
        offset: usize,
        /// What was still to come.
        expected: String,
    },
    /// A parameter of a C3D file does not fit what it is needed for.
    #[error("parameter {parameter}: found {found}; expected {expected}")]
    Parameter {
        /// Group and name: `FORCE_PLATFORM:TYPE`.
        parameter: String,
        /// What stands there.
        found: String,
        /// What is needed.
        expected: String,
    },
    /// A record made in memory could not be written so that it reads back the same.
    #[error("not a valid record: found {found}; expected {expected}")]
    Record {
        /// What the record holds.
        found: String,
        /// What the format allows.
        expected: String,
    },
}

/// Something odd that did not stop the reading: the record is complete, but a person should know.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Line number counted from 1, where one line is the place.
    pub line: Option<usize>,
    /// What was found and what was made of it.
    pub message: String,
}

impl Remark {
    /// A remark on the file as a whole, or on a place that has no line.
    pub(crate) fn of_file(message: impl Into<String>) -> Remark {
        Remark { line: None, message: message.into() }
    }
}

impl fmt::Display for Remark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.line {
            Some(line) => write!(f, "line {line}: {}", self.message),
            None => f.write_str(&self.message),
        }
    }
}

/// Text shortened for a message: the first 40 characters, in back quotes.
pub(crate) fn quoted(text: &str) -> String {
    const SHOWN: usize = 40;
    let trimmed = text.trim();
    if trimmed.is_empty() {
        return "nothing".into();
    }
    let mut shown: String = trimmed.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if trimmed.chars().count() > SHOWN {
        shown.push('…');
    }
    format!("`{shown}`")
}
