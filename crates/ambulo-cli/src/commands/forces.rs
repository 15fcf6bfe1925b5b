//! `ambulo forces`: a recording in, joint moments, powers, reactions and ground forces out.

use super::ground_input::{self, GroundTable};
use super::outcome::{Outcome, read_thresholds};
use super::stopwatch::Stopwatch;
use crate::args::{AddedMass, Filter, ForcesArgs, Voice};
use crate::{Verdict, files};
use ambulo::analysis::feasibility::{Person, Thresholds};
use ambulo::analysis::{AnalysisError, Settings, analyse};
use ambulo::findings::Findings;
use ambulo::model::{Model, from_osim};
use ambulo::motion::filter::LowPass;
use ambulo::motion::{
    DeviceRecording, ForceRecording, Motion, Smoother, Window, coordinates_from_table, device_from_table,
    force_recordings,
};
use ambulo::report::{GroundSource, Input};
use ambulo_formats::osim::OsimModel;
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

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
struct Recording {
    model: Model,
    motion: Motion,
    plates: Vec<ForceRecording>,
    device: Option<DeviceRecording>,
    settings: Settings,
    thresholds: Thresholds,
    input: Input,
    /// Every file that was read; none of them is written over.
    read: Vec<PathBuf>,
}

fn compute(
    recording: &Recording,
    mut findings: Findings,
    mut clock: Stopwatch,
    output: &Path,
    voice: Voice,
) -> Result<Verdict> {
    let Recording { model, motion, plates, device, settings, thresholds, input, read } = recording;
    let analysis = analyse(model, motion, plates, *settings, &mut findings, &mut |stage| clock.lap(stage))
        .map_err(|error| name_the_file(error, input))?;
    if let Some(device) = device {
        device.report_cover(analysis.trajectory.grid(), &mut findings);
    }
    let device = device.as_ref().map(|d| d.on(analysis.trajectory.grid()));
    let (person, device) = (Person::of_model(model), device.as_deref());
    let outcome = Outcome { model, settings, thresholds, input, person, device, read, walk: None };
    outcome.write(analysis, findings, clock, output, voice)
}

/// The error with the file that it is about.
fn name_the_file(error: AnalysisError, input: &Input) -> anyhow::Error {
    let file = match error {
        AnalysisError::Ground(_) => input.ground.clone().unwrap_or_default(),
        _ => input.motion.clone(),
    };
    anyhow::Error::new(error).context(file)
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
