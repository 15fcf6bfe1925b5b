//! Twins of clean recordings with one fault of a laboratory each, and whether the fault is named.
//!
//! A twin is the bytes of the two C3D files (trial, standing trial), changed in one way; it takes the same road as any
//! file. It is named if one of the codes that belong to the fault is among its findings. The same codes must not appear
//! in the clean recordings.

use super::Chosen;
use super::changes::{
    clock, corners, cross_talk, delayed, exchanged, frozen, held, left_handed, mirrored_force, moved, other_stands,
    pair, plate_silent, scaled, two_people, without,
};
use super::clean::{Files, is_tested, people};
use ambulo::findings::Findings;
use ambulo::job::{FileError, Job};
use ambulo::study::validation::TextTable;
use ambulo::study::{self, Outcome};
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

/// A way to spoil a recording; `None` if it does not apply to it.
struct Fault {
    name: &'static str,
    /// Any of these names it: codes of findings, or words of the error that refuses the file.
    codes: &'static [&'static str],
    spoil: fn(&mut Trial) -> Option<()>,
}

/// All kinds of faults.
const FAULTS: &[Fault] = &[
    Fault { name: "a plate measured nothing", codes: &["plates.silent"], spoil: |t| plate_silent(t) },
    Fault { name: "cross-talk of 4 %", codes: &["plates.cross_talk"], spoil: |t| cross_talk(t, 0.04) },
    Fault { name: "plates 30 ms late", codes: &["forces.delayed"], spoil: |t| delayed(t, 0.030) },
    Fault { name: "plates 30 ms early", codes: &["forces.delayed"], spoil: |t| delayed(t, -0.030) },
    Fault { name: "plates 60 ms late", codes: &["forces.delayed"], spoil: |t| delayed(t, 0.060) },
    Fault { name: "every second frame held", codes: HELD, spoil: |t| held(t, |frame| frame - frame % 2) },
    Fault { name: "20 Hz held as 100 Hz", codes: HELD, spoil: |t| held(t, |frame| frame - frame % 5) },
    Fault { name: "second half frozen", codes: HELD, spoil: |t| frozen(t) },
    Fault { name: "clock 1.6 times as fast", codes: CLOCK, spoil: |t| clock(t, 1.6) },
    Fault { name: "clock 0.6 times as fast", codes: CLOCK, spoil: |t| clock(t, 0.6) },
    Fault { name: "corners begin one further", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [b, c, d, a]) },
    Fault { name: "corners begin two further", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [c, d, a, b]) },
    Fault { name: "corners the other way round", codes: CORNERS, spoil: |t| corners(t, |[a, b, c, d]| [d, c, b, a]) },
    Fault { name: "forces in kilonewton", codes: UNIT, spoil: |t| scaled(t, 1e-3) },
    Fault { name: "lateral forces mirrored", codes: MIRRORED, spoil: |t| mirrored_force(t, false) },
    Fault { name: "fore-aft forces mirrored", codes: MIRRORED, spoil: |t| mirrored_force(t, true) },
    Fault { name: "left and right exchanged", codes: SIDES, spoil: |t| exchanged(&mut t.moving) },
    Fault { name: "standing trial exchanged", codes: SIDES, spoil: |t| exchanged(t.standing.as_mut()?) },
    Fault {
        name: "both exchanged",
        codes: SIDES,
        spoil: |t| {
            exchanged(&mut t.moving)?;
            exchanged(t.standing.as_mut()?)
        },
    },
    Fault { name: "an axis mirrored", codes: SIDES, spoil: |t| left_handed(t) },
    Fault { name: "knees exchanged", codes: PAIR, spoil: |t| pair(t, &["LKNE", "L_FLE"]) },
    Fault { name: "wrists exchanged", codes: PAIR, spoil: |t| pair(t, &["LWRA", "L_RSP"]) },
    Fault { name: "knee marker 40 mm off", codes: MOVED, spoil: |t| moved(t, KNEES, ANKLES) },
    Fault { name: "another person stands", codes: OTHER, spoil: |t| other_stands(t) },
    Fault { name: "two people in the file", codes: SEVERAL, spoil: |t| two_people(t) },
    Fault { name: "standing without a toe", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, TOES) },
    Fault { name: "standing without a heel", codes: UNSEEN, spoil: |t| without(t.standing.as_mut()?, HEELS) },
];

/// The file is refused with these words.
const SEVERAL: &[&str] = &["has the markers of 2 people"];
const HELD: &[&str] = &["motion.held_frames"];
const CLOCK: &[&str] = &["motion.clock"];
const CORNERS: &[&str] = &["plates.corners_ordered", "plates.corners_unclear"];
const UNIT: &[&str] = &["plates.unit_by_weight"];
const MIRRORED: &[&str] = &["plates.mirrored"];
const SIDES: &[&str] = &["markers.sides_exchanged"];
const PAIR: &[&str] = &["markers.swap"];
const MOVED: &[&str] = &["markers.moved"];
const OTHER: &[&str] = &["calibration.other_person", "calibration.other_limbs"];
const UNSEEN: &[&str] = &["calibration.placed", "markers.not_measured"];
const TOES: &[&str] = &["RTOE", "R_FM2", "RMT2", "R_FM1"];
const KNEES: &[&str] = &["RKNE", "R_FLE"];
const ANKLES: &[&str] = &["RANK", "R_FAL"];
const HEELS: &[&str] = &["RHEE", "R_FCC", "RHEEL"];

/// How many twins of each fault are named.
pub(super) struct Spoiled {
    pub(super) table: TextTable,
    /// Number of clean recordings.
    pub(super) clean: usize,
    /// Faults of which too few twins are named, or that too many clean recordings show.
    pub(super) failures: Vec<&'static str>,
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
    };
    for fault in FAULTS.iter().filter(|fault| fault.name.contains(chosen.fault)) {
        let Twins { named, made, unnamed } = Twins::of(fault, &recordings, is_chosen)?;
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
}

impl Twins {
    fn of(fault: &Fault, recordings: &[Files], is_chosen: impl Fn(&Files) -> bool) -> Result<Twins, String> {
        let mut twins = Twins { named: 0, made: 0, unnamed: Vec::new() };
        for (index, files) in recordings.iter().enumerate().filter(|(_, files)| is_chosen(files)) {
            let mut trial = Trial::read(files, &recordings[(index + 1) % recordings.len()])?;
            if (fault.spoil)(&mut trial).is_none() {
                continue;
            }
            twins.made += 1;
            let (found, outcome) = trial.codes();
            let refusal = outcome.err().unwrap_or_default();
            match fault.codes.iter().any(|code| found.contains(code) || refusal.contains(code)) {
                true => twins.named += 1,
                false => twins.unnamed.push(name(&files.trial)),
            }
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
