// Made from the types of requests by crates/ambulo-cli/tests/request_contract.rs; do not edit.

/** The verbs that a request may have, each with its fields. */
export type Request = {
  forces: ForcesRequest;
} | {
  calibrate: CalibrateRequest;
} | {
  validate: ValidateArgs;
} | {
  batch: BatchRequest;
} | {
  session: SessionRequest;
} | {
  walk: WalkArgs;
} | {
  sweep: SweepArgs;
} | {
  demo: DemoArgs;
} | {
  simulate: SimulateArgs;
} | {
  events: EventsArgs;
};

/** The forces of a recording. */
export interface ForcesRequest {
  /** Recording, person and settings. */
  job?: Job;
  /** How angles of pelvis and hips are measured. */
  convention?: Convention;
  /** Names of the outputs that are written; all if there are none. */
  keep?: string[];
  /** Folder for the results. */
  output?: string;
}

/** A request for the forces of a recording. Files are named; [`Job::read`] reads them.  Fields that are left open are filled by the set-ups, if there are any, and then have the defaults of their documentation. In JSON, every field may be left out. */
export interface Job {
  /** The recording: markers, poses of segments, coordinates, orientations of sensors, a skeleton, a motion of the SMPL family or a subject of AddBiomechanics. Only a set-up makes it unnecessary. */
  recording?: string | null;
  /** The trial of a `.b3d`: its name, or its number counted from 1. Needed if there are several. */
  trial?: number | string | null;
  /** The same person standing still. */
  standing?: string | null;
  /** The same person in a movement of hips and knees, which shows the joint centres and axes of the built-in body. */
  functional?: string | null;
  /** The person in recordings of several people: the prefix of the names of the markers. By default such recordings are refused. */
  subject?: string | null;
  /** The body. Coordinates need a model; by default a `.b3d` has its own, and everything else the built-in body. */
  model?: string | null;
  /** Markers for the model in a file of their own. */
  marker_set?: string | null;
  /** The set of the recorded markers: a name, or a `.toml`. By default it is recognised. */
  markers?: string | null;
  /** Segment masses of the built-in body. */
  segments?: string;
  /** Body mass and stature. */
  size?: StatedSize;
  /** The SMPL model that gives a motion its lengths. */
  smpl?: string | null;
  /** How orientations of sensors are read. */
  sensors?: SensorStatements;
  /** Files of measured ground forces. */
  forces?: ForceFiles;
  /** Force plates of which the laboratory knows the foot, or which signs and directions are wrong. */
  plates?: string[];
  /** Calibration of this person, by which predicted ground forces are corrected. */
  person?: string | null;
  /** Joint moments of a worn device. */
  device?: string | null;
  /** Masses that the person carried. */
  added_mass?: string[];
  /** How muscle forces are found; `None` finds none. */
  muscles?: MuscleStatements | null;
  /** Limits of a person, for the verdict. */
  thresholds?: string | null;
  /** Set-ups of OpenSim's tools, at most one of each. */
  setups?: string[];
  /** How the recording is processed. */
  settings?: Processing;
}

/** Mass and stature that are stated for the person who moved; a model of another size is scaled to them. */
export interface StatedSize {
  /** Body mass [kg]. */
  mass_kg?: number | null;
  /** Stature [m]. */
  height_m?: number | null;
}

/** How orientations of sensors are read. */
export interface SensorStatements {
  /** The axis of a sensor that points forward in the standing posture. By default the bending of the knees shows the direction. */
  heading?: string | null;
  /** From the earth of the sensors to the axes of the model. By default z is up. */
  earth?: string | null;
}

/** Files of measured ground forces. By default the forces are those in the recording. */
export interface ForceFiles {
  /** The table; by default the one that the external loads name. */
  table?: string | null;
  /** External loads of OpenSim: which columns act on which body. */
  loads?: string | null;
  /** Body and columns of the right foot. */
  right?: string | null;
  /** Body and columns of the left foot. */
  left?: string | null;
}

/** How muscle forces are found, by static optimisation (`docs/MUSCLES.md`). The defaults are those of OpenSim's tool. */
export interface MuscleStatements {
  /** Motors that help the muscles, an OpenSim `ForceSet` (`.xml`). By default each coordinate has one. */
  reserves?: string | null;
  /** Electromyograms of the recording in a table of their own (`.sto`, `.mot`, `.csv`). By default the analog channels of a C3D are used. */
  emg?: string | null;
  /** How paths over surfaces are found. */
  wraps?: WrapRule;
  /** How the pennation of muscles of Millard's kind is found. */
  pennation?: Pennation;
  /** Exponent of the activations in the sum that is least. */
  exponent?: number;
  /** Weight of each activation in that sum, by the name of the muscle; 1 where none is given. */
  weights?: Record<string, number>;
  /** Distance between the contacts of the two condyles of a knee [m]. By default 40 mm for a knee 90 mm wide, in proportion to the width that the recording states (`KneeWidth`), otherwise to stature. */
  condyles_m?: number | null;
}

