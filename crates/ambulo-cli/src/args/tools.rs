//! Options of `ambulo simulate`, `info`, `compare` and `reproduce`.

use super::values::{above_zero, limit, outputs_of_paper, outputs_of_scene, seconds};
use super::{CheckArgs, PrintArgs, ReplaceArgs};
use clap::Args as ClapArgs;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs)]
#[command(after_help = "Example (in the source folder, which contains examples/):
  ambulo simulate examples/pendulum.toml -o out
  ambulo simulate examples/pile.toml --keep report,energy -o out

Files written to DIR: poses.csv, joints.csv, reactions.csv, contacts.csv, closures.csv, energy.csv, shapes.json, summary.json, report.html
(open it with `ambulo view DIR`); moments.sto if the scene has figures; figures/*.svg (the quantities under `plot` in the
scene, or else energy, contacts, joints and heights). Files that would be empty are not written; --keep writes only some of them. The results of an earlier run in DIR are replaced as a whole; other files stay. docs/SCENES.md describes scene files,
docs/OUTPUTS.md the results.")]
pub(crate) struct SimulateArgs {
    /// The scene (.toml).
    pub(crate) scene: PathBuf,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_scene())]
    pub(crate) keep: Vec<String>,
    /// Time at which the simulation ends [s] [default: as in the scene].
    #[arg(long, value_name = "S", value_parser = above_zero)]
    pub(crate) duration: Option<f64>,
    /// Time step [s] [default: as in the scene].
    #[arg(long, value_name = "S", value_parser = above_zero)]
    pub(crate) step: Option<f64>,
    /// Save the final state to a file; an existing one is only overwritten with --force.
    #[arg(long, value_name = "FILE")]
    pub(crate) save: Option<PathBuf>,
    /// Continue from a state that --save wrote; the results begin with the row after its last one.
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) check: CheckArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo info demo/input/walk.c3d
  ambulo info demo/input/walk.c3d --markers mine.toml

Reads recordings (.c3d), markers (.trc), skeletons (.bvh), models (.osim), tables (.mot, .sto, .csv) and external loads (.xml). Lists the
content (rates, markers and their gaps, marker set, poses of segments, force plates, events, subject), problems, and a command to try next.")]
pub(crate) struct InfoArgs {
    /// The file.
    pub(crate) file: PathBuf,
    /// Write the markers of the file with their meaning as a marker set, for `ambulo forces --markers FILE`: recognised by name, or proposed by where they sit on the body; an existing file is only overwritten with --force.
    #[arg(long, value_name = "FILE.toml")]
    pub(crate) markers: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo` and the example of `ambulo forces --help`):
  ambulo compare out/moments.sto demo/moments.sto --from 0.5 --to 2.5 --columns knee_angle_r_moment,ankle_angle_r_moment --limit 10

A is interpolated at the times of B in the range. Exit code 1 if --limit is exceeded.")]
pub(crate) struct CompareArgs {
    /// A table: .mot, .sto or .csv.
    pub(crate) a: PathBuf,
    /// The reference: .mot, .sto or .csv.
    pub(crate) b: PathBuf,
    /// Largest allowed root-mean-square difference of any column, in the columns' unit.
    #[arg(long, value_name = "X", value_parser = limit, allow_hyphen_values = true)]
    pub(crate) limit: Option<f64>,
    /// Columns to compare [default: all common columns].
    #[arg(long, value_name = "NAME,...", value_delimiter = ',')]
    pub(crate) columns: Vec<String>,
    /// Start of the compared time range [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) from: Option<f64>,
    /// End of the compared time range [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) to: Option<f64>,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example:
  ambulo reproduce -o paper

The paper: Faure, Debunne, Cani, Multon 1997, Dynamic analysis of human walking. Files written to DIR: report.html (all results on one
page; open it with `ambulo view DIR`), claims.json (each claim with the numbers computed, whether it holds, and why), figures/figure1 to
figure7 as .svg and .csv, muscles.csv (what net moments imply about muscles), torques.csv and torques.toml (torque curves as harmonics),
assumptions.csv (values that the paper does not give, and how other values change its claims). The results of an earlier run in DIR are
replaced as a whole; other files stay. --keep writes only some of the files. docs/REPRODUCTION.md describes them.

Exit code: 0 whether or not claims hold, 2 if nothing could be computed.")]
pub(crate) struct ReproduceArgs {
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_paper())]
    pub(crate) keep: Vec<String>,
    /// Skip the sensitivity to values that the paper does not give, which takes most of the time.
    #[arg(long)]
    pub(crate) brief: bool,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}
