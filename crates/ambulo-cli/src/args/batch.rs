//! Options of `ambulo batch`.

use super::values::{above_zero, from_one, jobs, megabytes, part};
use super::{CheckArgs, PrintArgs, TrialWords, json};
use ambulo::job::json as text;
use ambulo_results::Keep;
use clap::Args as ClapArgs;
use clap::builder::PossibleValuesParser;
use serde::Deserialize;
use std::ffi::OsString;
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Example (after `ambulo demo -o demo`, which writes these files):
  ambulo batch demo/input -o batch
  ambulo batch demo/input -o batch --dry-run -- --predict

SOURCE is a folder, a list of trials (.csv or .jsonl, docs/BATCH.md), or a subject of AddBiomechanics (.b3d).
Every recording in a folder and its subfolders is a trial; BIDS data sets are supported. Standing trials, models
and tables of ground forces are found by the rules of docs/VALIDATE.md, and trials.toml states exceptions. Words
after `--` are options of `ambulo forces` for every trial.

Files written to DIR, for DuckDB, polars, pandas and Spark: trials/, frames/, cycles/, events/, each with one
file for a part of the trials. The file in trials/ is written last and completes its part. summary.html is
written when all parts of all shards are complete, and README.md, which lists what the tables hold. A trial
that cannot be computed is a row with its error.
After an interruption, --resume computes the missing parts; the files have the same bytes as those of an
uninterrupted run, with any number of --jobs. Exit code: 0 if any trial has results, 2 if none; with --check 1
if a trial could not be computed, has bad data or an infeasible motion.")]
pub(crate) struct BatchArgs {
    /// A folder with recordings, a list of trials (.csv, .jsonl) or a subject of AddBiomechanics (.b3d).
    #[arg(value_name = "SOURCE")]
    pub(crate) source: PathBuf,
    /// Folder for the results: a new one, or with --resume the folder of an interrupted batch.
    #[arg(short, long, value_name = "DIR", default_value = BatchArgs::OUTPUT)]
    #[serde(default = "BatchArgs::output")]
    pub(crate) output: PathBuf,
    /// Trials that are computed at the same time [default: the number of processors; 1 in a job of Slurm, PBS, LSF or
    /// Grid Engine].
    #[arg(long, value_name = "N", value_parser = jobs)]
    #[serde(default, deserialize_with = "json::jobs")]
    pub(crate) jobs: Option<u32>,
    /// Compute only every n-th trial, beginning with number I, counted from 0: N machines share a batch.
    #[arg(long, value_name = "I/N", default_value_t = Shard::default(), allow_hyphen_values = true)]
    #[serde(default, deserialize_with = "text::text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub(crate) shard: Shard,
    /// Continue an interrupted batch in its folder.
    #[arg(long)]
    #[serde(default)]
    pub(crate) resume: bool,
    /// Tables to write, separated by commas: tables of frames, cycles, events.
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = BatchArgs::KEEP,
        value_parser = PossibleValuesParser::new(tables()))]
    #[serde(default = "BatchArgs::keep", deserialize_with = "json::tables")]
    pub(crate) keep: Vec<String>,
    /// Trials in one file of each table.
    #[arg(long, value_name = "N", default_value_t = BatchArgs::PART, value_parser = part)]
    #[serde(default = "BatchArgs::part", deserialize_with = "json::part")]
    pub(crate) part: u32,
    /// Compute only the first trials.
    #[arg(long, value_name = "N", value_parser = from_one)]
    #[serde(default, deserialize_with = "json::limit")]
    pub(crate) limit: Option<u32>,
    /// Longest time for one trial [s]: a trial that takes longer ends after its stage and is a row with its error.
    #[arg(long, value_name = "S", value_parser = above_zero)]
    #[serde(default, deserialize_with = "json::duration_s")]
    pub(crate) time_limit: Option<f64>,
    /// Largest size of all files of one trial [MB]: a larger trial is not read and is a row with its error.
    #[arg(long, value_name = "MB", value_parser = megabytes)]
    #[serde(default, deserialize_with = "json::megabytes")]
    pub(crate) size_limit: Option<f64>,
    /// Only print which trials were found, with which files.
    #[arg(long)]
    #[serde(default)]
    pub(crate) dry_run: bool,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) check: CheckArgs,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) print: PrintArgs,
    /// Options of `ambulo forces` for every trial.
    #[arg(last = true, value_name = "OPTIONS")]
    #[serde(skip)]
    pub(crate) options: Vec<OsString>,
}

impl BatchArgs {
    /// The folder for the results, if none is given.
    const OUTPUT: &'static str = "batch";
    /// Tables that are written, if none are chosen.
    const KEEP: &'static str = "kinematics,moments,powers,grf,grf_sd,cycles,events";
    /// Trials in one file, if no number is given.
    const PART: u32 = 100;

    fn output() -> PathBuf {
        BatchArgs::OUTPUT.into()
    }

    fn keep() -> Vec<String> {
        BatchArgs::KEEP.split(',').map(str::to_owned).collect()
    }

    fn part() -> u32 {
        BatchArgs::PART
    }

    /// The options of every trial.
    pub(crate) fn of_trials(&self) -> Result<TrialWords, clap::Error> {
        TrialWords::parse("ambulo batch SOURCE", &self.options)
    }
}

/// Tables of a run that have a row per frame, cycles and events.
pub(super) fn tables() -> impl Iterator<Item = &'static str> {
    let others =
        ["report", "figures", "tables", "model", "summary", "timings", "recording", "states", "times_and_distances"];
    Keep::OF_RUNS.into_iter().filter(move |name| !others.contains(name))
}

/// One of several shares of the trials.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Shard {
    /// Counted from 0.
    pub(crate) index: usize,
    pub(crate) count: usize,
}

impl Default for Shard {
    fn default() -> Shard {
        Shard { index: 0, count: 1 }
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.index, self.count)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Shard, String> {
        const MOST: usize = 1_000_000;
        let expected = || format!("expected I/N with I from 0 to N - 1, such as 0/4, and N at most {MOST}");
        let (index, count) = text.split_once('/').ok_or_else(expected)?;
        let number = |text: &str| text.trim().parse::<usize>().map_err(|_| expected());
        let shard = Shard { index: number(index)?, count: number(count)? };
        if shard.index < shard.count && shard.count <= MOST { Ok(shard) } else { Err(expected()) }
    }
}
