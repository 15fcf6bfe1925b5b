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
//! A table of ground forces lies next to a recording if both have the same words in their names, apart from [`FORCES`]
//! and [`RECORDINGS`]. A recording with the words of another one of its folder is the same trial in another form, and
//! only the first form is judged.

use super::TrialFiles;
use super::found_file::{FoundFile, Wanted};
use super::participants::Participants;
use super::recorded_person::RecordedPerson;
use crate::findings::Findings;
use crate::job::error::{At, Field, JobError};
use crate::job::files::{Files, read};
use crate::job::laboratory::read_laboratory_file;
use crate::job::read_header;
use crate::study::{StatedSize, StatedTrial, TrialList};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// The list of what a laboratory states, in the folder of all trials.
pub const LIST: &str = "trials.toml";
/// Words in the names of tables of ground forces.
const FORCES: [&str; 4] = ["grf", "force", "forces", "plates"];
/// Words in names of recordings that state only the kind of recording.
const RECORDINGS: [&str; 10] =
    ["ground", "reaction", "marker", "markers", "motion", "capture", "mocap", "ik", "kinematics", "coordinates"];
/// Words in the names of standing trials, of which the first one with such a name is preferred.
const STANDING: [&str; 4] = ["static", "stand", "calib", "pose"];
/// Parts of the names of movements that show the joints of a person, without separators.
const FUNCTIONAL: [&str; 7] =
    ["functionalcal", "functionalhip", "functionalknee", "functionaljoint", "stararc", "hipcal", "kneecal"];

/// A trial with the files that belong to it.
#[derive(Debug, Clone)]
pub struct PlannedTrial {
    /// Path of the recording from the folder of all trials.
    pub name: String,
    /// Person of the trial.
    pub person: String,
    /// The kind that the laboratory states.
    pub kind: Option<String>,
    /// Its files.
    pub files: TrialFiles,
    /// Statements of the laboratory about it.
    pub stated: StatedTrial,
    /// Why it cannot be read.
    pub broken: Option<String>,
}

/// Trials, and files that are none.
#[derive(Debug, Default)]
pub struct Plan {
    /// The trials, by name.
    pub trials: Vec<PlannedTrial>,
    /// Recordings that are not judged, each with the reason.
    pub others: Vec<(String, String)>,
    /// Every file that was read.
    pub read: Vec<PathBuf>,
    /// Recordings in which the person stands still.
    pub standing: Vec<String>,
}

/// Kind and person of a recording.
#[derive(Debug, Clone)]
pub struct Content {
    kind: Kind,
    person: RecordedPerson,
}

/// Kind of a recording, by its content.
#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    /// With force plates.
    Plates,
    /// Standing still.
    Still,
    /// Without forces.
    Motion,
    /// The recording cannot be read, for this reason.
    Broken(String),
}

impl From<Kind> for Content {
    fn from(kind: Kind) -> Content {
        Content { kind, person: RecordedPerson::default() }
    }
}

impl Kind {
    /// Why a recording without forces is no trial.
    fn without_forces(&self) -> String {
        match self {
            Kind::Broken(reason) => reason.clone(),
            _ => "no measured ground forces: no force plates, and no table of forces next to it".to_owned(),
        }
    }
}

/// The files of a folder with what the laboratory states about them: the first step to a [`Plan`]. The caller reads
/// what each recording is ([`Listing::content`]), in any order, and passes it to [`Listing::plan`].
pub struct Listing<'a> {
    root: &'a Path,
    root_name: String,
    wanted: Wanted,
    found: &'a [FoundFile],
    list: TrialList,
    read: Vec<PathBuf>,
    people: Participants,
    recordings: Vec<(&'a FoundFile, StatedTrial)>,
}

/// The folder of all trials.
#[derive(Debug, Clone, Copy)]
pub struct TrialFolder<'a> {
    /// Its path.
    pub path: &'a Path,
    /// Its name: the name of the person whose recordings lie in it.
    pub name: &'a str,
    /// Which recordings are trials.
    pub wanted: Wanted,
}

