//! `ambulo walk` and `ambulo demo`: what may be typed.

use super::Voice;
use ambulo::simulation::synthetic::SyntheticMode;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example:
  ambulo demo -o demo

The same as `ambulo walk -o demo`. The walk is also written to DIR/input as a recording would be, so that the run can be repeated with
`ambulo forces` (`ambulo forces --help`).")]
pub(crate) struct DemoArgs {
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples:
  ambulo walk -o out
  ambulo walk --speed 1.0 --figure de-leva-female --mass 60 --height 1.65 -o out
  ambulo walk --gait goose --mode paper -o out
  ambulo walk --gait slow --states

Modes: `corrected` changes the gait by a few degrees until its forces come from the ground alone, and steps it on soft shoes;
`paper` drives the joints as the gait has them, holds the trunk upright and lets rigid soles strike, as Faure, Debunne, Cani and Multon
did in 1997. Both take every gait and style; standard, long, short and goose are the paper's own: of style 1997 in its mode, of
style knots in the corrected one, unless --style says otherwise. A gait that no small change makes consistent is said to be so, and the verdict judges what comes out.

Of --speed, --step-length and --cadence two make the third; with one, the others follow from how people share speed between the two
(docs/GAITS.md, which also describes gait files); the gait's own count no more.

Files written to DIR: kinematics.mot, moments.sto, powers.sto, reactions.sto, grf.mot, external_loads.xml, events.csv, cycles.csv,
clinical.csv, times_and_distances.csv, summary.json, report.html (`ambulo view DIR` opens it), figure.osim, figures/*.svg. Results of an earlier run in DIR are removed. docs/OUTPUTS.md
describes them.

Exit code 0 if a person could do this, 1 if not (docs/FEASIBILITY.md), 2 if nothing could be computed.")]
pub(crate) struct WalkArgs {
    #[command(flatten)]
    pub(crate) gait: GaitArgs,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    /// How the walk is made.
    #[arg(long, value_enum, default_value_t = WalkMode::Corrected)]
    pub(crate) mode: WalkMode,
    /// How clinical.csv and the page measure angles of pelvis and hips: clinical, from the line through the iliac spines; opensim, the model's own.
    #[arg(long, value_enum, default_value_t = super::forces::AngleConvention::Clinical)]
    pub(crate) convention: super::forces::AngleConvention,
    /// Whole gait cycles of each foot.
    #[arg(long, value_name = "N", default_value_t = 3)]
    pub(crate) cycles: usize,
    /// Frames a second of the results.
    #[arg(long, value_name = "HZ", default_value_t = 100.0, allow_negative_numbers = true)]
    pub(crate) rate: f64,
    /// Print the state machine of the gait, and walk no step.
    #[arg(long)]
    pub(crate) states: bool,
    /// What a person can do, by which the verdict is given: .toml (docs/FEASIBILITY.md) [default: built in].
    #[arg(long, value_name = "FILE")]
    pub(crate) thresholds: Option<PathBuf>,
    /// Folder for the results [default: out]; with --states for the figure of the gait, if given.
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

/// Which gait.
#[derive(Debug, ClapArgs)]
pub(crate) struct GaitArgs {
    /// A gait by name (standard, long, short, goose, slow, free, fast) or from a file (docs/GAITS.md).
    #[arg(long, value_name = "NAME|FILE.toml", default_value = "free")]
    pub(crate) gait: String,
    /// Walking speed [m/s] [default: the gait's own].
    #[arg(long, value_name = "M/S", allow_negative_numbers = true)]
    pub(crate) speed: Option<f64>,
    /// Contact of one foot to contact of the other [m] [default: the gait's own].
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub(crate) step_length: Option<f64>,
    /// Steps a minute [default: the gait's own].
    #[arg(long, value_name = "STEPS/MIN", allow_negative_numbers = true)]
    pub(crate) cadence: Option<f64>,
    /// How high feet are lifted, against the natural height [default: the gait's own].
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true)]
    pub(crate) step_height: Option<f64>,
    /// How joint curves run between their knots: 1997 or knots [default: the gait's own].
    #[arg(long, value_name = "1997|knots")]
    pub(crate) style: Option<String>,
}

/// Who walks.
#[derive(Debug, ClapArgs)]
pub(crate) struct FigureArgs {
    /// Table of body segments: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = "de-leva-male")]
    pub(crate) figure: String,
    /// Body mass [kg] [default: 75, de-leva-female 60, faure-1997 80].
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    pub(crate) mass: Option<f64>,
    /// Stature [m] [default: 1.75, de-leva-female 1.65, faure-1997 1.80].
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub(crate) height: Option<f64>,
    /// Feet in one piece, without a joint at the toes.
    #[arg(long)]
    pub(crate) no_toe_joint: bool,
}

/// How a walk is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum WalkMode {
    /// Made consistent, on soft shoes.
    Corrected,
    /// As in 1997: rigid soles, the trunk held.
    Paper,
}

impl WalkMode {
    pub(crate) fn mode(self) -> SyntheticMode {
        match self {
            WalkMode::Corrected => SyntheticMode::Corrected,
            WalkMode::Paper => SyntheticMode::Paper,
        }
    }
}
