//! Which files are trials, and which other files belong to each.
//!
//! | file | is |
//! |---|---|
//! | `.c3d` with force plates | a trial |
//! | any recording of motion, where force plates are not asked for ([`Wanted`]) | a trial |
//! | `.c3d` without plates, `.trc`, `.mot`, `.sto` with a table of ground forces next to it | a trial |
//! | `_motion.tsv` of a BIDS data set, of the person `sub-...` | a trial, where force plates are not asked for |
//! | `.c3d`, `.trc`, `_motion.tsv` in which the person stands still | the standing trial of the trials in its folder |
//! | `.mot`, `.sto` with a word of [`FORCES`] in its name | a table of ground forces |
//! | `.b3d` | a person with trials |
//! | the only `.osim` of a folder | the model of the `.trc`, `.mot` and `.sto` in it |
//!
//! A table of ground forces lies next to a recording if both have the same words in their names, apart from [`FORCES`] and [`RECORDINGS`]. A
//! recording with the words of another one of its folder is the same trial in another form, and only the first form is judged.

use super::Wanted;
use super::folder::FoundFile;
use super::participants::Participants;
use crate::args::TrialFiles;
use crate::caller::Caller;
use crate::commands::forces::markers::read_laboratory_file;
use crate::commands::forces::subject::read_header;
use crate::commands::side_by_side::side_by_side;
use crate::files;
use ambulo::findings::Findings;
use ambulo::study::{StatedTrial, TrialList};
use anyhow::{Context, Result, bail};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The list of what a laboratory states, in the folder of all trials.
pub(crate) const LIST: &str = "trials.toml";
/// Words in the names of tables of ground forces.
const FORCES: [&str; 4] = ["grf", "force", "forces", "plates"];
/// Words in the names of recordings that say only what kind of recording it is.
const RECORDINGS: [&str; 10] =
    ["ground", "reaction", "marker", "markers", "motion", "capture", "mocap", "ik", "kinematics", "coordinates"];
/// Words in the names of standing trials, of which the first one with such a name is preferred.
const STANDING: [&str; 4] = ["static", "stand", "calib", "pose"];

/// A trial with the files that belong to it.
#[derive(Debug, Clone)]
pub(crate) struct PlannedTrial {
    /// Path of the recording from the folder of all trials.
    pub(crate) name: String,
    pub(crate) person: String,
    /// The kind that the laboratory states.
    pub(crate) kind: Option<String>,
    pub(crate) files: TrialFiles,
    /// Statements of the laboratory about it.
    pub(crate) stated: StatedTrial,
    /// Why it cannot be read.
    pub(crate) broken: Option<String>,
}

/// Trials, and files that are none.
#[derive(Debug, Default)]
pub(crate) struct Plan {
    pub(crate) trials: Vec<PlannedTrial>,
    /// Recordings that are not judged, each with the reason.
    pub(crate) others: Vec<(String, String)>,
    /// Every file that was read.
    pub(crate) read: Vec<PathBuf>,
    /// Recordings in which the person stands still.
    pub(crate) standing: Vec<String>,
}

/// Kind of a recording, by its content.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Content {
    /// With force plates.
    Plates,
    /// Standing still.
    Still,
    /// Without forces.
    Motion,
    Broken(String),
}

impl Content {
    /// Why a recording without forces is no trial.
    fn without_forces(&self) -> String {
        match self {
            Content::Broken(reason) => reason.clone(),
            _ => "no measured ground forces: no force plates, and no table of forces next to it".to_owned(),
        }
    }
}

/// Finds trials and what belongs to them.
pub(crate) fn plan(root: &Path, wanted: Wanted, found: &[FoundFile], threads: usize) -> Result<Plan> {
    let list = read_list(&root.join(LIST), found)?;
    list.check_files(found.iter().map(|file| file.name.as_str()))
        .with_context(|| root.join(LIST).display().to_string())?;
    plan_with(root, wanted, found, &list, threads)
}

/// As [`plan`], of files that a user listed: entries of `trials.toml` for other files count for nothing.
pub(crate) fn plan_listed(root: &Path, wanted: Wanted, found: &[FoundFile], threads: usize) -> Result<Plan> {
    let list = read_list(&root.join(LIST), found)?;
    plan_with(root, wanted, found, &list, threads)
}

