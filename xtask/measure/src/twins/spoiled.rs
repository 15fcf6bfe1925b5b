//! Twins of clean recordings with one fault of a laboratory each, and whether the fault is named.
//!
//! A twin is the bytes of the two C3D files (trial, standing trial), changed in one way; it takes the same road as any
//! file. It is named if one of the codes that belong to the fault is among its findings. The same codes must not appear
//! in the clean recordings.

use super::Chosen;
use super::clean::{Files, is_tested, people};
use super::faults::{FAULTS, Fault, NOT_GOOD};
use ambulo::findings::Findings;
use ambulo::job::{FileError, Job};
use ambulo::study::validation::TextTable;
use ambulo::study::{self, Outcome, QualityState};
use ambulo_formats::c3d::{C3d, Storage};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

/// Of the clean recordings, at most this share may show the codes of a fault [1].
const MOST_FALSE: f64 = 0.05;
/// Of the twins of a fault, at least this share is named [1].
const LEAST_NAMED: f64 = 0.95;

/// The files of a person: a walk, and a standing trial if there is one.
#[derive(Debug, Clone)]
pub(super) struct Pair {
    pub(super) moving: C3d,
    pub(super) standing: Option<C3d>,
}

/// A recording while it is spoiled.
pub(super) struct Trial {
    pub(super) moving: C3d,
    pub(super) standing: Option<C3d>,
    /// Somebody else's.
    pub(super) other: Pair,
}

/// How many twins of each fault are named.
pub(super) struct Spoiled {
    pub(super) table: TextTable,
    /// Number of clean recordings.
    pub(super) clean: usize,
    /// Faults of which too few twins are named, or that too many clean recordings show.
    pub(super) failures: Vec<&'static str>,
    /// What is said of the twins that are not named: the state of the quality and the tested codes, or the refusal.
    pub(super) said: Vec<String>,
}

/// Spoils the first clean recording of each person in every way that is chosen, and counts how many are named.
pub(super) fn judged(data: &Path, chosen: &Chosen<'_>) -> Result<Spoiled, String> {
    let is_chosen = |files: &Files| name(&files.trial).contains(chosen.recording);
    let recordings: Vec<Files> = people(data).into_iter().filter_map(|trials| trials.into_iter().next()).collect();
    if let Some(code) = FAULTS.iter().flat_map(|fault| fault.codes).find(|code| !is_tested(code) && !code.contains(' '))
    {
        return Err(format!("{code} is missing in the list of the clean recordings"));
    }
    let clean = codes_of_clean(data, is_chosen)?;
    let mut found = Spoiled {
        table: TextTable::new(&["fault", "named", "of", "clean", "not named"]),
        clean: clean.len(),
        failures: Vec::new(),
        said: Vec::new(),
    };
    for fault in FAULTS.iter().filter(|fault| fault.name.contains(chosen.fault)) {
        let Twins { named, made, unnamed, said } = Twins::of(fault, &recordings, is_chosen)?;
        found.said.extend(said);
        let is_false = |codes: &&BTreeSet<&str>| fault.codes.iter().any(|code| codes.contains(code));
        let falsely = clean.values().filter(is_false).count();
        let counts = [named, made, falsely].map(|count| count.to_string());
        found.table.row([fault.name.to_owned()].into_iter().chain(counts).chain([unnamed.join(" ")]));
        if (named as f64) < LEAST_NAMED * made as f64 || falsely as f64 > MOST_FALSE * clean.len() as f64 {
            found.failures.push(fault.name);
        }
    }
    Ok(found)
}

/// Twins of a fault.
struct Twins {
    named: usize,
    made: usize,
    /// The recordings whose twins are not named.
    unnamed: Vec<String>,
    /// What is said of them instead.
    said: Vec<String>,
}

