//! The files of a folder and of the folders in it.

use crate::record::Record;
use ambulo::job::trials::{FoundFile, Wanted};
use anyhow::{Context, Result, bail};
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// More folders inside each other are a mistake, such as a link to the root of a disk.
const DEEPEST: usize = 32;

/// All files that may be parts of trials, in the order of their names. Hidden files and folders are left out, and
/// result folders of this program, whose motion is not a recording.
pub(crate) fn files_in(root: &Path, wanted: Wanted) -> Result<Vec<FoundFile>> {
    let shown = root.display();
    if root.is_file() {
        bail!(
            "{shown}: this is a file; expected a folder with recordings. hint: `ambulo forces {shown}` computes one \
             recording"
        );
    }
    if !root.is_dir() {
        bail!("{shown}: there is no such folder; expected a folder with recordings");
    }
    if Record::of_folder(root).is_some() {
        bail!(
            "{shown}: this folder has results of Ambulo; expected a folder with recordings. hint: the recordings of \
             `ambulo demo` are in its folder input"
        );
    }
    let mut found = Vec::new();
    collect(root, "", DEEPEST, &mut BTreeSet::new(), &mut found)?;
    let is_bids = root.join(FoundFile::BIDS).is_file();
    found.retain(|file| file.may_be_part(wanted, is_bids));
    Ok(found)
}

/// The listed files as if they lay in one folder, and their deepest common folder.
///
/// # Errors
/// A file that does not exist, is listed twice, or is no part of a trial.
pub(crate) fn listed(paths: &[PathBuf]) -> Result<(PathBuf, Vec<FoundFile>)> {
    let folder = |path: &PathBuf| path.parent().unwrap_or(Path::new("")).to_owned();
    let mut root = paths.first().map(folder).unwrap_or_default();
    while !paths.iter().all(|path| path.starts_with(&root)) && root.pop() {}
    let mut found: Vec<FoundFile> = Vec::with_capacity(paths.len());
    for path in paths {
        let shown = path.display();
        if path.is_dir() {
            bail!("{shown}: this is a folder; expected one folder, or files only");
        }
        if !path.is_file() {
            bail!("{shown}: there is no such file; expected a recording, or a file of one");
        }
        let name = path.strip_prefix(&root).unwrap_or(path).display().to_string().replace('\\', "/");
        let file = FoundFile { path: path.clone(), name, folder: String::new() };
        if !file.may_be_part(Wanted::Motion, false) {
            bail!(
                "{shown}: this is no file of a trial; expected .{}, or the motion of a BIDS data set",
                FoundFile::endings().collect::<Vec<_>>().join(", .")
            );
        }
        if found.iter().any(|other| other.path == file.path) {
            bail!("{shown}: found in the list twice; expected each file once");
        }
        found.push(file);
    }
    found.sort_by(|a, b| a.name.cmp(&b.name));
    let root = if root.as_os_str().is_empty() { PathBuf::from(".") } else { root };
    Ok((root, found))
}

fn collect(
    folder: &Path,
    name: &str,
    deeper: usize,
    visited: &mut BTreeSet<PathBuf>,
    found: &mut Vec<FoundFile>,
) -> Result<()> {
    let cannot = || format!("{}: this folder cannot be read", folder.display());
    // A link may lead back to a folder around it.
    let is_new = visited.insert(folder.canonicalize().with_context(cannot)?);
    if !is_new || Record::of_folder(folder).is_some() {
        return Ok(());
    }
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).with_context(cannot)? {
        names.push(entry.with_context(cannot)?.file_name());
    }
    names.sort();
    for own in names {
        let (path, shown) = (folder.join(&own), own.to_string_lossy().into_owned());
        if shown.starts_with('.') {
            continue;
        }
        let below = if name.is_empty() { shown } else { format!("{name}/{shown}") };
        if path.is_dir() {
            if deeper == 0 {
                bail!(
                    "{}: found more than {DEEPEST} folders inside each other. Does a link lead to the folder of a \
                     disk?",
                    path.display()
                );
            }
            collect(&path, &below, deeper - 1, visited, found)?;
        } else if path.is_file() {
            found.push(FoundFile { path, name: below, folder: name.to_owned() });
        }
    }
    Ok(())
}
