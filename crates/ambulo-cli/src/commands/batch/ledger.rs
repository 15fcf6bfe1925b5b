//! The folder of a batch: which parts are closed, and how a part is closed.
//!
//! | file | content |
//! |---|---|
//! | `batch.json` | what the batch is: version, number of shards, trials in a part, tables, options |
//! | `frames/part-SSS-PPPPP.parquet`, `cycles/`, `events/` | tables of part P of shard S; none in `frames/` if no trial of the part has results |
//! | `trials/part-SSS-PPPPP.parquet` | the trials of the part; it appears last and closes the part |
//! | `summary.html` | the page of the batch, made from the tables of trials when all parts of all shards are closed |
//! | `README.md` | the card of the data, written last; while it is there, all files of a table have the same columns |
//!
//! Each file is first written under another name and flushed to the disk, and then renamed. After a kill at any moment
//! each part is either closed or open, and the files of an open part are written again. A lock keeps two runs of one
//! shard apart.

use super::columns::unify;
use super::part_file::{read, removed, written};
use super::tables::PartTables;
use super::trial::Limits;
use crate::args::Shard;
use crate::folder_lock::FolderLock;
use crate::replacement::write_through;
use ambulo_formats::parquet::{ColumnValues, ParquetTable};
use ambulo_results::BATCH;
use anyhow::{Context, Result, anyhow, bail};
use serde::{Deserialize, Serialize};
use std::fs::{self, File};
use std::io::{ErrorKind, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

const TABLES: [&str; 4] = [FRAMES, "cycles", "events", TRIALS];
const FRAMES: &str = "frames";
const TRIALS: &str = "trials";
/// Tables of frames that every trial with results has; others are of some trials only.
const OF_EVERY_TRIAL: [&str; 2] = ["kinematics", "moments"];
/// The card of the data.
const CARD: &str = "README.md";
/// Key of the limits in the texts of a table of trials.
const LIMITS: &str = "limits of a trial";
/// Folder of the locks of the shards.
const LOCKS: &str = ".shards";

/// The description of a batch. All shards and all runs that continue the batch must have the same one.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(super) struct Description {
    /// Version of Ambulo.
    pub(super) version: String,
    /// Number of shards.
    pub(super) shards: usize,
    /// Trials in a part.
    pub(super) part: usize,
    /// Number of trials that are computed at most.
    pub(super) limit: Option<u32>,
    /// Tables that are kept.
    pub(super) keep: Vec<String>,
    /// Options of `ambulo forces`.
    pub(super) options: Vec<String>,
    /// SHA-256 of the names of all trials in their order, if there are several shards: each of them must find the same
    /// list.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(super) trials: Option<String>,
}

/// The folder, while this process alone writes the parts of one shard.
pub(super) struct Ledger {
    folder: PathBuf,
    shard: Shard,
    /// Whether every trial with results has frames.
    keeps_frames: bool,
    /// Limits of time and size of a trial, in words.
    limits: String,
    _lock: FolderLock,
}

impl Ledger {
    /// Opens the shard of a folder: a new one, or one of the same batch to continue.
    pub(super) fn open(
        folder: &Path,
        shard: Shard,
        description: &Description,
        limits: Limits,
        resume: bool,
    ) -> Result<Ledger> {
        let shown = folder.display();
        if folder.is_file() {
            bail!("{shown}: this is a file; expected a folder for the results");
        }
        let path = folder.join(BATCH);
        let is_used = |folder: &Path| {
            fs::read_dir(folder)
                .is_ok_and(|mut entries| entries.any(|entry| entry.is_ok_and(|entry| entry.file_name() != LOCKS)))
        };
        if !path.exists() && is_used(folder) {
            bail!(
                "{shown}: this folder has other files; expected a new folder, or that of a batch. hint: choose another \
                 one with -o"
            );
        }
        let Some(lock) = FolderLock::take(&place_of_lock(folder, shard))? else {
            bail!(
                "{shown}: another batch is writing shard {}/{} of this folder; expected one at a time. hint: wait \
                 until it has ended, or choose another folder with -o",
                shard.index,
                shard.count
            );
        };
        let keeps_frames = description.keep.iter().any(|table| OF_EVERY_TRIAL.contains(&table.as_str()));
        let limits = limits.to_string();
        let ledger = Ledger { folder: folder.to_owned(), shard, keeps_frames, limits, _lock: lock };
        ledger.agree(&path, description)?;
        for table in TABLES {
            let place = folder.join(table);
            fs::create_dir_all(&place)
                .with_context(|| format!("{}: this folder cannot be created", place.display()))?;
        }
        if !resume && let Some(closed) = ledger.first_closed()? {
            bail!(
                "{shown}: shard {}/{} has results already ({closed}); expected none. hint: --resume continues this \
                 batch; or choose another folder with -o",
                shard.index,
                shard.count
            );
        }
        Ok(ledger)
    }

