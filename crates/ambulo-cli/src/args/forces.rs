//! `ambulo forces`: what may be typed.

use super::Voice;
use super::values::{CarriedMass, Cutoff, FootColumns, PlateFoot, order, seconds, zero_or_more_seconds};
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::study::Settings;
use clap::{Args as ClapArgs, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`, which writes these files):
  ambulo forces demo/input/walk.c3d --static demo/input/standing.c3d --mass 75 --height 1.75 -o out
  ambulo forces demo/input/walk.trc --model demo/input/figure.osim --loads demo/input/walk_grf.xml -o out
  ambulo forces demo/input/walk.mot --model demo/input/figure.osim -o out
  ambulo forces demo/input/walk.mot --model demo/input/figure.osim --grf demo/input/walk_grf.mot --right calcn_r:ground_force_r_ --left calcn_l:ground_force_l_ --cutoff 6 --force-cutoff off --from 0.5 -o out

Markers (.c3d, .trc) are fitted with the built-in body, calibrated from --static or, without one, from the trial itself, or with an
OpenSim model, which --static scales. Plates inside a C3D are used unless --grf is given. docs/MARKERS.md lists the marker names.
Without measured ground forces they are predicted from the motion; with --predict they are predicted and compared.

Files written to DIR: kinematics.mot, moments.sto, powers.sto, reactions.sto, grf.mot, external_loads.xml,
events.csv, cycles.csv, clinical.csv, times_and_distances.csv, summary.json, report.html (`ambulo view DIR` opens it), figures/*.svg, subject.osim (the body that was used);
with --device moments_biological.sto; with predicted forces grf_sd.mot and, with --predict beside plates, grf_measured.mot. Results of an earlier run in DIR are removed. docs/OUTPUTS.md describes them.

Exit code 0 if a person could do this, 1 if not (strength, joint ranges, power, friction, centre of pressure, sliding, flight,
forces that nothing supplies; docs/FEASIBILITY.md), 2 if nothing could be computed.")]
pub(crate) struct ForcesArgs {
    /// The recording: markers (.c3d, .trc), coordinates (.mot, .sto) or a skeleton (.bvh).
    pub(crate) input: PathBuf,
    /// The body: an OpenSim model (.osim); coordinates need one [default for markers and skeletons: the built-in body].
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) subject: SubjectArgs,
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
    /// Predict the ground forces from the motion even if they were measured, and compare [default where none were measured].
    #[arg(long, conflicts_with = "no_ground")]
    pub(crate) predict: bool,
    /// Compute without ground forces (a swinging leg, a flight); the whole weight then stands in the root's residual.
    #[arg(long, conflicts_with_all = ["grf", "loads"])]
    pub(crate) no_ground: bool,
    /// How clinical.csv and the page measure angles of pelvis and hips: clinical, from the line through the iliac spines; opensim, the model's own.
    #[arg(long, value_enum, default_value_t = AngleConvention::Clinical)]
    pub(crate) convention: AngleConvention,
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
    #[arg(long, value_name = "HZ|off", default_value_t = Cutoff(Some(Settings::LOW_PASS.cutoff_hz)), allow_hyphen_values = true)]
    pub(crate) cutoff: Cutoff,
    /// Low-pass of the measured forces [default: the same as the motion's; beside a prediction 20 Hz, order 2].
    #[arg(long, value_name = "HZ|off", allow_hyphen_values = true)]
    pub(crate) force_cutoff: Option<Cutoff>,
    /// Order of one pass of the Butterworth filters (1 to 8).
    #[arg(long, value_name = "N", default_value_t = Settings::LOW_PASS.order, value_parser = order)]
    pub(crate) order: usize,
    /// How the motion is smoothed; spline: quintic, stiffness by generalised cross-validation, --cutoff then goes for the forces only.
    #[arg(long, value_enum, default_value_t = Filter::Butterworth)]
    pub(crate) filter: Filter,
    /// Change the motion within its noise until it obeys the measured forces (docs/CONSISTENCY.md): `motion` alone, or with the `body`'s mass and the trunk's mass centre [without a value: body].
    #[arg(long, value_enum, value_name = "WHAT", num_args = 0..=1, require_equals = true, default_missing_value = "body", conflicts_with = "no_ground")]
    pub(crate) consistent: Option<Consistency>,
    /// What a worn device contributes: .sto or .csv with columns as in moments.sto; adds moments_biological.sto.
    #[arg(long, value_name = "FILE")]
    pub(crate) device: Option<PathBuf>,
    /// A point mass fixed to a body, place in the body's frame in metres; may be repeated.
    #[arg(long, value_name = "BODY:KG[:X,Y,Z]")]
    pub(crate) add_mass: Vec<CarriedMass>,
    /// What a person can do, by which the verdict is given: .toml (docs/FEASIBILITY.md) [default: built in].
    #[arg(long, value_name = "FILE")]
    pub(crate) thresholds: Option<PathBuf>,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) voice: Voice,
}

/// What may change to make motion and forces agree.
/// How angles of pelvis and hips are measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum)]
pub(crate) enum AngleConvention {
    #[default]
    Clinical,
    Opensim,
}

impl From<AngleConvention> for ambulo_results::Convention {
    fn from(convention: AngleConvention) -> Self {
        match convention {
            AngleConvention::Clinical => Self::Clinical,
            AngleConvention::Opensim => Self::Opensim,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Consistency {
    /// The motion alone.
    Motion,
    /// The motion, the body's mass and the trunk's mass centre.
    Body,
}

/// A filter family.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum Filter {
    /// Zero-phase low-pass.
    Butterworth,
    /// Smoothing spline.
    Spline,
}

/// Who was recorded, and how markers are read.
#[derive(Debug, ClapArgs)]
pub(crate) struct SubjectArgs {
    /// Markers of the same person standing still: .c3d or .trc.
    #[arg(long = "static", value_name = "FILE")]
    pub(crate) still: Option<PathBuf>,
    /// Body mass [kg]; a standing trial on plates that comes within 5 % of it is believed instead [default: what the plates carry or the
    /// recording states; with --model the model's own].
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    pub(crate) mass: Option<f64>,
    /// Stature [m] [default: what the recording states, or an estimate from the markers].
    #[arg(long, value_name = "M", allow_negative_numbers = true)]
    pub(crate) height: Option<f64>,
    /// Table of body segments of the built-in body: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = SubjectArgs::USUAL_FIGURE)]
    pub(crate) figure: String,
    /// The marker set: a name of docs/MARKERS.md or a .toml [default: the one whose names are found].
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) markers: Option<String>,
    /// Which foot stands on a plate of the C3D, such as 1=r; `off` leaves a plate out; may be repeated [default: found].
    #[arg(long, value_name = "N=r|l|off")]
    pub(crate) plate: Vec<PlateFoot>,
    /// How markers become coordinates: frame by frame, or all frames together with a prior on acceleration.
    #[arg(long, value_enum, default_value_t = MarkerFitting::Frames)]
    pub(crate) fit: MarkerFitting,
    /// Gaps of markers up to this long are bridged [s]; longer ones stay gaps.
    #[arg(long, value_name = "S", default_value_t = FitSettings::default().longest_gap_s, value_parser = zero_or_more_seconds, allow_negative_numbers = true)]
    pub(crate) max_gap: f64,
}

impl SubjectArgs {
    pub(crate) const USUAL_FIGURE: &'static str = "de-leva-male";
}

/// How markers become coordinates.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(crate) enum MarkerFitting {
    /// Each frame by itself.
    Frames,
    /// All frames together.
    Trajectory,
}
