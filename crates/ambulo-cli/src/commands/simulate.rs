//! `ambulo simulate`: simulates a scene file.

use super::report::{page_not_written, page_of_run};
use super::run_files::completion;
use super::stopwatch::Stopwatch;
use crate::args::{PrintArgs, SimulateArgs};
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::{Thresholds, VerdictState};
use ambulo::findings::Findings;
use ambulo::simulation::scene::{SavedState, Scene, SceneFile, SceneSettings};
use ambulo::simulation::{SceneVerdict, scene_verdict, scene_walked};
use ambulo_report::{SceneCurves, scene_shapes};
use ambulo_results::{
    Keep, OutputFile, PAGE, RunSummary, SceneExtremes, SceneInput, SceneSummary, SceneTables, TIMINGS, summary_json,
};
use anyhow::{Context, Result, bail};
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

pub(crate) fn run(args: &SimulateArgs) -> Result<Completion> {
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let run = compute(args, &Caller::default())?;
    let summary = run.save(&target, args.print)?;
    if let Some(path) = &args.save {
        files::write(path, &summary_json(&run.state)?)?;
    }
    printer::simulate(&summary, &run.clock.laps(), target.folder(), args.print)?;
    let state = summary.verdict.as_ref().map_or(VerdictState::Feasible, |verdict| verdict.state);
    Ok(completion(state == VerdictState::Infeasible, args.check))
}

/// A simulated scene, with everything that is written to the result folder.
pub(crate) struct SceneRun {
    pub(super) written: Vec<OutputFile<'static>>,
    /// Without the list of files.
    pub(super) summary: SceneSummary,
    /// State from which the simulation continues.
    state: SavedState,
    keep: Keep,
    /// Every file that was read; the scene is the first.
    inputs: Vec<PathBuf>,
    caller: Caller,
    options: String,
    pub(super) clock: Stopwatch,
}

impl SceneRun {
    /// Writes all files; the durations only if they are not to be left out.
    pub(super) fn save(&self, target: &ResultTarget, print: PrintArgs) -> Result<SceneSummary> {
        let mut written: Vec<OutputFile<'_>> = self.written.iter().map(OutputFile::borrowed).collect();
        let mut summary = self.summary.clone();
        if self.keep.includes(PAGE) {
            match page_of_run(target.folder(), &written, RunSummary::Scene(Box::new(summary.clone()))) {
                Ok(page) => written.push(page),
                Err(reason) => summary.findings.push(page_not_written(&reason)),
            }
        }
        written.retain(|file| self.keep.includes(&file.name));
        summary.run_id = run_id(&self.options, &self.inputs, &self.caller)?;
        if self.keep.includes(TIMINGS) && !print.quiet {
            written.push(self.clock.file(&summary.run_id)?);
        }
        target.replace(&written, &self.inputs, &mut |files| {
            summary.files = files;
            Ok(summary_json(&summary)?)
        })?;
        Ok(summary)
    }
}

/// Reads a scene and simulates it.
pub(crate) fn compute(args: &SimulateArgs, caller: &Caller) -> Result<SceneRun> {
    let mut clock = Stopwatch::new();
    let keep = Keep::of_names(&args.keep);
    let mut findings = Findings::default();
    let mut input = SceneInput { scene: args.scene.display().to_string(), ..SceneInput::default() };
    let mut inputs = vec![args.scene.clone()];
    let mut scene = build(args, caller, &mut inputs, &mut findings)?;
    input.files = inputs[1..].iter().map(|path| path.display().to_string()).collect();
    if let Some(path) = &args.resume {
        resume(&mut scene, path)?;
        inputs.push(path.clone());
        input.resumed = Some(path.display().to_string());
    }
    if let Some(save) = &args.save {
        files::check_target(save, &inputs, args.replace.existing())?;
    }
    // Before the run: a figure that falls gets further surfaces, which are the shapes that it already has.
    let shapes = scene.outputs().poses.then(|| scene_shapes(&scene)).transpose()?;
    clock.lap("read");

    let (mut tables, mut extremes) = (SceneTables::new(&scene), SceneExtremes::default());
    let mut curves = keep.includes("figures/").then(SceneCurves::default);
    let statistics = scene
        .run_while(&mut findings, |frame| {
            tables.add(frame);
            extremes.add(frame);
            if let Some(curves) = &mut curves {
                curves.add(frame);
            }
            if caller.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        })
        .with_context(|| args.scene.display().to_string())?;
    clock.lap("simulate");

    let verdict = scene_verdict(&scene, &Thresholds::default(), &mut findings)?;
    clock.lap("feasibility");

    let mut written = scene_files(&scene, tables, curves.as_ref(), verdict.as_ref())?;
    written.extend(shapes);
    clock.lap("tables");
    let mut summary = extremes.summary(&scene, &statistics, input, &findings);
    summary.walked = scene_walked(&scene)?;
    summary.verdict = verdict;
    let (state, options, caller) = (scene.save(), options(args), caller.clone());
    Ok(SceneRun { written, summary, state, keep, inputs, caller, options, clock })
}

