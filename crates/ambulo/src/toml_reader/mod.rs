//! Reads TOML files (scenes, gaits, thresholds, marker sets); every error states line and key.

mod error;
mod value;
mod words;

pub use error::{Place, TomlError};
pub(crate) use value::{Source, Table, Value};
pub(crate) use words::{listed, nearest};
