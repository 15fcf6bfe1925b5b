//! One trial of a batch: its key, and what was computed.

use crate::args::TrialWords;
use crate::caller::Caller;
use crate::commands::forces;
use crate::commands::trials::sentence;
use crate::printer;
use crate::record::{hash, hash_of_file};
use ambulo::analysis::Analysis;
use ambulo::job::trials::{PlannedTrial, TrialFiles, relative};
use ambulo::job::{Shared, bids_files_beside};
use ambulo::model::Model;
use ambulo::motion::Event;
use ambulo_formats::table::Table;
use ambulo_results::{
    CLINICAL, CYCLES, CycleRow, EVENTS, GROUND_MEASURED, KINEMATICS_RECORDED, Keep, TIMES_AND_DISTANCES,
    columns_of_predictions, cycle_rows, unit_of,
};
use anyhow::{Context, Error, Result, anyhow, bail};
use serde_json::Value;
use std::collections::BTreeMap;
use std::fmt::{self, Display, Formatter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Tables whose columns have names of another table, and the prefix of these columns.
const PREFIXES: [(&str, &str); 3] =
    [(GROUND_MEASURED, "measured_"), (CLINICAL, "clinical_"), (KINEMATICS_RECORDED, "recorded_")];

/// Largest time and size of a trial; a trial that is longer or larger is a row with its error.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Limits {
    /// Time until the stage after which the trial ends [s].
    pub(super) time_s: Option<f64>,
    /// Size of all files of the trial together [MB].
    pub(super) size_mb: Option<f64>,
}

impl Display for Limits {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let shown = |limit: Option<f64>, unit: &str| limit.map_or("none".to_owned(), |limit| format!("{limit} {unit}"));
        write!(f, "time {}, size {}", shown(self.time_s, "s"), shown(self.size_mb, "MB"))
    }
}

/// The work that a batch does on every trial.
#[derive(Debug, Default)]
pub(super) struct Work {
    /// The folder that names of trials begin at.
    pub(super) root: PathBuf,
    /// The options of every trial.
    pub(super) options: TrialWords,
    /// Tables that are kept.
    pub(super) keep: Vec<String>,
    /// Who may stop the computation.
    pub(super) caller: Caller,
    /// Largest time and size of a trial.
    pub(super) limits: Limits,
    /// Data that trials share.
    pub(super) shared: Shared,
    /// SHA-256 of files that several trials may have.
    pub(super) hashes: Mutex<BTreeMap<PathBuf, String>>,
}

/// The identity of a trial: the content of its files and its settings, independent of the folder.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Key {
    /// SHA-256 of version, options and the content of all files.
    pub(super) hash: String,
    /// File name and SHA-256 of each input.
    pub(super) inputs: Vec<(String, String)>,
}

/// A trial that was computed.
#[derive(Debug)]
pub(super) struct Computed {
    /// As in `summary.json`.
    pub(super) summary: Value,
    /// A row per frame.
    pub(super) frames: Vec<FrameColumn>,
    pub(super) cycles: Vec<CycleRow>,
    pub(super) events: Vec<Event>,
}

/// A column of frames.
#[derive(Debug)]
pub(super) struct FrameColumn {
    pub(super) name: String,
    pub(super) unit: &'static str,
    pub(super) values: Vec<f64>,
}

impl Work {
    /// The key of a trial; files that cannot be read have no hash.
    pub(super) fn key(&self, trial: &PlannedTrial) -> Key {
        let files = &trial.files;
        let words = self.options.apart();
        let of_words = words.iter().map(Path::new).filter(|path| path.is_file());
        let named = [&files.standing, &files.functional, &files.model, &files.grf, &files.loads]
            .into_iter()
            .flatten()
            .map(PathBuf::as_path);
        let shown = |path: &Path| {
            let path = path.strip_prefix(&self.root).unwrap_or(path);
            path.display().to_string().replace('\\', "/")
        };
        let recording = files.recording.as_path();
        // Trials of a .b3d have one file.
        let of_recording = match files.trial {
            Some(_) => self.shared_hash(recording),
            None => hash_of_file(recording).unwrap_or_default(),
        };
        let of_bids = bids_files_beside(recording).into_iter().flatten().filter(|path| path.is_file());
        let of_bids = of_bids.map(|path| (shown(&path), hash_of_file(&path).unwrap_or_default()));
        let others = named.chain(of_words).map(|path| (shown(path), self.shared_hash(path)));
        let inputs: Vec<(String, String)> =
            std::iter::once((shown(recording), of_recording)).chain(of_bids).chain(others).collect();
        let mut text = format!("{}\n{:?}\n{:?}\n", env!("AMBULO_VERSION"), words, self.keep);
        // Writing to memory does not fail.
        let _ = write!(text, "{:?} {:?} {:?} {:?}", files.trial, files.size.mass_kg, files.size.height_m, trial.broken);
        for (name, hash) in &inputs {
            let _ = write!(text, "\n{name} {hash}");
        }
        Key { hash: hash(text.as_bytes()), inputs }
    }