    /// Writes the description, or compares it with the existing one.
    fn agree(&self, path: &Path, description: &Description) -> Result<()> {
        // Beside the lock: after a kill the folder is still one without other files.
        let own = place_of_lock(&self.folder, self.shard).join(BATCH);
        let text = serde_json::to_string_pretty(description)? + "\n";
        write_through(&own, text.as_bytes()).with_context(|| format!("{}: cannot be written", own.display()))?;
        // Of several shards that begin at once one is the first.
        let linked = fs::hard_link(&own, path);
        let done = match linked {
            Err(error) if error.kind() == ErrorKind::AlreadyExists => Ok(()),
            // A file system without links.
            Err(_) if !path.exists() => fs::rename(&own, path),
            other => other,
        };
        let _ = fs::remove_file(&own);
        done.with_context(|| format!("{}: cannot be written", path.display()))?;
        let found = fs::read_to_string(path).with_context(|| format!("{}: cannot be read", path.display()))?;
        let found: Description = serde_json::from_str(&found)
            .with_context(|| format!("{}: this is not the description of a batch", path.display()))?;
        match differences(&found, description).as_slice() {
            [] if found.trials != description.trials => bail!(
                "{}: the shards before this one found other trials in the source; expected the same list in every \
                 shard. hint: compute all shards again into another folder with -o, and change no recording meanwhile",
                self.folder.display()
            ),
            [] => Ok(()),
            all if found.version != description.version => bail!(
                "{}: this folder has the batch of another version: {}. hint: choose another folder with -o",
                self.folder.display(),
                all.join("; ")
            ),
            all => bail!(
                "{}: this folder has another batch: {}. hint: give the same options, or choose another folder with -o",
                self.folder.display(),
                all.join("; ")
            ),
        }
    }

    fn place(&self, table: &str, part: usize) -> PathBuf {
        self.place_of(self.shard.index, table, part)
    }

    fn place_of(&self, shard: usize, table: &str, part: usize) -> PathBuf {
        self.folder.join(table).join(format!("{}{part:05}.parquet", beginning(shard)))
    }

    /// The tables of trials of all shards, if all their parts are closed. `trials` is the number of trials of the
    /// batch.
    pub(super) fn complete(&self, trials: usize, part: usize) -> Result<Option<Vec<ParquetTable>>> {
        let trials_of = self.places(TRIALS, trials, part);
        if !trials_of.iter().all(|place| place.is_file()) {
            return Ok(None);
        }
        // Of several shards that end at once one completes the folder.
        let Some(_lock) = FolderLock::take(&self.folder.join(LOCKS).join("complete"))? else {
            return Ok(None);
        };
        if !self.folder.join(CARD).is_file() {
            unify(&self.places(FRAMES, trials, part))?;
        }
        trials_of.iter().map(|place| read(place)).collect::<Result<_>>().map(Some)
    }

    /// The first table of frames of a complete batch; `None` if no part has one.
    pub(super) fn first_frames(&self, trials: usize, part: usize) -> Result<Option<ParquetTable>> {
        self.places(FRAMES, trials, part).iter().find(|place| place.is_file()).map(|place| read(place)).transpose()
    }

    /// Writes the card of the data, the last file of a complete batch.
    pub(super) fn write_card(&self, text: &str) -> Result<()> {
        let path = self.folder.join(CARD);
        written(&path, text.as_bytes()).with_context(|| format!("{}: cannot be written", path.display()))
    }

    /// The files of a table in the order of shards and parts.
    fn places(&self, table: &str, trials: usize, part: usize) -> Vec<PathBuf> {
        let Shard { count, .. } = self.shard;
        let parts = |shard: usize| trials.saturating_sub(shard).div_ceil(count).div_ceil(part);
        (0..count).flat_map(|shard| (0..parts(shard)).map(move |k| self.place_of(shard, table, k))).collect()
    }

    fn first_closed(&self) -> Result<Option<String>> {
        let folder = self.folder.join(TRIALS);
        let entries = fs::read_dir(&folder).with_context(|| format!("{}: cannot be read", folder.display()))?;
        let names = entries.filter_map(|entry| Some(entry.ok()?.file_name().to_string_lossy().into_owned()));
        Ok(names.filter(|name| name.starts_with(&beginning(self.shard.index))).min())
    }

