//! `ambulo forces`: a recording in, joint moments, powers, reactions and ground forces out.

mod agreed;
mod coordinates;
mod ground_table;
mod marker_ground;
mod markers;
mod prediction;
mod skeleton;

use super::outcome::{Outcome, read_thresholds};
use super::stopwatch::Stopwatch;
use crate::args::{AddedMass, Filter, ForcesArgs};
use crate::{Verdict, files};
use ambulo::analysis::feasibility::{Person, Thresholds};
use ambulo::analysis::{
    Analysis, AnalysisError, BodyInMotion, Event, GroundAgreement, PredictedAnalysis, PredictionChecks, Settings,
    analyse,
};
use ambulo::findings::{Code, Findings};
use ambulo::model::{Model, from_osim, to_osim};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{DeviceRecording, ForceRecording, Motion, Smoother, Window, device_from_table};
use ambulo_formats::osim::OsimModel;
use ambulo_results::{Input, OutputFile, SubjectSummary};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &ForcesArgs) -> Result<Verdict> {
    if let (Some(from), Some(to)) = (args.from, args.to)
        && from > to
    {
        bail!("--from {from} is after --to {to}; expected a range of time that runs forwards");
    }
    let mut reading =
        Reading { findings: Findings::default(), clock: Stopwatch::new(), read: vec![args.input.clone()] };
    let recorded = match Kind::of(&args.input)? {
        Kind::Coordinates => coordinates::read(args, &mut reading)?,
        Kind::Markers => markers::read(args, &mut reading)?,
        Kind::Skeleton => skeleton::read(args, &mut reading)?,
    };
    let device = read_device(args, &recorded.model, &mut reading)?;
    let thresholds = read_thresholds(args.thresholds.as_deref())?;
    reading.read.extend(args.device.iter().chain(&args.thresholds).cloned());
    compute(args, recorded, device, &thresholds, reading)
}

/// What kind of recording a file is, by the ending of its name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Coordinates,
    Markers,
    Skeleton,
}

impl Kind {
    fn of(input: &Path) -> Result<Kind> {
        let ending = files::ending(input);
        let found = match ending.as_str() {
            _ if input.as_os_str() == "-" => "standard input is not read".to_owned(),
            _ if input.is_dir() => "this is a folder".to_owned(),
            "" => "its name has no ending that says what it is".to_owned(),
            other => format!("unknown kind of recording `.{other}`"),
        };
        match ending.as_str() {
            "mot" | "sto" | "csv" => Ok(Kind::Coordinates),
            "c3d" | "trc" => Ok(Kind::Markers),
            "bvh" => Ok(Kind::Skeleton),
            _ => bail!(
                "{}: {found}; expected .c3d or .trc (markers), .mot, .sto or .csv (coordinates) or .bvh (a skeleton)",
                input.display()
            ),
        }
    }
}

/// What accompanies the reading of files.
struct Reading {
    findings: Findings,
    clock: Stopwatch,
    /// Every file that was read; none of them is written over.
    read: Vec<PathBuf>,
}

/// A recording, whatever it was made with: a body, its motion, and the forces under its feet.
struct Recorded {
    model: Model,
    motion: Motion,
    plates: Vec<ForceRecording>,
    person: Person,
    input: Input,
    /// What else is known of it.
    origin: Origin,
    /// Whether somebody states the body mass, rather than the model alone.
    mass_is_stated: bool,
}

/// What came out of it.
struct Computed {
    analysis: Analysis,
    subject: Option<SubjectSummary>,
    checks: Option<PredictionChecks>,
    comparison: Option<GroundAgreement>,
    files: Vec<OutputFile>,
}

/// What a recording was made with.
enum Origin {
    Coordinates,
    Markers(Box<Followed>),
    Skeleton(Box<SubjectSummary>),
}

/// A body that followed markers, and what its files say besides.
struct Followed {
    body: BodyInMotion,
    /// Foot strikes and toe-offs that the file lists.
    listed: Vec<Event>,
    /// What plates carried while the person stood [kg].
    standing_kg: Option<f64>,
}