    /// SHA-256 of a file that several trials may have, computed once; empty if it cannot be read.
    fn shared_hash(&self, path: &Path) -> String {
        let hashes = || self.hashes.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = hashes().get(path) {
            return known.clone();
        }
        let hash = hash_of_file(path).unwrap_or_default();
        hashes().insert(path.to_owned(), hash.clone());
        hash
    }

    /// Computes a trial; the error is a sentence.
    pub(super) fn compute(&self, trial: &PlannedTrial) -> Result<Computed, String> {
        let computed = match &trial.broken {
            Some(reason) => Err(Error::msg(reason.clone())),
            None => self.limited(trial),
        };
        computed.map_err(|error| {
            let (message, hint) = printer::error_parts(&error);
            sentence(&message, hint, &trial.files.recording, &self.root)
        })
    }

    /// Computes a trial within the limits.
    fn limited(&self, trial: &PlannedTrial) -> Result<Computed> {
        let Limits { time_s, size_mb } = self.limits;
        let found_mb = size_mb.map_or(0.0, |_| megabytes(&trial.files));
        if let Some(limit) = size_mb.filter(|limit| found_mb > *limit) {
            bail!(
                "the files have {found_mb:.1} MB; expected at most {limit} MB. hint: raise the limit of size and \
                 continue the batch"
            );
        }
        // A time that no clock can count is no limit.
        let end = |seconds: f64| Instant::now().checked_add(Duration::try_from_secs_f64(seconds).ok()?);
        let caller = Caller { deadline: time_s.and_then(end), ..self.caller.clone() };
        self.computed(trial, &caller).map_err(|error| match time_s {
            Some(limit) if caller.is_stopped() && !self.caller.is_stopped() => anyhow!(
                "it took longer than the limit of {limit} s. hint: raise the limit of time and continue the batch, or \
                 choose a shorter time range"
            ),
            _ => error,
        })
    }

    fn computed(&self, trial: &PlannedTrial, caller: &Caller) -> Result<Computed> {
        let TrialWords { job, outputs, .. } = &self.options;
        let run = forces::compute_with(&trial.files.job(job), outputs.clone(), caller, &self.shared)?;
        let keep = Keep::of_names(&self.keep);
        let (files, mut summary) = run.tables_for(&keep)?;
        let Analysis { events, .. } = &run.outcome.analysis;
        let body = &run.outcome.body;
        let mut frames = Vec::new();
        for file in files.iter().filter(|file| keep.includes(&file.name)) {
            let prefix = PREFIXES.iter().find(|(name, _)| *name == file.name).map_or("", |(_, prefix)| prefix);
            if let Some(table) = file.table() {
                let table = table.with_context(|| file.name.clone())?;
                add_columns(&mut frames, &table, &file.name, prefix, &|column| unit_of(&file.name, column, Some(body)));
            }
        }
        add_unwritten(&mut frames, &keep, body);
        // The place of a folder is no result: the same batch has the same bytes.
        summary.findings.iter_mut().for_each(|finding| finding.message = relative(&finding.message, &self.root));
        Ok(Computed {
            summary: serde_json::to_value(&summary)?,
            frames,
            cycles: if keep.includes(CYCLES) { cycle_rows(body, run.outcome.complete()) } else { Vec::new() },
            events: if keep.includes(EVENTS) { events.clone() } else { Vec::new() },
        })
    }
}

/// Size of all files of a trial. Of a `.b3d` only the trial is read, so it does not count.
fn megabytes(files: &TrialFiles) -> f64 {
    let recording = files.trial.is_none().then_some(&files.recording);
    let others = [&files.standing, &files.functional, &files.model, &files.grf, &files.loads];
    let all = recording.into_iter().chain(others.into_iter().flatten());
    all.filter_map(|path| Some(path.metadata().ok()?.len())).sum::<u64>() as f64 / 1e6
}

/// Adds the columns of tables that a run writes only if forces were predicted, or predicted and measured, so that all
/// trials of a body have the same columns.
fn add_unwritten(frames: &mut Vec<FrameColumn>, keep: &Keep, body: &Model) {
    let Some(count) = frames.first().map(|column| column.values.len()) else { return };
    for (file, name, unit) in columns_of_predictions(body).into_iter().filter(|(file, ..)| keep.includes(file)) {
        let prefix = PREFIXES.iter().find(|(known, _)| *known == file).map_or("", |(_, prefix)| prefix);
        let name = format!("{prefix}{name}");
        if frames.iter().all(|column| column.name != name) {
            frames.push(FrameColumn { name, unit, values: vec![f64::NAN; count] });
        }
    }
}

/// Adds the columns of a table with a row per frame.
fn add_columns(
    frames: &mut Vec<FrameColumn>,
    table: &Table,
    file: &str,
    prefix: &str,
    unit: &dyn Fn(&str) -> &'static str,
) {
    let has_time = table.columns().next().is_some_and(|(name, _)| name == "time");
    if !has_time || file == TIMES_AND_DISTANCES {
        return;
    }
    for (name, values) in table.columns() {
        let is_shared = name == "time" || name.starts_with("ground_source_");
        let own = if is_shared { name.to_owned() } else { format!("{prefix}{name}") };
        if is_shared && frames.iter().any(|known| known.name == own) {
            continue;
        }
        frames.push(FrameColumn { name: own, unit: unit(name), values: values.to_vec() });
    }
}
