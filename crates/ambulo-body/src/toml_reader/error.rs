//! Errors of TOML files, with line and key.

/// Why a file could not be read: the place, what was found, what was expected, and a hint.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
#[error("line {line}{}: {message}", place(key))]
pub struct TomlError {
    /// Line of the file, counted from 1.
    pub line: usize,
    /// Path of the key, entries of lists counted from 1: `body[3].mass`. Empty if the text is not TOML.
    pub key: String,
    /// Found and expected value, and a hint.
    pub message: String,
}

/// A place in a file, for errors that are detected later.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Place {
    /// Line of the file, counted from 1.
    pub line: usize,
    /// Path of the key, entries of lists counted from 1.
    pub key: String,
}

impl Place {
    /// An error here.
    #[must_use]
    pub fn error(&self, message: impl Into<String>) -> TomlError {
        TomlError::new(self.line, self.key.clone(), message)
    }
}

fn place(key: &str) -> String {
    if key.is_empty() { String::new() } else { format!(", `{key}`") }
}

impl TomlError {
    /// An error at a place of the file.
    #[must_use]
    pub fn new(line: usize, key: impl Into<String>, message: impl Into<String>) -> TomlError {
        TomlError { line, key: key.into(), message: message.into() }
    }

    /// The same error with a hint at its end.
    #[must_use]
    pub fn hint(mut self, advice: &str) -> TomlError {
        let joined = if self.message.contains(". hint: ") { "; " } else { ". hint: " };
        self.message.push_str(joined);
        self.message.push_str(advice);
        self
    }
}
