//! Sessions that were computed before: the session to compare with, sessions of a reference group, and one that lies
//! where this one is to be written.

use super::{Computing, Stated, visit};
use crate::args::{Existing, SessionArgs};
use crate::commands::result_folder::ResultFolder;
use crate::record::Record;
use crate::{files, printer};
use ambulo::job::trials::{Plan, PlannedTrial};
use ambulo_report::{ReferenceGroup, Session, session_from_files};
use ambulo_results::{BATCH, CYCLES, SUMMARY};
use anyhow::{Context, Error, Result, bail};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The keys by which the summary of a session differs from summaries of other results.
#[derive(Deserialize)]
struct Head {
    session_format: Option<u32>,
    #[serde(default)]
    recordings: Vec<String>,
}

fn head(folder: &Path) -> Option<Head> {
    serde_json::from_slice(&fs::read(folder.join(SUMMARY)).ok()?).ok()
}

/// Refuses to replace the results of another command or of another visit.
pub(super) fn check_output(args: &SessionArgs, root: &Path, recordings: &[String]) -> Result<()> {
    let (output, shown) = (&args.output, args.output.display());
    let same = |a: &Path, b: &Path| a.canonicalize().is_ok_and(|a| b.canonicalize().is_ok_and(|b| a == b));
    if let Some(earlier) = args.compare.as_deref().filter(|earlier| same(earlier, output)) {
        bail!(
            "{}: the earlier session lies in the folder for the results, which would replace it. hint: choose another \
             folder with -o",
            earlier.display()
        );
    }
    if same(root, output) {
        bail!("{shown}: the results would lie between the recordings. hint: choose another folder with -o");
    }
    if output.join(BATCH).is_file() {
        bail!("{shown}: this folder has a batch ({BATCH}). hint: choose another folder with -o");
    }
    if args.replace.existing() == Existing::Replaced || Record::of_folder(output).is_none() {
        return Ok(());
    }
    let how = "hint: choose another folder with -o; --force replaces the results";
    match head(output) {
        Some(Head { session_format: None, .. }) | None => {
            bail!("{shown}: this folder has the results of another command, which would be lost. {how}")
        }
        Some(Head { recordings: known, .. }) => {
            let is_other = !known.is_empty() && !known.iter().any(|hash| recordings.contains(hash));
            if is_other {
                bail!("{shown}: this folder has the session of other recordings, which would be lost. {how}");
            }
            Ok(())
        }
    }
}

/// The session in a result folder.
pub(super) fn read(folder: &Path) -> Result<Session> {
    let shown = || folder.display().to_string();
    // This also completes the files of a run that was interrupted.
    let found = ResultFolder::of_any_run(folder).map_err(|error| match folder.join(SUMMARY).is_file() {
        true => error,
        false => Error::msg(format!(
            "{}: found no session here; expected a folder that `ambulo session` wrote. hint: `ambulo session DIR -o \
             OUT` writes one",
            folder.display()
        )),
    })?;
    let summary = found.read(SUMMARY).unwrap_or_default();
    if head(folder).is_none_or(|head| head.session_format.is_none()) {
        bail!(
            "{}: these are the results of another command; expected a folder that `ambulo session` wrote",
            folder.display()
        );
    }
    let cycles = found.checked(CYCLES)?;
    session_from_files(&summary, &cycles).map_err(Error::msg).with_context(shown)
}

/// The reference group of a file, or of the subjects in a folder.
pub(super) fn group(path: &Path, computing: &Computing<'_>) -> Result<ReferenceGroup> {
    let shown = || path.display().to_string();
    if !path.is_dir() {
        return ReferenceGroup::from_json(&files::read(path)?).with_context(shown);
    }
    let sessions = sessions_in(path)?;
    let people = if sessions.is_empty() { recorded_people(path, computing)? } else { sessions };
    ReferenceGroup::of(&people).with_context(shown)
}

/// The sessions that were computed into the folders of a folder.
fn sessions_in(folder: &Path) -> Result<Vec<Session>> {
    let cannot = || format!("{}: this folder cannot be read", folder.display());
    let mut folders: Vec<PathBuf> = Vec::new();
    for entry in fs::read_dir(folder).with_context(cannot)? {
        folders.push(entry.with_context(cannot)?.path());
    }
    folders.sort();
    let is_session = |folder: &&PathBuf| head(folder).is_some_and(|head| head.session_format.is_some());
    folders.iter().filter(is_session).map(|folder| read(folder)).collect()
}

/// The sessions of the subjects whose recordings are in the subfolders of a folder.
fn recorded_people(folder: &Path, computing: &Computing<'_>) -> Result<Vec<Session>> {
    let plan: Plan = visit::planned(folder, computing.threads)?;
    let names: BTreeSet<&str> = plan.trials.iter().map(|trial| trial.person.as_str()).collect();
    let mut people = Vec::new();
    for name in names {
        let trials: Vec<&PlannedTrial> = plan.trials.iter().filter(|trial| trial.person == name).collect();
        let found = computing.person(folder, &plan, &trials, Stated::default())?;
        if !found.session.has_cycles() {
            printer::progress(
                &format!("{name}: no trial has a cycle that counts; left out of the reference group"),
                computing.print,
            );
        }
        people.push(found.session);
    }
    Ok(people)
}
