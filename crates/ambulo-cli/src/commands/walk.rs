//! `ambulo walk`: synthesises a walk and computes its forces.

use super::run_files::{MoreFiles, MotionRun, read_thresholds};
use super::stopwatch::Stopwatch;
use crate::args::{ConditionArgs, FigureArgs, GaitArgs, TimedValue, WalkArgs, WalkMode};
use crate::caller::Caller;
use crate::replacement::ResultTarget;
use crate::request::WrongFields;
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::{Person, Thresholds};
use ambulo::findings::Findings;
use ambulo::formats::table::Table;
use ambulo::gait::machine::StateChange;
use ambulo::gait::{Gait, PaceChange, Style, Walk};
use ambulo::model::anthropometry::{Build, BuildError, SegmentTable, UnknownTable};
use ambulo::motion::RecordedTable;
use ambulo::numerics::{NaturalSpline, Order};
use ambulo::optimal::{Device, WalkConditions};
use ambulo::simulation::synthetic::{
    SyntheticError, SyntheticMode, SyntheticWalk, SyntheticWalkSettings, predict_observed, replay, run_of_states,
    synthesise_observed,
};
use ambulo::simulation::walking::TorqueSeries;
use ambulo::study::{self, CompleteMotion, Recording, Settings, Source, Stage};
use ambulo_report::gait_figure;
use ambulo_results::{Convention, FIGURE, GroundSource, Input, Keep, OutputFile, STATES, WalkSummary, states_csv};
use anyhow::{Context, Result, bail};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &WalkArgs) -> Result<Completion> {
    if args.states {
        return states(args);
    }
    let (clock, mut findings) = (Stopwatch::new(), Findings::default());
    // A mistake in the options is reported before the folder is made.
    let walk = Described::new(args, &mut findings)?;
    let output = args.output.as_deref().unwrap_or(Path::new(DEFAULT_OUTPUT));
    let target = ResultTarget::for_run(output, args.replace.existing())?;
    walked(args, walk, findings, clock, &Caller::default())?.write(&target, args.print, args.check)
}

/// A walk as the options describe it, before it is computed.
struct Described {
    gait: Gait,
    /// The name as it was typed.
    name: String,
    build: Build,
    conditions: WalkConditions,
    /// Every file that was read; a gait file is the first.
    read: Vec<PathBuf>,
    gait_file: Option<PathBuf>,
}

impl Described {
    fn new(args: &WalkArgs, findings: &mut Findings) -> Result<Described> {
        let name = args.gait.gait.as_deref().unwrap_or(if args.torques.is_some() { "standard" } else { "free" });
        let (gait, mut read) = gait(name, &args.gait, findings)?;
        let gait_file = read.first().cloned();
        let build = build(&args.figure)?;
        let conditions = conditions(args, &mut read)?;
        Ok(Described { gait, name: name.to_owned(), build, conditions, read, gait_file })
    }

    /// The mode that the gait allows.
    fn own_mode(&self) -> Result<SyntheticMode, BuildError> {
        Ok(SyntheticMode::of(&self.gait, &self.build, self.build.human()?.dimensions.leg_length))
    }
}

/// Synthesises a walk and computes its forces.
pub(crate) fn compute(args: &WalkArgs, caller: &Caller) -> Result<MotionRun> {
    let (clock, mut findings) = (Stopwatch::new(), Findings::default());
    let walk = Described::new(args, &mut findings)?;
    walked(args, walk, findings, clock, caller)
}

fn walked(
    args: &WalkArgs,
    mut walk: Described,
    mut findings: Findings,
    mut clock: Stopwatch,
    caller: &Caller,
) -> Result<MotionRun> {
    let thresholds = read_thresholds(args.thresholds.as_deref())?;
    walk.read.extend(args.thresholds.clone());
    let torques = args.torques.as_deref().map(|path| read_torques(path, &walk.gait.name)).transpose()?;
    walk.read.extend(args.torques.clone());
    let mode = match (&torques, asked_mode(args, &walk.conditions)?) {
        (Some(_), None | Some(SyntheticMode::Paper)) => SyntheticMode::Paper,
        (Some(_), Some(mode)) => {
            let what = format!("found the mode {mode}; expected the mode paper, in which the torques were computed");
            return Err(WrongFields::new(&["torques"], what).into());
        }
        (None, mode) => mode.map_or_else(|| walk.own_mode(), Ok)?,
    };
    let Described { gait, name, build, conditions, read, gait_file } = walk;
    let gait = if mode == SyntheticMode::Corrected { style_for_correction(gait, &name, &args.gait) } else { gait };
    let walk_settings = shaped(&gait, build, mode, args);
    let print = args.print;
    let observer = caller.observer(move |steps| printer::solver_steps(Some(steps), print));
    let mut walk = match &torques {
        Some(torques) => replay(&walk_settings, torques, &mut findings),
        None if mode == SyntheticMode::Predicted => {
            predict_observed(&walk_settings, &conditions, &observer, &mut findings)
        }
        None => synthesise_observed(&walk_settings, &observer, &mut findings),
    };
    walk.iter_mut().for_each(|walk| walk.compare_without_devices(&observer));
    printer::solver_steps(None, print);
    let walk = in_file(walk, gait_file.as_ref())?;
    clock.lap("walk");
    let run = SyntheticRun {
        walk: &walk,
        walk_settings: &walk_settings,
        device: args.conditions.device.as_ref().map(|path| path.display().to_string()),
        thresholds,
        convention: args.convention.into(),
        read,
        caller,
        options: options(args),
        keep: Keep::of_names(&args.keep),
        more: Box::new(|_| Ok(Vec::new())),
    };
    run.analyse(findings, clock)
}

