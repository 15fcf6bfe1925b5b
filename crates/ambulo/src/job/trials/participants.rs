//! Masses and statures of the participants of a BIDS data set: the columns `weight` and `height` of `participants.tsv`.
//!
//! BIDS recommends these columns and leaves their units to `participants.json`. A column whose unit is not stated there
//! is not read: a height of 180 can only be centimetres, but a weight of 70 may be pounds.

use crate::job::error::{At, JobError};
use crate::job::files::{Files, read};
use crate::study::StatedSize;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// The file with the sizes.
pub const TABLE: &str = "participants.tsv";
/// The file with the units of its columns.
pub const DESCRIPTION: &str = "participants.json";
/// The column with the name of each person.
const PERSON: &str = "participant_id";
/// A cell without a value.
const MISSING: &str = "n/a";

/// Mass [kg] and stature [m] of a person.
pub type Size = [Option<f64>; 2];

/// Columns, and the factors of their units to kilograms and to metres.
const COLUMNS: [(&str, &[(&str, f64)]); 2] =
    [("weight", &[("kg", 1.0), ("g", 1e-3)]), ("height", &[("m", 1.0), ("cm", 1e-2), ("mm", 1e-3)])];

/// The sizes of the participants of a data set, by name.
#[derive(Debug, Default)]
pub(super) struct Participants {
    /// Files that were read.
    pub(super) read: Vec<PathBuf>,
    sizes: BTreeMap<String, Size>,
}

impl Participants {
    /// Reads the sizes of the participants of a data set. Without `participants.tsv` or without `participants.json`
    /// there are none.
    pub(super) fn of(root: &Path, files: &mut dyn Files) -> Result<Participants, JobError> {
        let [table, description] = [TABLE, DESCRIPTION].map(|name| root.join(name));
        if !files.has(&table) || !files.has(&description) {
            return Ok(Participants::default());
        }
        let sizes = sizes(&read(files, &table)?, &read(files, &description)?, &table, &description)?;
        Ok(Participants { read: vec![table, description], sizes })
    }

    /// The size of a person.
    pub(super) fn size(&self, person: &str) -> StatedSize {
        let [mass_kg, height_m] = self.sizes.get(person).copied().unwrap_or_default();
        StatedSize { mass_kg, height_m }
    }
}

/// The sizes of participants by name, from the bytes of both files.
pub fn sizes(
    table: &[u8],
    description: &[u8],
    table_path: &Path,
    description_path: &Path,
) -> Result<BTreeMap<String, Size>, JobError> {
    let refused = |path: &Path, what: String| JobError::new(&[], what).within(path.display().to_string());
    let units: Value = serde_json::from_slice(description).map_err(|error| {
        let what = format!(
            "{error}; expected JSON with the unit of each column. hint: {{\"weight\": {{\"Units\": \"kg\"}}}}, or \
             remove the file, and no size is read"
        );
        refused(description_path, what)
    })?;
    let text = std::str::from_utf8(table).at(format!("{}: this is not UTF-8 text", table_path.display()))?;
    let mut lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let names: Vec<&str> = lines.next().map(|(_, line)| line.split('\t').map(str::trim).collect()).unwrap_or_default();
    let place = |name: &str| names.iter().position(|own| *own == name);
    let Some(person) = place(PERSON) else { return Ok(BTreeMap::new()) };
    let factor = |(name, known): (&str, &[(&str, f64)])| {
        let unit = units[name]["Units"].as_str()?.trim();
        known.iter().find(|(own, _)| *own == unit).map(|(_, factor)| *factor)
    };
    let columns = COLUMNS.map(|column| Some((place(column.0)?, factor(column)?)));
    let mut sizes = BTreeMap::new();
    for (k, line) in lines {
        let cells: Vec<&str> = line.split('\t').map(str::trim).collect();
        let mut own: Size = [None, None];
        for (size, column) in own.iter_mut().zip(columns) {
            let Some((place, factor)) = column else { continue };
            *size = match cells.get(place) {
                None | Some(&"" | &MISSING) => None,
                Some(cell) => match cell.parse::<f64>() {
                    Ok(value) if value > 0.0 && value.is_finite() => Some(value * factor),
                    _ => {
                        let what = format!(
                            "line {}: found `{cell}` as `{}`; expected a number above 0, or {MISSING}",
                            k + 1,
                            names[place]
                        );
                        return Err(refused(table_path, what));
                    }
                },
            };
        }
        sizes.insert(cells.get(person).copied().unwrap_or_default().to_owned(), own);
    }
    Ok(sizes)
}
