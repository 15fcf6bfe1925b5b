//! `ambulo reproduce`: recomputes the claims and figures of the 1997 paper.

use crate::args::ReproduceArgs;
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, files, printer};
use ambulo_paper::{
    Claim, CorrectedMode, Evidence, Mode, NAMED, ReproductionError, Run, Scope, Sensitivity, Setting, TrialSettings,
    add_experiments, claims, sensitivities,
};
use ambulo_report::{reproduction_files, reproduction_page};
use ambulo_results::{CLAIMS, Keep, OutputFile, summary_json};
use anyhow::{Context, Result, bail};
use serde_json::json;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Why nothing was written.
const STOPPED: &str = "the computation was stopped; nothing was written";

pub(crate) fn run(args: &ReproduceArgs, caller: &Caller) -> Result<Completion> {
    let setting = args.setting.as_deref().map_or_else(|| Ok(Setting::papers_results()?), read_setting)?;
    if let Some(path) = &args.write_setting {
        let inputs: Vec<PathBuf> = args.setting.iter().cloned().collect();
        files::check_target(path, &inputs, args.replace.existing())?;
        files::write(path, setting.to_toml().as_bytes())?;
        printer::setting_written(path, args.print)?;
        return Ok(Completion::Passed);
    }
    if args.check && setting.holds.is_none() {
        bail!(
            "the setting `{}` has no list `holds`; expected the claims that hold with it. hint: a run writes \
             setting.toml with this list",
            setting.name
        );
    }
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let start = Instant::now();
    let clock = move || start.elapsed().as_secs_f64();
    let mut mode = |trial: &TrialSettings<'_>| unless_stopped(caller, trial, &mut |trial| setting.walk(trial));
    let paper = gather("the paper's mode", &mut mode, &clock, args)?;
    let mut corrected_mode = CorrectedMode::of(&setting);
    corrected_mode.settings.observer = caller.observer(|_| ());
    let mut mode = |trial: &TrialSettings<'_>| unless_stopped(caller, trial, &mut |trial| corrected_mode.walk(trial));
    let corrected = gather("the corrected mode", &mut mode, &clock, args)?;
    printer::progress("loops, obstacles, grasping, hand in hand, and a walk by own torques", args.print);
    let mut claims: Vec<Claim> = claims(&paper, Some(&corrected));
    add_experiments(&mut claims, &paper, &setting)?;
    let others = if args.brief { Vec::new() } else { other_values(&setting, &paper, args, caller) };
    if caller.is_stopped() {
        bail!(STOPPED);
    }
    let modes = [("The paper's mode", &paper), ("The corrected mode", &corrected)];
    let mut written = reproduction_files(&claims, &paper, Some(&corrected), &setting, &others)?;
    written.push(reproduction_page(&claims, &modes, &setting, &others, &written));
    let mut json = serde_json::to_vec_pretty(&claims)?;
    json.push(b'\n');
    written.push(OutputFile::new(CLAIMS, json));
    let keep = Keep::of_names(&args.keep);
    let options = format!("reproduce brief={} keep={:?} setting={}", args.brief, args.keep, setting.to_toml());
    written.retain(|file| keep.includes(&file.name));
    let run_id = run_id(&options, &[], &Caller::default())?;
    target.replace(&written, &[], &mut |files| {
        let summary = json!({ "version": env!("CARGO_PKG_VERSION"), "run_id": run_id, "files": files });
        Ok(summary_json(&summary)?)
    })?;
    printer::reproduce(&claims, &others, &args.output, args.print)?;
    let lost = if args.check { setting.lost(&claims).unwrap_or_default() } else { Vec::new() };
    printer::lost_claims(&lost, &setting.name, args.print)?;
    Ok(if lost.is_empty() { Completion::Passed } else { Completion::Failed })
}

/// A setting that comes with the program, or the setting of a file.
fn read_setting(path: &Path) -> Result<Setting> {
    if let Some(setting) = path.to_str().and_then(Setting::named) {
        return Ok(setting?);
    }
    let names = || NAMED.map(|(name, _)| name).join(", ");
    let bytes = files::read(path).with_context(|| format!("--setting: expected a file, or one of {}", names()))?;
    let text = String::from_utf8(bytes).with_context(|| format!("{}: this is not text", path.display()))?;
    Setting::from_toml(&text).with_context(|| path.display().to_string())
}

fn other_values(setting: &Setting, paper: &Evidence, args: &ReproduceArgs, caller: &Caller) -> Vec<Sensitivity> {
    sensitivities(setting, paper, &mut |done, all| {
        if done % 10 == 0 {
            printer::progress(&format!("other values that the paper does not give, {done} of {all}"), args.print);
        }
        if caller.is_stopped() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    })
}

/// Makes a walk, unless the caller stopped the computation.
fn unless_stopped(caller: &Caller, trial: &TrialSettings<'_>, walk: &mut Mode<'_>) -> Result<Run, ReproductionError> {
    match caller.is_stopped() {
        true => Err(ReproductionError::Mode { gait: trial.gait.name.clone(), reason: STOPPED.to_owned() }),
        false => walk(trial),
    }
}

fn gather(name: &str, mode: &mut Mode<'_>, clock: &dyn Fn() -> f64, args: &ReproduceArgs) -> Result<Evidence> {
    printer::progress(name, args.print);
    Ok(Evidence::gather(mode, Scope::Full, Some(clock))?)
}
