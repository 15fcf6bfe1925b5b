//! `ambulo sweep`: walks at many speeds, of many bodies, on slopes and with loads.

use super::side_by_side::{processors, side_by_side};
use super::walk::{read_devices, segments, source};
use crate::args::{SweepArgs, Values};
use crate::caller::Caller;
use crate::record::run_id;
use crate::replacement::ResultTarget;
use crate::{Completion, printer};
use ambulo::analysis::feasibility::VerdictState;
use ambulo::findings::Findings;
use ambulo::gait::{Gait, Walk, walking_speeds};
use ambulo::model::anthropometry::Build;
use ambulo::optimal::{Device, Load, Observer, WalkConditions};
use ambulo::simulation::synthetic::{SyntheticMode, SyntheticWalkSettings, predict_observed, synthesise_observed};
use ambulo::study::{self, Settings};
use ambulo_report::{SweptConditions, SweptWalk, WalkCurves, sweep_files};
use ambulo_results::{Keep, OutputFile, summary_json};
use anyhow::{Result, bail};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::atomic::{AtomicUsize, Ordering};

/// More walks take hours.
const MOST_WALKS: usize = 500;

pub(crate) fn run(args: &SweepArgs) -> Result<Completion> {
    // A mistake in the options is reported before the folder is made.
    let mut read = Vec::new();
    let sweep = Sweep::new(args, &mut read)?;
    let target = ResultTarget::for_run(&args.output, args.replace.existing())?;
    let run = walked(args, &sweep, read, &Caller::default())?;
    run.save(&target)?;
    printer::sweep(&run.walks, &args.output, args.print)?;
    let is_good =
        |walk: &SweptWalk| walk.found.as_ref().is_ok_and(|found| found.verdict != VerdictState::Infeasible.words());
    let failed = args.check.check && !run.walks.iter().all(is_good);
    Ok(if failed { Completion::Failed } else { Completion::Passed })
}

/// The walks of a sweep, with everything that is written to the result folder.
pub(crate) struct SweepRun {
    walks: Vec<SweptWalk>,
    pub(super) written: Vec<OutputFile<'static>>,
    mode: SyntheticMode,
    read: Vec<PathBuf>,
    caller: Caller,
    options: String,
}

/// Computes all walks.
pub(crate) fn compute(args: &SweepArgs, caller: &Caller) -> Result<SweepRun> {
    let mut read = Vec::new();
    let sweep = Sweep::new(args, &mut read)?;
    walked(args, &sweep, read, caller)
}

fn walked(args: &SweepArgs, sweep: &Sweep, read: Vec<PathBuf>, caller: &Caller) -> Result<SweepRun> {
    let walks = sweep.walks(args, caller);
    if caller.is_stopped() {
        bail!("the sweep was stopped after {} of {} walks", walks.len(), sweep.points.len());
    }
    let found = walks.iter().filter(|walk| walk.found.is_ok()).count();
    if let (0, Some(Err(reason))) = (found, walks.first().map(|walk| &walk.found)) {
        match walks.len() {
            1 => bail!("{reason}"),
            count => bail!("none of {count} walks was found; the first one: {reason}"),
        }
    }
    let keep = Keep::of_names(&args.keep);
    let mut written = sweep_files(&sweep.title(), &walks)?;
    written.retain(|file| keep.includes(&file.name));
    let (caller, options) = (caller.clone(), options(args));
    Ok(SweepRun { walks, written, mode: sweep.mode, read, caller, options })
}

impl SweepRun {
    /// Writes all files.
    pub(super) fn save(&self, target: &ResultTarget) -> Result<()> {
        let run_id = run_id(&self.options, &self.read, &self.caller)?;
        target.replace(&self.written, &self.read, &mut |files| Ok(summary_json(&self.summary(&run_id, files))?))
    }

    /// The content of `summary.json`.
    pub(super) fn summary(&self, run_id: &str, files: BTreeMap<String, String>) -> Value {
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "run_id": run_id,
            "walks": self.walks.len(),
            "walks_found": self.walks.iter().filter(|walk| walk.found.is_ok()).count(),
            "mode": self.mode.name(),
            "files": files,
        })
    }
}

/// The command with the options that matter for the results.
fn options(args: &SweepArgs) -> String {
    let (output, replace, check, print) = Default::default();
    format!("sweep {:?}", SweepArgs { output, replace, check, print, ..args.clone() })
}

/// Every combination of the values; the speed changes first.
fn points(args: &SweepArgs, gait: &Gait, build: &Build) -> Result<Vec<SweptConditions>> {
    type Quantity = fn(&mut SweptConditions) -> &mut f64;
    let leg_length = build.human()?.dimensions.leg_length;
    let usual = SweptConditions {
        speed_m_s: Walk::new(gait, leg_length, &mut Findings::default())?.speed(),
        mass_kg: build.mass,
        height_m: build.height,
        slope_percent: 0.0,
        load_kg: 0.0,
    };
    let axes: [(Option<&Values>, Quantity); 5] = [
        (args.load.as_ref().map(|loads| &loads.masses), |point| &mut point.load_kg),
        (args.slope.as_ref(), |point| &mut point.slope_percent),
        (args.height.as_ref(), |point| &mut point.height_m),
        (args.mass.as_ref(), |point| &mut point.mass_kg),
        (args.speed.as_ref(), |point| &mut point.speed_m_s),
    ];
    let counts = axes.map(|(values, _)| values.map_or(1, |values| values.0.len()));
    let count = counts.iter().try_fold(1_usize, |count, values| count.checked_mul(*values));
    if count.is_none_or(|count| count > MOST_WALKS) {
        let found = counts.map(|count| count.to_string()).join(" x ");
        bail!("found {found} walks; expected at most {MOST_WALKS}. hint: each takes some seconds; use larger steps");
    }
    let mut points = vec![usual];
    for (values, quantity) in axes {
        let Some(Values(values)) = values else { continue };
        let with = |mut point: SweptConditions, value: f64| {
            *quantity(&mut point) = value;
            point
        };
        points = points.iter().flat_map(|point| values.iter().map(|value| with(*point, *value))).collect();
    }
    Ok(points)
}

