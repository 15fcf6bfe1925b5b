//! `summary.json` of a recording or synthetic walk: input, settings and results with stable keys (docs/OUTPUTS.md).

use crate::consistency_summary::ConsistencySummary;
use crate::convention::ConventionSummary;
use crate::force_unit::ForceUnit;
use crate::muscle_summary::{MuscleSummary, muscle_summary};
use crate::subject_summary::SubjectSummary;
use crate::tables::UNLOADED_N;
use crate::tracking_summary::TrackingSummary;
use crate::walk_summary::WalkSummary;
use crate::walking_summary::{QuantitySummary, WalkingSummary, knee_adduction_summary};
use ambulo::analysis::activity::Activity;
use ambulo::analysis::feasibility::Verdict;
use ambulo::analysis::{Analysis, GroundAgreement, PredictionChecks, peak};
use ambulo::findings::{Finding, Findings, word};
use ambulo::model::{Model, Side};
use ambulo::motion::Smoother;
use ambulo::motion::filter::LowPass;
use ambulo::study::{BodyMass, ForceOrigin, Outcome, Processing, Quality, Tracking};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt;

/// The summary of one run. Keys that do not apply to a run are `null`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Summary {
    /// Version of the program.
    pub version: String,
    /// Identifies the run: SHA-256 of version, options and the content of the input files. Empty until files are
    /// written.
    #[serde(default)]
    pub run_id: String,
    /// SHA-256 of every other file of the run but `timings.json`, by name.
    #[serde(default)]
    pub files: BTreeMap<String, String>,
    /// Input files and settings.
    pub input: Input,
    /// Name of the model.
    pub model: String,
    /// Body mass [kg]; results are normalised by it.
    pub mass_kg: f64,
    /// Gravity [m/s²].
    pub gravity_m_s2: f64,
    /// The mass that forces are computed with, the body mass by each source, and how well it is known.
    pub mass: BodyMass,
    /// Stature [m], if it was given.
    pub height_m: Option<f64>,
    /// Walking speed relative to the floor or belt [m/s].
    pub speed_m_s: Option<f64>,
    /// First and last instant [s].
    pub window_s: [f64; 2],
    /// The requested time range [s]; `null` where it was left open.
    pub requested_window_s: [Option<f64>; 2],
    /// Frame rate [Hz].
    pub rate_hz: f64,
    /// Number of frames.
    pub frames: usize,
    /// Filters of motion and forces, in words.
    pub filter: Filters,
    /// Convention for the angles of pelvis and hips in `clinical.csv`; `null` without that file.
    pub convention: Option<ConventionSummary>,
    /// Activity of the person; it determines the limits of the verdict.
    #[serde(default)]
    pub activity: Option<Activity>,
    /// Times and distances of the strides.
    pub times_and_distances: WalkingSummary,
    /// External knee adduction moment over the whole stances of each leg: `first_peak` and `second_peak` (the largest
    /// in the first and in the second half of stance) and `impulse` (the area of its positive part). Empty where it is
    /// not known.
    #[serde(default)]
    pub knee_adduction_moment: Vec<QuantitySummary>,
    /// Muscle forces; left out where they were not asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub muscles: Option<MuscleSummary>,
    /// Source of the ground forces.
    pub ground: Ground,
    /// Residual force and moment at the root.
    pub residual: Option<ResidualSummary>,
    /// Extremes of every generalised force.
    pub peaks: Vec<PeakSummary>,
    /// Warnings and notes.
    pub findings: Vec<Finding>,
    /// Quality of the data: whether recording, body and forces fit together.
    pub quality: Option<Quality>,
    /// Verdict: whether a person could do this motion.
    pub verdict: Option<Verdict>,
    /// Checks of predicted forces; `null` without a prediction.
    pub prediction: Option<PredictionChecks>,
    /// Comparison of predicted forces with force plates; `null` without a prediction or a wholly measured stance.
    pub comparison: Option<GroundAgreement>,
    /// Marker fit, segments, plates and events; `null` for recorded coordinates.
    pub subject: Option<SubjectSummary>,
    /// Coordinates of pelvis and legs that nothing recorded determines, or that sit on a limit; left out if there are
    /// none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub not_measured: Vec<String>,
    /// Residual reduction; `null` if the motion was not changed.
    pub consistency: Option<ConsistencySummary>,
    /// Tracking by feet on soft ground; `null` if the motion was not changed by it.
    #[serde(default)]
    pub tracking: Option<TrackingSummary>,
    /// How a synthetic walk was made; `null` for recordings.
    pub walk: Option<WalkSummary>,
    /// Empty: durations are in `timings.json`. Folders of earlier versions have them here [ms].
    #[serde(default)]
    pub timing_ms: BTreeMap<String, f64>,
}

