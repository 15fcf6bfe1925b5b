//! Analysis with measured forces, completed with predicted ones in the stances that were not measured.
//!
//! ```text
//! motion -> stances, measured or not (`ground::stances`) -> inverse dynamics with the measured forces -> judgement
//!                 |                                                                                      |
//!                 prediction for the others -------------------> inverse dynamics with all forces -> tables
//! ```
//!
//! Quality and verdict are judged on the measured forces alone. The tables use the completed forces, because a leg that
//! carries the body on ground without a plate would have no moments otherwise.

use super::observation::Observation;
use super::settings::Settings;
use crate::analysis::activity::activity;
use crate::analysis::{
    Analysis, AnalysisError, AnalysisSettings, Cycle, ForceSource, PredictionInput, Progress, Stage, analyse_measured,
    predicted_in_frames, trajectory_of_measured, vertical_by_side,
};
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::findings::{Code, Findings, and_more_times};
use crate::ground::footfalls::{Footfalls, footfalls};
use crate::ground::phases::contacts_from_force;
use crate::ground::predict::{Prediction, total_wrench};
use crate::ground::stances::{
    LoadedTime, MeasuredMotion, Missing, Stance, StanceSource, VerticalForces, completed, measured_share,
};
use crate::kinematics::Trajectory;
use crate::model::{BySide, Model, Side};
use crate::motion::{Motion, interpolate};
use crate::numerics::Order;

/// The stances of a measured motion, and forces for those that were not measured.
pub(super) struct StanceLoads {
    /// All stances, in order of time.
    pub(super) stances: Vec<Stance>,
    /// The stances that the motion shows.
    pub(super) footfalls: Footfalls,
    missing: Vec<Missing>,
    prediction: Option<Prediction>,
}

/// An analysis with measured forces, the stances, and the settings with the time in which nothing is missing.
pub(super) struct Measured {
    pub(super) analysis: Analysis,
    pub(super) loads: StanceLoads,
    pub(super) processing: AnalysisSettings,
}

