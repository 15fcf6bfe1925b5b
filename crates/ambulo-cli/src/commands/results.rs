//! The results of a run in memory, or of a result folder, for programs that call this crate.

use super::report::page_of_run;
use super::result_folder::ResultFolder;
use super::run_files::MotionRun;
use super::simulate::SceneRun;
use super::sweep::SweepRun;
use super::validate::ValidationRun;
use crate::args::{Existing, PrintArgs};
use crate::failure::Failure;
use crate::replacement::ResultTarget;
use ambulo_formats::table::Table;
use ambulo_report::page::report_page;
use ambulo_results::{
    Folder, Keep, OutputFile, PAGE, RunSummary, SUMMARY, TIMINGS, VALIDATION_PAGE, is_storage, summary_json, unit_of,
};
use anyhow::{Context, Result};
use std::collections::BTreeMap;
use std::path::Path;

/// Results: the same tables, summary and page as the files of a result folder, computed on request.
pub struct Results(Content);

enum Content {
    Motion(Box<MotionRun>),
    Scene(Box<SceneRun>),
    Sweep(Box<SweepRun>),
    Validation(Box<ValidationRun>),
    Folder(Box<ResultFolder>),
}

impl From<MotionRun> for Results {
    fn from(run: MotionRun) -> Results {
        Results(Content::Motion(Box::new(run)))
    }
}

impl From<SceneRun> for Results {
    fn from(run: SceneRun) -> Results {
        Results(Content::Scene(Box::new(run)))
    }
}

impl From<SweepRun> for Results {
    fn from(run: SweepRun) -> Results {
        Results(Content::Sweep(Box::new(run)))
    }
}

impl From<ValidationRun> for Results {
    fn from(run: ValidationRun) -> Results {
        Results(Content::Validation(Box::new(run)))
    }
}

impl Results {
    pub(crate) fn of_folder(path: &Path) -> Result<Results> {
        Ok(Results(Content::Folder(Box::new(ResultFolder::of_any_run(path)?))))
    }

