//! `ambulo forces`: joint moments, powers, reactions and ground forces of a recording.

mod coordinates;
mod errors;
mod ground_table;
pub(crate) mod markers;
mod read_once;
mod sensors;
mod setup;
mod size;
mod skeleton;
pub(crate) mod subject;

use super::bids;
use super::run_files::{MotionRun, read_thresholds};
use super::stopwatch::Stopwatch;
use crate::args::{Adjusted, Filter, ForceCutoff, ForcesArgs, MarkerFitting};
use crate::caller::Caller;
use crate::replacement::ResultTarget;
use crate::{Completion, files};
use ambulo::analysis::{Adjustable, Subject};
use ambulo::findings::{Code, Findings};
use ambulo::ground::predict::PersonalErrors;
use ambulo::kinematics::marker_fit::{FitMethod, FitSettings, OutlierDetection, SmoothnessPrior};
use ambulo::model::{Model, from_osim};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{Smoother, SubjectParameters, Window, is_bids_markers, is_marker_table};
use ambulo::study::{
    self, AddedMass, ForceFilter, ForceOrigin, GroundSettings, MarkerBody, Outcome, Recording, Settings, Source,
    TrackedTasks,
};
use ambulo_formats::osim::{OsimMarkerSet, OsimModel};
use ambulo_formats::table::Table;
use ambulo_results::{GroundSource, Input, Keep, OutputFile};
use anyhow::{Context, Result, bail};
use read_once::{ModelFiles, Models, StandingTrials};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &ForcesArgs) -> Result<Completion> {
    check_range(args)?;
    if args.trial.as_deref() == Some(ForcesArgs::ALL_TRIALS) {
        return subject::run_all(args);
    }
    run_one(args)
}

/// Computes one recording into one folder.
fn run_one(args: &ForcesArgs) -> Result<Completion> {
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    compute(args, &Caller::default())?.write(&target, args.print, args.check)
}

fn check_range(args: &ForcesArgs) -> Result<()> {
    if let (Some(from), Some(to)) = (args.from, args.to)
        && from > to
    {
        bail!("--from {from} is after --to {to}; expected a start before the end");
    }
    Ok(())
}

/// Reads the recording and computes its forces.
pub(crate) fn compute(args: &ForcesArgs, caller: &Caller) -> Result<MotionRun> {
    compute_with(args, caller, &Shared::default())
}

/// Data that are read or computed once for several recordings of a person.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    /// Standing trials, read once.
    pub(crate) standing_trials: StandingTrials,
    /// Models, read once.
    pub(crate) models: Models,
    /// A body that was calibrated before, for markers with the built-in body.
    pub(crate) body: Option<Subject>,
}

/// As [`compute`], with what other recordings share.
pub(crate) fn compute_with(args: &ForcesArgs, caller: &Caller, shared: &Shared) -> Result<MotionRun> {
    let mut reading = Reading {
        standing_trials: shared.standing_trials.clone(),
        models: shared.models.clone(),
        caller: caller.clone(),
        findings: Findings::default(),
        clock: Stopwatch::new(),
        read: Vec::new(),
        ground: None,
        setups: setup::Setups::default(),
        tracked: None,
    };
    let args = &setup::resolved(args, &mut reading)?;
    check_range(args)?;
    reading.read.push(args.recording().to_owned());
    let kind = RecordingKind::of(args.recording(), caller)?;
    if args.trial.is_some() && kind != RecordingKind::Subject {
        bail!("{}: --trial chooses a trial of a .b3d; this file has one recording", args.recording().display());
    }
    if let (Some(setup), true) = (reading.setups.of_sensors(), kind != RecordingKind::Sensors) {
        bail!(
            "{}: {} needs orientations of sensors (.sto with quaternions) as the recording; this is another recording",
            args.recording().display(),
            setup.display()
        );
    }
    if let Some(option) = args.sensors.given().filter(|_| kind != RecordingKind::Sensors) {
        bail!(
            "{}: {option} is for orientations of sensors (.sto with quaternions); this is another recording",
            args.recording().display()
        );
    }
    if args.smpl.is_some() && kind != RecordingKind::Smpl {
        bail!(
            "{}: --smpl gives a motion of the SMPL family (.npz) its lengths; this file has its own",
            args.recording().display()
        );
    }
    let source = match kind {
        RecordingKind::Coordinates => coordinates::read(args, &mut reading)?,
        RecordingKind::Markers => markers::read(args, &mut reading)?,
        RecordingKind::Skeleton => skeleton::read(args, &mut reading)?,
        RecordingKind::Smpl => skeleton::read_smpl(args, &mut reading)?,
        RecordingKind::Subject => subject::read(args, &mut reading)?,
        RecordingKind::Sensors => sensors::read(args, &mut reading)?,
    };
    let mut source = Source { device: read_device(args, &mut reading)?, ..source };
    if let (Recording::Markers(markers), Some(body)) = (&mut source.recording, &shared.body) {
        markers.body = MarkerBody::Calibrated(Box::new(body.clone()));
    }
    reading.read.extend(args.device.iter().chain(&args.thresholds).chain(&args.person).cloned());
    studied(args, source, reading)
}

