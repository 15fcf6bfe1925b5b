//! Reading and writing of files; every error names its file.

use crate::args::Existing;
use crate::caller::Caller;
use crate::replacement::{is_input, recover, write_through};
use ambulo::findings::{Code, Findings};
use ambulo::job::{FileError, Files};
use ambulo_formats::Remark;
use anyhow::{Context, Error, Result, bail};
use std::fmt;
use std::fs;
use std::io::{ErrorKind, Read, Seek, SeekFrom};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Larger files are rejected before they are read, which bounds the memory; no recording of walking needs more.
const LARGEST_FILE_BYTES: u64 = 512 << 20;

/// A file that does not exist.
#[derive(Debug)]
pub(crate) struct NoSuchFile(String);

impl fmt::Display for NoSuchFile {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let NoSuchFile(shown) = self;
        write!(
            f,
            "{shown}: there is no such file. hint: check the path; it is relative to the folder in which you typed the \
             command, or to the file that names it"
        )
    }
}

impl std::error::Error for NoSuchFile {}

/// The input files of a caller, from its memory or the disk.
pub(crate) struct FilesOf<'a>(pub(crate) &'a Caller);

impl Files for FilesOf<'_> {
    fn read(&mut self, path: &Path) -> Result<Vec<u8>, FileError> {
        read_input(self.0, path).map_err(Error::reallocate_into_boxed_dyn_error_without_backtrace)
    }

    fn read_part(&mut self, path: &Path, part: Range<usize>) -> Result<Vec<u8>, FileError> {
        read_part(self.0, path, part).map_err(Error::reallocate_into_boxed_dyn_error_without_backtrace)
    }

    fn has(&mut self, path: &Path) -> bool {
        self.0.has_file(path)
    }
}

/// Reads an input file from the caller's memory or, without one there, from the disk.
pub(crate) fn read_input(caller: &Caller, path: &Path) -> Result<Vec<u8>> {
    caller.content(path).map_or_else(|| read(path), |content| Ok(content.to_vec()))
}

/// Reads a file. If it is in a result folder, an interrupted run is finished or undone first.
pub(crate) fn read(path: &Path) -> Result<Vec<u8>> {
    let shown = path.display();
    folders_around(path).iter().try_for_each(|folder| recover(folder))?;
    let metadata = match fs::metadata(path) {
        Ok(metadata) => metadata,
        Err(e) if e.kind() == ErrorKind::NotFound => return Err(NoSuchFile(shown.to_string()).into()),
        Err(e) => return Err(e).with_context(|| format!("{shown}: cannot be opened")),
    };
    if metadata.is_dir() {
        bail!("{shown}: this is a folder; expected a file");
    }
    if !metadata.is_file() {
        bail!("{shown}: this is a pipe or a device; expected a file. hint: save the data as a file first");
    }
    if metadata.len() > LARGEST_FILE_BYTES {
        let (found, allowed) = (metadata.len() >> 20, LARGEST_FILE_BYTES >> 20);
        bail!("{shown}: {found} MB; expected at most {allowed} MB. hint: is this really a motion or a model?");
    }
    // A vector that grows takes up to twice the memory of the file.
    let mut bytes = Vec::with_capacity(usize::try_from(metadata.len()).unwrap_or_default().saturating_add(1));
    let file = fs::File::open(path).with_context(|| format!("{shown}: cannot be opened"))?;
    // The size in the metadata may be wrong (a growing file).
    file.take(LARGEST_FILE_BYTES).read_to_end(&mut bytes).with_context(|| format!("{shown}: cannot be read"))?;
    Ok(bytes)
}