/** How paths run over surfaces. */
export type WrapRule = "exact" | "opensim";

/** Whose pennation reduces the active force of Millard's muscles. */
export type Pennation = "opensim" | "exact";

/** How a recording is processed: the choices of a caller. Files and set-ups complete them to [`Settings`]. */
export interface Processing {
  /** How the ground forces are found. A calibration of the person asks for predicted ones. */
  ground?: GroundSettings;
  /** Whether the motion is changed so that loaded feet do not slide. */
  refit?: boolean;
  /** The time range to analyse. */
  window?: Window;
  /** Frames per second of the results [Hz]; `None` keeps those of the recording. */
  rate_hz?: number | null;
  /** How the motion is smoothed. */
  filter?: Filter;
  /** Low-pass of the motion; `None` takes that of a set-up, or [`Settings::LOW_PASS`]. */
  cutoff?: number | string | null;
  /** Low-pass of the measured forces; `None` chooses it by the movement and the way in which ground forces are found. */
  force_cutoff?: number | string | null;
  /** By how much the measured forces were recorded late against the motion [s]: they are moved to earlier times by it; negative for forces that are early. */
  force_delay_s?: number;
  /** Order of one pass of the Butterworth filters. */
  order?: number;
  /** What residual reduction may change; `None` changes nothing. */
  residual_reduction?: Adjustable | null;
  /** How markers are fitted; `None` is by the kind of recording. */
  fit?: MarkerFitting | null;
  /** Longest marker gap that is interpolated [s]. */
  longest_gap_s?: number;
  /** How the built-in body finds the centres of the hips. */
  hip?: HipRegression;
  /** How the built-in body finds the axes of the knees. */
  knee_axis?: KneeAxis;
}

/** How the ground forces are found. */
export type GroundSettings = "measured_or_predicted" | "predicted" | "tracked" | "no_contact";

/** A range of time; `None` is an open end. */
export interface Window {
  /** Start [s]. */
  from_s?: number | null;
  /** End [s]. */
  to_s?: number | null;
}

/** A filter family. */
export type Filter = "butterworth" | "spline";

/** The parts of a study that residual reduction may change. */
export type Adjustable = "motion" | "body";

/** How coordinates are fitted to markers. */
export type MarkerFitting = "frames" | "trajectory";

/** How the centres of the hips follow from the markers of the pelvis. */
export type HipRegression = "harrington" | "hara" | "bell" | "plug-in-gait";

/** Where the axes of the knees of the built-in body come from. */
export type KneeAxis = "markers" | "least-cross-talk";

/** A convention for the angles of pelvis and hips. */
export type Convention = "clinical" | "opensim";

/** The calibration of a person, whose ground forces are predicted. */
export interface CalibrateRequest {
  /** Trials of one person walking over force plates. */
  trials: string[];
  /** Tables of measured forces, one per trial; none: the force plates in the trials. */
  tables?: string[];
  /** External loads of OpenSim, one per trial, or none. */
  loads?: string[];
  /** Person and settings of every trial. */
  job?: Job;
  /** File for the calibration. */
  output?: string;
}

export interface ValidateArgs {
  /** The folder with the recordings. */
  folder: string;
  /** Body mass of the person, if DIR has the trials of one person [kg] [default: as in trials.toml, measured by the force plates or stated in the recordings]. */
  mass?: number | null;
  /** Stature of the person, if DIR has the trials of one person [m] [default: as in trials.toml, stated in the recordings or estimated]. */
  height?: number | null;
  /** Table of segment masses of the built-in body: de-leva-male, de-leva-female, dempster-winter or faure-1997. */
  figure?: string;
  /** The marker set: a name from docs/MARKERS.md or a .toml [default: recognised from the marker names]. */
  markers?: string | null;
  /** Judge tracking as well (`ambulo forces --track`): one to three seconds per trial. */
  track?: boolean;
  /** Only print which files are judged, with their settings, and which are not. */
  dry_run?: boolean;
  /** Trials that are computed at the same time [default: the number of processors]; the results do not depend on it. */
  jobs?: number | null;
  /** Folder for the results. */
  output?: string;
}