fn plan_with(root: &Path, wanted: Wanted, found: &[FoundFile], list: &TrialList, threads: usize) -> Result<Plan> {
    let list_path = root.join(LIST);
    let mut plan = Plan { read: list_path.is_file().then_some(list_path).into_iter().collect(), ..Plan::default() };
    let recordings: Vec<(&FoundFile, StatedTrial)> =
        (found.iter().filter(|file| is_recording(file))).map(|file| (file, list.of(&file.name))).collect();
    let contents = side_by_side(recordings.len(), threads, |k| content(recordings[k].0, &recordings[k].1));
    let folders = Folders::new(found, &recordings, &contents, root, wanted);
    let mut taken = BTreeSet::new();
    // C3D before TRC before coordinates.
    let mut order: Vec<usize> = (0..recordings.len()).collect();
    order.sort_by_key(|&k| (&recordings[k].0.folder, form(recordings[k].0), k));
    for k in order {
        let (file, stated) = &recordings[k];
        plan.read.push(file.path.clone());
        match folders.trial(file, stated, &contents[k], &mut taken) {
            Ok(trial) => plan.trials.push(trial),
            Err(reason) => plan.others.push((file.name.clone(), reason)),
        }
    }
    for file in found.iter().filter(|file| file.ending() == "b3d") {
        plan.add_subject(file, &list.of(&file.name), root);
    }
    let is_still = |(_, content): &(&(&FoundFile, StatedTrial), &Content)| **content == Content::Still;
    plan.standing = recordings.iter().zip(&contents).filter(is_still).map(|((file, _), _)| file.name.clone()).collect();
    plan.trials.sort_by(|a, b| a.name.cmp(&b.name));
    plan.others.iter_mut().for_each(|(_, why)| *why = relative(why, root));
    plan.others.sort();
    plan.take_sizes(Participants::of(root)?);
    Ok(plan)
}

impl Plan {
    /// Uses a size that is stated on the command line for trials without statements; it belongs to one person.
    pub(crate) fn take_size(&mut self, source: &Path, mass: Option<f64>, height: Option<f64>) -> Result<()> {
        let persons: BTreeSet<&str> = self.trials.iter().map(|trial| trial.person.as_str()).collect();
        let given = [("--mass", mass.is_some()), ("--height", height.is_some())];
        if let (2.., Some((option, _))) = (persons.len(), given.iter().find(|(_, given)| *given)) {
            bail!(
                "{option}: found the trials of {} persons in {}; expected those of one. hint: state the size of each person in {LIST} (docs/VALIDATE.md)",
                persons.len(),
                source.display()
            );
        }
        for trial in &mut self.trials {
            trial.files.mass = trial.files.mass.or(mass);
            trial.files.height = trial.files.height.or(height);
        }
        Ok(())
    }

    /// Gives trials without a stated size the size of their person in a data set.
    fn take_sizes(&mut self, people: Participants) {
        for trial in &mut self.trials {
            let [mass, height] = people.size(&trial.person);
            trial.files.mass = trial.files.mass.or(mass);
            trial.files.height = trial.files.height.or(height);
        }
        self.read.extend(people.read);
    }

    /// The trials of a subject of AddBiomechanics.
    pub(crate) fn of_subject(path: &Path) -> Result<Plan> {
        let name = files::last(path);
        let file = FoundFile { path: path.to_owned(), name, folder: String::new() };
        let mut plan = Plan::default();
        plan.add_subject(&file, &StatedTrial::default(), path.parent().unwrap_or(Path::new("")));
        Ok(plan)
    }

    /// Adds the trials of a subject of AddBiomechanics.
    fn add_subject(&mut self, file: &FoundFile, stated: &StatedTrial, root: &Path) {
        self.read.push(file.path.clone());
        if let Some(reason) = &stated.excluded {
            self.others.push((file.name.clone(), excluded(reason)));
            return;
        }
        let ending = format!(".{}", file.path.extension().unwrap_or_default().to_string_lossy());
        let own = file.name.strip_suffix(&ending).unwrap_or(&file.name);
        let trial = |name: String, number: Option<usize>, broken: Option<String>| PlannedTrial {
            name,
            person: stated.person.clone().unwrap_or_else(|| own.to_owned()),
            kind: stated.kind.clone(),
            broken,
            stated: stated.clone(),
            files: TrialFiles {
                recording: file.path.clone(),
                trial: number.map(|number| number.to_string()),
                model: stated.model.as_ref().map(|model| root.join(model)),
                mass: stated.mass_kg,
                height: stated.height_m,
                ..TrialFiles::default()
            },
        };
        match read_header(&Caller::default(), &file.path) {
            Err(error) => self.trials.push(trial(file.name.clone(), None, Some(format!("{error:#}")))),
            Ok(header) => {
                self.trials.extend(header.trials.iter().enumerate().map(|(k, own)| {
                    trial(format!("{}, trial {:03} ({})", file.name, k + 1, own.name), Some(k + 1), None)
                }))
            }
        }
    }
}