/// The kinds of recording, by the extension of the file name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum RecordingKind {
    Coordinates,
    Markers,
    Skeleton,
    Smpl,
    Subject,
    Sensors,
}

impl RecordingKind {
    fn of(input: &Path, caller: &Caller) -> Result<RecordingKind> {
        let ending = files::ending(input);
        let found = match ending.as_str() {
            _ if input.as_os_str() == "-" => "standard input is not read".to_owned(),
            _ if input.is_dir() => "this is a folder".to_owned(),
            "" => "its name has no extension".to_owned(),
            other => format!("unknown kind of recording `.{other}`"),
        };
        match ending.as_str() {
            "csv" if files::read_table(caller, input).is_ok_and(|(table, _)| is_marker_table(&table)) => {
                Ok(RecordingKind::Markers)
            }
            "mot" | "sto" if sensors::is_recording(input, caller) => Ok(RecordingKind::Sensors),
            "mot" | "sto" | "csv" => Ok(RecordingKind::Coordinates),
            "c3d" | "trc" | "mvnx" => Ok(RecordingKind::Markers),
            "tsv" => {
                let bids = bids::read(caller, input)?;
                let has_markers = is_bids_markers(&bids.motion).with_context(|| input.display().to_string())?;
                Ok(if has_markers { RecordingKind::Markers } else { RecordingKind::Coordinates })
            }
            "bvh" => Ok(RecordingKind::Skeleton),
            "npz" => Ok(RecordingKind::Smpl),
            "b3d" => Ok(RecordingKind::Subject),
            _ => bail!(
                "{}: {found}; expected .c3d, .trc or .csv (markers), .mvnx (Xsens), .mot, .sto or .csv (coordinates), .sto with quaternions (sensors), _motion.tsv (BIDS), .bvh (a skeleton), .npz (a motion of the SMPL family) or .b3d (a subject of AddBiomechanics)",
                input.display()
            ),
        }
    }
}

/// Collected while the input files are read.
struct Reading {
    standing_trials: StandingTrials,
    models: Models,
    caller: Caller,
    findings: Findings,
    clock: Stopwatch,
    /// Every file that was read; none of them is overwritten.
    read: Vec<PathBuf>,
    /// The table of ground forces.
    ground: Option<PathBuf>,
    /// Set-ups of OpenSim's tools.
    setups: setup::Setups,
    /// Weights of the fit of markers that a set-up states.
    tracked: Option<TrackedTasks>,
}