    /// The names of the files, except the summary; figures and page are listed only if they exist.
    ///
    /// # Errors
    /// Results that no file can store.
    pub fn names(&self) -> Result<Vec<String>, Failure> {
        let names = |files: &[OutputFile<'_>]| files.iter().map(|file| file.name.clone()).collect();
        Ok(match &self.0 {
            Content::Motion(run) => names(&run.tables_for(&run.keep_tables())?.0),
            Content::Scene(run) => names(&run.written),
            Content::Sweep(run) => names(&run.written),
            Content::Validation(run) => names(&run.written),
            Content::Folder(folder) => folder.names().cloned().collect(),
        })
    }

    /// The content of a file; `None` if the run has no such file.
    ///
    /// # Errors
    /// Results that no file can store; a folder that was changed.
    pub fn bytes(&self, name: &str) -> Result<Option<Vec<u8>>, Failure> {
        let of_file =
            |file: Option<&OutputFile<'_>>| file.map(OutputFile::bytes).transpose().map_err(anyhow::Error::new);
        Ok(match &self.0 {
            Content::Motion(run) => of_file(run.file(name)?.as_ref())?,
            Content::Scene(run) => of_file(run.written.iter().find(|file| file.name == name))?,
            Content::Sweep(run) => of_file(run.written.iter().find(|file| file.name == name))?,
            Content::Validation(run) => of_file(run.written.iter().find(|file| file.name == name))?,
            Content::Folder(folder) => from_folder(folder, |folder| folder.read(name))?,
        })
    }

    /// A table of numbers; `None` if the run has no such table.
    ///
    /// # Errors
    /// As [`Results::bytes`].
    pub fn table(&self, name: &str) -> Result<Option<Table>, Failure> {
        let of_file =
            |file: Option<&OutputFile<'_>>| file.and_then(OutputFile::table).transpose().map_err(anyhow::Error::new);
        Ok(match &self.0 {
            Content::Motion(run) => of_file(run.file(name)?.as_ref())?,
            Content::Scene(run) => of_file(run.written.iter().find(|file| file.name == name))?,
            Content::Sweep(_) | Content::Validation(_) => None,
            Content::Folder(folder) => from_folder(folder, |folder| {
                let read = |name: &str| folder.read(name);
                let files = Folder::of_files(folder.shown(), &read);
                if is_storage(name) { files.table(name) } else { files.csv_table(name) }
            })??,
        })
    }

    /// The units of the columns of a table, as words; empty where a column has none.
    ///
    /// # Errors
    /// A body that cannot be read.
    pub fn units(&self, table: &str, columns: &[String]) -> Result<Vec<String>, Failure> {
        let model = match &self.0 {
            Content::Motion(run) => Some(run.outcome.body.clone()),
            Content::Folder(folder) => from_folder(folder, |folder| {
                let read = |name: &str| folder.read(name);
                Folder::of_files(folder.shown(), &read).body()
            })??
            .map(|(_, model)| model),
            Content::Scene(_) | Content::Sweep(_) | Content::Validation(_) => None,
        };
        Ok(columns.iter().map(|column| unit_of(table, column, model.as_ref()).to_owned()).collect())
    }

    /// Computing time of each stage [ms]; empty for runs that do not measure it.
    #[must_use]
    pub fn timings(&self) -> BTreeMap<String, f64> {
        match &self.0 {
            Content::Motion(run) => run.clock.laps(),
            Content::Scene(run) => run.clock.laps(),
            Content::Sweep(_) | Content::Validation(_) => BTreeMap::new(),
            Content::Folder(folder) => folder.timings(),
        }
    }

    /// The content of `summary.json`. What is written with a folder (`run_id`, `files`) is empty before that.
    ///
    /// # Errors
    /// Results that JSON cannot store.
    pub fn summary(&self) -> Result<Vec<u8>, Failure> {
        let json = match &self.0 {
            Content::Motion(run) => summary_json(&run.tables_for(&run.keep_tables())?.1),
            Content::Scene(run) => summary_json(&run.summary),
            Content::Sweep(run) => summary_json(&run.summary("", BTreeMap::new())),
            Content::Validation(run) => summary_json(&run.summary("", BTreeMap::new())),
            Content::Folder(folder) => return Ok(folder.read(SUMMARY).unwrap_or_default()),
        };
        Ok(json.map_err(anyhow::Error::new)?)
    }

    /// The report page.
    ///
    /// # Errors
    /// Results that no page can show.
    pub fn page(&self) -> Result<Vec<u8>, Failure> {
        let name = Path::new("results");
        Ok(match &self.0 {
            Content::Motion(run) => {
                let (files, summary) = run.tables_for(&Keep::of_names(&["report".to_owned()]))?;
                page_of_run(name, &files, RunSummary::Motion(Box::new(summary)))?.bytes().map_err(anyhow::Error::new)?
            }
            Content::Scene(run) => page_of_run(name, &run.written, RunSummary::Scene(Box::new(run.summary.clone())))?
                .bytes()
                .map_err(anyhow::Error::new)?,
            Content::Sweep(_) => self.bytes(PAGE)?.context("the sweep was computed without its page")?,
            Content::Validation(_) => self.bytes(VALIDATION_PAGE)?.context("a validation has a page")?,
            Content::Folder(folder) if folder.has(VALIDATION_PAGE) => {
                self.bytes(VALIDATION_PAGE)?.context("a validation has a page")?
            }
            Content::Folder(folder) => match self.bytes(PAGE)? {
                Some(page) => page,
                None => from_folder(folder, |folder| {
                    let read = |name: &str| folder.read(name);
                    report_page(&[Folder::of_files(folder.name(), &read)])
                })?
                .map_err(anyhow::Error::new)?
                .into_bytes(),
            },
        })
    }

    /// Writes the folder that the command writes. With `force`, files that no run of Ambulo wrote are replaced.
    ///
    /// # Errors
    /// A folder that cannot be written, or that has files of others.
    pub fn save(&self, folder: &Path, force: bool) -> Result<(), Failure> {
        let shown = folder.display().to_string();
        let saved = self.write(folder, force);
        saved.map_err(|error| Failure::from(error).in_one_of(std::iter::once(shown.as_str())))
    }

    fn write(&self, folder: &Path, force: bool) -> Result<()> {
        let existing = if force { Existing::Replaced } else { Existing::Kept };
        let target = ResultTarget::for_run(folder, existing)?;
        match &self.0 {
            Content::Motion(run) => run.save(&target, PrintArgs::default()).map(drop)?,
            Content::Scene(run) => run.save(&target, PrintArgs::default()).map(drop)?,
            Content::Sweep(run) => run.save(&target)?,
            Content::Validation(run) => run.save(&target).map(drop)?,
            Content::Folder(folder) => {
                let files = folder.names().map(|name| Ok(OutputFile::new(name, folder.checked(name)?)));
                let mut files = files.collect::<Result<Vec<_>>>()?;
                files.extend(folder.timings_file().map(|bytes| OutputFile::new(TIMINGS, bytes)));
                target.replace(&files, &[], &mut |_| folder.read(SUMMARY).context(SUMMARY))?;
            }
        }
        Ok(())
    }
}

/// Reads from a folder; an unreadable file is an error.
fn from_folder<T>(folder: &ResultFolder, read: impl FnOnce(&ResultFolder) -> T) -> Result<T> {
    let value = read(folder);
    folder.check()?;
    Ok(value)
}