/** The trials of a folder or a list as tables. */
export interface BatchRequest {
  /** Source, folder and tables. */
  own: BatchArgs;
  /** Person and settings of every trial. */
  job?: Job;
  /** How angles of pelvis and hips are measured. */
  convention?: Convention;
}

export interface BatchArgs {
  /** A folder with recordings, a list of trials (.csv, .jsonl) or a subject of AddBiomechanics (.b3d). */
  source: string;
  /** Folder for the results: a new one, or with --resume the folder of an interrupted batch. */
  output?: string;
  /** Trials that are computed at the same time [default: the number of processors; 1 in a job of Slurm, PBS, LSF or Grid Engine]. */
  jobs?: number | null;
  /** Compute only every n-th trial, beginning with number I, counted from 0: N machines share a batch. */
  shard?: string;
  /** Continue an interrupted batch in its folder. */
  resume?: boolean;
  /** Tables to write, separated by commas: tables of frames, cycles, events. */
  keep?: string[];
  /** Trials in one file of each table. */
  part?: number;
  /** Compute only the first trials. */
  limit?: number | null;
  /** Longest time for one trial [s]: a trial that takes longer ends after its stage and is a row with its error. */
  time_limit?: number | null;
  /** Largest size of all files of one trial [MB]: a larger trial is not read and is a row with its error. */
  size_limit?: number | null;
  /** Only print which trials were found, with which files. */
  dry_run?: boolean;
}

/** The trials of a visit. */
export interface SessionRequest {
  /** Recordings, folder and comparison. */
  own: SessionArgs;
  /** Person and settings of every trial. */
  job?: Job;
  /** How angles of pelvis and hips are measured. */
  convention?: Convention;
}

export interface SessionArgs {
  /** The folder with the recordings of the visit; or the files: recordings, standing trial, models, tables of forces. */
  source: string[];
  /** Folder for the results. */
  output?: string;
  /** Folder of an earlier session of the person, to show the changes. */
  compare?: string | null;
  /** Your own reference group: norm.json of an earlier run, or a folder with recordings or sessions of healthy subjects, one folder per subject [default: children of Schwartz et al. 2008]. */
  norm?: string | null;
  /** Name of the person on the page [default: as in trials.toml, in the recordings, or the folder]. */
  name?: string | null;
  /** Day of the session, as YYYY-MM-DD [default: as in trials.toml or in the recordings]. */
  date?: string | null;
  /** Write no name, no path and no date into any file, and no page of a trial. */
  anonymous?: boolean;
  /** Only print which trials were found, with which files. */
  dry_run?: boolean;
  /** Trials that are computed at the same time [default: the number of processors]; the results do not depend on it. */
  jobs?: number | null;
}

export interface WalkArgs {
  gait?: GaitArgs;
  figure?: FigureArgs;
  conditions?: ConditionArgs;
  /** How the walk is computed [default: optimal for a steady gait with normative curves; corrected for other gaits that repeat; else paper]. */
  mode?: WalkMode | null;
  /** Reference of the pelvis and hip angles in clinical.csv and the report: `clinical`, the line through the iliac spines; `opensim`, the model's own axes. */
  convention?: AngleConvention;
  /** Replay torques without feedback, in the mode paper: a torques.toml of `ambulo reproduce` [--gait then defaults to standard]. */
  torques?: string | null;
  /** Whole gait cycles per foot, 1 to 1000. */
  cycles?: number;
  /** Frame rate of the results, 20 to 5000 Hz. */
  rate?: number;
  /** Only print the state machines of the gait and each change of their states: time, machine, old and new state, and the condition that was true. */
  states?: boolean;
  /** Limits of the feasibility checks: .toml (docs/JUDGEMENT.md) [default: built in]. */
  thresholds?: string | null;
  /** Folder for the results [default: out]; with --states, for the figure of the gait [default: none]. */
  output?: string | null;
  /** Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all]. */
  keep?: string[];
}

export interface GaitArgs {
  /** Name of a gait (standard, long, short, goose, parade, slow, free, fast) or a gait file (docs/GAITS.md) [default: free]. */
  gait?: string | null;
  /** Walking speed, 0.05 to 5 m/s, or 0 to stand until the first change [default: the gait's]. */
  speed?: number | null;
  /** Step length, foot strike to opposite foot strike, 0.02 to 3 m [default: the gait's]. */
  step_length?: number | null;
  /** Steps per minute, 5 to 1000 [default: the gait's]. */
  cadence?: number | null;
  /** Change the speed on the way: at TIME [s] to SPEED [m/s], 0 to stand still, within DURATION [s]; repeatable [default: two steps]. */
  speed_change?: string[];
  /** Change the step length on the way, as with --speed-change [m]. */
  step_length_change?: string[];
  /** Change the cadence on the way, as with --speed-change [steps/min]. */
  cadence_change?: string[];
  /** Foot clearance as a multiple of the natural one, 0.1 to 10 [default: the gait's]. */
  step_height?: number | null;
  /** How joint curves are interpolated between their knots: 1997 or knots [default: the gait's]. */
  style?: string | null;
}

