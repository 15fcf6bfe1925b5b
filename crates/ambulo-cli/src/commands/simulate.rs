//! `ambulo simulate`: simulates a scene file.

use super::report::{page_not_written, page_of_run};
use super::run_files::completion;
use super::stopwatch::Stopwatch;
use crate::args::SimulateArgs;
use crate::{Completion, files, printer};
use ambulo::analysis::feasibility::{Thresholds, VerdictState};
use ambulo::analysis::scene_verdict;
use ambulo::findings::Findings;
use ambulo::simulation::scene::{SavedState, Scene, SceneFile, SceneSettings};
use ambulo_report::{SceneCurves, scene_shapes};
use ambulo_results::{RunSummary, SceneExtremes, SceneInput, SceneTables, summary_json};
use anyhow::{Context, Result, bail};
use std::path::{Path, PathBuf};

/// More steps than this are a mistake of the user.
const MOST_STEPS: f64 = 1e9;

pub(crate) fn run(args: &SimulateArgs) -> Result<Completion> {
    let mut clock = Stopwatch::new();
    let mut findings = Findings::default();
    let mut input = SceneInput { scene: args.scene.display().to_string(), ..SceneInput::default() };
    let mut inputs = vec![args.scene.clone()];
    let mut scene = build(args, &mut inputs, &mut findings)?;
    input.files = inputs[1..].iter().map(|path| path.display().to_string()).collect();
    if let Some(path) = &args.resume {
        resume(&mut scene, path)?;
        inputs.push(path.clone());
        input.resumed = Some(path.display().to_string());
    }
    refuse_to_overwrite(args.save.as_deref(), &inputs)?;
    clock.lap("read");

    let (mut tables, mut extremes) = (SceneTables::new(&scene), SceneExtremes::default());
    let mut curves = args.plot.then(SceneCurves::default);
    let statistics = scene
        .run(&mut findings, |frame| {
            tables.add(frame);
            extremes.add(frame);
            if let Some(curves) = &mut curves {
                curves.add(frame);
            }
        })
        .with_context(|| args.scene.display().to_string())?;
    clock.lap("simulate");

    let verdict = scene_verdict(&scene, &Thresholds::default(), &mut findings)?;
    let state = verdict.as_ref().map_or(VerdictState::Feasible, |verdict| verdict.state);
    clock.lap("feasibility");

    let mut written = tables.files(&scene)?;
    if scene.outputs().poses {
        written.push(scene_shapes(&scene)?);
    }
    if let Some(curves) = &curves {
        written.extend(curves.files(&scene, verdict.as_ref())?);
    }
    files::replace_results(&args.output, &written, &inputs)?;
    if let Some(path) = &args.save {
        write_json(path, &scene.save())?;
    }
    clock.lap("write");
    let mut summary = extremes.summary(&scene, &statistics, input, &findings);
    summary.verdict = verdict;
    summary.timing_ms = clock.into_laps();
    let page = page_of_run(&args.output, &written, RunSummary::Scene(Box::new(summary.clone())));
    match page {
        Ok(page) => files::write(&args.output.join(&page.name), &page.bytes)?,
        Err(reason) => summary.findings.push(page_not_written(&reason)),
    }
    write_json(&args.output.join("summary.json"), &summary)?;
    printer::simulate(&summary, &args.output, args.print)?;
    Ok(completion(state, args.check))
}

/// Builds the scene and reads every file that it names; adds their paths to `inputs`.
fn build(args: &SimulateArgs, inputs: &mut Vec<PathBuf>, findings: &mut Findings) -> Result<Scene> {
    let shown = || args.scene.display().to_string();
    let bytes = files::read(&args.scene)?;
    let text = String::from_utf8(bytes).map_err(|e| {
        anyhow::anyhow!("{}: byte {} is not UTF-8; expected a scene in TOML", shown(), e.utf8_error().valid_up_to())
    })?;
    let file = SceneFile::parse(&text).with_context(shown)?;
    let changes = SceneSettings { step_s: args.step, duration_s: args.duration };
    let (step_s, end_s) = (args.step.unwrap_or(file.step_s), args.duration.unwrap_or(file.duration_s));
    if step_s > end_s || end_s / step_s > MOST_STEPS {
        bail!("{}: the time step is {step_s} s, the duration {end_s} s; expected 1 to 1e9 time steps", shown());
    }
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    let mut load = |path: &str| {
        let path = folder.join(path);
        let bytes = files::read(&path).map_err(|error| error.to_string())?;
        inputs.push(path);
        Ok(bytes)
    };
    Scene::build(&file, changes, &mut load, findings).with_context(shown)
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

fn refuse_to_overwrite(save: Option<&Path>, inputs: &[PathBuf]) -> Result<()> {
    let Some(save) = save else { return Ok(()) };
    let same = |path: &PathBuf| path.canonicalize().is_ok_and(|path| save.canonicalize().is_ok_and(|s| s == path));
    if inputs.iter().any(same) {
        bail!("{}: this input file would be overwritten. hint: choose another name for --save", save.display());
    }
    Ok(())
}

fn write_json(path: &Path, content: &impl serde::Serialize) -> Result<()> {
    files::write(path, &summary_json(content)?)
}
