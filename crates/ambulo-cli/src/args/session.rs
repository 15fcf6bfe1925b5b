//! Options of `ambulo session`.

use super::values::{day, jobs};
use super::{PrintArgs, ReplaceArgs, TrialWords, json};
use clap::Args as ClapArgs;
use serde::Deserialize;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Examples (after `ambulo demo -o demo`, which writes these files):
  ambulo session demo/input -o session -- --mass 75 --height 1.75
  ambulo session demo/input --dry-run
  ambulo session demo/input/walk.mot demo/input/figure.osim -o session     # these files only

DIR is a visit: the trials of one person, with at most one standing trial. The files of each trial are found by
the rules of docs/VALIDATE.md, and trials.toml states exceptions: person, age, static, mass, height, model, grf,
loads, exclude, date. All trials use one body, calibrated once. Each trial is computed as by `ambulo forces --predict`.
Forces are measured if force plates measured the whole stance of a cycle, else predicted. Words after `--` are
options of `ambulo forces` for every trial.

Files written to OUT: session.html (open it with `ambulo view OUT`; it needs no other file), summary.json,
cycles.csv, times_and_distances.csv, deviations.csv, trials.csv; with --compare differences.csv; with --norm
norm.json; trials/ has the page of each trial. A trial that cannot be computed is a row with its reason. Exit code: 0 if any trial has a cycle that counts, 2 if none.
docs/SESSION.md has the rules and the definitions.")]
pub(crate) struct SessionArgs {
    /// The folder with the recordings of the visit; or the files: recordings, standing trial, models, tables of forces.
    #[arg(value_name = "DIR|FILES", required = true, num_args = 1..)]
    #[serde(deserialize_with = "json::sources")]
    pub(crate) source: Vec<PathBuf>,
    /// Folder for the results.
    #[arg(short, long, value_name = "OUT", default_value = SessionArgs::OUTPUT)]
    #[serde(default = "SessionArgs::output")]
    pub(crate) output: PathBuf,
    /// Folder of an earlier session of the person, to show the changes.
    #[arg(long, value_name = "EARLIER")]
    pub(crate) compare: Option<PathBuf>,
    /// Your own reference group: norm.json of an earlier run, or a folder with recordings or sessions of healthy
    /// subjects, one folder per subject [default: children of Schwartz et al. 2008].
    #[arg(long, value_name = "FILE|DIR")]
    pub(crate) norm: Option<PathBuf>,
    /// Name of the person on the page [default: as in trials.toml, in the recordings, or the folder].
    #[arg(long, value_name = "NAME", conflicts_with = "anonymous")]
    pub(crate) name: Option<String>,
    /// Day of the session, as YYYY-MM-DD [default: as in trials.toml or in the recordings].
    #[arg(long, value_name = "DAY", value_parser = day, conflicts_with = "anonymous")]
    #[serde(default, deserialize_with = "json::day")]
    pub(crate) date: Option<String>,
    /// Write no name, no path and no date into any file, and no page of a trial.
    #[arg(long)]
    #[serde(default)]
    pub(crate) anonymous: bool,
    /// Only print which trials were found, with which files.
    #[arg(long)]
    #[serde(default)]
    pub(crate) dry_run: bool,
    /// Trials that are computed at the same time [default: the number of processors]; the results do not depend on it.
    #[arg(long, value_name = "N", value_parser = jobs)]
    #[serde(default, deserialize_with = "json::jobs")]
    pub(crate) jobs: Option<u32>,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) print: PrintArgs,
    /// Options of `ambulo forces` for every trial.
    #[arg(last = true, value_name = "OPTIONS")]
    #[serde(skip)]
    pub(crate) options: Vec<OsString>,
}

impl SessionArgs {
    /// The folder for the results, if none is given.
    const OUTPUT: &'static str = "session";

    fn output() -> PathBuf {
        SessionArgs::OUTPUT.into()
    }

    /// The options of every trial.
    pub(crate) fn of_trials(&self) -> Result<TrialWords, clap::Error> {
        TrialWords::parse("ambulo session DIR", &self.options)
    }
}