impl Twins {
    fn of(fault: &Fault, recordings: &[Files], is_chosen: impl Fn(&Files) -> bool) -> Result<Twins, String> {
        let mut twins = Twins { named: 0, made: 0, unnamed: Vec::new(), said: Vec::new() };
        for (index, files) in recordings.iter().enumerate().filter(|(_, files)| is_chosen(files)) {
            let mut trial = Trial::read(files, &recordings[(index + 1) % recordings.len()])?;
            if (fault.spoil)(&mut trial).is_none() {
                continue;
            }
            twins.made += 1;
            let (found, outcome) = trial.codes();
            let refusal = outcome.as_ref().err().map_or("", String::as_str);
            let is_good = outcome.as_ref().is_ok_and(|outcome| outcome.quality.state == QualityState::Good);
            let is_named = fault.codes.iter().any(|code| found.contains(code) || refusal.contains(code));
            if is_named || fault.codes == NOT_GOOD && !is_good {
                twins.named += 1;
                continue;
            }
            let codes: Vec<&str> = found.into_iter().filter(|code| is_tested(code)).collect();
            let said =
                outcome.map_or_else(|why| why, |outcome| format!("{:?} {}", outcome.quality.state, codes.join(" ")));
            twins.unnamed.push(name(&files.trial));
            twins.said.push(format!("{}: {}: {said}", fault.name, name(&files.trial)));
        }
        Ok(twins)
    }
}

pub(super) fn name(path: &Path) -> String {
    path.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default()
}

/// The codes of each clean recording.
fn codes_of_clean(
    data: &Path,
    is_chosen: impl Fn(&Files) -> bool,
) -> Result<BTreeMap<String, BTreeSet<&'static str>>, String> {
    let all = people(data).into_iter().flatten().filter(is_chosen);
    all.map(|files| {
        let (codes, outcome) = Trial::read(&files, &files)?.codes();
        outcome.map_err(|why| format!("{}: {why}", files.trial.display()))?;
        Ok((files.trial.display().to_string(), codes))
    })
    .collect()
}

impl Trial {
    pub(super) fn read(files: &Files, other: &Files) -> Result<Trial, String> {
        let both = |files: &Files| -> Result<Pair, String> {
            Ok(Pair { standing: files.standing.as_deref().map(c3d).transpose()?, moving: c3d(&files.trial)? })
        };
        let Pair { moving, standing } = both(files)?;
        Ok(Trial { moving, standing, other: both(other)? })
    }

    /// The codes of all findings, and the outcome or why there is none.
    fn codes(&self) -> (BTreeSet<&'static str>, Result<Outcome, String>) {
        let mut findings = Findings::default();
        let outcome = self.computed(&mut findings);
        (findings.as_slice().iter().map(|finding| finding.code.name()).collect(), outcome)
    }

    pub(super) fn computed(&self, findings: &mut Findings) -> Result<Outcome, String> {
        let moving = self.moving.write().map_err(|e| e.to_string())?;
        let standing = self.standing.as_ref().map(C3d::write).transpose().map_err(|e| e.to_string())?;
        let mut files = |path: &Path| match path.to_str() {
            Some("standing.c3d") => standing.clone().ok_or_else(|| FileError::from("no standing trial".to_owned())),
            _ => Ok(moving.clone()),
        };
        let job = Job { standing: standing.as_ref().map(|_| "standing.c3d".into()), ..Job::of("walk.c3d") };
        let read = job.read(&mut files, findings).map_err(|error| error.text())?;
        study::run(read.source, &read.settings, findings).map_err(|error| error.to_string())
    }
}

/// A file in reals, so that every value can be written back.
fn c3d(path: &Path) -> Result<C3d, String> {
    let bytes = fs::read(path).map_err(|e| format!("{}: {e}", path.display()))?;
    let (mut file, _) = C3d::read(&bytes).map_err(|e| format!("{}: {e}", path.display()))?;
    file.encoding.storage = Storage::Real;
    for channel in &mut file.channels {
        (channel.scale, channel.offset) = (1.0, 0.0);
    }
    Ok(file)
}
