//! Replaces the results in a folder as a whole: after a kill at any moment, or on a full disk, the old or the new
//! results are complete.
//!
//! | step | change | after a kill, the next command |
//! |---|---|---|
//! | 1 | the new files are written to `DIR/.ambulo-new/`, through to the disk | undoes: removes `.ambulo-new`; all old |
//! | 2 | `.ambulo-new/manifest.json`, which lists them, appears by a rename | finishes: repeats steps 3 to 5; all new |
//! | 3 | the old `summary.json` is removed, then the old files that have no successor | finishes |
//! | 4 | the new files are moved to `DIR`, each by a rename, `summary.json` last | finishes |
//! | 5 | the manifest is removed, then `.ambulo-new` | finishes |
//!
//! Steps 3 to 5 can be repeated: what is already removed or moved is left out. A lock ([`FolderLock`]) keeps other
//! commands out. Only files that the old `summary.json` records with their present content are replaced, and the
//! `timings.json` of the same run, which is not recorded because durations differ between equal runs; any other file
//! needs `--force`, and an input is never replaced. The folder itself is never replaced, so it may be a mount point or
//! `.`.
//!
//! Tests: every step interrupted, also while an interrupted run is finished (tests/replacement.rs); kills, a full disk
//! and two runs at once (tests/folders.rs).

use crate::args::Existing;
use crate::folder_lock::FolderLock;
use crate::record::{Hashed, Record, hash_of_file, is_inside};
use ambulo_results::{OutputFile, SUMMARY, TIMINGS, WriteError};
use anyhow::{Context, Error, Result, bail};
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};

/// Folder of the new files until all of them are complete.
pub const NEW: &str = ".ambulo-new";
/// In [`NEW`]: the list of its files. A run is complete as soon as this file exists.
pub const MANIFEST: &str = "manifest.json";

/// Makes the content of the summary from the hashes of all other files by name.
pub type MakeSummary<'a> = dyn FnMut(BTreeMap<String, String>) -> Result<Vec<u8>> + 'a;
/// Writes the content of a file.
pub type WriteContent<'a> = dyn FnMut(&mut dyn Write) -> io::Result<()> + 'a;

/// A folder that this process alone writes to.
pub struct ResultTarget {
    folder: PathBuf,
    existing: Existing,
    _lock: FolderLock,
}

impl ResultTarget {
    /// Takes the folder for a run, before anything is computed; finishes or undoes an interrupted run in it.
    ///
    /// # Errors
    /// Another command writes there, or the folder has files that are not replaced.
    pub fn for_run(folder: &Path, existing: Existing) -> Result<ResultTarget> {
        let target = ResultTarget::open(folder, existing)?;
        let record = target.record()?;
        target.refuse_foreign(record.as_ref(), record.iter().flat_map(|record| record.files.keys()))?;
        Ok(target)
    }

    /// The same for a change of one file.
    ///
    /// # Errors
    /// Another command writes there, or an interrupted run cannot be finished or undone.
    pub fn open(folder: &Path, existing: Existing) -> Result<ResultTarget> {
        let shown = folder.display();
        if folder.is_file() {
            bail!("{shown}: this is a file; expected a folder for the results");
        }
        let Some(lock) = FolderLock::take(folder)? else {
            bail!(
                "{shown}: another ambulo command is writing to this folder; expected one at a time. hint: wait until \
                 it has ended, or choose another folder with -o"
            );
        };
        settle(&Disk, folder)?;
        Ok(ResultTarget { folder: folder.to_owned(), existing, _lock: lock })
    }

    pub(crate) fn folder(&self) -> &Path {
        &self.folder
    }