fn studied(args: &ForcesArgs, source: Source, reading: Reading) -> Result<MotionRun> {
    let Reading { caller, mut findings, mut clock, read, ground, tracked, setups: _, standing_trials: _, models: _ } =
        reading;
    let mut settings = settings(args, tracked)?;
    settings.prediction.person = read_person(args, &caller)?;
    let mut watch = |stage: study::Stage| {
        clock.lap(stage.word());
        if caller.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let stated = match &source.recording {
        Recording::Markers(markers) => markers.trial.subject.clone(),
        Recording::Coordinates { .. }
        | Recording::Skeleton { .. }
        | Recording::Sensors(_)
        | Recording::Complete { .. } => SubjectParameters::default(),
    };
    let outcome = study::run_observed(source, &settings, &mut findings, &mut watch)
        .map_err(|error| errors::with_file(error, args, ground.as_deref()))?;
    let body = body_file(&outcome.body, &mut findings);
    let input = input(args, ground.as_deref(), stated, &outcome);
    Ok(MotionRun {
        outcome,
        input,
        convention: args.convention.into(),
        walk: None,
        files: body.into_iter().collect(),
        keep: Keep::of_names(&args.keep),
        more: Box::new(|_| Ok(Vec::new())),
        read,
        caller,
        options: options(args),
        findings,
        clock,
    })
}

/// The command with the options that matter for the results.
fn options(args: &ForcesArgs) -> String {
    let (output, replace, check, print) = Default::default();
    format!("forces {:?}", ForcesArgs { output, replace, check, print, ..args.clone() })
}

/// The body that was used as an OpenSim model; a note if it cannot be written.
fn body_file(model: &Model, findings: &mut Findings) -> Option<OutputFile<'static>> {
    match OutputFile::body("subject.osim", model) {
        Ok(file) => Some(file),
        Err(reason) => {
            findings.report(Code::SubjectNotWritten, format!("subject.osim was not written: {reason}"));
            None
        }
    }
}

/// The input files and options, for the summary.
fn input(args: &ForcesArgs, ground: Option<&Path>, stated: SubjectParameters, outcome: &Outcome) -> Input {
    let shown = |path: &Path| path.display().to_string();
    let is_measured = outcome.force_origin == ForceOrigin::Measured
        || outcome.prediction.as_ref().is_some_and(|prediction| prediction.measured.is_some());
    let is_subject = files::ending(args.recording()) == "b3d";
    let in_recording = ((outcome.tracking.is_some() || is_subject) && is_measured).then_some(args.recording());
    let of_trial = args.trial.as_ref().map_or_else(String::new, |trial| format!(", trial {trial}"));
    let own = if is_subject && !args.has_chosen_body() { subject::OWN_MODEL } else { ForcesArgs::BUILT_IN };
    Input {
        motion: format!("{}{of_trial}", shown(args.recording())),
        person: stated.name,
        recorded_on: stated.recorded_on,
        model: args.model_file().map_or(own.into(), shown),
        standing: args.subject.still.as_deref().map(shown),
        ground: ground.or(in_recording).map(shown),
        loads: args.loads.as_deref().map(shown),
        device: args.device.as_deref().map(shown),
        added_mass: args.add_mass.iter().map(ToString::to_string).collect(),
        ground_source: GroundSource::None,
    }
}

/// The model of a file, with the markers of `--marker-set`.
fn read_model(path: &Path, set: Option<&Path>, reading: &mut Reading) -> Result<Model> {
    let Reading { models, caller, findings, setups, read, .. } = reading;
    read.push(path.to_owned());
    read.extend(set.map(Path::to_owned));
    let from = ModelFiles {
        path: path.to_owned(),
        marker_set: set.map(Path::to_owned),
        without: setups.excluded_forces().to_vec(),
    };
    let model = models.get(from, findings, |findings| {
        let document = document_with_markers(path, set, caller, setups, findings)?;
        from_osim(&document, findings).with_context(|| path.display().to_string())
    })?;
    Ok(Model::clone(&model))
}

fn document_with_markers(
    path: &Path,
    set: Option<&Path>,
    caller: &Caller,
    setups: &setup::Setups,
    findings: &mut Findings,
) -> Result<OsimModel> {
    let document = document_of(path, caller, setups)?;
    let Some(set_path) = set else { return Ok(document) };
    let shown = set_path.display().to_string();
    let set = OsimMarkerSet::read(&files::read_input(caller, set_path)?).with_context(|| shown.clone())?;
    files::note_remarks(&shown, &set.remarks, findings);
    document.with_marker_set(&set).context(shown)
}

/// The document of a model, without the forces that a set-up excludes.
fn read_document(path: &Path, reading: &mut Reading) -> Result<OsimModel> {
    reading.read.push(path.to_owned());
    document_of(path, &reading.caller, &reading.setups)
}

