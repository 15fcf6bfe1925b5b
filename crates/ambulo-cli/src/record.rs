//! The record of a run in its `summary.json`: the id of the run and the SHA-256 of every other file but `timings.json`,
//! as `sha256sum` prints it.
//!
//! The id is made from version, command, options and the content of all inputs, so the same run has the same id
//! everywhere and always.

use crate::caller::Caller;
use ambulo_results::{SUMMARY, TIMINGS, Timings};
use anyhow::{Context, Result, bail};
use serde::Deserialize;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::fmt::Write;
use std::fs;
use std::io;
use std::path::{Component, Path, PathBuf};

/// Which run wrote a folder, and the hashes of its files by name.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Record {
    /// The id of the run.
    pub run_id: String,
    /// Hashes of its files by name.
    pub files: BTreeMap<String, String>,
}

impl Record {
    /// The record in the content of a `summary.json`; `None` if Ambulo did not write one there.
    #[must_use]
    pub fn from_summary(bytes: &[u8]) -> Option<Record> {
        let record: Record = serde_json::from_slice(bytes).ok()?;
        record.files.keys().all(|name| is_inside(name)).then_some(record)
    }

    /// The record of a folder; `None` if its summary is missing or has none.
    #[must_use]
    pub fn of_folder(folder: &Path) -> Option<Record> {
        Record::from_summary(&fs::read(folder.join(SUMMARY)).ok()?)
    }

    /// The durations of this run; `None` if the folder has none, or the durations of another run.
    pub(crate) fn timings(&self, folder: &Path) -> Option<BTreeMap<String, f64>> {
        let timings: Timings = serde_json::from_slice(&fs::read(folder.join(TIMINGS)).ok()?).ok()?;
        (timings.run_id == self.run_id).then_some(timings.timing_ms)
    }

    /// Checks the content of a file of the folder, which must be recorded.
    pub(crate) fn check(&self, folder: &Path, name: &str, bytes: &[u8]) -> Result<()> {
        if self.files.get(name).is_some_and(|recorded| *recorded == hash(bytes)) {
            return Ok(());
        }
        let (shown, run) = (folder.display(), short(&self.run_id));
        if Record::of_folder(folder).as_ref() != Some(self) {
            bail!("{shown}: another run replaced these results while they were read. hint: try again");
        }
        bail!(
            "{shown}: these files belong to two runs: {name} is not the file that {SUMMARY} of run {run} records; it \
             was changed, or another run wrote it. hint: run the command that wrote this folder again, with --force"
        )
    }

    /// Checks all recorded files of the folder itself that exist, except the one named. Subfolders have pictures and
    /// inputs, which no command takes for results.
    pub(crate) fn check_all_but(&self, folder: &Path, except: &str) -> Result<()> {
        let names = self.files.keys().filter(|name| *name != except && !name.contains('/'));
        for (name, path) in names.map(|name| (name, folder.join(name))).filter(|(_, path)| path.exists()) {
            let bytes = fs::read(&path).with_context(|| format!("{}: cannot be read", path.display()))?;
            self.check(folder, name, &bytes)?;
        }
        Ok(())
    }
}

/// The id of a run: `options` are the command with all its options but those that only choose the folder and the
/// printout.
pub(crate) fn run_id(options: &str, inputs: &[PathBuf], caller: &Caller) -> Result<String> {
    let mut text = format!("{}\n{options}\n", env!("CARGO_PKG_VERSION"));
    for input in inputs {
        if let Some(content) = caller.content(input) {
            text += &hash(content);
        } else if input.is_file() {
            // A pipe can be read only once.
            text += &hash_of_file(input).with_context(|| format!("{}: cannot be read again", input.display()))?;
        }
    }
    Ok(hash(text.as_bytes()))
}

/// SHA-256 in hexadecimal digits.
#[must_use]
pub fn hash(bytes: &[u8]) -> String {
    let mut hashed = Hashed::new(io::sink());
    hashed.hasher.update(bytes);
    hashed.hash()
}

/// SHA-256 of a file in hexadecimal digits, read piece by piece.
pub(crate) fn hash_of_file(path: &Path) -> io::Result<String> {
    let mut hashed = Hashed::new(io::sink());
    io::copy(&mut fs::File::open(path)?, &mut hashed)?;
    Ok(hashed.hash())
}

/// Passes bytes on and computes their hash.
pub(crate) struct Hashed<W> {
    out: W,
    hasher: Sha256,
}

impl<W: io::Write> Hashed<W> {
    pub(crate) fn new(out: W) -> Hashed<W> {
        Hashed { out, hasher: Sha256::new() }
    }

    /// SHA-256 of all bytes so far in hexadecimal digits.
    pub(crate) fn hash(self) -> String {
        self.hasher.finalize().iter().fold(String::new(), |mut text, byte| {
            // Writing to memory does not fail.
            let _ = write!(text, "{byte:02x}");
            text
        })
    }
}

impl<W: io::Write> io::Write for Hashed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let count = self.out.write(bytes)?;
        self.hasher.update(&bytes[..count]);
        Ok(count)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}

/// The beginning of a hash, for messages.
pub(crate) fn short(hash: &str) -> String {
    hash.chars().take(8).collect()
}

/// Whether a name leads to a file inside the folder.
pub(crate) fn is_inside(name: &str) -> bool {
    !name.is_empty() && Path::new(name).components().all(|part| matches!(part, Component::Normal(_)))
}