/// Input files and settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Input {
    /// The recorded motion.
    pub motion: String,
    /// Name of the person, if the recording states it.
    pub person: Option<String>,
    /// Day of the recording, as YYYY-MM-DD, if the recording states it.
    pub recorded_on: Option<String>,
    /// The model; `built-in` for Ambulo's own body.
    pub model: String,
    /// The standing trial.
    #[serde(rename = "static")]
    pub standing: Option<String>,
    /// The ground forces.
    pub ground: Option<String>,
    /// The description of the loads.
    pub loads: Option<String>,
    /// The forces of a worn device.
    pub device: Option<String>,
    /// Masses added to the model, as `BODY:KG:X,Y,Z`.
    pub added_mass: Vec<String>,
    /// Source of the ground forces; reported under `ground`.
    #[serde(skip)]
    pub ground_source: ForceOrigin,
}

/// The filters in words and numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Filters {
    /// Filter of the motion.
    pub motion: FilterSummary,
    /// Filter of the measured forces.
    pub force: FilterSummary,
}

/// One filter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct FilterSummary {
    /// Kind of filter.
    pub kind: FilterKind,
    /// Cut-off of one pass [Hz].
    pub cutoff_hz: Option<f64>,
    /// Order of one pass; the filter runs forwards and backwards.
    pub order: Option<usize>,
}

/// A kind of filter.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum FilterKind {
    /// Butterworth low-pass, forwards and backwards.
    Butterworth,
    /// Smoothing spline.
    Spline,
    /// No filter.
    Off,
}

impl FilterKind {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// Source of the ground forces of a run, as a word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum GroundOrigin {
    /// Force plates or other sensors.
    Measured,
    /// Force plates or other sensors; the motion where a loaded foot was not on them.
    Mixed,
    /// The motion itself.
    Predicted,
    /// A simulation of the motion.
    Simulated,
    /// There are none.
    None,
}

impl GroundOrigin {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// Source of the ground forces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct Ground {
    /// Source of the ground forces.
    pub source: GroundOrigin,
    /// Method for double support; `null` for measured forces.
    pub rule: Option<String>,
    /// Of the time in which each leg was loaded, the share in which its load was measured; `null` without measured
    /// forces.
    #[serde(default)]
    pub measured_share: Option<MeasuredShare>,
    /// A foot counts as unloaded below this vertical force [N].
    pub threshold_n: f64,
    /// By how much the measured forces are late against the motion [s], negative if they are early; left out where no
    /// delay was found.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub force_delay_s: Option<f64>,
}

impl Ground {
    /// In words, of which share of each leg's loaded time the load was measured; `None` if all of it was, or nothing.
    #[must_use]
    pub fn shares(&self) -> Option<String> {
        let MeasuredShare { right, left } = self.measured_share.as_ref()?;
        let percent = |share: f64| (100.0 * share).round();
        let of_leg = |(side, share): (Side, Option<f64>)| {
            share.map(|share| format!("{:.0} % of the {side} leg's loaded time", percent(share)))
        };
        let known = [(Side::Right, *right), (Side::Left, *left)];
        let legs: Vec<String> = known.into_iter().filter_map(of_leg).collect();
        let is_incomplete = known.iter().any(|(_, share)| share.is_some_and(|share| share < 1.0));
        let rest = if self.source == GroundOrigin::Mixed { "predicted" } else { "unknown" };
        is_incomplete.then(|| format!("measured in {}; {rest} in the rest", legs.join(" and ")))
    }

