//! Options of `ambulo walk` and `ambulo demo`.

use super::forces::AngleConvention;
use super::values::{
    Loads, TimedValue, Values, kilograms, load, metres, number, outputs_of_demo, outputs_of_run, outputs_of_sweep,
    percent, weakness, whole_number,
};
use super::{CheckArgs, OUT, PrintArgs, ReplaceArgs, json};
use ambulo::job::Job;
use ambulo::job::json as text;
use ambulo::optimal::Load;
use ambulo::simulation::synthetic::SyntheticMode;
use clap::{Args as ClapArgs, ValueEnum};
use serde::Deserialize;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Example:
  ambulo demo -o demo

The same as `ambulo walk -o demo`. The walk is also written to DIR/input as a recording (C3D, TRC, BVH,
coordinates), which the examples of the other commands use (`ambulo forces --help`).")]
pub(crate) struct DemoArgs {
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = OUT)]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_demo())]
    #[serde(deserialize_with = "json::outputs_of_demo")]
    pub(crate) keep: Vec<String>,
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

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Examples:
  ambulo walk -o out
  ambulo walk --speed 1.0 --figure de-leva-female --mass 60 --height 1.65 -o out
  ambulo walk --gait goose --mode paper -o out
  ambulo walk --gait slow --states
  ambulo walk --slope 8 --load 15kg:back -o uphill

Modes (docs/WALKS.md says which mode to use when):
  optimal    3-D, near normative curves, no residual forces; usual figures and speeds are solved beforehand
  predict    3-D, minimises muscle effort, follows no recorded curves; slopes, loads, weak joints, devices
  corrected  sagittal plane (--planar), nearest motion to the gait without residual forces; any gait whose
             machines repeat in every cycle
  physical   3-D, by the figure's own torques along its optimal walk; it may fall
  paper      sagittal plane, exactly the curves of the gait, trunk held upright, rigid soles, as in the 1997 paper

The gaits standard, long, short and goose (a high step) are from the paper; parade is a step with straight
knees. Without --style they use style 1997 in the mode `paper` and style knots in the mode `corrected`.
If no motion near a gait is dynamically consistent, a warning reports it.

Two of --speed, --step-length and --cadence determine the third. With one of them, the others follow from the
usual relation of step length and cadence to speed (docs/GAITS.md, which also describes gait files). In both
cases the gait's own values are ignored.