/// Analyses a motion with its measured forces, and predicts the forces that are missing.
pub(super) fn measured(
    observation: &Observation,
    motion: &Motion,
    processing: AnalysisSettings,
    settings: &Settings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Measured, AnalysisError> {
    let Observation { model, forces, person, .. } = observation;
    let trajectory = trajectory_of_measured(model, motion, forces, processing, findings)?;
    progress.end(Stage::Smoothing)?;
    let footfalls = footfalls(model, &trajectory, &person.soles, &mut Findings::default());
    let loaded = loaded_times(observation);
    let of_motion = MeasuredMotion { grid: trajectory.grid(), footfalls: &footfalls, loaded };
    // Without any forces there is no contact by the caller's choice.
    let (mut stances, missing) = match forces.is_empty() {
        true => (Vec::new(), Vec::new()),
        false => of_motion.stances(|| vertical_forces(observation, &trajectory)),
    };
    let is_incomplete = processing.instrumented.is_none() && !missing.is_empty();
    let own = is_incomplete.then(|| of_motion.complete_window(&missing));
    let processing = AnalysisSettings { instrumented: processing.instrumented.or(own), ..processing };
    let input = PredictionInput { soles: &person.soles, settings: &settings.prediction, plates_filter: None };
    let predicted =
        || predicted_in_frames(model, motion, &trajectory, processing, &input, &mut Findings::default()).ok();
    let prediction = (!missing.is_empty()).then(predicted).flatten();
    let kind = || activity(model, &trajectory, &person.soles, person.leg_length_m, &footfalls).kind;
    let is_known = prediction.is_some() && kind().has_validated_prediction();
    let source = if is_known { StanceSource::Predicted } else { StanceSource::Unknown };
    let others = missing
        .iter()
        .filter_map(|Missing { side, span }| Stance::within(*side, *span, source.clone(), trajectory.grid()));
    stances.extend(others);
    stances.sort_by_numbers(|stance| [stance.start_s, stance.side.rank()]);
    report(&stances, findings);
    let forces_of = ForceSource::Measured { filter: processing.force_filter, within: processing.instrumented };
    let analysis = analyse_measured(model, trajectory, forces, forces_of, findings, progress)?;
    Ok(Measured { analysis, loads: StanceLoads { stances, footfalls, missing, prediction }, processing })
}

/// The times in which feet carry measured loads.
fn loaded_times(observation: &Observation) -> Vec<LoadedTime> {
    let Observation { model, forces, origin, .. } = observation;
    if let Some(followed) = origin.followed().filter(|_| observation.is_from_plates) {
        return LoadedTime::on_plates(&followed.body.on_plates);
    }
    let of_side = |(side, (times, vertical)): (_, (Vec<f64>, Vec<f64>))| {
        let ends = [times.first(), times.last()].map(|time| time.copied().unwrap_or_default());
        let spans =
            contacts_from_force(&times, &vertical).into_iter().map(move |contact| contact.span(ends[0], ends[1]));
        spans.map(move |span| LoadedTime { side, span, source: StanceSource::Table, may_be_partial: false })
    };
    vertical_by_side(model, forces, model.up()).into_iter().flat_map(of_side).collect()
}

/// Measured vertical forces, and the vertical forces that the motion requires.
fn vertical_forces(observation: &Observation, trajectory: &Trajectory) -> VerticalForces {
    let Observation { model, forces, .. } = observation;
    let (grid, up) = (trajectory.grid(), model.up());
    let by_side = vertical_by_side(model, forces, up);
    let of_side = |side| {
        let known = by_side.iter().find(|(own, _)| *own == side).map(|(_, recorded)| recorded);
        let at = |time: f64| {
            let is_recorded = |times: &[f64]| times.first() <= Some(&time) && Some(&time) <= times.last();
            known
                .filter(|(times, _)| is_recorded(times))
                .map_or(0.0, |(times, values)| interpolate(times, values, time))
        };
        (0..grid.frames).map(|frame| at(grid.time(frame))).collect()
    };
    VerticalForces {
        required: total_wrench(model, trajectory).iter().map(|wrench| wrench.force.dot(&up)).collect(),
        measured: BySide::from_fn(of_side),
        weight_n: model.mass() * model.gravity().norm(),
    }
}

/// Reports loads that were not measured.
fn report(stances: &[Stance], findings: &mut Findings) {
    let of = |source: StanceSource| {
        let found: Vec<&Stance> = stances.iter().filter(|stance| stance.source == source).collect();
        let first = *found.first()?;
        Some(format!(
            "the load of the {} foot from {:.3} to {:.3} s{} was not measured{}",
            first.side,
            first.start_s,
            first.end_s,
            and_more_times(found.len()),
            legs_without_measured_stance(stances)
        ))
    };
    if let Some(what) = of(StanceSource::Predicted) {
        let message = format!(
            "{what}; moments, powers and reactions have predicted forces there (`stances.csv`, columns `ground_source`)"
        );
        findings.report(Code::StancesPredicted, message);
    }
    if let Some(what) = of(StanceSource::Unknown) {
        let message = format!(
            "{what} and cannot be predicted reliably; moments, powers and reactions of this leg are unknown there \
             (`stances.csv`, columns `ground_source`). hint: choose the time in which every loaded foot is on a plate"
        );
        findings.report(Code::StancesUnknown, message);
    }
}

/// Which leg has no measured stance at all, to be added to a sentence.
fn legs_without_measured_stance(stances: &[Stance]) -> String {
    let without =
        Side::BOTH.into_iter().filter(|side| measured_share(stances, *side).is_some_and(|share| share <= 0.0));
    without.map(|side| format!(", nor that of any other stance of the {side} leg")).collect()
}

impl StanceLoads {
    /// The analysis with predicted forces where measured ones are missing, of the motion and body that residual
    /// reduction may have changed; `None` where nothing is missing or can be predicted.
    pub(super) fn complete(&self, model: &Model, analysis: &Analysis) -> Option<Analysis> {
        let prediction = self.prediction.as_ref()?;
        let trajectory = &analysis.trajectory;
        let ground = completed(model, trajectory.grid(), &analysis.ground, prediction, &self.missing);
        let forces = inverse_with_residual(&mut Workspace::new(model), trajectory, &ground.loads());
        Some(Analysis { ground, forces, ..analysis.clone() })
    }

    /// The cycles in which the foot has one stance: between two measured strikes there may be one that was not
    /// measured.
    pub(super) fn single(&self, cycles: Vec<Cycle>) -> Vec<Cycle> {
        let begins_inside = |stance: &Stance, cycle: &Cycle| {
            let quarter_s = 0.25 * (cycle.end_s - cycle.start_s);
            stance.side == cycle.side && (cycle.start_s + quarter_s..cycle.end_s - quarter_s).contains(&stance.start_s)
        };
        let mut single: Vec<Cycle> = cycles
            .into_iter()
            .filter(|cycle| !self.stances.iter().any(|stance| begins_inside(stance, cycle)))
            .collect();
        for i in 0..single.len() {
            let side = single[i].side;
            single[i].number = single[..=i].iter().filter(|cycle| cycle.side == side).count();
        }
        single
    }

    /// Whether loads are missing.
    pub(super) fn are_incomplete(&self) -> bool {
        !self.missing.is_empty()
    }

    /// How predicted forces were divided between the feet in double support.
    pub(super) fn rule(&self) -> Option<&'static str> {
        let is_used = self.stances.iter().any(|stance| stance.source == StanceSource::Predicted);
        self.prediction.as_ref().filter(|_| is_used).map(|prediction| prediction.rule)
    }
}