    /// In words, the leg none of whose stances was measured, while the other leg was measured; `None` if there is none.
    #[must_use]
    pub fn unmeasured_leg(&self) -> Option<String> {
        let MeasuredShare { right, left } = self.measured_share.as_ref()?;
        let side = match (right, left) {
            (Some(right), Some(left)) if *right > 0.0 && *left <= 0.0 => Side::Left,
            (Some(right), Some(left)) if *left > 0.0 && *right <= 0.0 => Side::Right,
            _ => return None,
        };
        let rest = if self.source == GroundOrigin::Mixed { "rest on predicted forces" } else { "are unknown" };
        Some(format!("no stance of the {side} leg was measured: its moments, powers and reactions {rest}"))
    }
}

/// Of the time in which each leg was loaded, the share in which its load was measured; `null` for a leg that was never
/// loaded.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MeasuredShare {
    /// Of the right leg, 0 to 1.
    pub right: Option<f64>,
    /// Of the left leg, 0 to 1.
    pub left: Option<f64>,
}

/// The residual at the root.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ResidualSummary {
    /// Root mean square of the force [N].
    pub force_rms_n: f64,
    /// Largest force [N].
    pub force_peak_n: f64,
    /// Root mean square of the force in body weights.
    pub force_rms_bw: f64,
    /// Root mean square of the moment about the root joint [N.m].
    pub moment_rms_nm: f64,
    /// Largest moment [N.m].
    pub moment_peak_nm: f64,
}

/// Extremes of one generalised force.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct PeakSummary {
    /// Column of `moments.sto`.
    pub quantity: String,
    /// Its unit.
    pub unit: ForceUnit,
    /// Largest value.
    pub max: f64,
    /// Time of the largest value [s].
    pub max_at_s: f64,
    /// Smallest value.
    pub min: f64,
    /// Time of the smallest value [s].
    pub min_at_s: f64,
}

/// The summary of a run. `input` names the input files; the source of the ground forces is taken from the outcome. The
/// caller adds the synthetic walk and the convention of the angles.
#[must_use]
pub fn outcome_summary(outcome: &Outcome, input: Input, findings: &Findings) -> Summary {
    let Outcome { body: model, analysis, verdict, prediction, processing, .. } = outcome;
    let prediction = prediction.as_ref();
    let grid = analysis.trajectory.grid();
    let (source, rule) = ground(outcome.force_origin);
    Summary {
        version: env!("CARGO_PKG_VERSION").to_owned(),
        run_id: String::new(),
        files: BTreeMap::new(),
        input: Input { ground_source: outcome.force_origin, ..input },
        model: model.name().to_owned(),
        mass_kg: analysis.mass.kg,
        gravity_m_s2: model.gravity().norm(),
        mass: outcome.mass.clone(),
        height_m: outcome.height_m(),
        speed_m_s: analysis.speed_m_s,
        window_s: [grid.start_s, grid.end_s()],
        requested_window_s: [processing.window.from_s, processing.window.to_s],
        rate_hz: grid.rate_hz(),
        frames: grid.frames,
        filter: filters(processing),
        ground: Ground {
            source,
            rule,
            measured_share: measured_share(outcome),
            threshold_n: UNLOADED_N,
            force_delay_s: outcome.force_delay_s,
        },
        convention: None,
        activity: Some(outcome.activity),
        times_and_distances: WalkingSummary::of(&outcome.times_and_distances),
        knee_adduction_moment: knee_adduction_summary(&outcome.knee_adduction()),
        muscles: muscle_summary(outcome),
        residual: residual(model, analysis),
        peaks: peaks(model, outcome.complete()),
        findings: findings.as_slice().to_vec(),
        quality: Some(outcome.quality.clone()),
        verdict: Some(verdict.clone()),
        prediction: prediction.map(|prediction| prediction.checks.clone()),
        comparison: prediction.and_then(|prediction| prediction.agreement.clone()),
        subject: outcome.tracking.as_ref().map(subject),
        not_measured: outcome.not_measured.iter().map(|id| model.coordinates()[id.index()].name.clone()).collect(),
        consistency: outcome.residual_reduction.as_ref().map(ConsistencySummary::of),
        tracking: prediction.and_then(|prediction| prediction.tracked.as_ref()).map(TrackingSummary::of),
        walk: None,
        timing_ms: BTreeMap::new(),
    }
}

