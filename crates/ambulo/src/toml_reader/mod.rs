//! Files in TOML, read so that whatever is refused is refused with line and key: scenes and gaits.

mod error;
mod value;
mod words;

pub use error::{Place, TomlError};
pub(crate) use value::{Source, Table, Value};
pub(crate) use words::{listed, nearest};