/// The mode that the user chose, or that the conditions need.
fn asked_mode(args: &WalkArgs, conditions: &WalkConditions) -> Result<Option<SyntheticMode>> {
    let asked = if args.planar { Some(SyntheticMode::Corrected) } else { args.mode.map(WalkMode::mode) };
    match asked {
        // A slope of zero asks for a prediction, too.
        None => Ok((args.conditions != ConditionArgs::default()).then_some(SyntheticMode::Predicted)),
        Some(SyntheticMode::Predicted) => Ok(asked),
        Some(_) if *conditions == WalkConditions::default() => Ok(asked),
        Some(mode) => {
            let fields = &["slope", "load", "weak", "device", "step_width", "asymmetric", "free_cadence"];
            let what = format!(
                "found the mode {mode}; expected the mode predict, because the other modes do not support them"
            );
            Err(WrongFields::new(fields, what).into())
        }
    }
}

/// The devices of a file, which is added to the files that were read.
pub(super) fn read_devices(path: Option<&Path>, read: &mut Vec<PathBuf>) -> Result<Vec<Device>> {
    let Some(path) = path else { return Ok(Vec::new()) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    read.push(path.to_owned());
    Device::from_toml(&text).with_context(shown)
}

/// The conditions of a predicted walk; a device file is added to the files that were read.
fn conditions(args: &WalkArgs, read: &mut Vec<PathBuf>) -> Result<WalkConditions> {
    let asked = &args.conditions;
    let devices = read_devices(asked.device.as_deref(), read)?;
    Ok(WalkConditions {
        slope: asked.slope.unwrap_or_default() / 100.0,
        load: asked.load,
        strengths: asked.weak.clone(),
        devices,
        step_width_m: asked.step_width,
        asymmetric: asked.asymmetric,
        free_cadence: asked.free_cadence,
    })
}

fn shaped<'a>(gait: &'a Gait, build: Build, mode: SyntheticMode, args: &WalkArgs) -> SyntheticWalkSettings<'a> {
    SyntheticWalkSettings { gait, build, mode, cycles: args.cycles, rate_hz: args.rate }
}

/// Names the gait file in errors of its machines.
fn in_file<T>(result: Result<T, SyntheticError>, file: Option<&PathBuf>) -> Result<T> {
    match (&result, file) {
        (Err(SyntheticError::Walking(_)), Some(file)) => result.with_context(|| file.display().to_string()),
        _ => Ok(result?),
    }
}

/// Prints the machines of the gait and the run of their states while it happens; draws the gait if a folder is given.
fn states(args: &WalkArgs) -> Result<Completion> {
    let mut findings = Findings::default();
    let described = Described::new(args, &mut findings)?;
    let mode = asked_mode(args, &described.conditions)?.map_or_else(|| described.own_mode(), Ok)?;
    let settings = &shaped(&described.gait, described.build, mode, args);
    let read = &described.read;
    let human = settings.build.human()?;
    let walk = Walk::new(settings.gait, human.dimensions.leg_length, &mut findings)?;
    if let Some(output) = &args.output {
        let file = gait_file(&walk)?;
        let path = output.join(&file.name);
        files::check_target(&path, read, args.replace.existing())?;
        files::write(&path, &file.bytes()?)?;
    }
    // The same remarks would be made about the same gait.
    let run = |tell: &mut dyn FnMut(&StateChange)| {
        in_file(run_of_states(settings, tell, &mut Findings::default()), described.gait_file.as_ref())
    };
    printer::states(&walk, &findings, args.print, run).map(|()| Completion::Passed)
}

/// The command with the options that matter for the results.
fn options(args: &WalkArgs) -> String {
    let (output, replace, check, print) = Default::default();
    format!("walk {:?}", WalkArgs { output, replace, check, print, ..args.clone() })
}

const DEFAULT_OUTPUT: &str = "out";

