//! The same columns in the frames of every part, so that readers take the whole folder without an option.
//!
//! Trials of different bodies have different columns, and a part knows its own trials only. When all parts of all
//! shards are closed, the columns of all of them are known: in the order of shards, parts and columns.

use super::part_file::{read, written};
use ambulo_formats::parquet::{Column, ColumnValues, ParquetTable};
use anyhow::{Context, Result};
use std::path::{Path, PathBuf};

/// A column of numbers: its name and the text about its unit.
type Known = (String, Option<(String, String)>);

/// Adds to each file the columns that it lacks; their values are missing. Files that do not exist are left out.
pub(super) fn unify(places: &[PathBuf]) -> Result<()> {
    let files: Vec<&PathBuf> = places.iter().filter(|place| place.is_file()).collect();
    let mut all: Vec<Known> = Vec::new();
    let mut found = Vec::with_capacity(files.len());
    for file in &files {
        let names = known(&read(file)?);
        all.extend(
            names.iter().filter(|(name, _)| all.iter().all(|(other, _)| other != name)).cloned().collect::<Vec<_>>(),
        );
        found.push(names);
    }
    for (file, names) in files.iter().zip(found) {
        if names.iter().map(|(name, _)| name).ne(all.iter().map(|(name, _)| name)) {
            rewrite(file, &all)?;
        }
    }
    Ok(())
}

fn known(table: &ParquetTable) -> Vec<Known> {
    let unit = |name: &str| table.about.iter().find(|(key, _)| key.strip_prefix("unit of ") == Some(name)).cloned();
    table.columns.iter().map(|column| (column.name.clone(), unit(&column.name))).collect()
}

fn rewrite(file: &Path, all: &[Known]) -> Result<()> {
    let ParquetTable { mut columns, mut about } = read(file)?;
    let rows = columns.first().map_or(0, |column| column.values.len());
    let mut ordered = Vec::with_capacity(all.len());
    for (name, unit) in all {
        match columns.iter().position(|column| column.name == *name) {
            Some(k) => ordered.push(columns.swap_remove(k)),
            None => {
                // Key, trial, frame and time are in every file; all others are numbers of single precision.
                ordered.push(Column { name: name.clone(), values: ColumnValues::Single(vec![f32::NAN; rows]) });
                about.extend(unit.clone());
            }
        }
    }
    let bytes = ParquetTable { columns: ordered, about }.write()?;
    written(file, &bytes).with_context(|| format!("{}: cannot be written. hint: --resume continues", file.display()))
}
