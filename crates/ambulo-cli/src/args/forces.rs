//! Options of `ambulo forces`.

use super::muscles::MuscleArgs;
use super::values::{
    kilograms, metres, number, one_of, order, outputs_of_run, seconds, segments, zero_or_more_seconds,
};
use super::{CheckArgs, Handling, OUT, PrintArgs, ReplaceArgs};
use crate::request::{CalibrateRequest, ForcesRequest};
use ambulo::analysis::Adjustable;
use ambulo::job::{
    Cutoff, EarthTurn, Filter, FootColumns, ForceCutoff, ForceFiles, HeadingAxis, Job, MarkerFitting, ModelChoice,
    PlateFoot, Processing, SensorStatements,
};
use ambulo::kinematics::calibration::{HipRegression, KneeAxis};
use ambulo::kinematics::marker_fit::FitSettings;
use ambulo::model::anthropometry::SegmentTable;
use ambulo::motion::Window;
use ambulo::study::{AddedMass, GroundSettings, Settings, StatedSize};
use ambulo_results::Convention;
use clap::{Args as ClapArgs, ValueEnum};
use serde::Deserialize;
use std::path::PathBuf;

#[derive(Debug, Clone, ClapArgs)]
#[command(after_help = "Examples (after `ambulo demo -o demo`, which writes these files):
  ambulo forces demo/input/walk.c3d --static demo/input/standing.c3d --mass 75 --height 1.75 -o out
  ambulo forces demo/input/walk.trc --model demo/input/figure.osim --loads demo/input/walk_grf.xml -o out
  ambulo forces demo/input/walk.mot --model demo/input/figure.osim -o out
  ambulo forces demo/input/walk.mot --model demo/input/figure.osim --grf demo/input/walk_grf.mot --right calcn_r:ground_force_r_ --left calcn_l:ground_force_l_ --cutoff 6 --force-cutoff off --from 0.5 -o out
  ambulo forces --setup Setup_Scale.xml --setup Setup_IK.xml --setup Setup_InverseDynamics.xml -o out

Markers (.c3d, .trc) are fitted with the built-in body or with an OpenSim model. The built-in body is calibrated
from --static, or from the trial itself; a model is scaled by --static. Poses of segments in a .c3d (Theia3D) or
a .mvnx (Xsens) drive the built-in body directly. A .sto with quaternions (OpenSense) drives a model, or the
built-in body of --mass and --height; --static is then a .sto of the person standing. A .b3d has its own model
and coordinates; with --model its markers are fitted instead. Force plates in a C3D are used unless --grf is
given. docs/MARKERS.md lists the marker names. If ground forces were not measured, they are predicted from the
motion, also for single steps alongside the plates (stances.csv lists them); with --predict, the prediction is
compared with the measurement. With --track, motion and forces agree to rounding, without force plates.