/// A synthesised walk with everything that its analysis and its files need.
pub(super) struct SyntheticRun<'a> {
    pub(super) walk: &'a SyntheticWalk,
    pub(super) walk_settings: &'a SyntheticWalkSettings<'a>,
    /// The file of the devices.
    pub(super) device: Option<String>,
    pub(super) thresholds: Thresholds,
    /// Convention of the angles of pelvis and hips.
    pub(super) convention: Convention,
    pub(super) read: Vec<PathBuf>,
    pub(super) caller: &'a Caller,
    /// The command with the options that matter for the results.
    pub(super) options: String,
    /// The outputs that are written.
    pub(super) keep: Keep,
    /// Makes further files from the tables and figures of the run.
    pub(super) more: Box<MoreFiles>,
}

impl SyntheticRun<'_> {
    /// Computes the forces as for a recording, beginning with a complete motion.
    pub(super) fn analyse(self, mut findings: Findings, mut clock: Stopwatch) -> Result<MotionRun> {
        let prediction = self.walk.report.prediction.as_ref();
        let weak = prediction.map(|prediction| prediction.conditions.strengths.clone()).unwrap_or_default();
        let settings = Settings { thresholds: Thresholds { weak, ..self.thresholds.clone() }, ..Settings::default() };
        let mut watch = |stage: Stage| {
            clock.lap(stage.word());
            if self.caller.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        };
        let outcome =
            study::run_observed(source(self.walk, self.walk_settings.mode), &settings, &mut findings, &mut watch)?;
        Ok(MotionRun {
            outcome,
            input: Input { device: self.device.clone(), ..input(self.walk_settings) },
            convention: self.convention,
            walk: Some(WalkSummary::new(&self.walk.human.model, &self.walk.report)),
            files: self.files()?,
            keep: self.keep,
            more: self.more,
            read: self.read,
            caller: self.caller.clone(),
            options: self.options,
            findings,
            clock,
        })
    }

    /// The figure as an OpenSim model, the picture of the gait, and the torques of a controller's plan.
    fn files(&self) -> Result<Vec<OutputFile<'static>>> {
        let mut files = vec![
            OutputFile::body(FIGURE, &self.walk.human.model, None)?,
            gait_file(&self.walk.walk)?,
            OutputFile::new(STATES, states_csv(&self.walk.states).into_bytes()),
        ];
        if !self.walk.torques.is_empty() {
            let text = TorqueSeries::text([("physical", &*self.walk.report.gait, self.walk.torques.clone())]);
            files.push(OutputFile::new("torques.toml", text.into_bytes()));
        }
        Ok(files)
    }
}

/// A walk with the ground forces of its simulation or correction.
pub(super) fn source(walk: &SyntheticWalk, mode: SyntheticMode) -> Source {
    let SyntheticWalk { human, trajectory, loads, .. } = walk;
    let made = CompleteMotion {
        model: human.model.clone(),
        person: Person::of_human(human),
        trajectory: trajectory.clone(),
        loads: loads.clone(),
        rule: rule(mode),
    };
    Source { device: device(walk), ..Source::new(Recording::Complete(Box::new(made))) }
}

/// The moments of the devices of a walk as the table that a recording with a worn device has.
fn device(walk: &SyntheticWalk) -> Option<Table> {
    let prediction = walk.report.prediction.as_ref()?;
    let names = walk.human.model.force_names();
    let moments = prediction.devices.iter().zip(&prediction.device_moments);
    let mut columns = vec![("time".to_owned(), walk.trajectory.grid().times())];
    columns.extend(moments.map(|(effort, moments)| (names[effort.coordinate.index()].clone(), moments.clone())));
    if columns.len() > 1 { Table::new("device", columns).ok() } else { None }
}

/// The picture of a gait.
fn gait_file(walk: &Walk) -> Result<OutputFile<'static>> {
    Ok(OutputFile::new("figures/gait.svg", gait_figure(walk)?.into_bytes()))
}

/// How the ground forces were determined, also in double support.
fn rule(mode: SyntheticMode) -> &'static str {
    match mode {
        SyntheticMode::Paper => "rigid soles",
        _ => "soft shoes",
    }
}

fn input(walk_settings: &SyntheticWalkSettings<'_>) -> Input {
    Input {
        motion: format!("gait {}", walk_settings.gait.name),
        person: None,
        recorded_on: None,
        model: format!("figure {}", walk_settings.build.table),
        standing: None,
        ground: None,
        loads: None,
        device: None,
        added_mass: Vec::new(),
        ground_source: GroundSource::None,
    }
}

/// The table of segment masses of a name.
pub(super) fn segments(name: &str) -> Result<SegmentTable> {
    name.parse().map_err(|error: UnknownTable| WrongFields::new(&["figure"], error).into())
}

