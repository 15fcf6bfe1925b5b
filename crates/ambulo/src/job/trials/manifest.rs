//! A list of trials, one per line: `.csv` with a head, or `.jsonl` with an object per line. Paths are relative to the
//! folder of the list.

use super::TrialFiles;
use super::plan::{Plan, PlannedTrial};
use crate::job::error::{At, JobError};
use crate::job::files::{Files, ending, read};
use crate::study::{StatedSize, StatedTrial};
use serde::Deserialize;
use serde::de::Error as _;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A line of the list.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Line {
    /// The recording.
    file: PathBuf,
    /// The number of the trial in a `.b3d`.
    #[serde(default, deserialize_with = "filled")]
    trial: Option<String>,
    #[serde(default, deserialize_with = "filled")]
    person: Option<String>,
    #[serde(default, deserialize_with = "filled")]
    kind: Option<String>,
    #[serde(default, rename = "static", deserialize_with = "filled")]
    standing: Option<PathBuf>,
    #[serde(default, deserialize_with = "filled")]
    model: Option<PathBuf>,
    #[serde(default, deserialize_with = "filled")]
    grf: Option<PathBuf>,
    #[serde(default, deserialize_with = "filled")]
    loads: Option<PathBuf>,
    #[serde(default, deserialize_with = "size")]
    mass: Option<f64>,
    #[serde(default, deserialize_with = "size")]
    height: Option<f64>,
}

/// An empty cell states nothing.
fn filled<'de, D: serde::Deserializer<'de>, T: From<String>>(deserializer: D) -> Result<Option<T>, D::Error> {
    let text: Option<String> = Option::deserialize(deserializer)?;
    Ok(text.filter(|text| !text.trim().is_empty()).map(T::from))
}

/// A size as a number or, in a cell, as its text.
#[derive(Deserialize)]
#[serde(untagged)]
enum Size {
    Number(f64),
    Text(String),
}

fn size<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let number = match Option::deserialize(deserializer)? {
        Some(Size::Text(text)) if text.trim().is_empty() => None,
        Some(Size::Text(text)) => match text.trim().parse::<f64>() {
            Ok(number) => Some(number),
            Err(_) => {
                return Err(D::Error::custom(format!(
                    "found the size `{text}`, expected a number with a point, such as 82.5"
                )));
            }
        },
        Some(Size::Number(number)) => Some(number),
        None => None,
    };
    match number {
        Some(number) if !(number > 0.0 && number.is_finite()) => {
            Err(D::Error::custom(format!("found the size {number}, expected a number above 0")))
        }
        known => Ok(known),
    }
}

impl Plan {
    /// The trials of a list, in its order.
    ///
    /// # Errors
    /// A list that cannot be read, or that has a line without a recording or a trial twice.
    pub fn of_list(path: &Path, files: &mut dyn Files) -> Result<Plan, JobError> {
        let shown = path.display().to_string();
        let bytes = read(files, path)?;
        // Some programs begin a file with a byte order mark.
        let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(&bytes);
        let lines = match ending(path).as_str() {
            "csv" => csv_lines(bytes),
            _ => json_lines(bytes),
        };
        planned_lines(lines.map_err(|error| error.within(shown.clone()))?, path)
            .map_err(|what| JobError::new(&[], what).within(shown))
    }
}

fn planned_lines(lines: Vec<Line>, path: &Path) -> Result<Plan, String> {
    if lines.is_empty() {
        return Err("found no trial; expected a line for each, with the path of the recording as `file`".into());
    }
    let root = path.parent().unwrap_or(Path::new(""));
    let mut plan = Plan { read: vec![path.to_owned()], ..Plan::default() };
    let mut names = BTreeSet::new();
    for line in lines {
        let trial = planned(line, root);
        if trial.name.is_empty() || trial.files.recording == root {
            return Err("found a line without `file`; expected the path of a recording in each".into());
        }
        if !names.insert(trial.name.clone()) {
            return Err(format!("found `{}` in two lines; expected each trial once", trial.name));
        }
        plan.read.push(trial.files.recording.clone());
        plan.trials.push(trial);
    }
    Ok(plan)
}

fn csv_lines(bytes: &[u8]) -> Result<Vec<Line>, JobError> {
    let head = bytes.split(|byte| *byte == b'\n').next().unwrap_or_default();
    if !head.contains(&b',') && head.iter().any(|byte| [b';', b'\t'].contains(byte)) {
        let what = format!(
            "line 1: found `{}`; expected columns separated by commas. hint: save the list as CSV with commas, and \
             numbers with points",
            String::from_utf8_lossy(head).trim()
        );
        return Err(JobError::new(&[], what));
    }
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(bytes);
    reader.deserialize().map(|line| line.map_err(|error| JobError::new(&[], error))).collect()
}

fn json_lines(bytes: &[u8]) -> Result<Vec<Line>, JobError> {
    let text = std::str::from_utf8(bytes).at("the list is not UTF-8 text")?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let parsed = |(k, line): (usize, &str)| {
        let refused = |what: String| JobError::new(&[], what).within(format!("line {}", k + 1));
        if !line.trim_start().starts_with('{') {
            return Err(refused("expected an object, such as {\"file\": \"walk.c3d\"}".into()));
        }
        // Each line is parsed alone, so that its number is always 1.
        serde_json::from_str(line).map_err(|error| refused(error.to_string().replace(" at line 1 column", ": column")))
    };
    lines.map(parsed).collect()
}

fn planned(line: Line, root: &Path) -> PlannedTrial {
    let shown = line.file.display().to_string().replace('\\', "/");
    let of_subject = line.trial.as_ref().map_or_else(String::new, |trial| format!(", trial {trial}"));
    let folder = line.file.parent().map(|folder| folder.display().to_string()).filter(|folder| !folder.is_empty());
    let path = |named: Option<PathBuf>| named.map(|named| root.join(named));
    PlannedTrial {
        name: format!("{shown}{of_subject}"),
        person: line.person.or(folder).unwrap_or_else(|| shown.clone()),
        kind: line.kind,
        stated: StatedTrial::default(),
        broken: None,
        files: TrialFiles {
            recording: root.join(&line.file),
            trial: line.trial,
            standing: path(line.standing),
            functional: None,
            model: path(line.model),
            grf: path(line.grf),
            loads: path(line.loads),
            size: StatedSize { mass_kg: line.mass, height_m: line.height },
        },
    }
}
