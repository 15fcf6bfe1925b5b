//! `ambulo forces`: a recording in, joint moments, powers, reactions and ground forces out.

use super::ground_input::{self, GroundTable};
use crate::args::{AddedMass, Filter, ForcesArgs, Voice};
use crate::{Verdict, files, printer};
use ambulo::analysis::feasibility::{self, Evidence, Person, Thresholds};
use ambulo::analysis::{Analysis, AnalysisError, Settings, analyse};
use ambulo::findings::Findings;
use ambulo::model::{Model, from_osim};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{
    DeviceRecording, ForceRecording, Motion, Smoother, Window, coordinates_from_table, device_from_table,
    force_recordings,
};
use ambulo::report::{GroundSource, Input, Summary, output_files, summary};
use ambulo_formats::osim::OsimModel;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};
use std::time::Instant;

pub(crate) fn run(args: &ForcesArgs) -> Result<Verdict> {
    if let (Some(from), Some(to)) = (args.from, args.to)
        && from > to
    {
        bail!("--from {from} is after --to {to}; expected a range of time that runs forwards");
    }
    refuse_other_inputs(&args.input)?;
    let mut findings = Findings::default();
    let mut clock = Stopwatch::new();
    let model = read_model(args, &mut findings)?;
    clock.lap("read_model");
    let motion = read_motion(&model, &args.input, &mut findings)?;
    clock.lap("read_motion");
    let (ground, plates) = read_ground(args, &model, &mut findings)?;
    let device = read_device(args, &model, &mut findings)?;
    clock.lap("read_forces");
    let thresholds = read_thresholds(args.thresholds.as_deref())?;
    let input = Input {
        motion: args.input.display().to_string(),
        model: args.model.display().to_string(),
        ground: ground.as_ref().map(|g| g.path.display().to_string()),
        loads: args.loads.as_ref().map(|p| p.display().to_string()),
        device: args.device.as_ref().map(|p| p.display().to_string()),
        added_mass: args.add_mass.iter().map(ToString::to_string).collect(),
        ground_source: if args.no_ground { GroundSource::None } else { GroundSource::Measured },
    };
    let optional =
        [Some(&args.input), Some(&args.model), args.loads.as_ref(), args.device.as_ref(), args.thresholds.as_ref()];
    let read = optional.into_iter().flatten().cloned().chain(ground.map(|g| g.path)).collect();
    let recording = Recording { model, motion, plates, device, settings: settings(args), thresholds, input, read };
    compute(&recording, findings, clock, &args.output, args.voice)
}

/// Everything that was read.
pub(super) struct Recording {
    pub(super) model: Model,
    pub(super) motion: Motion,
    pub(super) plates: Vec<ForceRecording>,
    pub(super) device: Option<DeviceRecording>,
    pub(super) settings: Settings,
    pub(super) thresholds: Thresholds,
    pub(super) input: Input,
    /// Every file that was read; none of them is written over.
    pub(super) read: Vec<PathBuf>,
}

/// Computes, writes and reports: what `forces` and `demo` share.
pub(super) fn compute(
    recording: &Recording,
    mut findings: Findings,
    mut clock: Stopwatch,
    output: &Path,
    voice: Voice,
) -> Result<Verdict> {
    let Recording { model, motion, plates, device, settings, thresholds, input, read: inputs } = recording;
    let mut analysis = analyse(model, motion, plates, *settings, &mut findings, &mut |stage| clock.lap(stage))
        .map_err(|error| name_the_file(error, input))?;
    if let Some(device) = device {
        device.report_cover(analysis.trajectory.grid(), &mut findings);
    }
    if analysis.cycles.is_empty() {
        findings.note("cycles.none", "no whole gait cycle in the window: cycles.csv and the figure were not written");
    }
    let device = device.as_ref().map(|d| d.on(analysis.trajectory.grid()));
    let feasible = judge(model, &mut analysis, device.as_deref(), thresholds, &mut findings);
    clock.lap("feasibility");
    let written = output_files(model, &analysis, device.as_deref())?;
    files::replace_results(output, &written, inputs)?;
    clock.lap("write");
    let mut summary = summary(model, &analysis, settings, input.clone(), &findings);
    summary.timing_ms = clock.laps.into_iter().collect();
    write_summary(output, &summary)?;
    printer::forces(&summary, output, voice)?;
    Ok(if feasible { Verdict::Accepted } else { Verdict::Refused })
}

/// Whether a person could do this; the verdict stays with the analysis.
fn judge(
    model: &Model,
    analysis: &mut Analysis,
    device: Option<&[Vec<f64>]>,
    thresholds: &Thresholds,
    findings: &mut Findings,
) -> bool {
    let Analysis { trajectory, forces, ground, .. } = &*analysis;
    let evidence = Evidence { model, trajectory, forces, ground, device };
    let verdict = feasibility::check(&evidence, &Person::of_model(model), thresholds, findings);
    analysis.verdict.insert(verdict).feasible
}

