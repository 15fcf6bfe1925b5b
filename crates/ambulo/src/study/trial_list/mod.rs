//! Statements of a laboratory about the files of a folder of trials (`trials.toml`).
//!
//! Entries `[[trial]]` have a pattern of file names and what is true of these files. Where several entries fit a file,
//! the last one that states something counts. Paths are relative to the folder of the list, with `/`.
//! Pinned by: tests/study_trial_list.rs

pub(crate) mod pattern;

use crate::toml_reader::{Place, Source, Table, TomlError};
use pattern::Pattern;

const DOCUMENT: &str = "docs/VALIDATE.md";
const KEYS: [&str; 12] =
    ["files", "person", "date", "kind", "static", "mass", "height", "age", "model", "grf", "loads", "exclude"];

/// The list.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct TrialList {
    entries: Vec<Entry>,
}

#[derive(Debug, Clone, PartialEq)]
struct Entry {
    files: Pattern,
    place: Place,
    stated: StatedTrial,
}

/// Statements of the list about a file. The rest is found by the rules of docs/VALIDATE.md.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StatedTrial {
    /// Person of the trial.
    pub person: Option<String>,
    /// Day of the recording, as YYYY-MM-DD.
    pub recorded_on: Option<String>,
    /// The kind of trial in tables, in place of the recognised one.
    pub kind: Option<String>,
    /// The standing trial of the person.
    pub standing: Option<String>,
    /// Body mass [kg].
    pub mass_kg: Option<f64>,
    /// Stature [m].
    pub height_m: Option<f64>,
    /// Age of the person [years].
    pub age_years: Option<f64>,
    /// The model of the body.
    pub model: Option<String>,
    /// The table of measured ground forces.
    pub forces: Option<String>,
    /// External loads: which columns act on which body.
    pub loads: Option<String>,
    /// Why the file is left out.
    pub excluded: Option<String>,
}

impl StatedTrial {
    /// The paths to other files.
    pub fn paths(&self) -> impl Iterator<Item = &str> {
        [&self.standing, &self.model, &self.forces, &self.loads].into_iter().flatten().map(String::as_str)
    }

    fn replaced_by(self, later: &StatedTrial) -> StatedTrial {
        let text = |later: &Option<String>, earlier: Option<String>| later.clone().or(earlier);
        StatedTrial {
            person: text(&later.person, self.person),
            recorded_on: text(&later.recorded_on, self.recorded_on),
            kind: text(&later.kind, self.kind),
            standing: text(&later.standing, self.standing),
            mass_kg: later.mass_kg.or(self.mass_kg),
            height_m: later.height_m.or(self.height_m),
            age_years: later.age_years.or(self.age_years),
            model: text(&later.model, self.model),
            forces: text(&later.forces, self.forces),
            loads: text(&later.loads, self.loads),
            excluded: text(&later.excluded, self.excluded),
        }
    }
}

impl TrialList {
    /// From the text of a file.
    ///
    /// # Errors
    /// Text that is not TOML; keys that are unknown or missing; values of another kind.
    pub fn from_toml(text: &str) -> Result<TrialList, TomlError> {
        let source = Source::new(text, DOCUMENT);
        let parsed = source.parse()?;
        let root = Table::root(&source, &parsed);
        root.only(&[&["trial"]])?;
        let entries = root.tables("trial")?.iter().map(entry).collect::<Result<_, _>>()?;
        Ok(TrialList { entries })
    }

    /// Statements about a file.
    #[must_use]
    pub fn of(&self, path: &str) -> StatedTrial {
        let own = self.entries.iter().filter(|entry| entry.files.matches(path));
        own.fold(StatedTrial::default(), |stated, entry| stated.replaced_by(&entry.stated))
    }

    /// Checks that every entry fits at least one of the files.
    ///
    /// # Errors
    /// The first entry that fits none.
    pub fn check_files<'p>(&self, paths: impl Iterator<Item = &'p str> + Clone) -> Result<(), TomlError> {
        let fits_none = |entry: &&Entry| !paths.clone().any(|path| entry.files.matches(path));
        self.entries.iter().find(fits_none).map_or(Ok(()), |entry| {
            let message = format!("found no file `{}`; expected the path of at least one recording", entry.files);
            Err(entry
                .place
                .error(message)
                .hint("paths are relative to the folder of this list; `*` is any part of a name, `**` any folders"))
        })
    }
}

/// A day, as YYYY-MM-DD.
///
/// # Errors
/// The form that is expected.
pub fn day(text: &str) -> Result<String, &'static str> {
    let parts: Vec<Option<u32>> = text.split('-').map(|part| part.parse().ok()).collect();
    let is_day = match parts[..] {
        [Some(_), Some(month), Some(day)] => (1..=12).contains(&month) && (1..=31).contains(&day),
        _ => false,
    };
    let has_widths = text.split('-').map(str::len).eq([4, 2, 2]);
    if is_day && has_widths { Ok(text.to_owned()) } else { Err("a day as YYYY-MM-DD, such as 2026-03-12") }
}

/// The day of the key `date`: a text, or a date of TOML.
fn recorded_on(table: &Table<'_>) -> Result<Option<String>, TomlError> {
    let Some(value) = table.get("date") else { return Ok(None) };
    day(&value.filled_text()?).map(Some).map_err(|expected| value.wrong(expected))
}

fn entry(table: &Table<'_>) -> Result<Entry, TomlError> {
    table.only(&[&KEYS])?;
    let files = table.need("files", "the path of a file, or a pattern such as \"person1/*.c3d\"")?;
    let text = |key: &str| table.get(key).map(|value| value.filled_text()).transpose();
    let size = |key: &str| table.get(key).map(|value| value.above_zero()).transpose();
    Ok(Entry {
        place: files.place(),
        files: Pattern::new(&files.filled_text()?),
        stated: StatedTrial {
            person: text("person")?,
            recorded_on: recorded_on(table)?,
            kind: text("kind")?,
            standing: text("static")?,
            mass_kg: size("mass")?,
            height_m: size("height")?,
            age_years: size("age")?,
            model: text("model")?,
            forces: text("grf")?,
            loads: text("loads")?,
            excluded: text("exclude")?,
        },
    })
}