impl<'a> Listing<'a> {
    /// The files of a folder. `trials.toml` and `participants.tsv` are read, if they are there.
    ///
    /// # Errors
    /// A list that cannot be read, or that names files that are not there.
    pub fn of_folder(
        folder: TrialFolder<'a>,
        found: &'a [FoundFile],
        files: &mut dyn Files,
    ) -> Result<Listing<'a>, JobError> {
        let listing = Listing::of_files(folder, found, files)?;
        let names = found.iter().map(|file| file.name.as_str());
        listing.list.check_files(names).in_file(&folder.path.join(LIST))?;
        Ok(listing)
    }

    /// Files that a user listed: entries of `trials.toml` for other files count for nothing.
    ///
    /// # Errors
    /// As [`Listing::of_folder`].
    pub fn of_files(
        folder: TrialFolder<'a>,
        found: &'a [FoundFile],
        files: &mut dyn Files,
    ) -> Result<Listing<'a>, JobError> {
        let TrialFolder { path: root, name, wanted } = folder;
        let list_path = root.join(LIST);
        let list = read_list(&list_path, found, files)?;
        let recordings =
            found.iter().filter(|file| is_recording(file)).map(|file| (file, list.of(&file.name))).collect();
        Ok(Listing {
            root,
            root_name: name.to_owned(),
            wanted,
            found,
            read: files.has(&list_path).then_some(list_path).into_iter().collect(),
            people: Participants::of(root, files)?,
            list,
            recordings,
        })
    }

    /// Number of recordings.
    #[must_use]
    pub fn recordings(&self) -> usize {
        self.recordings.len()
    }

    /// The content of a recording, by its number.
    pub fn content(&self, number: usize, files: &mut dyn Files) -> Content {
        let (file, stated) = &self.recordings[number];
        if stated.excluded.is_some() || !is_of_markers(file) {
            return Kind::Motion.into();
        }
        match read_laboratory_file(&file.path, files, &mut Findings::default()) {
            // A motion of BIDS may have coordinates instead of markers; the computation then reports the error.
            Err(_) if file.is_bids_motion() => Kind::Motion.into(),
            Err(error) => Kind::Broken(error.text()).into(),
            Ok(recording) => {
                let kind = match () {
                    () if recording.is_still() => Kind::Still,
                    () if recording.recording.plates.is_empty() => Kind::Motion,
                    () => Kind::Plates,
                };
                Content { kind, person: RecordedPerson::of(&recording) }
            }
        }
    }

    /// The trials. `contents` has the kind and the person of each recording.
    #[must_use]
    pub fn plan(self, contents: &[Content], files: &mut dyn Files) -> Plan {
        let mut plan = Plan { read: self.read.clone(), ..Plan::default() };
        let folders = Folders::new(&self, contents);
        let mut taken = BTreeSet::new();
        // C3D before TRC before coordinates.
        let mut order: Vec<usize> = (0..self.recordings.len()).collect();
        order.sort_by_key(|&k| (&self.recordings[k].0.folder, form(self.recordings[k].0), k));
        for k in order {
            let (file, stated) = &self.recordings[k];
            plan.read.push(file.path.clone());
            match folders.trial(file, stated, &contents[k], &mut taken) {
                Ok(trial) => plan.trials.push(trial),
                Err(reason) => plan.others.push((file.name.clone(), reason)),
            }
        }
        for file in self.found.iter().filter(|file| file.ending() == "b3d") {
            plan.add_subject(file, &self.list.of(&file.name), self.root, files);
        }
        let is_still = |(_, content): &(&(&FoundFile, StatedTrial), &Content)| content.kind == Kind::Still;
        let still = self.recordings.iter().zip(contents).filter(is_still);
        plan.standing = still.map(|((file, _), _)| file.name.clone()).collect();
        plan.trials.sort_by(|a, b| a.name.cmp(&b.name));
        plan.others.iter_mut().for_each(|(_, why)| *why = relative(why, self.root));
        plan.others.sort();
        plan.take_sizes(self.people);
        plan
    }
}

impl Plan {
    /// Uses a size stated for all trials in the trials that state none themselves; it is the size of one person.
    ///
    /// # Errors
    /// A size, and the trials of several persons.
    pub fn take_size(&mut self, source: &Path, size: StatedSize) -> Result<(), JobError> {
        let persons: BTreeSet<&str> = self.trials.iter().map(|trial| trial.person.as_str()).collect();
        let given = [(Field::Mass, size.mass_kg.is_some()), (Field::Height, size.height_m.is_some())];
        if let (2.., Some((field, _))) = (persons.len(), given.into_iter().find(|(_, given)| *given)) {
            let what = format!(
                "the {} is that of one person, but there are trials of {} persons in {}. hint: state the size of each \
                 person in {LIST} (docs/VALIDATE.md)",
                field.name(),
                persons.len(),
                source.display()
            );
            return Err(JobError::new(&[field], what));
        }
        self.fill_sizes(|_| size);
        Ok(())
    }