/// A message with paths from the folder of all trials, so that it does not depend on where that is.
pub(crate) fn relative(message: &str, root: &Path) -> String {
    let shown = root.join("").display().to_string();
    // A short path, such as `./`, could be a part of another one.
    if shown.len() > 2 { message.replace(&shown, "") } else { message.replacen(&shown, "", 1) }
}

/// The error of a recording in a row that has the name of the recording.
pub(crate) fn sentence(message: &str, hint: Option<String>, recording: &Path, root: &Path) -> String {
    let message = relative(message, root);
    let shown = relative(&recording.display().to_string(), root);
    let own = message.strip_prefix(&shown).and_then(|rest| rest.strip_prefix(": ")).unwrap_or(&message);
    let sentence = own.trim_end().trim_end_matches('.').to_owned();
    hint.map_or(sentence.clone(), |hint| format!("{sentence}. hint: {hint}"))
}

fn excluded(reason: &str) -> String {
    format!("excluded: {reason}")
}

/// Reads `trials.toml`, if there is one, and checks the files that it names.
fn read_list(path: &Path, found: &[FoundFile]) -> Result<TrialList> {
    if !path.is_file() {
        return Ok(TrialList::default());
    }
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    let list = TrialList::from_toml(&text).with_context(shown)?;
    let root = path.parent().unwrap_or(Path::new(""));
    for file in found {
        let stated = list.of(&file.name);
        if let Some(missing) = stated.paths().find(|named| !root.join(named).is_file()) {
            bail!(
                "{}: names `{missing}` for {}; there is no such file. hint: paths are relative to the folder of {LIST}",
                path.display(),
                file.name
            );
        }
    }
    Ok(list)
}

/// Whether a file may be a recording of motion.
fn is_recording(file: &FoundFile) -> bool {
    match file.ending().as_str() {
        "c3d" | "trc" => true,
        "mot" | "sto" => !is_force_table(file),
        "bvh" | "npz" | "mvnx" => true,
        "tsv" => file.is_bids_motion(),
        _ => false,
    }
}

fn is_force_table(file: &FoundFile) -> bool {
    matches!(file.ending().as_str(), "mot" | "sto") && words(file).any(|word| FORCES.contains(&word.as_str()))
}

fn is_of_markers(file: &FoundFile) -> bool {
    matches!(file.ending().as_str(), "c3d" | "trc") || file.is_bids_motion()
}

/// Forms of one recording, the preferred one first.
fn form(file: &FoundFile) -> usize {
    ["c3d", "trc", "mot", "sto"].iter().position(|ending| *ending == file.ending()).unwrap_or(usize::MAX)
}

/// The words of a name: letters and digits that stand together.
fn words(file: &FoundFile) -> impl Iterator<Item = String> {
    let stem = file.stem();
    let words: Vec<String> =
        stem.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty()).map(str::to_owned).collect();
    words.into_iter()
}

/// The words that say which trial it is.
fn own_words(file: &FoundFile) -> BTreeSet<String> {
    words(file).filter(|word| !FORCES.contains(&word.as_str()) && !RECORDINGS.contains(&word.as_str())).collect()
}

fn content(file: &FoundFile, stated: &StatedTrial) -> Content {
    if stated.excluded.is_some() || !is_of_markers(file) {
        return Content::Motion;
    }
    match read_laboratory_file(&file.path, &Caller::default(), &mut Findings::default()) {
        // A motion of BIDS may have coordinates instead of markers; the computation then reports the error.
        Err(_) if file.is_bids_motion() => Content::Motion,
        Err(error) => Content::Broken(format!("{error:#}")),
        Ok(recording) if recording.is_still() => Content::Still,
        Ok(recording) if recording.recording.plates.is_empty() => Content::Motion,
        Ok(_) => Content::Plates,
    }
}

/// Files that belong together.
struct Folders<'a> {
    /// Name of the folder of all trials.
    root: String,
    root_path: &'a Path,
    wanted: Wanted,
    forces: BTreeMap<(&'a str, BTreeSet<String>), &'a FoundFile>,
    models: BTreeMap<&'a str, Vec<&'a FoundFile>>,
    standing: BTreeMap<&'a str, &'a FoundFile>,
}