/// A part of a file of any size; shorter at the end of the file.
fn read_part(caller: &Caller, path: &Path, part: Range<usize>) -> Result<Vec<u8>> {
    let shown = path.display();
    if let Some(content) = caller.content(path) {
        let end = part.end.min(content.len());
        return Ok(content[part.start.min(end)..end].to_vec());
    }
    let allowed = usize::try_from(LARGEST_FILE_BYTES).unwrap_or(usize::MAX);
    if part.len() > allowed {
        bail!("{shown}: found a part of {} MB; expected at most {} MB", part.len() >> 20, allowed >> 20);
    }
    let mut file = match fs::File::open(path) {
        Ok(file) => file,
        Err(e) if e.kind() == ErrorKind::NotFound => return Err(NoSuchFile(shown.to_string()).into()),
        Err(e) => return Err(e).with_context(|| format!("{shown}: cannot be opened")),
    };
    if !file.metadata().is_ok_and(|metadata| metadata.is_file()) {
        bail!("{shown}: this is no file; expected a file that can be read at any place");
    }
    let mut bytes = Vec::new();
    let read = file
        .seek(SeekFrom::Start(part.start as u64))
        .and_then(|_| file.take(part.len() as u64).read_to_end(&mut bytes));
    read.with_context(|| format!("{shown}: cannot be read"))?;
    Ok(bytes)
}

/// The folders that may be the result folder of a file: its own, and the one around that.
pub(crate) fn folders_around(path: &Path) -> Vec<PathBuf> {
    path.canonicalize().map_or(Vec::new(), |path| path.ancestors().skip(1).take(2).map(Path::to_owned).collect())
}

/// Refuses to write over an input, a folder, and with [`Existing::Kept`] over any file.
pub(crate) fn check_target(path: &Path, inputs: &[PathBuf], existing: Existing) -> Result<()> {
    let shown = path.display();
    if is_input(path, inputs) {
        bail!("{shown}: this input file would be overwritten. hint: choose another name");
    }
    if path.is_dir() {
        bail!("{shown}: this is a folder; expected the name of a file");
    }
    if path.is_file() && existing == Existing::Kept {
        bail!("{shown}: this file already exists. hint: --force overwrites it");
    }
    Ok(())
}

/// Refuses a file that is larger than the system allows this process (`ulimit -f`), which would end it in the middle.
fn check_size_limit(path: &Path, bytes: &[u8]) -> Result<()> {
    // Only Linux states the limit in a file; elsewhere there is none that matters.
    let limits = fs::read_to_string("/proc/self/limits").unwrap_or_default();
    let of_files = limits.lines().find_map(|line| line.strip_prefix("Max file size"));
    let allowed = of_files.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
    if let Some(allowed) = allowed.filter(|allowed| bytes.len() as u64 > *allowed) {
        let needed = bytes.len();
        bail!("{}: this file needs {needed} bytes; this shell allows {allowed}. hint: `ulimit -f`", path.display());
    }
    Ok(())
}

/// Writes a file as a whole or not at all; creates its folder if necessary.
pub(crate) fn write(path: &Path, bytes: &[u8]) -> Result<()> {
    check_size_limit(path, bytes)?;
    // A link stays, and a device or a pipe is written to directly.
    let path = &fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    if let Some(folder) = path.parent() {
        if folder.is_file() {
            bail!("{}: this is a file; expected a folder for the results", folder.display());
        }
        fs::create_dir_all(folder).with_context(|| format!("{}: this folder cannot be created", folder.display()))?;
    }
    let whole = || {
        if path.exists() && !path.is_file() {
            return fs::write(path, bytes);
        }
        let part = path.with_file_name(format!(".{}.ambulo-part", last(path)));
        let written = write_through(&part, bytes).and_then(|()| fs::rename(&part, path));
        if written.is_err() {
            // The error is the one of writing.
            let _ = fs::remove_file(&part);
        }
        written
    };
    whole().with_context(|| format!("{}: cannot be written", path.display()))
}

/// The last part of a path.
pub(crate) fn last(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// Reports the remarks of a reader as findings.
pub(crate) fn note_remarks(path: &str, remarks: &[Remark], findings: &mut Findings) {
    for remark in remarks {
        let code = if remark.is_about_clock { Code::MotionClock } else { Code::FileOdd };
        findings.report(code, format!("{path}: {remark}"));
    }
}
