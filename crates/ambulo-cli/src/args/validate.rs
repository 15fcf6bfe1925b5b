//! Options of `ambulo validate`.

use super::values::{Figure, jobs, kilograms, metres, segments};
use super::{PrintArgs, ReplaceArgs, json};
use ambulo::job::json as text;
use ambulo::job::trials::TrialFiles;
use ambulo::job::{Job, Processing, ending};
use ambulo::study::{GroundSettings, StatedSize};
use clap::Args as ClapArgs;
use clap::builder::TypedValueParser;
use serde::Deserialize;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Example (after `ambulo demo -o demo`, which writes these files):
  ambulo validate demo/input --mass 75 --height 1.75 -o validation
  ambulo validate demo/input --dry-run

Predicts the ground forces of every recording with force plates in DIR and its subfolders, as by
`ambulo forces --predict`, and compares them with the plates. A folder with recordings is a person. A recording
of the person standing still is the standing trial of the others in its folder. Markers (.c3d, .trc) and
coordinates (.mot, .sto) without plates use the table of ground forces with the same name except for words such
as `grf`: walk1.trc, walk1_grf.mot. The only model (.osim) of a folder is used for its .trc, .mot and .sto. A
.b3d is a person with several trials. trials.toml in DIR states exceptions: person, kind, static, mass, height,
model, grf, loads, exclude (docs/VALIDATE.md). --dry-run prints the files that were found.

Files written to OUT: validation.html (open it with `ambulo view OUT/validation.html`), validation.md (the same
tables), stances.csv (each stance), means.csv (each trial, person and kind of trial), summary.json. A trial that
cannot be judged is listed with its error. Exit code: 0 if at least one trial was judged, 2 if none.")]
pub(crate) struct ValidateArgs {
    /// The folder with the recordings.
    #[arg(value_name = "DIR")]
    pub(crate) folder: PathBuf,
    /// Body mass of the person, if DIR has the trials of one person [kg] [default: as in trials.toml, measured by the
    /// force plates or stated in the recordings].
    #[arg(long, value_name = "KG", allow_negative_numbers = true, value_parser = kilograms)]
    pub(crate) mass: Option<f64>,
    /// Stature of the person, if DIR has the trials of one person [m] [default: as in trials.toml, stated in the
    /// recordings or estimated].
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = metres)]
    pub(crate) height: Option<f64>,
    /// Table of segment masses of the built-in body: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = Job::SEGMENTS.name(), value_parser = segments().map(Figure))]
    #[serde(default, deserialize_with = "text::text")]
    #[cfg_attr(feature = "schema", schemars(with = "String"))]
    pub(crate) figure: Figure,
    /// The marker set: a name from docs/MARKERS.md or a .toml [default: recognised from the marker names].
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) markers: Option<String>,
    /// Judge tracking as well (`ambulo forces --track`): one to three seconds per trial.
    #[arg(long)]
    #[serde(default)]
    pub(crate) track: bool,
    /// Only print which files are judged, with their settings, and which are not.
    #[arg(long)]
    #[serde(default)]
    pub(crate) dry_run: bool,
    /// Trials that are computed at the same time [default: the number of processors]; the results do not depend on it.
    #[arg(long, value_name = "N", value_parser = jobs)]
    #[serde(default, deserialize_with = "json::jobs")]
    pub(crate) jobs: Option<u32>,
    /// Folder for the results.
    #[arg(short, long, value_name = "OUT", default_value = ValidateArgs::OUTPUT)]
    #[serde(default = "ValidateArgs::output")]
    pub(crate) output: PathBuf,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

impl ValidateArgs {
    /// The folder for the results, if none is given.
    const OUTPUT: &'static str = "validation";

    fn output() -> PathBuf {
        ValidateArgs::OUTPUT.into()
    }

    /// The job of a trial: its ground forces are predicted.
    pub(crate) fn job_of(&self, files: &TrialFiles) -> Job {
        let has_markers = matches!(ending(&files.recording).as_str(), "c3d" | "trc");
        let is_built_in = files.model.is_none() && has_markers;
        let settings = Processing { ground: GroundSettings::Predicted, ..Processing::default() };
        files.job(&Job {
            segments: if is_built_in { self.figure.0 } else { Job::SEGMENTS },
            markers: self.markers.clone().filter(|_| is_built_in),
            settings,
            ..Job::default()
        })
    }

    /// The size of the person.
    pub(crate) fn size(&self) -> StatedSize {
        StatedSize { mass_kg: self.mass, height_m: self.height }
    }
}