impl<'a> Folders<'a> {
    fn new(
        found: &'a [FoundFile],
        recordings: &[(&'a FoundFile, StatedTrial)],
        contents: &[Content],
        root_path: &'a Path,
        wanted: Wanted,
    ) -> Folders<'a> {
        let canonical = root_path.canonicalize().unwrap_or_else(|_| root_path.to_owned());
        let mut folders = Folders {
            root: files::last(&canonical),
            root_path,
            wanted,
            forces: BTreeMap::new(),
            models: BTreeMap::new(),
            standing: BTreeMap::new(),
        };
        for file in found {
            if is_force_table(file) {
                folders.forces.entry((file.own_folder(), own_words(file))).or_insert(file);
            } else if file.ending() == "osim" {
                folders.models.entry(&file.folder).or_default().push(file);
            }
        }
        let is_named = |file: &FoundFile| STANDING.iter().any(|word| file.stem().contains(word));
        for ((file, _), _) in recordings.iter().zip(contents).filter(|(_, content)| **content == Content::Still) {
            let chosen = folders.standing.entry(&file.folder).or_insert(file);
            if !is_named(chosen) && is_named(file) {
                *chosen = file;
            }
        }
        folders
    }

    /// The trial of a recording, or why it is none.
    fn trial(
        &self,
        file: &FoundFile,
        stated: &StatedTrial,
        content: &Content,
        taken: &mut BTreeSet<(String, BTreeSet<String>)>,
    ) -> Result<PlannedTrial, String> {
        if let Some(reason) = &stated.excluded {
            return Err(excluded(reason));
        }
        let path = |named: &String| self.root_path.join(named);
        let key = (file.own_folder().to_owned(), own_words(file));
        let beside = || self.forces.get(&(key.0.as_str(), key.1.clone())).map(|table| table.path.clone());
        let grf = match content {
            Content::Still => return Err(self.use_of_standing(file)),
            Content::Plates => None,
            Content::Broken(_) if file.ending() == "c3d" => None,
            Content::Motion | Content::Broken(_) => match stated.forces.as_ref().map(path).or_else(beside) {
                Some(table) => Some(table),
                None if stated.loads.is_some() || self.wanted == Wanted::Motion => None,
                None => return Err(content.without_forces()),
            },
        };
        if !taken.insert(key) && content != &Content::Plates {
            return Err("the same trial as another recording with this name".to_owned());
        }
        let model = stated.model.as_ref().map(path).or_else(|| self.model_of(file));
        let standing = self.standing.get(file.folder.as_str()).filter(|_| model.is_none() && is_of_markers(file));
        Ok(PlannedTrial {
            name: file.name.clone(),
            person: stated.person.clone().unwrap_or_else(|| self.person(file)),
            kind: stated.kind.clone(),
            stated: stated.clone(),
            broken: if let Content::Broken(reason) = content { Some(reason.clone()) } else { None },
            files: TrialFiles {
                recording: file.path.clone(),
                trial: None,
                standing: stated.standing.as_ref().map(path).or_else(|| standing.map(|standing| standing.path.clone())),
                model,
                grf: stated.forces.as_ref().map(path).or(grf),
                loads: stated.loads.as_ref().map(path),
                mass: stated.mass_kg,
                height: stated.height_m,
            },
        })
    }

    fn use_of_standing(&self, file: &FoundFile) -> String {
        match self.standing.get(file.folder.as_str()) {
            Some(chosen) if *chosen == file => "the person stands still: the standing trial of this folder".to_owned(),
            chosen => {
                let name = chosen.map_or("", |chosen| &chosen.name);
                format!("the person stands still; the standing trial of this folder is {name}")
            }
        }
    }

    /// The only model next to a recording that is not a C3D.
    fn model_of(&self, file: &FoundFile) -> Option<PathBuf> {
        match self.models.get(file.folder.as_str()).map(Vec::as_slice) {
            Some([only]) if file.ending() != "c3d" => Some(only.path.clone()),
            _ => None,
        }
    }

    fn person(&self, file: &FoundFile) -> String {
        let of_folder = || if file.folder.is_empty() { self.root.clone() } else { file.folder.clone() };
        file.bids_subject().map_or_else(of_folder, str::to_owned)
    }
}
