//! `ambulo forces`: what may be typed.

use super::Voice;
use super::values::{AddedMass, Cutoff, FootColumns, order, seconds};
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`, which writes these files):
  ambulo forces demo/input/walk.mot --model demo/input/figure.osim --loads demo/input/walk_grf.xml -o out
  ambulo forces demo/input/walk.mot --model demo/input/figure.osim --grf demo/input/walk_grf.mot --right calcn_r:ground_force_r_ --left calcn_l:ground_force_l_ --cutoff 6 --force-cutoff off --from 0.5 -o out

Files written to DIR: kinematics.mot, moments.sto, powers.sto, reactions.sto, grf.mot, external_loads.xml,
events.csv, cycles.csv, summary.json, figures/moments.svg, with --device moments_biological.sto.
Results of an earlier run in DIR are removed. docs/OUTPUTS.md describes them.

Exit code 0 if a person could do this, 1 if not (strength, joint ranges, power, friction, centre of pressure, sliding, flight,
forces that nothing supplies; docs/FEASIBILITY.md), 2 if nothing could be computed.")]
pub(crate) struct ForcesArgs {
    /// Recorded coordinates: .mot or .sto.
    pub(crate) input: PathBuf,
    /// The body: an OpenSim model (.osim).
    #[arg(long, value_name = "FILE")]
    pub(crate) model: PathBuf,
    /// Measured ground forces: .mot, .sto or .csv [default: the file that --loads names; the columns by their usual names if neither --loads nor --right and --left are given].
    #[arg(long, value_name = "FILE")]
    pub(crate) grf: Option<PathBuf>,
    /// Which columns act on which body: OpenSim's external loads (.xml).
    #[arg(long, value_name = "FILE", conflicts_with_all = ["right", "left"])]
    pub(crate) loads: Option<PathBuf>,
    /// Right foot: body and column prefix, such as calcn_r:ground_force_
    #[arg(long, value_name = "BODY:PREFIX", requires = "grf")]
    pub(crate) right: Option<FootColumns>,
    /// Left foot: body and column prefix, such as calcn_l:1_ground_force_
    #[arg(long, value_name = "BODY:PREFIX", requires = "grf")]
    pub(crate) left: Option<FootColumns>,
    /// Compute without ground forces (a swinging leg, a flight); the whole weight then stands in the root's residual.
    #[arg(long, conflicts_with_all = ["grf", "loads"])]
    pub(crate) no_ground: bool,
    /// First instant to analyse [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) from: Option<f64>,
    /// Last instant to analyse [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) to: Option<f64>,
    /// Frames a second of the results [default: as recorded].
    #[arg(long, value_name = "HZ")]
    pub(crate) rate: Option<f64>,
    /// Low-pass of the motion: cut-off in Hz of one pass of the zero-phase Butterworth filter, or off.
    #[arg(long, value_name = "HZ|off", default_value = "6", allow_hyphen_values = true)]
    pub(crate) cutoff: Cutoff,
    /// Low-pass of the measured forces [default: the same as the motion's].
    #[arg(long, value_name = "HZ|off", allow_hyphen_values = true)]
    pub(crate) force_cutoff: Option<Cutoff>,
    /// Order of one pass of the Butterworth filters (1 to 8).
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = order)]
    pub(crate) order: usize,
    /// How the motion is smoothed; spline: quintic, stiffness by generalised cross-validation, --cutoff then goes for the forces only.
    #[arg(long, value_enum, default_value_t = Filter::Butterworth)]
    pub(crate) filter: Filter,
    /// What a worn device contributes: .sto or .csv with columns as in moments.sto; adds moments_biological.sto.
    #[arg(long, value_name = "FILE")]
    pub(crate) device: Option<PathBuf>,
    /// A point mass fixed to a body, place in the body's frame in metres; may be repeated.
    #[arg(long, value_name = "BODY:KG[:X,Y,Z]")]
    pub(crate) add_mass: Vec<AddedMass>,
    /// What a person can do, by which the verdict is given: .toml (docs/FEASIBILITY.md) [default: built in].
    #[arg(long, value_name = "FILE")]
    pub(crate) thresholds: Option<PathBuf>,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

/// A filter family.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Filter {
    /// Zero-phase low-pass.
    Butterworth,
    /// Smoothing spline.
    Spline,
}
