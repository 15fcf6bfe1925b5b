//! Errors and remarks of the readers: where in the file, what was found, what was expected.

use std::fmt;

/// Why a file could not be read: the place, what was found and what was expected there.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// The file contains no bytes, or only white space.
    #[error("the file is empty; expected {expected}")]
    Empty {
        /// Beginning of a valid file.
        expected: &'static str,
    },
    /// The content is of another format than the name of the file states.
    #[error("the content is {found}; expected {expected}. hint: {remedy}")]
    OtherContent {
        /// Format of the content.
        found: &'static str,
        /// The format that is read.
        expected: &'static str,
        /// Remedy: how to get the expected content.
        remedy: &'static str,
    },
    /// A line of a text file does not follow the format.
    #[error("line {line}: found {found}; expected {expected}")]
    Line {
        /// Line number, counted from 1.
        line: usize,
        /// Found text, shortened.
        found: String,
        /// Values that the format allows.
        expected: String,
    },
    /// The file ends too early.
    #[error("line {line}: the file ends here; expected {expected}. Is it truncated?")]
    Truncated {
        /// Last line that was read, counted from 1.
        line: usize,
        /// The expected rest.
        expected: String,
    },
    /// The text is not well-formed XML.
    #[error("not a readable XML document: {reason}")]
    Xml {
        /// Message of the XML parser, with row and column.
        reason: String,
    },
    /// An element of an XML document does not follow the format.
    #[error("line {line}, element <{element}>: found {found}; expected {expected}")]
    Element {
        /// Line of the element's opening tag, counted from 1.
        line: usize,
        /// Tag, with the `name` attribute where there is one.
        element: String,
        /// Found text, shortened.
        found: String,
        /// Values that the format allows.
        expected: String,
    },
    /// A value in a binary file is not allowed at its place.
    #[error("byte {offset}: found {found}; expected {expected}")]
    Byte {
        /// Place in the file, counted from 0.
        offset: usize,
        /// Found value.
        found: String,
        /// Values that the format allows.
        expected: String,
    },
    /// A binary file ends too early.
    #[error("the file ends after {offset} bytes; expected {expected}. Is it truncated?")]
    CutOff {
        /// Bytes of the file.
        offset: usize,
        /// The expected rest.
        expected: String,
    },
    /// A parameter of a C3D file has the wrong type, shape or value.
    #[error("parameter {parameter}: found {found}; expected {expected}")]
    Parameter {
        /// Group and name: `FORCE_PLATFORM:TYPE`.
        parameter: String,
        /// Found value.
        found: String,
        /// Required value.
        expected: String,
    },
    /// A table of results has a number that is not finite, so that it is not written.
    #[error(
        "{table}: column `{column}`, row {row}: found {found}; expected a finite number. hint: a number of the \
         recording or a setting is far outside of the usual range"
    )]
    NotFinite {
        /// Name of the file.
        table: String,
        /// Name of the column.
        column: String,
        /// Row, counted from 1.
        row: usize,
        /// The number.
        found: f64,
    },
    /// A record made in memory cannot be written without loss.
    #[error("not a valid record: found {found}; expected {expected}")]
    Record {
        /// Content of the record.
        found: String,
        /// Values that the format allows.
        expected: String,
    },
}

/// Something unusual in a file that was read nevertheless, with the assumption that was made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Line number, counted from 1, if the remark is about one line.
    pub line: Option<usize>,
    /// Found value and its interpretation.
    pub message: String,
    /// Whether the file contradicts itself on its frame rate, on which every speed and force depends.
    pub is_about_clock: bool,
}

impl Remark {
    /// A remark on the whole file, or on a place without a line number.
    pub(crate) fn of_file(message: impl Into<String>) -> Remark {
        Remark { line: None, message: message.into(), is_about_clock: false }
    }

    /// A remark on a line.
    pub(crate) fn of_line(line: usize, message: impl Into<String>) -> Remark {
        Remark { line: Some(line), ..Remark::of_file(message) }
    }

    /// A contradiction in the frame rate of the file.
    pub(crate) fn of_clock(message: impl Into<String>) -> Remark {
        Remark { is_about_clock: true, ..Remark::of_file(message) }
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

/// Text shortened for a message: at most 40 characters, in back quotes.
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
