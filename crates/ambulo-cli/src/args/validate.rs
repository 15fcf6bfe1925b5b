//! Options of `ambulo validate`.

use super::forces::{ForcesArgs, SubjectArgs};
use super::trial_files::TrialFiles;
use super::values::number;
use super::{PrintArgs, ReplaceArgs};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs)]
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
    /// Body mass of the person, if DIR has the trials of one person [kg] [default: as in trials.toml, measured by the force plates or stated in the recordings].
    #[arg(long, value_name = "KG", allow_negative_numbers = true, value_parser = number)]
    pub(crate) mass: Option<f64>,
    /// Stature of the person, if DIR has the trials of one person [m] [default: as in trials.toml, stated in the recordings or estimated].
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub(crate) height: Option<f64>,
    /// Table of segment masses of the built-in body: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = SubjectArgs::DEFAULT_FIGURE)]
    pub(crate) figure: String,
    /// The marker set: a name from docs/MARKERS.md or a .toml [default: recognised from the marker names].
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) markers: Option<String>,
    /// Judge tracking as well (`ambulo forces --track`): one to three seconds per trial.
    #[arg(long)]
    pub(crate) track: bool,
    /// Only print which files are judged, with their settings, and which are not.
    #[arg(long)]
    pub(crate) dry_run: bool,
    /// Trials that are computed at the same time [default: the number of processors]; the results do not depend on it.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1024))]
    pub(crate) jobs: Option<u32>,
    /// Folder for the results.
    #[arg(short, long, value_name = "OUT", default_value = "validation")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

impl ValidateArgs {
    /// The options by which a trial is predicted.
    pub(crate) fn of_trial(&self, files: &TrialFiles) -> Result<ForcesArgs, clap::Error> {
        let defaults = files.options(&["--predict".into()])?;
        let has_markers = ["c3d", "trc"]
            .iter()
            .any(|known| files.recording.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(known)));
        let is_built_in = files.model.is_none() && has_markers;
        let subject = SubjectArgs {
            figure: if is_built_in { self.figure.clone() } else { defaults.subject.figure },
            markers: self.markers.clone().filter(|_| is_built_in),
            ..defaults.subject
        };
        Ok(ForcesArgs { subject, ..defaults })
    }
}