fn ground(origin: ForceOrigin) -> (GroundOrigin, Option<String>) {
    match origin {
        ForceOrigin::Measured => (GroundOrigin::Measured, None),
        ForceOrigin::Mixed { rule } => (GroundOrigin::Mixed, Some(rule.to_owned())),
        ForceOrigin::Predicted { rule } => (GroundOrigin::Predicted, Some(rule.to_owned())),
        ForceOrigin::Simulated { rule } => (GroundOrigin::Simulated, Some(rule.to_owned())),
        ForceOrigin::None => (GroundOrigin::None, None),
    }
}

fn measured_share(outcome: &Outcome) -> Option<MeasuredShare> {
    let [right, left] = Side::BOTH.map(|side| outcome.measured_share(side));
    (right.is_some() || left.is_some()).then_some(MeasuredShare { right, left })
}

fn subject(tracking: &Tracking) -> SubjectSummary {
    match tracking {
        Tracking::Markers(markers) => SubjectSummary::of_markers(markers),
        Tracking::Skeleton { statement, fit, regions, .. } => SubjectSummary::of_skeleton(statement, fit, regions),
    }
}

fn filters(settings: &Processing) -> Filters {
    let off = FilterSummary { kind: FilterKind::Off, cutoff_hz: None, order: None };
    let low_pass = |f: LowPass| FilterSummary {
        kind: FilterKind::Butterworth,
        cutoff_hz: Some(f.cutoff_hz),
        order: Some(f.order),
    };
    Filters {
        motion: match settings.smoother {
            Smoother::Off => off.clone(),
            Smoother::Butterworth(f) => low_pass(f),
            Smoother::Spline => FilterSummary { kind: FilterKind::Spline, ..off.clone() },
        },
        force: settings.force_filter.map_or(off, low_pass),
    }
}

fn residual(model: &Model, analysis: &Analysis) -> Option<ResidualSummary> {
    let weight = analysis.mass.kg * model.gravity().norm();
    analysis.residual.map(|r| ResidualSummary {
        force_rms_n: r.force_rms_n,
        force_peak_n: r.force_peak_n,
        force_rms_bw: r.force_rms_n / weight,
        moment_rms_nm: r.moment_rms_nm,
        moment_peak_nm: r.moment_peak_nm,
    })
}

fn peaks(model: &Model, analysis: &Analysis) -> Vec<PeakSummary> {
    let grid = analysis.trajectory.grid();
    let names = model.force_names();
    let series = names.into_iter().zip(model.coordinates()).zip(&analysis.forces.generalized);
    series
        .filter_map(|((quantity, coordinate), values)| {
            let p = peak(grid, values)?;
            let unit = ForceUnit::of_rotation(coordinate.kind.force_suffix() == "moment");
            Some(PeakSummary { quantity, unit, max: p.max, max_at_s: p.max_at_s, min: p.min, min_at_s: p.min_at_s })
        })
        .collect()
}

impl fmt::Display for FilterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}

impl fmt::Display for GroundOrigin {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.word())
    }
}
