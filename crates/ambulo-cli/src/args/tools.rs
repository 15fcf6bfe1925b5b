//! Options of `ambulo simulate`, `tune`, `info`, `compare` and `reproduce`.

use super::values::{above_zero, force, jobs, limit, outputs_of_paper, outputs_of_scene, seconds};
use super::{CheckArgs, OUT, PrintArgs, ReplaceArgs, json, out};
use clap::Args as ClapArgs;
use serde::Deserialize;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Example (in the source folder, which contains examples/):
  ambulo simulate examples/pendulum.toml -o out
  ambulo simulate examples/pile.toml --keep report,energy -o out

Files written to DIR: poses.csv, joints.csv, reactions.csv, contacts.csv, closures.csv, energy.csv, shapes.json,
summary.json, timings.json, report.html (open it with `ambulo view DIR`); moments.sto if the scene has figures; figures/*.svg
(the quantities under `plot` in the scene, or else energy, contacts, joints and heights). Files that would be
empty are not written; --keep writes only some of them. The results of an earlier run in DIR are replaced as a
whole; other files stay. docs/SCENES.md describes scene files, docs/OUTPUTS.md the results.")]
pub(crate) struct SimulateArgs {
    /// The scene (.toml).
    pub(crate) scene: PathBuf,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = OUT)]
    #[serde(default = "out")]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_scene())]
    #[serde(default, deserialize_with = "json::outputs_of_scene")]
    pub(crate) keep: Vec<String>,
    /// Time at which the simulation ends [s] [default: as in the scene].
    #[arg(long, value_name = "S", value_parser = above_zero)]
    #[serde(default, deserialize_with = "json::duration_s")]
    pub(crate) duration: Option<f64>,
    /// Time step [s] [default: as in the scene].
    #[arg(long, value_name = "S", value_parser = above_zero)]
    #[serde(default, deserialize_with = "json::duration_s")]
    pub(crate) step: Option<f64>,
    /// Save the final state to a file; an existing one is only overwritten with --force.
    #[arg(long, value_name = "FILE")]
    pub(crate) save: Option<PathBuf>,
    /// Continue from a state that --save wrote; the results begin with the row after its last one.
    #[arg(long, value_name = "FILE")]
    pub(crate) resume: Option<PathBuf>,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) check: CheckArgs,
    #[serde(skip)]
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (in the source folder, which contains examples/):
  ambulo tune examples/pushed-walker.toml -o tuned.toml

The figure walks alone on level ground and is pushed at the trunk for 0.2 s: forward and backward, or from all
sides if it has three dimensions. CMA-ES changes the gains. The cost counts falls, the deviation from the plan,
effort and speed. Three different sets of pushes, drawn from --seed, compare the candidates, choose the result
and make the report. Gains that are not better than the gains of the scene are not chosen.
docs/PHYSICAL_WALK.md has the formula.

Files written after every generation: FILE with the key `control` to paste into the scene, and FILE with the
extension .state.json for --resume. A stopped run loses at most one generation. The result depends on all
options but --jobs.

Gains: stiffness, damping, angle_deg, rate_deg, pelvis_deg, height, sideways, velocity, velocity_up, torque, as
in docs/SCENES.md.")]
pub(crate) struct TuneArgs {
    /// The scene (.toml), with a figure that has the key `control`.
    pub(crate) scene: PathBuf,
    /// File for the tuned gains; an existing one is only overwritten with --force or --resume.
    #[arg(short, long, value_name = "FILE.toml", default_value = "tuned.toml")]
    pub(crate) output: PathBuf,
    /// Name of the figure [default: the first one with `control`].
    #[arg(long, value_name = "NAME")]
    pub(crate) figure: Option<String>,
    /// Gains to tune, separated by commas [default: all but torque; in the plane also without sideways].
    #[arg(long, value_name = "LIST", value_delimiter = ',')]
    pub(crate) gains: Vec<String>,
    /// Number of evaluations; a generation that would exceed it is not started.
    #[arg(long, value_name = "N", default_value_t = 330, value_parser = clap::value_parser!(u32).range(0..=1_000_000))]
    pub(crate) evaluations: u32,
    /// Seed of the search and of its pushes.
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub(crate) seed: u32,
    /// Largest force of the pushes for a body of 75 kg [N]; it grows with the mass of the figure.
    #[arg(long, value_name = "N", default_value_t = 300.0, value_parser = force)]
    pub(crate) push: f64,
    /// Number of pushes per candidate; the choice of the result has three times as many, the report nine times.
    #[arg(long, value_name = "N", default_value_t = 24, value_parser = clap::value_parser!(u32).range(1..=1000))]
    pub(crate) pushes: u32,
    /// Candidates that are tried at the same time [default: the number of processors].
    #[arg(long, value_name = "N", value_parser = jobs)]
    pub(crate) jobs: Option<u32>,
    /// Continue a run of the same scene and options that was stopped, or one with fewer evaluations.
    #[arg(long)]
    pub(crate) resume: bool,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`):
  ambulo info demo/input/walk.c3d
  ambulo info demo/input/walk.c3d --markers mine.toml

Reads recordings (.c3d), markers (.trc), skeletons (.bvh), models (.osim), tables (.mot, .sto, .csv) and external
loads (.xml). Lists the content (rates, markers and their gaps, marker set, poses of segments, force plates,
events, subject), problems, and a command to try next.")]
pub(crate) struct InfoArgs {
    /// The file.
    pub(crate) file: PathBuf,
    /// Write the markers of the file and their meaning as a marker set for `ambulo forces --markers FILE`: recognised
    /// by name, or proposed by position; an existing file is only overwritten with --force.
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
  ambulo reproduce --write-setting own.toml
  ambulo reproduce --setting own.toml -o own
  ambulo reproduce --setting schwartz-children --brief --check -o children

The paper: Faure, Debunne, Cani, Multon 1997, Dynamic analysis of human walking. Files written to DIR:
report.html (all results on one page; open it with `ambulo view DIR`), claims.json (each claim with its numbers
and judgement), figures/figure1 to figure7 as .svg and .csv, paper_muscles.csv (what net moments imply about muscles),
torques.csv and torques.toml (torque curves as harmonics), assumptions.csv (values that the paper does not give,
and how other values change its claims), setting.toml (these values as a file for --setting). The results of an earlier run in DIR are replaced as a whole; other
files stay. --keep writes only some of the files. docs/REPRODUCTION.md describes them.

A setting has a value for everything that the paper does not give: size of the figure, steps, soles, and the time and
angle of every bound of the joint curves. papers-results (default) and schwartz-children come with the program and
are in examples/paper/.

Exit code: 0 whether or not claims hold; 1 with --check if a claim that the setting lists under `holds` does not
hold; 2 if nothing could be computed.")]
pub(crate) struct ReproduceArgs {
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = OUT)]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_paper())]
    pub(crate) keep: Vec<String>,
    /// Skip the sensitivity to values that the paper does not give, which takes half of the time.
    #[arg(long)]
    pub(crate) brief: bool,
    /// Values that the paper does not give: a file (.toml), papers-results or schwartz-children [default:
    /// papers-results]. A file may leave out values, which then are those of papers-results.
    #[arg(long, value_name = "FILE")]
    pub(crate) setting: Option<PathBuf>,
    /// Write all values of the setting to a file, with range, source and reason of each, and compute nothing.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["check", "brief", "keep", "output"])]
    pub(crate) write_setting: Option<PathBuf>,
    /// Fail (exit code 1) if a claim that the setting lists under `holds` does not hold.
    #[arg(long)]
    pub(crate) check: bool,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}