/// The thresholds of a file, or the built-in ones.
pub(super) fn read_thresholds(path: Option<&Path>) -> Result<Thresholds> {
    let Some(path) = path else { return Ok(Thresholds::default()) };
    let shown = || path.display().to_string();
    let text = String::from_utf8(files::read(path)?).with_context(shown)?;
    Thresholds::from_toml(&text).with_context(shown)
}

/// The error with the file that it is about.
fn name_the_file(error: AnalysisError, input: &Input) -> anyhow::Error {
    let file = match error {
        AnalysisError::Ground(_) => input.ground.clone().unwrap_or_default(),
        _ => input.motion.clone(),
    };
    anyhow::Error::new(error).context(file)
}

fn write_summary(output: &Path, summary: &Summary) -> Result<()> {
    let mut json = serde_json::to_vec_pretty(summary)?;
    json.push(b'\n');
    files::write(&output.join("summary.json"), &json)
}

/// Measures how long each stage took.
pub(super) struct Stopwatch {
    last: Instant,
    laps: Vec<(String, f64)>,
}

impl Stopwatch {
    pub(super) fn new() -> Stopwatch {
        Stopwatch { last: Instant::now(), laps: Vec::new() }
    }

    /// What each stage took [ms].
    pub(super) fn into_laps(self) -> std::collections::BTreeMap<String, f64> {
        self.laps.into_iter().collect()
    }

    pub(super) fn lap(&mut self, stage: &str) {
        let now = Instant::now();
        self.laps.push((stage.to_owned(), 1e3 * (now - self.last).as_secs_f64()));
        self.last = now;
    }
}

fn refuse_other_inputs(input: &Path) -> Result<()> {
    let ending = input.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let shown = input.display();
    match ending.as_str() {
        "trc" => bail!(
            "{shown}: markers are not fitted yet; expected recorded coordinates (.mot or .sto). hint: OpenSim's inverse kinematics makes them from a .trc"
        ),
        "c3d" => bail!(
            "{shown}: C3D is not read yet; expected recorded coordinates (.mot or .sto). hint: convert it to .trc and let OpenSim's inverse kinematics make them"
        ),
        "bvh" => bail!("{shown}: BVH is not read yet; expected recorded coordinates (.mot or .sto)"),
        _ => {}
    }
    Ok(())
}

fn read_model(args: &ForcesArgs, findings: &mut Findings) -> Result<Model> {
    let shown = || args.model.display().to_string();
    let document = OsimModel::read(&files::read(&args.model)?).with_context(shown)?;
    let mut model = from_osim(&document, findings).with_context(shown)?;
    for added in &args.add_mass {
        model = carry(&model, added)?;
    }
    Ok(model)
}

fn carry(model: &Model, added: &AddedMass) -> Result<Model> {
    let Some(body) = model.body(&added.body) else {
        let known: Vec<_> = model.bodies().iter().map(|b| b.name.as_str()).collect();
        bail!("--add-mass: the model has no body `{}`; expected one of {}", added.body, known.join(", "));
    };
    model.with_point_mass(body, added.mass_kg, added.place_m).context("--add-mass")
}

fn read_motion(model: &Model, path: &Path, findings: &mut Findings) -> Result<Motion> {
    let shown = path.display().to_string();
    let (table, remarks) = files::read_table(path)?;
    files::note_remarks(&shown, &remarks, findings);
    coordinates_from_table(model, &table, &shown, findings).context(shown)
}

fn read_ground(
    args: &ForcesArgs,
    model: &Model,
    findings: &mut Findings,
) -> Result<(Option<GroundTable>, Vec<ForceRecording>)> {
    if args.no_ground {
        return Ok((None, Vec::new()));
    }
    let ground = ground_input::read(args, model, findings)?;
    let shown = || match &args.loads {
        Some(loads) => format!("{} with {}", ground.path.display(), loads.display()),
        None => ground.path.display().to_string(),
    };
    let plates = force_recordings(model, &ground.loads, &ground.table, findings).with_context(shown)?;
    Ok((Some(ground), plates))
}

fn read_device(args: &ForcesArgs, model: &Model, findings: &mut Findings) -> Result<Option<DeviceRecording>> {
    let Some(path) = &args.device else { return Ok(None) };
    let shown = path.display().to_string();
    let (table, remarks) = files::read_table(path)?;
    files::note_remarks(&shown, &remarks, findings);
    device_from_table(model, &table, findings).map(Some).context(shown)
}

fn settings(args: &ForcesArgs) -> Settings {
    let low_pass = |cutoff_hz: Option<f64>| cutoff_hz.map(|cutoff_hz| LowPass { order: args.order, cutoff_hz });
    let smoother = match (args.filter, low_pass(args.cutoff.0)) {
        (Filter::Spline, _) => Smoother::Spline,
        (Filter::Butterworth, Some(filter)) => Smoother::Butterworth(filter),
        (Filter::Butterworth, None) => Smoother::Off,
    };
    let force_filter = low_pass(args.force_cutoff.unwrap_or(args.cutoff).0);
    Settings { smoother, force_filter, window: Window { from_s: args.from, to_s: args.to }, rate_hz: args.rate }
}
