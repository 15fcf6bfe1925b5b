//! The trials of one person, and what a session refuses: several persons, several standing trials.

use crate::commands::trials::{Origin, files_in, listed, plan};
use crate::record::hash_of_file;
use ambulo::job::trials::{LIST, Plan, PlannedTrial, Wanted};
use ambulo::numerics::sort_numbers;
use anyhow::{Result, bail};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Reasons and names that an error quotes.
const QUOTED: usize = 3;

/// The trials of a folder or of a list of files, and the folder that their names begin at.
pub(super) fn of(source: &[PathBuf], threads: usize) -> Result<(PathBuf, Plan)> {
    match source {
        [folder] if !folder.is_file() => Ok((folder.clone(), planned(folder, threads)?)),
        files => {
            let (root, found) = listed(files)?;
            let plan = with_trials(&root, plan(&root, Wanted::Motion, (Origin::List, &found), threads)?)?;
            Ok((root, plan))
        }
    }
}

/// The trials of a folder, one person or several.
pub(super) fn planned(folder: &Path, threads: usize) -> Result<Plan> {
    let wanted = Wanted::Motion;
    with_trials(folder, plan(folder, wanted, (Origin::Folder, &files_in(folder, wanted)?), threads)?)
}

fn with_trials(folder: &Path, plan: Plan) -> Result<Plan> {
    if plan.trials.is_empty() {
        let others: Vec<String> = plan.others.iter().take(QUOTED).map(|(name, why)| format!("{name}: {why}")).collect();
        let others = if others.is_empty() { String::new() } else { format!(" ({})", others.join("; ")) };
        bail!(
            "{}: found no trial{others}; expected the recordings of a visit: .c3d, .trc, .mot or .sto with a model, \
             .bvh, .mvnx, .npz or .b3d. hint: `ambulo info FILE` describes a file; docs/SESSION.md has the rules",
            folder.display()
        );
    }
    Ok(plan)
}

/// Refuses a folder with several persons.
pub(super) fn check_person(folder: &Path, plan: &Plan) -> Result<()> {
    let persons: BTreeSet<&str> = plan.trials.iter().map(|trial| trial.person.as_str()).collect();
    if persons.len() > 1 {
        bail!(
            "{}: found the trials of {} persons ({}); expected those of one, because a session has one body. A folder \
             with recordings is a person. hint: give the folder of one person; if all are one person, {LIST} states \
             it: [[trial]] files = \"**\" and person = \"NAME\" (docs/SESSION.md)",
            folder.display(),
            persons.len(),
            quoted(persons.iter().copied())
        );
    }
    Ok(())
}

/// Leaves out recordings that have the bytes of another one: their cycles would count twice.
pub(super) fn leave_out_copies(plan: &mut Plan) {
    let mut known: BTreeMap<String, String> = BTreeMap::new();
    let Plan { trials, others, .. } = plan;
    trials.retain(|trial| {
        // The trials of one file, and files that cannot be read, which get their own error.
        if trial.files.trial.is_some() {
            return true;
        }
        let Ok(hash) = hash_of_file(&trial.files.recording) else { return true };
        match known.get(&hash) {
            Some(first) => {
                others.push((trial.name.clone(), format!("a copy of {first}, byte for byte")));
                false
            }
            None => {
                known.insert(hash, trial.name.clone());
                true
            }
        }
    });
    others.sort();
}

/// Refuses several standing trials, unless it is stated which one counts.
pub(super) fn check_standing(folder: &Path, plan: &Plan, trials: &[&PlannedTrial]) -> Result<()> {
    let used: BTreeSet<&Path> = trials.iter().filter_map(|trial| trial.files.standing.as_deref()).collect();
    let by_rule = trials.iter().any(|trial| trial.files.standing.is_some() && trial.stated.standing.is_none());
    let candidates: Vec<&str> =
        plan.standing.iter().map(String::as_str).filter(|name| is_beside(name, trials)).collect();
    let how = format!(
        "hint: state it in {LIST}: [[trial]] files = \"**\" and static = \"FILE\"; or leave one out: [[trial]] files = \
         \"FILE\" and exclude = \"WHY\" (docs/SESSION.md)"
    );
    if by_rule && candidates.len() > 1 {
        bail!(
            "{}: found {} standing trials ({}); expected one, because one body is calibrated from it. {how}",
            folder.display(),
            candidates.len(),
            quoted(candidates.iter().copied())
        );
    }
    if used.len() > 1 {
        let names = used.iter().map(|path| path.strip_prefix(folder).unwrap_or(path).display().to_string());
        let names: Vec<String> = names.collect();
        bail!(
            "{}: the trials have {} standing trials ({}); expected one for all, because one body is calibrated from \
             it. {how}",
            folder.display(),
            used.len(),
            quoted(names.iter().map(String::as_str))
        );
    }
    Ok(())
}

/// Whether a recording is in the folder of one of the trials.
fn is_beside(name: &str, trials: &[&PlannedTrial]) -> bool {
    let folder = |name: &str| name.rsplit_once('/').map_or(String::new(), |(folder, _)| folder.to_owned());
    trials.iter().any(|trial| folder(&trial.name) == folder(name))
}

/// Refuses recordings that name different persons, unless the laboratory states whose they are.
pub(super) fn check_names(folder: &Path, named: &[(&PlannedTrial, String)]) -> Result<()> {
    let unstated = named.iter().filter(|(trial, _)| trial.stated.person.is_none());
    let names: BTreeSet<&str> = unstated.map(|(_, name)| name.as_str()).collect();
    if names.len() > 1 {
        bail!(
            "{}: the recordings name {} persons ({}); expected one. hint: give the folder of one person; if all are \
             one person, {LIST} states it: [[trial]] files = \"**\" and person = \"NAME\" (docs/SESSION.md)",
            folder.display(),
            names.len(),
            quoted(names.iter().copied())
        );
    }
    Ok(())
}

/// Refuses masses that differ: they belong to two persons, or one is wrong.
pub(super) fn check_stated(folder: &Path, trials: &[&PlannedTrial]) -> Result<()> {
    for (what, unit, of) in [
        ("mass", "kg", (|trial| trial.stated.mass_kg) as fn(&PlannedTrial) -> Option<f64>),
        ("height", "m", |trial| trial.stated.height_m),
        ("age", "years", |trial| trial.stated.age_years),
    ] {
        let mut values: Vec<f64> = trials.iter().filter_map(|trial| of(trial)).collect();
        sort_numbers(&mut values);
        if let (Some(low), Some(high)) = (values.first(), values.last())
            && high > low
        {
            bail!(
                "{}: {LIST} states `{what}` from {low} to {high} {unit} for the trials of one session; expected one \
                 number, because all have one body",
                folder.display()
            );
        }
    }
    Ok(())
}

fn quoted<'a>(names: impl ExactSizeIterator<Item = &'a str>) -> String {
    let more = if names.len() > QUOTED { ", ..." } else { "" };
    format!("{}{more}", names.take(QUOTED).collect::<Vec<_>>().join(", "))
}