/// Common settings of all walks, and their conditions.
struct Sweep {
    gait: Gait,
    build: Build,
    mode: SyntheticMode,
    /// Conditions of all walks, apart from slope and load.
    conditions: WalkConditions,
    points: Vec<SweptConditions>,
    load: Option<Load>,
}

impl Sweep {
    fn new(args: &SweepArgs, read: &mut Vec<PathBuf>) -> Result<Sweep> {
        let gait = Gait::named("free")?;
        let build = Build::usual(segments(&args.figure)?);
        let devices: Vec<Device> = read_devices(args.device.as_deref(), read)?;
        let (strengths, free_cadence) = (args.weak.clone(), args.free_cadence);
        let conditions = WalkConditions { strengths, devices, free_cadence, ..WalkConditions::default() };
        let is_predicted =
            args.predict || args.slope.is_some() || args.load.is_some() || conditions != WalkConditions::default();
        let points = points(args, &gait, &build)?;
        let mode = if is_predicted { SyntheticMode::Predicted } else { SyntheticMode::Optimal };
        let load = args.load.as_ref().map(|loads| Load { mass: 0.0, place: loads.place });
        Ok(Sweep { gait, build, mode, conditions, points, load })
    }

    /// Title of the page: the swept quantities.
    fn title(&self) -> String {
        let mode = match self.mode {
            SyntheticMode::Predicted => "predicted without curves of people",
            _ => "from the curves of people",
        };
        let named = |conditions: &[String]| {
            if conditions.is_empty() { String::new() } else { format!(", {}", conditions.join(", ")) }
        };
        let weak: Vec<String> = self
            .conditions
            .strengths
            .iter()
            .map(|(joint, share)| format!("{joint} with {share} of its strength"))
            .collect();
        let devices: Vec<String> =
            self.conditions.devices.iter().map(|device| format!("a device at {}", device.coordinate)).collect();
        let cadence = if self.conditions.free_cadence { ", each at its own cadence" } else { "" };
        format!("Walks in three dimensions, {mode}{}{}{cadence}", named(&weak), named(&devices))
    }

    /// Computes all walks, in the order of the conditions.
    fn walks(&self, args: &SweepArgs, caller: &Caller) -> Vec<SweptWalk> {
        let done = AtomicUsize::new(0);
        let walks = side_by_side(self.points.len(), processors(), |place| {
            let point = self.points.get(place).filter(|_| !caller.is_stopped())?;
            let found = self.walk(point, &caller.observer(|_| ())).map_err(|error| format!("{error:#}"));
            let count = done.fetch_add(1, Ordering::Relaxed) + 1;
            printer::progress(&format!("{count} of {} walks", self.points.len()), args.print);
            Some(SweptWalk { conditions: *point, found })
        });
        walks.into_iter().flatten().collect()
    }

    /// One walk, with its forces computed as for a recording.
    fn walk(&self, point: &SweptConditions, observer: &Observer) -> Result<WalkCurves> {
        let mut findings = Findings::default();
        let pace = self.gait.pace.with(Some(point.speed_m_s), None, None);
        let gait = Gait { pace, ..self.gait.clone() };
        let build = Build { mass: point.mass_kg, height: point.height_m, ..self.build };
        let leg_length = build.human()?.dimensions.leg_length;
        if SyntheticMode::of(&gait, &build, leg_length) != SyntheticMode::Optimal {
            // An invalid speed has its own error.
            Walk::new(&gait, leg_length, &mut findings)?;
            let [slowest, fastest] = walking_speeds(leg_length);
            bail!(
                "found {} m/s; expected {slowest:.2} to {fastest:.2} m/s, the speeds of walking on legs of \
                 {leg_length:.2} m",
                point.speed_m_s
            );
        }
        let settings = SyntheticWalkSettings { gait: &gait, build, mode: self.mode, cycles: 1, rate_hz: RATE_HZ };
        let walk = if self.mode == SyntheticMode::Predicted {
            let load = self.load.filter(|_| point.load_kg.abs() > 0.0).map(|load| Load { mass: point.load_kg, ..load });
            let conditions = WalkConditions { slope: point.slope_percent / 100.0, load, ..self.conditions.clone() };
            predict_observed(&settings, &conditions, observer, &mut findings)?
        } else {
            synthesise_observed(&settings, observer, &mut findings)?
        };
        let outcome = study::run(source(&walk, self.mode), &Settings::default(), &mut findings)?;
        let cost = walk.report.prediction.as_ref().map(|prediction| prediction.metabolic_power / walk.report.speed);
        Ok(WalkCurves::of(&outcome, point.mass_kg, walk.report.step_length, 120.0 / walk.report.cycle_s, cost))
    }
}

/// Frame rate of the walks [Hz], as in `ambulo walk`.
const RATE_HZ: f64 = 100.0;