Files written to DIR: kinematics.mot, moments.sto, powers.sto, reactions.sto, grf.mot, external_loads.xml,
events.csv, cycles.csv, clinical.csv, times_and_distances.csv, states.csv (states of the gait's machines),
summary.json, timings.json, report.html (open it with `ambulo view DIR`), figure.osim, figures/*.svg. The results of an
earlier run in DIR are replaced as a whole; other files stay. docs/OUTPUTS.md describes the files. --keep
writes only some of them; summary.json is always written.

The verdict states whether a person could make this motion (docs/JUDGEMENT.md). Exit code: 0 if results were
written, 2 if nothing could be computed; with --check, 1 if the data are bad or the motion is infeasible.")]
pub(crate) struct WalkArgs {
    #[command(flatten)]
    pub(crate) gait: GaitArgs,
    #[command(flatten)]
    pub(crate) figure: FigureArgs,
    #[command(flatten)]
    pub(crate) conditions: ConditionArgs,
    /// How the walk is computed [default: optimal for a steady gait with normative curves; corrected for other gaits
    /// that repeat; else paper].
    #[arg(long, value_enum)]
    pub(crate) mode: Option<WalkMode>,
    /// Walk in the sagittal plane: the same as `--mode corrected`.
    #[arg(long, conflicts_with = "mode")]
    #[serde(skip)]
    pub(crate) planar: bool,
    /// Reference of the pelvis and hip angles in clinical.csv and the report: `clinical`, the line through the iliac
    /// spines; `opensim`, the model's own axes.
    #[arg(long, value_enum, default_value_t = AngleConvention::default())]
    pub(crate) convention: AngleConvention,
    /// Replay torques without feedback, in the mode paper: a torques.toml of `ambulo reproduce` [--gait then defaults
    /// to standard].
    #[arg(long, value_name = "FILE")]
    pub(crate) torques: Option<PathBuf>,
    /// Whole gait cycles per foot, 1 to 1000.
    #[arg(long, value_name = "N", default_value_t = WalkArgs::CYCLES, allow_negative_numbers = true,
        value_parser = whole_number)]
    pub(crate) cycles: usize,
    /// Frame rate of the results, 20 to 5000 Hz.
    #[arg(long, value_name = "HZ", default_value_t = WalkArgs::RATE_HZ, allow_negative_numbers = true,
        value_parser = number)]
    pub(crate) rate: f64,
    /// Only print the state machines of the gait and each change of their states: time, machine, old and new state, and
    /// the condition that was true.
    #[arg(long)]
    pub(crate) states: bool,
    /// Limits of the feasibility checks: .toml (docs/JUDGEMENT.md) [default: built in].
    #[arg(long, value_name = "FILE")]
    pub(crate) thresholds: Option<PathBuf>,
    /// Folder for the results [default: out]; with --states, for the figure of the gait [default: none].
    #[arg(short, long, value_name = "DIR")]
    pub(crate) output: Option<PathBuf>,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_run())]
    #[serde(deserialize_with = "json::outputs_of_run")]
    pub(crate) keep: Vec<String>,
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

#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[command(after_help = "Examples:
  ambulo sweep --speed 0.8:1.6:0.2 --mass 60,80,100 -o sweep
  ambulo sweep --speed 1.2 --slope=-8,0,8 --load 0,15 -o hills

Each combination of the values is one walk in three dimensions, as `ambulo walk` computes it with these
options: near normative curves, or predicted if a slope, a load, a weak joint, a device or a free cadence is
given. LIST is numbers separated by commas, or FROM:TO:STEP. A walk takes some seconds; as many walks as there are
processors are computed at the same time.

Files written to DIR: sweep.csv (angle, rate, moment, power and ground force over the gait cycle of each foot
of each walk), walks.csv (one row per walk with the extremes of all quantities; walks that were not found, and
why), figures/*.svg, summary.json, report.html (envelopes over all walks; open it with `ambulo view DIR`).
docs/OUTPUTS.md describes the columns.

Exit code: 0 if a walk was found, 2 if none was; with --check, 1 if a walk was not found or is infeasible.")]
pub(crate) struct SweepArgs {
    /// Walking speeds [m/s] [default: free speed].
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::values::Written>"))]
    pub(crate) speed: Option<Values>,
    /// Body masses [kg] [default: 75, de-leva-female 60, faure-1997 80].
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::values::Written>"))]
    pub(crate) mass: Option<Values>,
    /// Statures [m] [default: 1.75, de-leva-female 1.65, faure-1997 1.80].
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::values::Written>"))]
    pub(crate) height: Option<Values>,
    /// Slopes of the ground [%], uphill is positive; implies predicted walks.
    #[arg(long, value_name = "LIST", allow_hyphen_values = true)]
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::values::Written>"))]
    pub(crate) slope: Option<Values>,
    /// Carried loads [kg]: on the back, half in each hand, or at the pelvis [default: back]; implies predicted walks.
    #[arg(long, value_name = "LIST[:back|hands|pelvis]", allow_hyphen_values = true)]
    #[cfg_attr(feature = "schema", schemars(with = "Option<super::values::Written>"))]
    pub(crate) load: Option<Loads>,
    /// Remaining share of a joint's strength in all walks, such as ankle=0.6; repeatable; implies predicted walks.
    #[arg(long, value_name = "JOINT=SHARE", value_parser = weakness)]
    #[serde(deserialize_with = "json::weaknesses")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub(crate) weak: Vec<(String, f64)>,
    /// Devices at joints in all walks, springs or given moments: .toml (docs/OPTIMAL.md); implies predicted walks.
    #[arg(long, value_name = "FILE")]
    pub(crate) device: Option<PathBuf>,
    /// Predict all walks: minimise muscle effort and follow no recorded curves.
    #[arg(long)]
    pub(crate) predict: bool,
    /// Choose cadence and step length of each walk too, for the least cost at its speed; implies predicted walks, takes
    /// about three times as long.
    #[arg(long)]
    pub(crate) free_cadence: bool,
    /// Table of segment masses: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = Job::SEGMENTS.name())]
    pub(crate) figure: String,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = OUT)]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_sweep())]
    #[serde(deserialize_with = "json::outputs_of_sweep")]
    pub(crate) keep: Vec<String>,
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

// The gait to synthesise.
#[derive(Debug, Clone, Default, ClapArgs, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct GaitArgs {
    /// Name of a gait (standard, long, short, goose, parade, slow, free, fast) or a gait file (docs/GAITS.md) [default:
    /// free].
    #[arg(long, value_name = "NAME|FILE.toml")]
    pub(crate) gait: Option<String>,
    /// Walking speed, 0.05 to 5 m/s, or 0 to stand until the first change [default: the gait's].
    #[arg(long, value_name = "M/S", allow_negative_numbers = true, value_parser = number)]
    pub(crate) speed: Option<f64>,
    /// Step length, foot strike to opposite foot strike, 0.02 to 3 m [default: the gait's].
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub(crate) step_length: Option<f64>,
    /// Steps per minute, 5 to 1000 [default: the gait's].
    #[arg(long, value_name = "STEPS/MIN", allow_negative_numbers = true, value_parser = number)]
    pub(crate) cadence: Option<f64>,
    /// Change the speed on the way: at TIME [s] to SPEED [m/s], 0 to stand still, within DURATION [s]; repeatable
    /// [default: two steps].
    #[arg(long, value_name = "TIME:SPEED[:DURATION]", allow_negative_numbers = true)]
    #[serde(deserialize_with = "text::each")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub(crate) speed_change: Vec<TimedValue>,
    /// Change the step length on the way, as with --speed-change [m].
    #[arg(long, value_name = "TIME:LENGTH[:DURATION]", allow_negative_numbers = true)]
    #[serde(deserialize_with = "text::each")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub(crate) step_length_change: Vec<TimedValue>,
    /// Change the cadence on the way, as with --speed-change [steps/min].
    #[arg(long, value_name = "TIME:CADENCE[:DURATION]", allow_negative_numbers = true)]
    #[serde(deserialize_with = "text::each")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub(crate) cadence_change: Vec<TimedValue>,
    /// Foot clearance as a multiple of the natural one, 0.1 to 10 [default: the gait's].
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, value_parser = number)]
    pub(crate) step_height: Option<f64>,
    /// How joint curves are interpolated between their knots: 1997 or knots [default: the gait's].
    #[arg(long, value_name = "1997|knots")]
    pub(crate) style: Option<String>,
}

// Conditions of a predicted walk.
#[derive(Debug, Clone, Default, PartialEq, ClapArgs, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct ConditionArgs {
    /// Slope of the ground, -40 to 40 percent; uphill is positive. This and the following options imply
    /// `--mode predict`.
    #[arg(long, value_name = "PERCENT", allow_negative_numbers = true, value_parser = percent)]
    pub(crate) slope: Option<f64>,
    /// Carried load: on the back, half in each hand, or at the pelvis [default: back].
    #[arg(long, value_name = "KG[:back|hands|pelvis]", allow_negative_numbers = true, value_parser = load)]
    #[serde(deserialize_with = "json::load")]
    #[cfg_attr(feature = "schema", schemars(with = "Option<text::TextOrNumber>"))]
    pub(crate) load: Option<Load>,
    /// Remaining share of a joint's strength, such as ankle=0.6 (both sides) or knee_r=0.5; repeatable.
    #[arg(long, value_name = "JOINT=SHARE", value_parser = weakness)]
    #[serde(deserialize_with = "json::weaknesses")]
    #[cfg_attr(feature = "schema", schemars(with = "Vec<String>"))]
    pub(crate) weak: Vec<(String, f64)>,
    /// Devices at joints, springs or given moments: .toml (docs/OPTIMAL.md); the results compare with the walk without
    /// them, which takes as long again.
    #[arg(long, value_name = "FILE")]
    pub(crate) device: Option<PathBuf>,
    /// Distance between the paths of both feet, 0 to 0.5 m [default: the one with the least muscle effort].
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = number)]
    pub(crate) step_width: Option<f64>,
    /// Let both sides move differently even if their conditions are the same.
    #[arg(long)]
    pub(crate) asymmetric: bool,
    /// Choose cadence and step length too, for the least cost at the speed; takes about three times as long.
    #[arg(long)]
    pub(crate) free_cadence: bool,
}

// The body that walks.
#[derive(Debug, Clone, ClapArgs, Deserialize)]
#[serde(default, deny_unknown_fields)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) struct FigureArgs {
    /// Table of segment masses: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = Job::SEGMENTS.name())]
    pub(crate) figure: String,
    /// Body mass [kg] [default: 75, de-leva-female 60, faure-1997 80].
    #[arg(long, value_name = "KG", allow_negative_numbers = true, value_parser = kilograms)]
    pub(crate) mass: Option<f64>,
    /// Stature [m] [default: 1.75, de-leva-female 1.65, faure-1997 1.80].
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = metres)]
    pub(crate) height: Option<f64>,
    /// Use feet of one segment, without a toe joint.
    #[arg(long)]
    pub(crate) no_toe_joint: bool,
}

impl WalkArgs {
    /// Whole gait cycles per foot, if none are given.
    const CYCLES: usize = 3;
    /// Frame rate of the results [Hz], if none is given.
    const RATE_HZ: f64 = 100.0;
}

impl Default for DemoArgs {
    fn default() -> DemoArgs {
        let (keep, replace, check, print) = Default::default();
        DemoArgs { output: OUT.into(), keep, replace, check, print }
    }
}

impl Default for WalkArgs {
    fn default() -> WalkArgs {
        let (replace, check, print) = Default::default();
        WalkArgs {
            gait: GaitArgs::default(),
            figure: FigureArgs::default(),
            conditions: ConditionArgs::default(),
            mode: None,
            planar: false,
            convention: AngleConvention::default(),
            torques: None,
            cycles: WalkArgs::CYCLES,
            rate: WalkArgs::RATE_HZ,
            states: false,
            thresholds: None,
            output: None,
            keep: Vec::new(),
            replace,
            check,
            print,
        }
    }
}

impl Default for SweepArgs {
    fn default() -> SweepArgs {
        let (speed, mass, height, slope) = Default::default();
        let (replace, check, print) = Default::default();
        SweepArgs {
            speed,
            mass,
            height,
            slope,
            load: None,
            weak: Vec::new(),
            device: None,
            predict: false,
            free_cadence: false,
            figure: Job::SEGMENTS.name().to_owned(),
            output: OUT.into(),
            keep: Vec::new(),
            replace,
            check,
            print,
        }
    }
}

impl Default for FigureArgs {
    fn default() -> FigureArgs {
        FigureArgs { figure: Job::SEGMENTS.name().to_owned(), mass: None, height: None, no_toe_joint: false }
    }
}

/// How a walk is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) enum WalkMode {
    /// 3-D walk on soft shoes, near normative curves.
    Optimal,
    /// Predicted: 3-D walk on soft shoes that minimises muscle effort; no recorded curves are used.
    Predict,
    /// Dynamically consistent walk in the sagittal plane, on soft shoes.
    Corrected,
    /// As in the 1997 paper: rigid soles, trunk held upright.
    Paper,
    /// 3-D walk by the figure's own torques along its optimal walk, on soft shoes; it may fall.
    Physical,
}

impl WalkMode {
    pub(crate) fn mode(self) -> SyntheticMode {
        match self {
            WalkMode::Optimal => SyntheticMode::Optimal,
            WalkMode::Predict => SyntheticMode::Predicted,
            WalkMode::Corrected => SyntheticMode::Corrected,
            WalkMode::Paper => SyntheticMode::Paper,
            WalkMode::Physical => SyntheticMode::Physical,
        }
    }
}