impl Origin {
    /// Adds to an analysis what is known besides forces and motion.
    fn complete(&self, analysis: &mut Analysis) -> Option<SubjectSummary> {
        match self {
            Origin::Coordinates => None,
            Origin::Skeleton(summary) => Some(*summary.clone()),
            Origin::Markers(followed) => {
                let Followed { body, listed, standing_kg } = &**followed;
                let seen = if listed.is_empty() { &body.feet.events } else { listed };
                let measured = match body.on_plates.contacts.is_empty() {
                    true => {
                        analysis.add_events(seen);
                        Vec::new()
                    }
                    false => {
                        let measured = body.measured_events();
                        analysis.take_events(&measured, &body.events(seen));
                        measured
                    }
                };
                let summary = SubjectSummary::of_markers(body, listed, &measured);
                if let Some(measured) = self.instrumented() {
                    let gravity = body.subject.model.gravity();
                    analysis.weigh_within(measured, -gravity.normalize(), gravity.norm());
                }
                if let Some(standing_kg) = standing_kg {
                    analysis.weigh_standing(*standing_kg);
                }
                Some(summary)
            }
        }
    }

    /// How markers became a body, where there are any, and what completes the forces that plates measured beside a prediction.
    fn complete_prediction(&self, predicted: &mut PredictedAnalysis) -> Option<SubjectSummary> {
        match (&mut predicted.measured, self) {
            (Some(measured), _) => self.complete(measured),
            (None, Origin::Coordinates) => None,
            (None, Origin::Skeleton(summary)) => Some(*summary.clone()),
            (None, Origin::Markers(followed)) => {
                Some(SubjectSummary::of_markers(&followed.body, &followed.listed, &[]))
            }
        }
    }

    /// What plates carried in a standing trial [kg].
    fn standing_kg(&self) -> Option<f64> {
        match self {
            Origin::Markers(followed) => followed.standing_kg,
            Origin::Coordinates | Origin::Skeleton(_) => None,
        }
    }

    /// Whether the directions of both feet are known.
    fn shows_both_feet(&self) -> bool {
        match self {
            Origin::Markers(followed) => followed.body.feet.feet_without_markers.is_empty(),
            Origin::Coordinates | Origin::Skeleton(_) => true,
        }
    }

    /// The time to analyse when nobody says: all of it, or the longest time without a gap in what the markers tell.
    fn known(&self, findings: &mut Findings) -> Window {
        let Origin::Markers(followed) = self else { return Window::default() };
        let Some([from, to]) = followed.body.longest_known_s() else { return Window::default() };
        let message =
            format!("markers are missing for too long outside of {from:.3} to {to:.3} s; only this time was analysed");
        findings.report(Code::MarkersWindow, message);
        Window { from_s: Some(from), to_s: Some(to) }
    }

    /// The longest time during which plates measured all that the ground did.
    fn instrumented(&self) -> Option<Window> {
        let Origin::Markers(followed) = self else { return None };
        let [from, to] = *followed.body.on_plates.windows.first()?;
        Some(Window { from_s: Some(from), to_s: Some(to) })
    }
}

/// The body that was used, for OpenSim, for later runs and for pictures. What cannot be written is noted.
fn body_file(model: &Model, findings: &mut Findings) -> Option<OutputFile> {
    match to_osim(model).map_err(anyhow::Error::new).and_then(|document| Ok(document.write()?)) {
        Ok(bytes) => Some(OutputFile { name: "subject.osim".to_owned(), bytes }),
        Err(reason) => {
            findings.report(Code::SubjectNotWritten, format!("subject.osim was not written: {reason:#}"));
            None
        }
    }
}