    /// Fills sizes that are not stated.
    fn fill_sizes(&mut self, size: impl Fn(&PlannedTrial) -> StatedSize) {
        for trial in &mut self.trials {
            let StatedSize { mass_kg, height_m } = size(trial);
            let own = &mut trial.files.size;
            *own = StatedSize { mass_kg: own.mass_kg.or(mass_kg), height_m: own.height_m.or(height_m) };
        }
    }

    /// Gives trials without a stated size the size of their person in a data set.
    fn take_sizes(&mut self, people: Participants) {
        self.fill_sizes(|trial| people.size(&trial.person));
        self.read.extend(people.read);
    }

    /// The trials of a subject of AddBiomechanics.
    pub fn of_subject(path: &Path, files: &mut dyn Files) -> Plan {
        let root = path.parent().unwrap_or(Path::new(""));
        let mut plan = Plan::default();
        plan.add_subject(&FoundFile::alone(path), &StatedTrial::default(), root, files);
        plan
    }

    /// Adds the trials of a subject of AddBiomechanics.
    fn add_subject(&mut self, file: &FoundFile, stated: &StatedTrial, root: &Path, files: &mut dyn Files) {
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
                size: StatedSize { mass_kg: stated.mass_kg, height_m: stated.height_m },
                ..TrialFiles::default()
            },
        };
        match read_header(files, &file.path) {
            Err(error) => self.trials.push(trial(file.name.clone(), None, Some(error.text()))),
            Ok(header) => {
                self.trials.extend(header.trials.iter().enumerate().map(|(k, own)| {
                    trial(format!("{}, trial {:03} ({})", file.name, k + 1, own.name), Some(k + 1), None)
                }))
            }
        }
    }
}

/// Reads `trials.toml`, if there is one, and checks the files that it names.
fn read_list(path: &Path, found: &[FoundFile], files: &mut dyn Files) -> Result<TrialList, JobError> {
    if !files.has(path) {
        return Ok(TrialList::default());
    }
    let text = String::from_utf8(read(files, path)?).in_file(path)?;
    let list = TrialList::from_toml(&text).in_file(path)?;
    let root = path.parent().unwrap_or(Path::new(""));
    for file in found {
        let stated = list.of(&file.name);
        if let Some(missing) = stated.paths().find(|named| !files.has(&root.join(named))) {
            let what = format!(
                "names `{missing}` for {}; there is no such file. hint: paths are relative to the folder of {LIST}",
                file.name
            );
            return Err(JobError::new(&[], what).within(path.display().to_string()));
        }
    }
    Ok(list)
}

/// A message with paths from the folder of all trials, so that it does not depend on where that is.
#[must_use]
pub fn relative(message: &str, root: &Path) -> String {
    let shown = root.join("").display().to_string();
    // A short path, such as `./`, could be a part of another one.
    if shown.len() > 2 { message.replace(&shown, "") } else { message.replacen(&shown, "", 1) }
}