    /// Replaces the results of an earlier run by these files and the summary that records them.
    ///
    /// # Errors
    /// Files that are not replaced, or cannot be written.
    pub fn replace(&self, written: &[OutputFile<'_>], inputs: &[PathBuf], summary: &mut MakeSummary<'_>) -> Result<()> {
        let record = self.record()?;
        let has_timings = record.as_ref().is_some_and(|record| record.timings(&self.folder).is_some());
        let timings = has_timings.then(|| TIMINGS.to_owned());
        let old = || record.iter().flat_map(|record| record.files.keys()).chain(&timings);
        let own = SUMMARY.to_owned();
        let new = || written.iter().map(|file| &file.name).chain([&own]);
        let names = || old().chain(new());
        if let Some(name) = names().find(|name| is_input(&self.folder.join(name), inputs)) {
            let path = self.folder.join(name);
            bail!("{}: this input file would be overwritten. hint: choose another folder with -o", path.display());
        }
        self.refuse_foreign(record.as_ref(), names())?;
        let stale = old().filter(|name| written.iter().all(|file| file.name != **name));
        let removed = stale.filter_map(|name| Some((name.clone(), hash_of_file(&self.folder.join(name)).ok()?)));
        replace(&Disk, &self.folder, written, summary, removed.collect())
    }

    /// Replaces one file of a run, and its hash in the summary.
    pub(crate) fn replace_one(&self, file: OutputFile<'_>) -> Result<()> {
        self.refuse_foreign(self.record()?.as_ref(), [&file.name])?;
        let path = self.folder.join(SUMMARY);
        let mut summary: Value = serde_json::from_slice(&read(&path)?).with_context(|| path.display().to_string())?;
        let mut summary = |hashes: BTreeMap<String, String>| {
            for (name, hash) in hashes {
                summary["files"][name] = hash.into();
            }
            Ok(ambulo_results::summary_json(&summary)?)
        };
        replace(&Disk, &self.folder, &[file], &mut summary, BTreeMap::new())
    }

    /// The record of the run in this folder. A summary without one is replaced only with `--force`.
    fn record(&self) -> Result<Option<Record>> {
        let record = Record::of_folder(&self.folder);
        let summary = self.folder.join(SUMMARY);
        if record.is_none() && self.existing == Existing::Kept && summary.symlink_metadata().is_ok() {
            bail!(
                "{}: this file does not record the files of a run, so it may be yours or that of an earlier version. \
                 hint: choose another folder with -o; --force replaces files that have the name of a result",
                summary.display()
            );
        }
        Ok(record)
    }

    /// Refuses to replace a file that the run in this folder did not write, or that was changed since.
    fn refuse_foreign<'a>(&self, record: Option<&Record>, names: impl IntoIterator<Item = &'a String>) -> Result<()> {
        for name in names {
            let path = self.folder.join(name);
            let shown = path.display();
            let hint = "hint: choose another folder with -o; --force replaces it";
            let parent = path.parent().unwrap_or(&self.folder);
            if parent.symlink_metadata().is_ok() && !parent.is_dir() {
                bail!("{}: this is a file; expected a folder for the results", parent.display());
            }
            match path.symlink_metadata() {
                Err(_) => {}
                Ok(found) if found.is_dir() => bail!("{shown}: this is a folder; expected the name of a file"),
                Ok(_) if self.existing == Existing::Replaced => {}
                // With a record it is the summary of a run.
                Ok(_) if name == SUMMARY && record.is_some() => {}
                Ok(_) if name == TIMINGS && record.is_some_and(|record| record.timings(&self.folder).is_some()) => {}
                Ok(_) => match record.and_then(|record| record.files.get(name)) {
                    None => {
                        bail!("{shown}: no run of Ambulo recorded this file as its own, so it is not replaced. {hint}")
                    }
                    Some(recorded) if *recorded != hash_of(&path)? => {
                        bail!(
                            "{shown}: this file was changed after the run that wrote it, so it is not replaced. {hint}"
                        )
                    }
                    Some(_) => {}
                },
            }
        }
        Ok(())
    }
}

/// Finishes or undoes an interrupted run before the files of a folder are read.
///
/// # Errors
/// New results that are complete cannot be moved to their places.
pub fn recover(folder: &Path) -> Result<()> {
    let shown = folder.display();
    let is_complete = || folder.join(NEW).join(MANIFEST).is_file();
    if !folder.join(NEW).exists() {
        return Ok(());
    }
    let settled = match FolderLock::take(folder) {
        Ok(Some(_lock)) => settle(&Disk, folder),
        Ok(None) if is_complete() => {
            bail!("{shown}: another ambulo command is replacing these results. hint: try again when it has ended")
        }
        Ok(None) => Ok(()),
        Err(error) => Err(error),
    };
    match settled {
        // Until the new results are complete, the old ones are.
        Err(error) if is_complete() => Err(error.context(format!(
            "{shown}: an interrupted run has left new results in {NEW}, which must be moved to their places by a \
             command that may write here"
        ))),
        _ => Ok(()),
    }
}

