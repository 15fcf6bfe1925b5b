//! What the user may type.

use ambulo::simulation::synthetic::Mode;
use ambulo::spatial::Vec3;
use clap::{Args as ClapArgs, Parser, Subcommand, ValueEnum};
use std::fmt;
use std::path::PathBuf;
use std::str::FromStr;

/// Forces behind human walking: motion in, forces out.
#[derive(Debug, Parser)]
#[command(version, about)]
pub(crate) struct Args {
    #[command(subcommand)]
    pub(crate) command: Option<Command>,
}

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    /// A recording in, joint moments, powers, reactions and ground forces out.
    Forces(Box<ForcesArgs>),
    /// A figure that walks, at any speed and in any style: the same outputs as `forces`, no file needed.
    Walk(Box<WalkArgs>),
    /// The main job without any input: a free walk and the forces behind it.
    Demo(DemoArgs),
    /// A scene file stepped through time: poses, joint efforts, contact forces, energies.
    Simulate(SimulateArgs),
    /// Every figure and claim of the 1997 paper, recomputed.
    Reproduce(ReproduceArgs),
    /// What a file holds.
    Info(InfoArgs),
    /// How far two tables agree, column by column.
    Compare(CompareArgs),
}

/// How much a command says, and in which form.
#[derive(Debug, Clone, Copy, ClapArgs)]
pub(crate) struct Voice {
    /// Print JSON on standard output instead of text.
    #[arg(long)]
    pub(crate) json: bool,
    /// Print nothing but errors.
    #[arg(long, conflicts_with = "json")]
    pub(crate) quiet: bool,
}

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
summary.json, figure.osim, figures/moments.svg, figures/gait.svg. Results of an earlier run in DIR are removed. docs/OUTPUTS.md
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
    pub(crate) fn mode(self) -> Mode {
        match self {
            WalkMode::Corrected => Mode::Corrected,
            WalkMode::Paper => Mode::Paper,
        }
    }
}

#[derive(Debug, ClapArgs)]
#[command(after_help = "Example (in the folder of the source, which holds examples/):
  ambulo simulate examples/pendulum.toml --plot -o out

Files written to DIR: poses.csv, joints.csv, reactions.csv, contacts.csv, closures.csv, energy.csv, summary.json, with
figures moments.sto, with --plot figures/*.svg; those that the scene has nothing for are left out. Results of an earlier
run in DIR are removed. docs/SCENES.md describes scene files, docs/OUTPUTS.md the results.")]
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
  ambulo info demo/input/figure.osim

Knows .osim models, .mot/.sto tables, .csv tables, .trc markers and external-loads .xml.")]
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

The paper: Faure, Debunne, Cani, Multon 1997, Dynamic analysis of human walking. Files written to DIR: claims.json (each claim with
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

fn order(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(order @ 1..=8) => Ok(order),
        _ => Err("expected a whole number from 1 to 8".into()),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() => Ok(seconds),
        _ => Err("expected a number of seconds".into()),
    }
}

fn above_zero(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds.is_finite() && seconds > 0.0 => Ok(seconds),
        _ => Err("expected a number of seconds above 0".into()),
    }
}

fn limit(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(limit) if limit.is_finite() && limit >= 0.0 => Ok(limit),
        _ => Err("expected a number, zero or more".into()),
    }
}

/// A filter family.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Filter {
    /// Zero-phase low-pass.
    Butterworth,
    /// Smoothing spline.
    Spline,
}

/// A cut-off frequency, or none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Cutoff(pub(crate) Option<f64>);

impl FromStr for Cutoff {
    type Err = String;
    fn from_str(text: &str) -> Result<Cutoff, String> {
        if text.eq_ignore_ascii_case("off") {
            return Ok(Cutoff(None));
        }
        match text.parse::<f64>() {
            Ok(hz) if hz.is_finite() && hz > 0.0 => Ok(Cutoff(Some(hz))),
            _ => Err("expected a frequency above 0 in Hz, or `off`".into()),
        }
    }
}

/// A body and the prefix of the columns that act on it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct FootColumns {
    pub(crate) body: String,
    pub(crate) prefix: String,
}

impl FromStr for FootColumns {
    type Err = String;
    fn from_str(text: &str) -> Result<FootColumns, String> {
        match text.split_once(':') {
            Some((body, prefix)) if !body.is_empty() && prefix.contains("force") => {
                Ok(FootColumns { body: body.to_owned(), prefix: prefix.to_owned() })
            }
            _ => Err(
                "expected BODY:PREFIX with `force` in the prefix, such as calcn_r:ground_force_r_; its columns are \
                      PREFIX + vx vy vz and px py pz, and the torque's have `torque` for `force`"
                    .into(),
            ),
        }
    }
}

/// A mass that the subject carries.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct AddedMass {
    pub(crate) body: String,
    pub(crate) mass_kg: f64,
    pub(crate) place_m: Vec3,
}

impl fmt::Display for AddedMass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z]: [f64; 3] = self.place_m.into();
        write!(f, "{}:{}:{x},{y},{z}", self.body, self.mass_kg)
    }
}

impl FromStr for AddedMass {
    type Err = String;
    fn from_str(text: &str) -> Result<AddedMass, String> {
        let expected = || "expected BODY:KG or BODY:KG:X,Y,Z, such as torso:2.5:-0.1,0.3,0".to_owned();
        let mut parts = text.split(':');
        let (body, mass) = (parts.next().unwrap_or_default(), parts.next().ok_or_else(expected)?);
        let mass_kg = mass.trim().parse().map_err(|_| expected())?;
        let place: Vec<f64> = match parts.next() {
            None => vec![0.0; 3],
            Some(place) => {
                place.split(',').map(|x| x.trim().parse()).collect::<Result<_, _>>().map_err(|_| expected())?
            }
        };
        match (place[..].try_into(), parts.next()) {
            (Ok::<[f64; 3], _>(place), None) if !body.is_empty() => {
                Ok(AddedMass { body: body.to_owned(), mass_kg, place_m: Vec3::from(place) })
            }
            _ => Err(expected()),
        }
    }
}