fn compute(
    args: &ForcesArgs,
    mut recorded: Recorded,
    device: Option<DeviceRecording>,
    thresholds: &Thresholds,
    reading: Reading,
) -> Result<Verdict> {
    let Reading { mut findings, mut clock, read } = reading;
    let mut settings = Settings { instrumented: recorded.origin.instrumented(), ..settings(args) };
    if settings.window == Window::default() {
        settings.window = recorded.origin.known(&mut findings);
    }
    let computed = if prediction::is_wanted(args, &recorded) {
        settings.force_filter = prediction::plates_filter(args).filter(|_| !recorded.plates.is_empty());
        prediction::compute(&mut recorded, settings, thresholds, &mut findings, &mut clock)
    } else {
        by_plates(&recorded, settings, &mut findings, &mut clock)
    };
    let Recorded { mut model, person, input, mass_is_stated, .. } = recorded;
    let Computed { mut analysis, subject, checks, comparison, mut files } =
        computed.map_err(|error| name_the_file(error, &input))?;
    let consistency = agreed::agree(args, &mut model, &mut analysis, &input, &settings, &mut findings)?;
    clock.lap("consistency");
    files.extend(body_file(&model, &mut findings));
    if let Some(device) = &device {
        device.report_cover(analysis.trajectory.grid(), &mut findings);
    }
    let device = device.map(|d| d.on(analysis.trajectory.grid()));
    let outcome = Outcome {
        model: &model,
        settings: &settings,
        thresholds,
        input: &input,
        person,
        device: device.as_deref(),
        read: &read,
        walk: None,
        consistency,
        subject,
        checks,
        comparison,
        mass_is_stated,
        files,
    };
    outcome.write(analysis, findings, clock, &args.output, args.voice)
}

/// With the forces that plates measured, or with none.
fn by_plates(
    recorded: &Recorded,
    settings: Settings,
    findings: &mut Findings,
    clock: &mut Stopwatch,
) -> Result<Computed, AnalysisError> {
    let Recorded { model, motion, plates, origin, .. } = recorded;
    let mut analysis = analyse(model, motion, plates, settings, findings, &mut |stage| clock.lap(stage))?;
    let subject = origin.complete(&mut analysis);
    Ok(Computed { analysis, subject, checks: None, comparison: None, files: Vec::new() })
}

/// The error with the file that it is about.
fn name_the_file(error: AnalysisError, input: &Input) -> anyhow::Error {
    let file = match error {
        AnalysisError::Ground(_) => input.ground.clone().unwrap_or_default(),
        _ => input.motion.clone(),
    };
    anyhow::Error::new(error).context(file)
}

fn read_model(path: &Path, args: &ForcesArgs, reading: &mut Reading) -> Result<Model> {
    let shown = || path.display().to_string();
    let document = OsimModel::read(&files::read(path)?).with_context(shown)?;
    reading.read.push(path.to_owned());
    loaded(from_osim(&document, &mut reading.findings).with_context(shown)?, args)
}

/// The body with what it carries.
fn loaded(model: Model, args: &ForcesArgs) -> Result<Model> {
    args.add_mass.iter().try_fold(model, |model, added| carry(&model, added))
}

fn carry(model: &Model, added: &AddedMass) -> Result<Model> {
    let Some(body) = model.body(&added.body) else {
        let known: Vec<_> = model.bodies().iter().map(|b| b.name.as_str()).collect();
        bail!("--add-mass: the model has no body `{}`; expected one of {}", added.body, known.join(", "));
    };
    model.with_point_mass(body, added.mass_kg, added.place_m).context("--add-mass")
}

fn read_device(args: &ForcesArgs, model: &Model, reading: &mut Reading) -> Result<Option<DeviceRecording>> {
    let Some(path) = &args.device else { return Ok(None) };
    let shown = path.display().to_string();
    let (table, remarks) = files::read_table(path)?;
    files::note_remarks(&shown, &remarks, &mut reading.findings);
    device_from_table(model, &table, &mut reading.findings).map(Some).context(shown)
}

fn settings(args: &ForcesArgs) -> Settings {
    let low_pass = |cutoff_hz: Option<f64>| cutoff_hz.map(|cutoff_hz| LowPass { order: args.order, cutoff_hz });
    let smoother = match (args.filter, low_pass(args.cutoff.0)) {
        (Filter::Spline, _) => Smoother::Spline,
        (Filter::Butterworth, Some(filter)) => Smoother::Butterworth(filter),
        (Filter::Butterworth, None) => Smoother::Off,
    };
    let force_filter = low_pass(args.force_cutoff.unwrap_or(args.cutoff).0);
    Settings {
        smoother,
        force_filter,
        window: Window { from_s: args.from, to_s: args.to },
        rate_hz: args.rate,
        instrumented: None,
    }
}