/// The files of a complete run in [`NEW`].
#[derive(Serialize, Deserialize)]
struct Manifest {
    /// Names of the new files.
    files: Vec<String>,
    /// Old files without a successor, with their hashes.
    removed: BTreeMap<String, String>,
}

/// Steps 1 to 5.
///
/// # Errors
/// A change of the disk has failed; the old or the new results are complete.
pub fn replace(
    disk: &impl Changes,
    folder: &Path,
    written: &[OutputFile<'_>],
    summary: &mut MakeSummary<'_>,
    removed: BTreeMap<String, String>,
) -> Result<()> {
    let files = written.iter().map(|file| file.name.clone()).chain([SUMMARY.to_owned()]).collect();
    let manifest = Manifest { files, removed };
    if let Err(error) = stage(disk, folder, written, summary, &manifest) {
        // The next command removes the rest.
        let _ = disk.remove_dir(&folder.join(NEW));
        return Err(error.context(format!("{}: no results were written; earlier ones are unchanged", folder.display())));
    }
    finish(disk, folder, &manifest).with_context(|| {
        format!(
            "{}: the new results are complete, but still in {NEW}; the next command here moves them",
            folder.display()
        )
    })
}

/// Steps 1 and 2.
fn stage(
    disk: &impl Changes,
    folder: &Path,
    written: &[OutputFile<'_>],
    summary: &mut MakeSummary<'_>,
    manifest: &Manifest,
) -> Result<()> {
    let new = folder.join(NEW);
    let write = |file: &OutputFile<'_>| {
        let path = new.join(&file.name);
        let failed = || format!("{}: cannot be written", path.display());
        disk.create_dir(path.parent().unwrap_or(&new)).with_context(failed)?;
        let mut hash = String::new();
        let mut content = |out: &mut dyn Write| {
            let mut hashed = Hashed::new(out);
            file.write_to(&mut hashed).map_err(|error| match error {
                WriteError::Place(error) => error,
                WriteError::Content(error) => io::Error::other(error),
            })?;
            hash = hashed.hash();
            Ok(())
        };
        disk.write(&path, &mut content).with_context(failed)?;
        Ok::<String, Error>(hash)
    };
    let mut hashes: BTreeMap<_, _> =
        written.iter().map(|file| Ok((file.name.clone(), write(file)?))).collect::<Result<_>>()?;
    hashes.remove(TIMINGS);
    write(&OutputFile::new(SUMMARY, summary(hashes)?))?;
    let [part, complete] = ["manifest.part", MANIFEST].map(|name| new.join(name));
    let failed = || format!("{}: cannot be written", complete.display());
    let list = serde_json::to_vec(manifest)?;
    disk.write(&part, &mut |out| out.write_all(&list)).with_context(failed)?;
    disk.rename(&part, &complete).with_context(failed)?;
    disk.sync_dir(&new);
    Ok(())
}

/// Steps 3 to 5, as far as they have not been done.
fn finish(disk: &impl Changes, folder: &Path, manifest: &Manifest) -> Result<()> {
    let new = folder.join(NEW);
    let old_summary = folder.join(SUMMARY);
    if new.join(SUMMARY).is_file() && old_summary.is_file() {
        disk.remove_file(&old_summary).with_context(|| format!("{}: cannot be replaced", old_summary.display()))?;
    }
    for (name, recorded) in &manifest.removed {
        let path = folder.join(name);
        if hash_of_file(&path).is_ok_and(|found| found == *recorded) {
            disk.remove_file(&path).with_context(|| format!("{}: cannot be removed", path.display()))?;
        }
    }
    let (last, first): (Vec<&String>, Vec<&String>) = manifest.files.iter().partition(|name| *name == SUMMARY);
    for name in first.into_iter().chain(last).filter(|name| new.join(name).is_file()) {
        let path = folder.join(name);
        let failed = || format!("{}: cannot be replaced", path.display());
        disk.create_dir(path.parent().unwrap_or(folder)).with_context(failed)?;
        disk.rename(&new.join(name), &path).with_context(failed)?;
    }
    for parent in
        manifest.removed.keys().filter_map(|name| Path::new(name).parent()).filter(|parent| *parent != Path::new(""))
    {
        // A subfolder stays if it has other files.
        let _ = fs::remove_dir(folder.join(parent));
    }
    disk.sync_dir(folder);
    // All results are in place; the next command removes the rest.
    let _ = disk.remove_file(&new.join(MANIFEST)).and_then(|()| disk.remove_dir(&new));
    Ok(())
}

/// Finishes a run that is complete in [`NEW`], or removes an incomplete one.
///
/// # Errors
/// A change of the disk has failed, or the list of the files is damaged.
pub fn settle(disk: &impl Changes, folder: &Path) -> Result<()> {
    let new = folder.join(NEW);
    let path = new.join(MANIFEST);
    if !new.exists() {
        return Ok(());
    }
    if !path.is_file() {
        return disk
            .remove_dir(&new)
            .with_context(|| format!("{}: this rest of a run cannot be removed", new.display()));
    }
    let manifest: Manifest = serde_json::from_slice(&read(&path)?).with_context(|| path.display().to_string())?;
    if let Some(name) = manifest.files.iter().chain(manifest.removed.keys()).find(|name| !is_inside(name)) {
        bail!("{}: found the file `{name}`; expected files inside the folder", path.display());
    }
    finish(disk, folder, &manifest)
}

/// Whether a path leads to one of these files.
pub(crate) fn is_input(path: &Path, inputs: &[PathBuf]) -> bool {
    let same = |input: &PathBuf| fs::canonicalize(input).ok() == fs::canonicalize(path).ok();
    path.exists() && inputs.iter().any(same)
}

/// The content of a file of the folder.
fn hash_of(path: &Path) -> Result<String> {
    hash_of_file(path).with_context(|| format!("{}: cannot be read", path.display()))
}

fn read(path: &Path) -> Result<Vec<u8>> {
    fs::read(path).with_context(|| format!("{}: cannot be read", path.display()))
}

/// Changes of a file system, one by one; tests fail each of them.
pub trait Changes {
    /// Makes a folder and those around it, if they do not exist.
    fn create_dir(&self, path: &Path) -> io::Result<()>;
    /// Writes a file; returns when it is on the disk.
    fn write(&self, path: &Path, content: &mut WriteContent<'_>) -> io::Result<()>;
    /// Moves a file, and replaces the one at its new place.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;
    /// Removes a file.
    fn remove_file(&self, path: &Path) -> io::Result<()>;
    /// Removes a folder with its files.
    fn remove_dir(&self, path: &Path) -> io::Result<()>;
    /// Waits until the names in a folder are on the disk, where the file system can do that.
    fn sync_dir(&self, _: &Path) {}
}

/// The file system itself.
pub struct Disk;

impl Changes for Disk {
    fn create_dir(&self, path: &Path) -> io::Result<()> {
        fs::create_dir_all(path)
    }

    fn write(&self, path: &Path, content: &mut WriteContent<'_>) -> io::Result<()> {
        let mut file = BufWriter::new(File::create(path)?);
        content(&mut file)?;
        file.into_inner()?.sync_all()
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        match fs::rename(from, to) {
            // A subfolder may be a link to another disk or a mount point.
            Err(error) if error.kind() == ErrorKind::CrossesDevices => {
                let part = to.with_extension("ambulo-part");
                write_through(&part, &fs::read(from)?)?;
                fs::rename(&part, to)?;
                fs::remove_file(from)
            }
            moved => moved,
        }
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    fn remove_dir(&self, path: &Path) -> io::Result<()> {
        fs::remove_dir_all(path)
    }

    fn sync_dir(&self, path: &Path) {
        // Without it, only a power cut can undo a rename, never a kill.
        let _ = File::open(path).and_then(|folder| folder.sync_all());
    }
}

/// Writes a file and returns when its bytes are on the disk.
pub(crate) fn write_through(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::create(path)?;
    file.write_all(bytes)?;
    file.sync_all()
}