fn build(args: &FigureArgs) -> Result<Build> {
    let usual = Build::usual(segments(&args.figure)?);
    let (mass, height) = (args.mass.unwrap_or(usual.mass), args.height.unwrap_or(usual.height));
    let build = Build { mass, height, toe_joint: !args.no_toe_joint, ..usual };
    // Reject an impossible size before anything is computed.
    build.human()?;
    Ok(build)
}

/// The gait with the user's changes, and the file that it was read from.
fn gait(name: &str, args: &GaitArgs, findings: &mut Findings) -> Result<(Gait, Vec<PathBuf>)> {
    let path = Path::new(name);
    let is_file = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("toml")) || path.components().count() > 1;
    let mut read = Vec::new();
    let mut gait = if is_file {
        let shown = || path.display().to_string();
        let text = String::from_utf8(files::read(path)?).with_context(shown)?;
        read.push(path.to_owned());
        let mut column = |file: &str, column: &str| {
            let file = path.with_file_name("").join(file);
            let values = recorded_angle(&file, column, findings).map_err(|error| format!("{error:#}"));
            read.push(file);
            values
        };
        Gait::from_toml_with(&text, &mut column).with_context(shown)?
    } else {
        Gait::named(name).map_err(|error| WrongFields::new(&["gait"], error))?
    };
    if let Some(word) = &args.style {
        gait = gait.in_style(style(word)?);
    }
    gait.pace = gait.pace.with(args.speed, args.step_length, args.cadence.map(|cadence| cadence / 60.0));
    let changes = pace_changes(args)?;
    if let (Some(machine), false) = (gait.machine_of_the_pace(), changes.is_empty()) {
        let name = &machine.name;
        bail!(
            "found changes of pace besides those of the gait; expected none, because the machine `{name}` of the gait \
             drives the pace"
        );
    }
    gait.pace_changes.extend(changes);
    gait.pace_changes.sort_by_number(|change| change.start_s);
    if let Some(height) = args.step_height {
        gait.step_height = height;
    }
    Ok((gait, read))
}

/// The torques of a gait.
fn read_torques(path: &Path, gait: &str) -> Result<Vec<TorqueSeries>> {
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    TorqueSeries::read(&text, "paper", gait).with_context(shown)
}

/// An angle of a recording [rad] against time.
fn recorded_angle(path: &Path, column: &str, findings: &mut Findings) -> Result<NaturalSpline> {
    let name = path.display().to_string();
    let table = RecordedTable::read(&files::read(path)?, &name, findings).with_context(|| name.clone())?;
    table.angle(column, findings).with_context(|| name)
}

/// Built-in gaits of style 1997 have zero acceleration at their knots; to be corrected, they take style knots unless
/// the user chose a style. Changes of single knots are made for the style of the gait, so such gaits keep it.
fn style_for_correction(gait: Gait, name: &str, args: &GaitArgs) -> Gait {
    let takes_knots = args.style.is_none() && Gait::NAMES.contains(&name) && gait.changes.is_empty();
    if takes_knots { gait.in_style(Style::Knots) } else { gait }
}

fn style(word: &str) -> Result<Style> {
    let known = Style::WORDS.into_iter().find(|(name, _)| *name == word);
    let names = Style::WORDS.map(|(name, _)| name).join(", ");
    let wrong = || WrongFields::new(&["style"], format!("found `{word}`; expected one of {names}")).into();
    known.map(|(_, style)| style).ok_or_else(wrong)
}

/// The changes of pace of the options. Changes of different quantities at the same time are one change.
fn pace_changes(args: &GaitArgs) -> Result<Vec<PaceChange>> {
    type Quantity = fn(&mut PaceChange) -> &mut Option<f64>;
    let options: [(&'static [&'static str], &[TimedValue], f64, Quantity); 3] = [
        (&["speed_change"], &args.speed_change, 1.0, |change| &mut change.speed),
        (&["step_length_change"], &args.step_length_change, 1.0, |change| &mut change.step_length),
        (&["cadence_change"], &args.cadence_change, 1.0 / 60.0, |change| &mut change.step_frequency),
    ];
    let mut changes: Vec<PaceChange> = Vec::new();
    for (field, values, unit, quantity) in options {
        for TimedValue { time_s, value, duration_s } in values.iter().copied() {
            let number = match changes.iter().position(|c| (c.start_s, c.duration_s) == (time_s, duration_s)) {
                Some(number) => number,
                None => {
                    changes.push(PaceChange { start_s: time_s, duration_s, ..PaceChange::default() });
                    changes.len() - 1
                }
            };
            let change = &mut changes[number];
            if quantity(change).replace(value * unit).is_some() {
                return Err(WrongFields::new(field, format!("found two changes at {time_s} s; expected one")).into());
            }
        }
    }
    Ok(changes)
}
