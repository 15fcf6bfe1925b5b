//! Reads TOML files (scenes, gaits, thresholds, marker sets); every error states line and key.

mod error;
mod value;
mod words;

pub use error::{Place, TomlError};
#[doc(hidden)]
pub use value::{Source, Table, Value};
#[doc(hidden)]
pub use words::{listed, nearest};
