//! The other verbs: what may be typed.

use super::Voice;
use super::values::{above_zero, limit, seconds};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (in the folder of the source, which holds examples/):
  ambulo simulate examples/pendulum.toml --plot -o out

Files written to DIR: poses.csv, joints.csv, reactions.csv, contacts.csv, closures.csv, energy.csv, shapes.json,
summary.json, report.html (`ambulo view DIR` opens it), with figures moments.sto, with --plot figures/*.svg; those
that the scene has nothing for are left out. Results of an earlier run in DIR are removed. docs/SCENES.md describes scene files, docs/OUTPUTS.md the results.")]
pub(crate) struct SimulateArgs {
    /// The scene: .toml.
    pub(crate) scene: PathBuf,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    /// Draw figures/*.svg: what the scene lists under `plot`, or energy, contacts, joints and heights.
    #[arg(long)]
    pub(crate) plot: bool,
    /// The instant at which the scene ends [s] [default: the scene's own].
    #[arg(long, value_name = "S", value_parser = above_zero)]
    pub(crate) duration: Option<f64>,
    /// Time step [s] [default: the scene's own].
    #[arg(long, value_name = "S", value_parser = above_zero)]
    pub(crate) step: Option<f64>,
    /// Save the state at the end.
    #[arg(long, value_name = "FILE")]
    pub(crate) save: Option<PathBuf>,
    /// Begin where a run with --save ended; the results go on with the row after its last.
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo info demo/input/walk.c3d

Knows recordings (.c3d), markers (.trc), skeletons (.bvh), models (.osim), tables (.mot, .sto, .csv) and external loads (.xml). Says what
is inside (rates, markers and their gaps, marker set, plates, events, subject), what was odd, and what to type next.")]
pub(crate) struct InfoArgs {
    /// The file.
    pub(crate) file: PathBuf,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo` and the example of `ambulo forces --help`):
  ambulo compare out/moments.sto demo/moments.sto --from 0.5 --to 2.5 --columns knee_angle_r_moment,ankle_angle_r_moment --limit 10

The instants of B inside the range are compared; A is read between its samples. Exit code 1 if --limit is exceeded.")]
pub(crate) struct CompareArgs {
    /// A table: .mot, .sto or .csv.
    pub(crate) a: PathBuf,
    /// The reference: .mot, .sto or .csv.
    pub(crate) b: PathBuf,
    /// Largest allowed root-mean-square difference of any column, in the columns' unit.
    #[arg(long, value_name = "X", value_parser = limit, allow_hyphen_values = true)]
    pub(crate) limit: Option<f64>,
    /// Columns to compare [default: all that both have].
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,
    /// First instant [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) from: Option<f64>,
    /// Last instant [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) to: Option<f64>,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example:
  ambulo reproduce -o paper

The paper: Faure, Debunne, Cani, Multon 1997, Dynamic analysis of human walking. Files written to DIR: report.html (all of it as a
page; `ambulo view DIR` opens it), claims.json (each claim with
the numbers found, whether it holds, and why), figures/figure1 to figure7 as .svg and .csv, muscles.csv (what net moments say
about muscles), torques.csv and torques.toml (torque curves as harmonics), assumptions.csv (what the paper does not give, and
what other values make of its claims). Results of an earlier run in DIR are removed. docs/REPRODUCTION.md describes them.

Exit code 0 whether or not claims hold, 2 if nothing could be computed.")]
pub(crate) struct ReproduceArgs {
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    /// Leave out the other values for what the paper does not give, which take most of the time.
    #[arg(long)]
    pub(crate) brief: bool,
    #[command(flatten)]
    pub(crate) voice: Voice,
}