fn excluded(reason: &str) -> String {
    format!("excluded: {reason}")
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

/// Whether a recording is a movement that shows the joints, and no trial: its name says so.
fn shows_joints(file: &FoundFile, content: &Content) -> bool {
    let stem = file.stem().replace(['-', '_', ' '], "");
    matches!(content.kind, Kind::Motion | Kind::Plates) && FUNCTIONAL.iter().any(|part| stem.contains(part))
}

/// The words that identify the trial.
fn own_words(file: &FoundFile) -> BTreeSet<String> {
    words(file).filter(|word| !FORCES.contains(&word.as_str()) && !RECORDINGS.contains(&word.as_str())).collect()
}

/// Files that belong together.
struct Folders<'a> {
    /// Name of the folder of all trials.
    root: &'a str,
    root_path: &'a Path,
    wanted: Wanted,
    forces: BTreeMap<(&'a str, BTreeSet<String>), &'a FoundFile>,
    models: BTreeMap<&'a str, Vec<&'a FoundFile>>,
    /// The standing trials of each folder, those with a usual name first.
    standing: BTreeMap<&'a str, Vec<(&'a FoundFile, &'a RecordedPerson)>>,
    /// The first movement of each folder that shows the joints.
    functional: BTreeMap<&'a str, &'a FoundFile>,
}

impl<'a> Folders<'a> {
    fn new(listing: &'a Listing<'_>, contents: &'a [Content]) -> Folders<'a> {
        let mut folders = Folders {
            root: &listing.root_name,
            root_path: listing.root,
            wanted: listing.wanted,
            forces: BTreeMap::new(),
            models: BTreeMap::new(),
            standing: BTreeMap::new(),
            functional: BTreeMap::new(),
        };
        for file in listing.found {
            if is_force_table(file) {
                folders.forces.entry((file.own_folder(), own_words(file))).or_insert(file);
            } else if file.ending() == "osim" {
                folders.models.entry(&file.folder).or_default().push(file);
            }
        }
        let is_named = |file: &FoundFile| STANDING.iter().any(|word| file.stem().contains(word));
        for ((file, _), content) in
            listing.recordings.iter().zip(contents).filter(|(_, content)| content.kind == Kind::Still)
        {
            folders.standing.entry(&file.folder).or_default().push((file, &content.person));
        }
        for ((file, _), _) in
            listing.recordings.iter().zip(contents).filter(|(read, content)| shows_joints(read.0, content))
        {
            folders.functional.entry(&file.folder).or_insert(file);
        }
        folders.standing.values_mut().for_each(|still| still.sort_by_key(|(file, _)| !is_named(file)));
        folders
    }

    /// The trial of a recording, or the reason why it is no trial.
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
        if shows_joints(file, content) {
            return Err("the person moves hips and knees: the movement that shows the joints of this folder".to_owned());
        }
        let path = |named: &String| self.root_path.join(named);
        let Content { kind, person } = content;
        let key = (file.own_folder().to_owned(), own_words(file));
        let beside = || self.forces.get(&(key.0.as_str(), key.1.clone())).map(|table| table.path.clone());
        let grf = match kind {
            Kind::Still => return Err(self.use_of_standing(file)),
            Kind::Plates => None,
            Kind::Broken(_) if file.ending() == "c3d" => None,
            Kind::Motion | Kind::Broken(_) => match stated.forces.as_ref().map(path).or_else(beside) {
                Some(table) => Some(table),
                None if stated.loads.is_some() || self.wanted == Wanted::Motion => None,
                None => return Err(kind.without_forces()),
            },
        };
        if !taken.insert(key) && kind != &Kind::Plates {
            return Err("the same trial as another recording with this name".to_owned());
        }
        let model = stated.model.as_ref().map(path).or_else(|| self.model_of(file));
        let is_built_in = model.is_none() && is_of_markers(file);
        let standing = self.standing_of(file, person).filter(|_| is_built_in);
        let functional = self.functional.get(file.folder.as_str()).filter(|_| is_built_in);
        Ok(PlannedTrial {
            name: file.name.clone(),
            person: stated.person.clone().unwrap_or_else(|| self.person(file)),
            kind: stated.kind.clone(),
            stated: stated.clone(),
            broken: if let Kind::Broken(reason) = kind { Some(reason.clone()) } else { None },
            files: TrialFiles {
                recording: file.path.clone(),
                trial: None,
                standing: stated.standing.as_ref().map(path).or_else(|| standing.map(|standing| standing.path.clone())),
                functional: functional.map(|movement| movement.path.clone()),
                model,
                grf: stated.forces.as_ref().map(path).or(grf),
                loads: stated.loads.as_ref().map(path),
                size: StatedSize { mass_kg: stated.mass_kg, height_m: stated.height_m },
            },
        })
    }

    /// The first standing trial of the folder that is of this person.
    fn standing_of(&self, file: &FoundFile, person: &RecordedPerson) -> Option<&'a FoundFile> {
        let all = self.standing.get(file.folder.as_str())?;
        let same_name = || all.iter().find(|(_, still)| person.has_name_of(still) && person.may_be(still));
        same_name().or_else(|| all.iter().find(|(_, still)| person.may_be(still))).map(|(file, _)| *file)
    }

    fn use_of_standing(&self, file: &FoundFile) -> String {
        match self.standing.get(file.folder.as_str()).and_then(|all| all.first()) {
            Some((chosen, _)) if *chosen == file => {
                "the person stands still: the standing trial of this folder".to_owned()
            }
            chosen => {
                let name = chosen.map_or("", |(chosen, _)| &chosen.name);
                format!(
                    "the person stands still; the standing trial of this folder is {name}, this one is for a recording \
                     of another person"
                )
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
        let of_folder = || if file.folder.is_empty() { self.root.to_owned() } else { file.folder.clone() };
        file.bids_subject().map_or_else(of_folder, str::to_owned)
    }
}
