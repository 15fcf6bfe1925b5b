//! A result folder on disk, for functions that read its files by name.

use crate::files;
use anyhow::{Error, Result, bail};
use std::cell::RefCell;
use std::path::{Path, PathBuf};

/// A result folder. The error of an existing file that cannot be read is kept for [`ResultFolder::check`].
pub(super) struct ResultFolder {
    path: PathBuf,
    failure: RefCell<Option<Error>>,
}

impl ResultFolder {
    /// Opens a folder with a `summary.json`; anything else is an error with a hint.
    pub(super) fn open(path: &Path) -> Result<ResultFolder> {
        let shown = path.display();
        let hint = "hint: `ambulo demo -o demo` writes one";
        if path.is_file() {
            let folder = path.parent().filter(|folder| folder.join(SUMMARY).is_file());
            let hint =
                folder.map_or_else(|| hint.to_owned(), |folder| format!("hint: its folder is {}", folder.display()));
            bail!("{shown}: this is a file; expected a result folder. {hint}");
        }
        if !path.is_dir() {
            bail!("{shown}: there is no such folder; expected a result folder. {hint}");
        }
        if !path.join(SUMMARY).is_file() {
            let other = if path.join("claims.json").is_file() {
                "; `ambulo reproduce` wrote this folder, and its report.html cannot be written again"
            } else {
                ""
            };
            bail!(
                "{shown}: found no {SUMMARY}{other}; expected a folder that `ambulo forces`, `walk`, `demo` or `simulate` wrote. {hint}"
            );
        }
        Ok(ResultFolder { path: path.to_owned(), failure: RefCell::new(None) })
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.path.join(name).is_file()
    }

    /// The content of a file of the folder, if it exists.
    pub(super) fn read(&self, name: &str) -> Option<Vec<u8>> {
        let path = self.path.join(name);
        if !path.exists() {
            return None;
        }
        files::read(&path).map_err(|error| self.failure.borrow_mut().get_or_insert(error).to_string()).ok()
    }

    /// The path as it was typed.
    pub(super) fn shown(&self) -> String {
        self.path.display().to_string()
    }

    /// The folder's own name.
    pub(super) fn name(&self) -> String {
        last(&self.path)
    }

    /// Returns the error of the first file that could not be read.
    pub(super) fn check(&self) -> Result<()> {
        self.failure.take().map_or(Ok(()), Err)
    }
}

const SUMMARY: &str = "summary.json";

/// Name of a folder without its path.
pub(super) fn last(folder: &Path) -> String {
    folder.file_name().unwrap_or(folder.as_os_str()).to_string_lossy().into_owned()
}