/// Tables and figures.
fn scene_files(
    scene: &Scene,
    tables: SceneTables,
    curves: Option<&SceneCurves>,
    verdict: Option<&SceneVerdict>,
) -> Result<Vec<OutputFile<'static>>> {
    let mut written = tables.files(scene)?;
    if let Some(curves) = curves {
        written.extend(curves.files(scene, verdict)?);
    }
    Ok(written)
}

/// Builds the scene and reads every file that it names; adds their paths to `inputs`.
fn build(args: &SimulateArgs, caller: &Caller, inputs: &mut Vec<PathBuf>, findings: &mut Findings) -> Result<Scene> {
    let file = read_scene(&args.scene, caller)?;
    let print = args.print;
    let observer = caller.observer(move |steps| printer::solver_steps(Some(steps), print));
    let changes = SceneSettings { step_s: args.step, duration_s: args.duration, observer };
    let mut load = |path: &str| read_named(&args.scene, path, caller, inputs);
    let scene = Scene::build(&file, changes, &mut load, findings);
    printer::solver_steps(None, print);
    scene.with_context(|| args.scene.display().to_string())
}

/// Reads a scene file.
pub(super) fn read_scene(scene: &Path, caller: &Caller) -> Result<SceneFile> {
    let shown = || scene.display().to_string();
    let text = String::from_utf8(files::read_input(caller, scene)?).map_err(|e| {
        anyhow::anyhow!("{}: byte {} is not UTF-8; expected a scene in TOML", shown(), e.utf8_error().valid_up_to())
    })?;
    SceneFile::parse(&text).with_context(shown)
}

/// Reads a file that a scene names, whose path is relative to it, and adds its path to `inputs`.
pub(super) fn read_named(
    scene: &Path,
    path: &str,
    caller: &Caller,
    inputs: &mut Vec<PathBuf>,
) -> Result<Vec<u8>, String> {
    let path = scene.parent().unwrap_or(Path::new("")).join(path);
    let bytes = files::read_input(caller, &path).map_err(|error| error.to_string())?;
    inputs.push(path);
    Ok(bytes)
}

fn resume(scene: &mut Scene, path: &Path) -> Result<()> {
    let shown = || path.display().to_string();
    let saved: SavedState = serde_json::from_slice(&files::read(path)?)
        .with_context(|| format!("{}: this file was not written by `ambulo simulate --save`", shown()))?;
    scene.resume(&saved).with_context(shown)?;
    if scene.steps_made() >= scene.steps_in_all() {
        bail!(
            "{}: the state is at {} s, but the scene ends at {} s. hint: --duration sets a later end",
            shown(),
            scene.state().time_s,
            scene.duration_s()
        );
    }
    Ok(())
}

/// The command with the options that matter for the results.
fn options(args: &SimulateArgs) -> String {
    let (output, replace, check, print) = Default::default();
    format!("simulate {:?}", SimulateArgs { output, replace, check, print, save: None, ..args.clone() })
}