export interface FigureArgs {
  /** Table of segment masses: de-leva-male, de-leva-female, dempster-winter or faure-1997. */
  figure?: string;
  /** Body mass [kg] [default: 75, de-leva-female 60, faure-1997 80]. */
  mass?: number | null;
  /** Stature [m] [default: 1.75, de-leva-female 1.65, faure-1997 1.80]. */
  height?: number | null;
  /** Use feet of one segment, without a toe joint. */
  no_toe_joint?: boolean;
}

export interface ConditionArgs {
  /** Slope of the ground, -40 to 40 percent; uphill is positive. This and the following options imply `--mode predict`. */
  slope?: number | null;
  /** Carried load: on the back, half in each hand, or at the pelvis [default: back]. */
  load?: number | string | null;
  /** Remaining share of a joint's strength, such as ankle=0.6 (both sides) or knee_r=0.5; repeatable. */
  weak?: string[];
  /** Devices at joints, springs or given moments: .toml (docs/OPTIMAL.md); the results compare with the walk without them, which takes as long again. */
  device?: string | null;
  /** Distance between the paths of both feet, 0 to 0.5 m [default: the one with the least muscle effort]. */
  step_width?: number | null;
  /** Let both sides move differently even if their conditions are the same. */
  asymmetric?: boolean;
  /** Choose cadence and step length too, for the least cost at the speed; takes about three times as long. */
  free_cadence?: boolean;
}

/** How a walk is computed. */
export type WalkMode = "optimal" | "predict" | "corrected" | "paper" | "physical";

/** How angles of pelvis and hips are measured. */
export type AngleConvention = "clinical" | "opensim";

export interface SweepArgs {
  /** Walking speeds [m/s] [default: free speed]. */
  speed?: Written | null;
  /** Body masses [kg] [default: 75, de-leva-female 60, faure-1997 80]. */
  mass?: Written | null;
  /** Statures [m] [default: 1.75, de-leva-female 1.65, faure-1997 1.80]. */
  height?: Written | null;
  /** Slopes of the ground [%], uphill is positive; implies predicted walks. */
  slope?: Written | null;
  /** Carried loads [kg]: on the back, half in each hand, or at the pelvis [default: back]; implies predicted walks. */
  load?: Written | null;
  /** Remaining share of a joint's strength in all walks, such as ankle=0.6; repeatable; implies predicted walks. */
  weak?: string[];
  /** Devices at joints in all walks, springs or given moments: .toml (docs/OPTIMAL.md); implies predicted walks. */
  device?: string | null;
  /** Predict all walks: minimise muscle effort and follow no recorded curves. */
  predict?: boolean;
  /** Choose cadence and step length of each walk too, for the least cost at its speed; implies predicted walks, takes about three times as long. */
  free_cadence?: boolean;
  /** Table of segment masses: de-leva-male, de-leva-female, dempster-winter or faure-1997. */
  figure?: string;
  /** Folder for the results. */
  output?: string;
  /** Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all]. */
  keep?: string[];
}

/** Values of a sweep in JSON. */
export type Written = number | number[] | string;

export interface DemoArgs {
  /** Folder for the results. */
  output?: string;
  /** Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all]. */
  keep?: string[];
}

export interface SimulateArgs {
  /** The scene (.toml). */
  scene: string;
  /** Folder for the results. */
  output?: string;
  /** Outputs that are written, separated by commas; a table is written if it or `tables` is listed [default: all]. */
  keep?: string[];
  /** Time at which the simulation ends [s] [default: as in the scene]. */
  duration?: number | null;
  /** Time step [s] [default: as in the scene]. */
  step?: number | null;
  /** Save the final state to a file; an existing one is only overwritten with --force. */
  save?: string | null;
  /** Continue from a state that --save wrote; the results begin with the row after its last one. */
  resume?: string | null;
}

export interface EventsArgs {
  /** The recording. */
  input: string;
  /** Also write the events to a .csv with side, event, time and source; an existing one is only overwritten with --force. */
  output?: string | null;
}
