//! Folders and lists of recordings: their files, read side by side for [`ambulo::job::trials`].

mod folder;

pub(crate) use folder::{files_in, listed};

use super::side_by_side::side_by_side;
use crate::caller::Caller;
use crate::files::{self, FilesOf};
use ambulo::job::trials::{Content, FoundFile, Listing, Plan, TrialFolder, Wanted, relative};
use anyhow::Result;
use std::path::Path;

/// Where the files of trials come from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Origin {
    /// All files of a folder.
    Folder,
    /// Files that a user listed.
    List,
}

/// Finds trials and what belongs to them.
pub(crate) fn plan(
    root: &Path,
    wanted: Wanted,
    (origin, found): (Origin, &[FoundFile]),
    threads: usize,
) -> Result<Plan> {
    let caller = Caller::default();
    let name = folder_name(root);
    let folder = TrialFolder { path: root, name: &name, wanted };
    let listing = match origin {
        Origin::Folder => Listing::of_folder(folder, found, &mut FilesOf(&caller))?,
        Origin::List => Listing::of_files(folder, found, &mut FilesOf(&caller))?,
    };
    let contents: Vec<Content> =
        side_by_side(listing.recordings(), threads, |k| listing.content(k, &mut FilesOf(&caller)));
    Ok(listing.plan(&contents, &mut FilesOf(&caller)))
}

/// The name of a folder, also of `.`.
pub(crate) fn folder_name(folder: &Path) -> String {
    files::last(&folder.canonicalize().unwrap_or_else(|_| folder.to_owned()))
}

/// The error of a recording in a row that has the name of the recording.
pub(crate) fn sentence(message: &str, hint: Option<String>, recording: &Path, root: &Path) -> String {
    let message = relative(message, root);
    let shown = relative(&recording.display().to_string(), root);
    let own = message.strip_prefix(&shown).and_then(|rest| rest.strip_prefix(": ")).unwrap_or(&message);
    let sentence = own.trim_end().trim_end_matches('.').to_owned();
    hint.map_or(sentence.clone(), |hint| format!("{sentence}. hint: {hint}"))
}