fn document_of(path: &Path, caller: &Caller, setups: &setup::Setups) -> Result<OsimModel> {
    let mut document =
        OsimModel::read(&files::read_input(caller, path)?).with_context(|| path.display().to_string())?;
    setups.exclude_forces(&mut document);
    Ok(document)
}

/// The model in the content of an OpenSim file.
pub(crate) fn parse_model(bytes: &[u8], path: &Path, findings: &mut Findings) -> Result<Model> {
    let shown = || path.display().to_string();
    let document = OsimModel::read(bytes).with_context(shown)?;
    from_osim(&document, findings).with_context(shown)
}

fn added_mass(args: &ForcesArgs) -> Vec<AddedMass> {
    args.add_mass.iter().map(|added| added.0.clone()).collect()
}

fn read_device(args: &ForcesArgs, reading: &mut Reading) -> Result<Option<Table>> {
    let Some(path) = &args.device else { return Ok(None) };
    let (table, remarks) = files::read_table(&reading.caller, path)?;
    files::note_remarks(&path.display().to_string(), &remarks, &mut reading.findings);
    Ok(Some(table))
}

fn settings(args: &ForcesArgs, tracked: Option<TrackedTasks>) -> Result<Settings> {
    let low_pass = |cutoff_hz: Option<f64>| cutoff_hz.map(|cutoff_hz| LowPass { order: args.order, cutoff_hz });
    let smoother = match (args.filter, low_pass(args.cutoff().0)) {
        (Filter::Spline, _) => Smoother::Spline,
        (Filter::Butterworth, Some(filter)) => Smoother::Butterworth(filter),
        (Filter::Butterworth, None) => Smoother::Off,
    };
    let of_forces = args.force_cutoff.map(|cutoff| match cutoff {
        ForceCutoff::Same => low_pass(args.cutoff().0),
        ForceCutoff::Hz(hz) => low_pass(Some(hz)),
        ForceCutoff::Off => None,
    });
    let defaults = Settings::default();
    // A set-up asks for the fit of OpenSim.
    let has_setup = tracked.is_some();
    Ok(Settings {
        smoother,
        force_filter: of_forces
            .map_or(defaults.force_filter, |asked| asked.map_or(ForceFilter::Off, ForceFilter::LowPass)),
        comparison_filter: of_forces.unwrap_or(defaults.comparison_filter),
        window: Window { from_s: args.from, to_s: args.to },
        rate_hz: args.rate,
        // A calibration corrects predicted forces alone, so it asks for them.
        ground: match (args.no_ground, args.predict || args.person.is_some(), args.track) {
            (true, _, _) => GroundSettings::NoContact,
            (false, _, true) => GroundSettings::Tracked,
            (false, true, false) => GroundSettings::Predicted,
            (false, false, false) => GroundSettings::MeasuredOrPredicted,
        },
        marker_fit: FitSettings {
            // Stated weights are kept.
            outliers: if has_setup { OutlierDetection::Labels } else { defaults.marker_fit.outliers },
            weights: tracked.as_ref().map_or_else(BTreeMap::new, |tracked| tracked.weights.clone()),
            tasks: tracked.map_or_else(Vec::new, |tracked| tracked.tasks),
            longest_gap_s: args.subject.max_gap,
            method: match args.subject.fit {
                None if has_setup => FitMethod::Frames,
                None => defaults.marker_fit.method,
                Some(MarkerFitting::Frames) => FitMethod::Frames,
                Some(MarkerFitting::Trajectory) => FitMethod::Together(SmoothnessPrior::default()),
            },
            ..defaults.marker_fit
        },
        refit: args.refit,
        residual_reduction: args.consistent.map(|what| match what {
            Adjusted::Motion => Adjustable::Motion,
            Adjusted::Body => Adjustable::MotionAndBody,
        }),
        thresholds: read_thresholds(args.thresholds.as_deref())?,
        ..defaults
    })
}

/// The calibration of `--person`.
fn read_person(args: &ForcesArgs, caller: &Caller) -> Result<Option<PersonalErrors>> {
    let Some(path) = &args.person else { return Ok(None) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read_input(caller, path)?).with_context(shown)?;
    PersonalErrors::from_toml(&text).with_context(shown).map(Some)
}