Files written to DIR: kinematics.mot, moments.sto, powers.sto, reactions.sto, grf.mot, external_loads.xml,
events.csv, stances.csv, foot_contact.sto, cycles.csv, clinical.csv, times_and_distances.csv, summary.json,
timings.json, report.html (open it with `ambulo view DIR`), figures/*.svg, subject.osim (the body used); with --muscles
muscles.sto, reactions_contact.sto and, from electromyograms, emg.sto; with --device moments_biological.sto;
with --consistent or --track kinematics_recorded.mot; with predicted forces grf_sd.mot; with --predict or --track
and force plates grf_measured.mot. The results of an earlier run in DIR are replaced as a whole; other files stay.
docs/OUTPUTS.md describes the files. --keep writes only some of them; summary.json is always written.

The verdict states whether a person could make this motion (strength, joint ranges, power, friction, centre of
pressure, sliding, flight, residual forces; docs/JUDGEMENT.md). Exit code: 0 if results were written, 2 if
nothing could be computed; with --check, 1 if the data are bad or the motion is infeasible.")]
pub(crate) struct ForcesArgs {
    /// The recording: markers (.c3d, .trc, .csv with three columns per marker, _motion.tsv of BIDS), poses of segments
    /// (.c3d, .mvnx), coordinates (.mot, .sto, _motion.tsv), orientations of sensors (.sto with quaternions), a
    /// skeleton (.bvh), a motion of the SMPL family (.npz) or a subject of AddBiomechanics (.b3d).
    #[arg(required_unless_present = "setup")]
    pub(crate) input: Option<PathBuf>,
    /// Set-up of OpenSim's ScaleTool, InverseKinematicsTool, InverseDynamicsTool, IMUPlacer or IMUInverseKinematicsTool
    /// (.xml), with files and settings; may be given once per tool, all in one run (docs/OPENSIM.md).
    #[arg(long, value_name = "FILE")]
    pub(crate) setup: Vec<PathBuf>,
    /// The body as an OpenSim model (.osim), or `built-in`; required for coordinates [default for markers, sensors and
    /// skeletons: the built-in body; for a .b3d: its own model].
    #[arg(long, value_name = "FILE|built-in")]
    pub(crate) model: Option<PathBuf>,
    /// The trial of a .b3d: its number or name as `ambulo info` lists them, or `all` for a result folder in DIR for
    /// each [default: the only one].
    #[arg(long, value_name = "N|NAME|all")]
    pub(crate) trial: Option<String>,
    /// The SMPL, SMPL-H or SMPL-X model (.npz) that a motion was made with; it gives the lengths of the body [default:
    /// the built-in body of --height].
    #[arg(long, value_name = "FILE")]
    pub(crate) smpl: Option<PathBuf>,
    #[command(flatten)]
    pub(crate) subject: SubjectArgs,
    #[command(flatten)]
    pub(crate) sensors: SensorArgs,
    /// Measured ground forces: .mot, .sto or .csv [default: the file named in --loads]. Columns are recognised by their
    /// names, and loads without a side are assigned by the centre of pressure, unless --loads or --right and --left are
    /// given.
    #[arg(long, value_name = "FILE")]
    pub(crate) grf: Option<PathBuf>,
    /// OpenSim external loads (.xml): which columns act on which body.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["right", "left"])]
    pub(crate) loads: Option<PathBuf>,
    /// Body and column prefix of the right foot, such as calcn_r:ground_force_
    #[arg(long, value_name = "BODY:PREFIX", requires = "grf")]
    pub(crate) right: Option<FootColumns>,
    /// Body and column prefix of the left foot, such as calcn_l:1_ground_force_
    #[arg(long, value_name = "BODY:PREFIX", requires = "grf")]
    pub(crate) left: Option<FootColumns>,
    /// Predict the ground forces from the motion even if they were measured, and compare both [default without measured
    /// forces].
    #[arg(long, conflicts_with = "no_ground")]
    pub(crate) predict: bool,
    /// Predict the ground forces as with --predict, corrected by the calibration of this person (.toml, written by
    /// `ambulo calibrate`).
    #[arg(long, value_name = "FILE", conflicts_with = "no_ground")]
    pub(crate) person: Option<PathBuf>,
    /// Track: find the motion nearest to the recording whose external forces come from feet on soft ground alone
    /// (docs/OPTIMAL.md). Measured forces are only compared with the result.
    #[arg(long, conflicts_with_all = ["no_ground", "predict", "consistent"])]
    pub(crate) track: bool,
    /// Change the motion as little as needed so that loaded feet do not slide, before forces are computed
    /// (docs/GROUND_FORCES.md); a note reports the improvement.
    #[arg(long, conflicts_with = "no_ground")]
    pub(crate) refit: bool,
    /// Compute without ground forces (a swinging leg, a flight); the residual force at the root then contains the whole
    /// weight.
    #[arg(long, conflicts_with_all = ["grf", "loads"])]
    pub(crate) no_ground: bool,
    /// Reference of the pelvis and hip angles in clinical.csv and the report: `clinical`, the line through the iliac
    /// spines; `opensim`, the model's own axes.
    #[arg(long, value_enum, default_value_t = AngleConvention::Clinical)]
    pub(crate) convention: AngleConvention,
    /// Start of the analysed time range [s]. With force plates, markers are fitted from one second before it on.
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) from: Option<f64>,
    /// End of the analysed time range [s].
    #[arg(long, value_name = "T", allow_negative_numbers = true, value_parser = seconds)]
    pub(crate) to: Option<f64>,
    /// Frame rate of the results [default: as recorded].
    #[arg(long, value_name = "HZ", allow_negative_numbers = true, value_parser = number)]
    pub(crate) rate: Option<f64>,
    /// Low-pass filter of the motion: cut-off in Hz (0.1 to half the frame rate) of one pass of the zero-phase
    /// Butterworth filter, or off [default: 6, or as in --setup].
    #[arg(long, value_name = "HZ|off", allow_hyphen_values = true)]
    pub(crate) cutoff: Option<Cutoff>,
    /// Low-pass filter of the measured forces: cut-off in Hz, `same` for the filter of the motion, or off [default: 25
    /// Hz for walking; the motion's, at least 8 Hz, for running and landing; off with --cutoff off; 20 Hz, order 2,
    /// when compared with a prediction; off with a --setup of inverse dynamics].
    #[arg(long, value_name = "same|HZ|off", allow_hyphen_values = true)]
    pub(crate) force_cutoff: Option<ForceCutoff>,
    /// Order of one pass of the Butterworth filters (1 to 8).
    #[arg(long, value_name = "N", default_value_t = Settings::LOW_PASS.order, value_parser = order)]
    pub(crate) order: usize,
    /// How the motion is smoothed. `spline`: quintic, stiffness by generalised cross-validation; --cutoff then applies
    /// only to forces with --force-cutoff same.
    #[arg(long, value_name = "FILTER", default_value = "butterworth", value_parser = one_of(&Filter::ALL))]
    pub(crate) filter: Filter,
    /// Residual reduction: change the motion within its noise until it agrees with the measured forces
    /// (docs/CONSISTENCY.md). `motion`: the motion only; `body`: also the body mass and the mass centre of the trunk
    /// [without a value: body].
    #[arg(long, value_name = "WHAT", value_parser = one_of(&Adjustable::ALL), num_args = 0..=1, require_equals = true,
        default_missing_value = "body", conflicts_with = "no_ground")]
    pub(crate) consistent: Option<Adjustable>,
    /// Joint moments of a worn device: .sto or .csv with columns as in moments.sto; adds moments_biological.sto.
    #[arg(long, value_name = "FILE")]
    pub(crate) device: Option<PathBuf>,
    /// A point mass fixed to a body, with its position in the body's frame in metres; may be repeated.
    #[arg(long, value_name = "BODY:KG[:X,Y,Z]")]
    pub(crate) add_mass: Vec<AddedMass>,
    #[command(flatten)]
    pub(crate) muscles: MuscleArgs,
    /// Limits of the feasibility checks: .toml (docs/JUDGEMENT.md) [default: built in].
    #[arg(long, value_name = "FILE")]
    pub(crate) thresholds: Option<PathBuf>,
    /// Folder for the results.
    #[arg(short, long, value_name = "DIR", default_value = OUT)]
    pub(crate) output: PathBuf,
    /// Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all].
    #[arg(long, value_name = "LIST", value_delimiter = ',', value_parser = outputs_of_run())]
    pub(crate) keep: Vec<String>,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) check: CheckArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

/// Settings of the files that a run writes.
#[derive(Debug, Clone, Default)]
pub struct Outputs {
    /// How angles of pelvis and hips are measured.
    pub convention: Convention,
    /// Names of the outputs; all if there are none.
    pub keep: Vec<String>,
}

impl ForcesArgs {
    /// The request that the options describe.
    pub(crate) fn request(&self) -> ForcesRequest {
        let (convention, keep, output) = (self.convention.into(), self.keep.clone(), self.output.clone());
        ForcesRequest { job: self.job(), convention, keep, output }
    }

    /// How it is handled.
    pub(crate) fn handling(&self) -> Handling {
        Handling { replace: self.replace, check: self.check, print: self.print }
    }

    fn job(&self) -> Job {
        let args = self.clone();
        Job {
            recording: args.input,
            trial: args.trial,
            model: args.model.map(ModelChoice::from),
            smpl: args.smpl,
            sensors: SensorStatements { heading: args.sensors.heading, earth: args.sensors.earth },
            forces: ForceFiles { table: args.grf, loads: args.loads, right: args.right, left: args.left },
            person: args.person,
            device: args.device,
            added_mass: args.add_mass,
            muscles: args.muscles.statements(),
            thresholds: args.thresholds,
            setups: args.setup,
            settings: self.settings(),
            ..args.subject.job()
        }
    }

    fn settings(&self) -> Processing {
        Processing {
            ground: match (self.no_ground, self.track, self.predict) {
                (true, ..) => GroundSettings::NoContact,
                (_, true, _) => GroundSettings::Tracked,
                (_, _, true) => GroundSettings::Predicted,
                _ => GroundSettings::MeasuredOrPredicted,
            },
            refit: self.refit,
            window: Window { from_s: self.from, to_s: self.to },
            rate_hz: self.rate,
            filter: self.filter,
            cutoff: self.cutoff,
            force_cutoff: self.force_cutoff,
            order: self.order,
            residual_reduction: self.consistent,
            ..self.subject.settings()
        }
    }
}

// Options of `ambulo calibrate`.
#[derive(Debug, Clone, ClapArgs)]
#[command(after_help = "Example (after `ambulo demo -o demo`, which writes these files):
  ambulo calibrate demo/input/walk.c3d --static demo/input/standing.c3d --mass 75 --height 1.75 -o person.toml
  ambulo forces demo/input/walk.c3d --static demo/input/standing.c3d --mass 75 --height 1.75 --person person.toml -o out

Errors of predicted ground forces are similar in all trials of a person. The trials show one person walking
over force plates, each foot on a separate plate: files that `forces` takes, with the plates inside, or with a
table of forces for each (--grf or --loads, once per trial and in the same order). They are predicted and compared with the plates. FILE has the
mean difference over the stance for each foot, and the size of the person, so that predictions of other persons
are refused. One trial is enough; more are better (docs/GROUND_FORCES.md).")]
pub(crate) struct CalibrateArgs {
    /// Trials of one person walking over force plates: .c3d, or .trc, .mot and others with --grf or --loads.
    #[arg(required = true)]
    pub(crate) trials: Vec<PathBuf>,
    /// The body as an OpenSim model (.osim) [default: the built-in body].
    #[arg(long, value_name = "FILE")]
    pub(crate) model: Option<PathBuf>,
    /// Measured ground forces of a trial: .mot, .sto or .csv; once per trial, in the order of the trials [default: the
    /// force plates in the trials].
    #[arg(long, value_name = "FILE")]
    pub(crate) grf: Vec<PathBuf>,
    /// OpenSim external loads of a trial (.xml): which columns act on which body; once per trial.
    #[arg(long, value_name = "FILE", conflicts_with_all = ["right", "left"])]
    pub(crate) loads: Vec<PathBuf>,
    /// Body and column prefix of the right foot, such as calcn_r:ground_force_
    #[arg(long, value_name = "BODY:PREFIX", requires = "grf")]
    pub(crate) right: Option<FootColumns>,
    /// Body and column prefix of the left foot, such as calcn_l:1_ground_force_
    #[arg(long, value_name = "BODY:PREFIX", requires = "grf")]
    pub(crate) left: Option<FootColumns>,
    #[command(flatten)]
    pub(crate) subject: SubjectArgs,
    /// File for the calibration; an existing one is only overwritten with --force.
    #[arg(short, long, value_name = "FILE.toml", default_value = CalibrateRequest::OUTPUT)]
    pub(crate) output: PathBuf,
    #[command(flatten)]
    pub(crate) replace: ReplaceArgs,
    #[command(flatten)]
    pub(crate) print: PrintArgs,
}

impl CalibrateArgs {
    /// How it is handled.
    pub(crate) fn handling(&self) -> Handling {
        Handling { replace: self.replace, print: self.print, ..Handling::default() }
    }

    /// The request that the options describe.
    pub(crate) fn request(&self) -> CalibrateRequest {
        let model = self.model.clone().map(ModelChoice::from);
        let forces = ForceFiles { right: self.right.clone(), left: self.left.clone(), ..ForceFiles::default() };
        let job = Job { model, forces, settings: self.subject.settings(), ..self.subject.clone().job() };
        let (trials, tables, loads) = (self.trials.clone(), self.grf.clone(), self.loads.clone());
        CalibrateRequest { trials, tables, loads, job, output: self.output.clone() }
    }
}

/// How angles of pelvis and hips are measured.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ValueEnum, Deserialize)]
#[serde(rename_all = "lowercase")]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub(crate) enum AngleConvention {
    #[default]
    Clinical,
    Opensim,
}

impl From<AngleConvention> for Convention {
    fn from(convention: AngleConvention) -> Self {
        match convention {
            AngleConvention::Clinical => Self::Clinical,
            AngleConvention::Opensim => Self::Opensim,
        }
    }
}

// The recorded person, and how markers are processed.
#[derive(Debug, Clone, ClapArgs)]
pub(crate) struct SubjectArgs {
    /// Standing trial of the same person: .c3d or .trc; for sensors a .sto with quaternions.
    #[arg(long = "static", value_name = "FILE")]
    pub(crate) still: Option<PathBuf>,
    /// The same person in a movement of hips and knees (.c3d, .trc), which shows the hip centres and knee axes of the
    /// built-in body (docs/MARKERS.md).
    #[arg(long, value_name = "FILE")]
    pub(crate) functional: Option<PathBuf>,
    /// The person in recordings of several people: the prefix of the marker names, as Anna for Anna:LASI [default: such
    /// recordings are refused].
    #[arg(long, value_name = "NAME")]
    pub(crate) subject: Option<String>,
    /// Body mass [kg]; the mass of a standing trial on force plates is used instead if it differs by less than 5 %, or
    /// if the motion on force plates agrees with it and not with KG. A
    /// given model is scaled to it [default: as measured by the force plates or stated in the recording; with --model
    /// the model's].
    #[arg(long, value_name = "KG", allow_negative_numbers = true, value_parser = kilograms)]
    pub(crate) mass: Option<f64>,
    /// Stature [m]; a given model is scaled to it [default: as stated in the recording, or estimated from the markers;
    /// with --model the model's].
    #[arg(long, value_name = "M", allow_negative_numbers = true, value_parser = metres)]
    pub(crate) height: Option<f64>,
    /// Table of segment masses of the built-in body: de-leva-male, de-leva-female, dempster-winter or faure-1997.
    #[arg(long, value_name = "NAME", default_value = Job::SEGMENTS.name(), value_parser = segments())]
    pub(crate) figure: SegmentTable,
    /// The marker set: a name from docs/MARKERS.md or a .toml [default: recognised from the marker names].
    #[arg(long, value_name = "NAME|FILE")]
    pub(crate) markers: Option<String>,
    /// Markers for --model from a separate OpenSim MarkerSet (.xml). Markers replace those with the same name; others
    /// are added.
    #[arg(long, value_name = "FILE")]
    pub(crate) marker_set: Option<PathBuf>,
    /// Which foot is on a force plate of the C3D, such as 1=r; `off` ignores a plate; flip-x, flip-y (a channel has the
    /// wrong sign), turn-90, turn-180 and turn-270 (to the left, seen from above) correct it, also together as in
    /// 1=r+flip-y; may be repeated [default: detected].
    #[arg(long, value_name = "N=r|l|off|...")]
    pub(crate) plate: Vec<PlateFoot>,
    /// By how much the measured forces were recorded late against the motion [s]; they are moved to earlier times by
    /// it. Negative if they are early. A warning (forces.delayed) states the delay that was found.
    #[arg(long, value_name = "S", default_value_t = 0.0, value_parser = seconds, allow_negative_numbers = true,
        hide_default_value = true)]
    pub(crate) force_delay: f64,
    /// Marker fit: frame by frame, or all frames together with a prior on the change of acceleration [default: frames
    /// for markers, trajectory for keypoints of video].
    #[arg(long, value_name = "METHOD", value_parser = one_of(&MarkerFitting::ALL))]
    pub(crate) fit: Option<MarkerFitting>,
    /// Centres of the hips of the built-in body: harrington (pelvis width and depth), hara (leg length), bell (pelvis
    /// width) or plug-in-gait (Davis; leg length, pelvis width). docs/MARKERS.md has the equations and their errors.
    #[arg(long, value_name = "NAME", default_value = HipRegression::default().word(),
        value_parser = one_of(&HipRegression::ALL))]
    pub(crate) hip: HipRegression,
    /// Axes of the knees of the built-in body: those of the markers, or turned so that varus follows flexion least in
    /// the recording.
    #[arg(long, value_name = "NAME", default_value = KneeAxis::default().word(), value_parser = one_of(&KneeAxis::ALL))]
    pub(crate) knee_axis: KneeAxis,
    /// Longest marker gap that is interpolated [s].
    #[arg(long, value_name = "S", default_value_t = FitSettings::default().longest_gap_s,
        value_parser = zero_or_more_seconds, allow_negative_numbers = true)]
    pub(crate) max_gap: f64,
}

// How the orientations of sensors are read.
#[derive(Debug, Clone, Default, ClapArgs)]
pub(crate) struct SensorArgs {
    /// Sensors: sensor and axis that point forward in the standing posture, such as pelvis_imu:-z (OpenSim's
    /// base_imu_label and base_heading_axis) [default: direction in which the knees bend].
    #[arg(long, value_name = "SENSOR:AXIS")]
    pub(crate) heading: Option<HeadingAxis>,
    /// Sensors: rotation from the sensors' world axes to the axes of the model (y up): angles about the fixed axes x, y
    /// and z in degrees (OpenSim's sensor_to_opensim_rotations) [default: -90,0,0, for a world with z up].
    #[arg(long, value_name = "X,Y,Z", allow_hyphen_values = true)]
    pub(crate) earth: Option<EarthTurn>,
}

impl SubjectArgs {
    /// The job with these statements about the person and the markers.
    fn job(self) -> Job {
        Job {
            standing: self.still,
            functional: self.functional,
            subject: self.subject,
            size: StatedSize { mass_kg: self.mass, height_m: self.height },
            segments: self.figure,
            markers: self.markers,
            marker_set: self.marker_set,
            plates: self.plate,
            ..Job::default()
        }
    }

    fn settings(&self) -> Processing {
        Processing {
            fit: self.fit,
            longest_gap_s: self.max_gap,
            hip: self.hip,
            knee_axis: self.knee_axis,
            force_delay_s: self.force_delay,
            ..Processing::default()
        }
    }
}