    /// The table of trials of a closed part; `None` if the part is open. With other limits a part with a trial that
    /// could not be computed is open again.
    ///
    /// # Errors
    /// A part of other trials: an input or the list has changed since.
    pub(super) fn closed(&self, part: usize, keys: &[(&str, &str)]) -> Result<Option<ParquetTable>> {
        let path = self.place(TRIALS, part);
        let bytes = match fs::read(&path) {
            Err(error) if error.kind() == ErrorKind::NotFound => return Ok(None),
            read => read.with_context(|| format!("{}: cannot be read", path.display()))?,
        };
        let shown = path.display();
        let hint = "hint: remove this file, and --resume computes its part again";
        let table = ParquetTable::read(&bytes).map_err(|error| anyhow!("{shown}: {error}. {hint}"))?;
        let Some(ColumnValues::Text(found)) = table.column("key") else {
            bail!("{shown}: found no column `key`; expected the trials of a batch. {hint}");
        };
        let has_error = || match table.column("error") {
            Some(ColumnValues::Text(errors)) => errors.iter().any(Option::is_some),
            _ => false,
        };
        let has_other_limits = || table.about(LIMITS) != Some(&self.limits);
        if !self.has_results(part, &table) || has_other_limits() && has_error() {
            return Ok(None);
        }
        let differs =
            keys.iter().enumerate().find(|(k, (_, key))| found.get(*k).and_then(|own| own.as_deref()) != Some(*key));
        match differs {
            None if found.len() == keys.len() => Ok(Some(table)),
            None => bail!("{}: found {} trials; expected {}. {CHANGED}", path.display(), found.len(), keys.len()),
            Some((_, (name, _))) => {
                bail!("{}: `{name}` was computed from other files or is another trial. {CHANGED}", path.display())
            }
        }
    }

    /// Whether the other tables of a closed part exist and are complete; one may have been removed or copied in part.
    fn has_results(&self, part: usize, trials: &ParquetTable) -> bool {
        const MARK: &[u8] = b"PAR1";
        let is_complete = |table: &str| {
            let mut ends = [[0; MARK.len()]; 2];
            let mut read = || {
                let mut file = File::open(self.place(table, part))?;
                file.read_exact(&mut ends[0])?;
                file.seek(SeekFrom::End(-(MARK.len() as i64)))?;
                file.read_exact(&mut ends[1])
            };
            read().is_ok() && ends.iter().all(|end| end == MARK)
        };
        let has_frames = || match trials.column("frames") {
            Some(ColumnValues::Whole(frames)) if self.keeps_frames => {
                frames.iter().any(|count| count.is_some_and(|count| count > 0))
            }
            _ => false,
        };
        TABLES.into_iter().filter(|table| *table != TRIALS && (*table != FRAMES || has_frames())).all(is_complete)
    }

    /// Writes the tables of a part; the trials are last and close it.
    ///
    /// The columns of frames come from the trials. A part without results would have a file without them, which Spark
    /// and polars do not read together with the others; so such a part has no file.
    pub(super) fn close(&self, part: usize, tables: &PartTables) -> Result<()> {
        let PartTables { trials, frames, cycles, events } = tables;
        let mut trials = trials.clone();
        trials.about.push((LIMITS.to_owned(), self.limits.clone()));
        let card = self.folder.join(CARD);
        removed(&card).with_context(|| format!("{}: cannot be removed", card.display()))?;
        for (name, table) in TABLES.into_iter().zip([frames, cycles, events, &trials]) {
            let path = self.place(name, part);
            let put = match name == FRAMES && frames.rows() == 0 {
                true => removed(&path),
                false => written(&path, &table.write()?),
            };
            put.with_context(|| {
                format!(
                    "{}: cannot be written; the parts that are closed are kept. hint: --resume continues",
                    path.display()
                )
            })?;
        }
        Ok(())
    }
}

fn place_of_lock(folder: &Path, shard: Shard) -> PathBuf {
    folder.join(LOCKS).join(format!("{:03}", shard.index))
}

/// The beginning of the names of all files of a shard.
fn beginning(shard: usize) -> String {
    format!("part-{shard:03}-")
}

/// Why a closed part does not fit.
const CHANGED: &str = "A recording, a file of it or the list has changed since. hint: choose another folder with -o";

fn differences(found: &Description, expected: &Description) -> Vec<String> {
    let mut all = Vec::new();
    let mut compare = |what: &str, found: String, expected: String| {
        if found != expected {
            all.push(format!("{what}: found {found}, expected {expected}"));
        }
    };
    compare("version", found.version.clone(), expected.version.clone());
    compare("shards", found.shards.to_string(), expected.shards.to_string());
    compare("--part", found.part.to_string(), expected.part.to_string());
    let number = |limit: Option<u32>| limit.map_or_else(|| "none".to_owned(), |limit| limit.to_string());
    let words = |words: &[String], between: &str| match words {
        [] => "none".to_owned(),
        _ => words.join(between),
    };
    compare("--limit", number(found.limit), number(expected.limit));
    compare("--keep", words(&found.keep, ","), words(&expected.keep, ","));
    compare("options after `--`", words(&found.options, " "), words(&expected.options, " "));
    all
}
