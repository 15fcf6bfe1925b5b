//! A file of a part: read, written as a whole, removed.

use crate::replacement::write_through;
use ambulo_formats::parquet::ParquetTable;
use anyhow::{Context, Result};
use std::fs;
use std::io::ErrorKind;
use std::path::Path;

/// Reads a table.
pub(super) fn read(place: &Path) -> Result<ParquetTable> {
    let shown = || place.display().to_string();
    ParquetTable::read(&fs::read(place).with_context(shown)?).with_context(shown)
}

/// Writes a file that appears when it is complete.
pub(super) fn written(path: &Path, content: &[u8]) -> std::io::Result<()> {
    let new = path.with_extension("new");
    write_through(&new, content).and_then(|()| fs::rename(&new, path)).inspect_err(|_| {
        let _ = fs::remove_file(&new);
    })
}

/// Removes what an interrupted run left.
pub(super) fn removed(path: &Path) -> std::io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}
