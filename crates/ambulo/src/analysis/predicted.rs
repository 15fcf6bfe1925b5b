//! Analysis of a recording with predicted ground forces, alongside one with measured forces if there are any.

use super::cycles::cycles;
use super::events::{Event, EventKind};
use super::feasibility::over_ground;
use super::motion_bandwidth::motion_bandwidth;
use super::plausibility;
use super::progress::{Progress, Stage};
use super::recording::{
    Analysis, AnalysisError, AnalysisSettings, ForceSource, Mass, MassSource, trajectory_within, with_forces,
};
use super::residual::residual;
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::findings::{Code, Finding, Findings};
use crate::ground::predict::{PredictSettings, Prediction, Prescribed, predict};
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use crate::motion::filter::LowPass;
use crate::motion::{ForceRecording, Motion, Smoother, TimeGrid, Window};
use std::borrow::Borrow;

/// Inputs of a prediction, in addition to the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictionInput<'a> {
    /// Right and left sole.
    pub soles: &'a BySide<Option<Sole>>,
    /// AnalysisSettings of the prediction.
    pub settings: &'a PredictSettings,
    /// Low-pass filter of the measured forces, if any; `None` leaves them unfiltered.
    pub plates_filter: Option<LowPass>,
}

/// Everything that was computed from one recording with predicted forces.
#[derive(Debug, Clone)]
pub struct PredictedAnalysis {
    /// The analysis with predicted forces.
    pub analysis: Analysis,
    /// The prediction.
    pub prediction: Prediction,
    /// The same motion with measured forces; `None` without plates.
    pub measured: Option<Analysis>,
}

/// Analyses a recording with predicted ground forces, otherwise as [`super::analyse`]. Measured forces in `plates` are
/// only used for comparison. A motion that is not borrowed is dropped before the forces are computed: a long recording
/// needs its memory for them.
pub(crate) fn predict_and_analyse(
    model: &Model,
    motion: impl Borrow<Motion>,
    plates: &[ForceRecording],
    settings: AnalysisSettings,
    input: &PredictionInput<'_>,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<PredictedAnalysis, AnalysisError> {
    let trajectory = trajectory_within(model, motion.borrow(), &[], settings, settings.window, findings)?;
    progress.end(Stage::Smoothing)?;
    let prediction = predicted_in_frames(model, motion.borrow(), &trajectory, settings, input, findings)?;
    drop(motion);
    progress.end(Stage::Prediction)?;
    with_plates(model, trajectory, prediction, plates, settings.instrumented, input, findings, progress)
}

/// Predicts the ground forces in the frames of a trajectory, which is a part of the recorded motion.
///
/// # Errors
/// Bodies for which no forces can be predicted: see [`PredictError`](crate::ground::predict::PredictError).
pub(crate) fn predicted_in_frames(
    model: &Model,
    motion: &Motion,
    trajectory: &Trajectory,
    settings: AnalysisSettings,
    input: &PredictionInput<'_>,
    findings: &mut Findings,
) -> Result<Prediction, AnalysisError> {
    if let Some(whole) = prediction_of_whole_motion(model, motion, settings, trajectory.grid(), input, findings) {
        return whole;
    }
    let passed = PredictSettings {
        motion_filter: settings.smoother.low_pass(),
        motion_bandwidth_hz: motion_bandwidth(model, motion, input.soles, settings),
        ..input.settings.clone()
    };
    Ok(predict(model, trajectory, input.soles, &passed, findings)?)
}

/// Predicts from the whole recording, also outside the window, and with the low-pass filter that was used to fit the
/// parameters of the estimator ([`LowPass::MOTION`], docs/measured/GROUND_FIT.md), whatever the filter of the motion
/// is. `None` if the recording outside the window cannot be used, or parts of the result are given.
fn prediction_of_whole_motion(
    model: &Model,
    motion: &Motion,
    settings: AnalysisSettings,
    grid: TimeGrid,
    input: &PredictionInput<'_>,
    findings: &mut Findings,
) -> Option<Result<Prediction, AnalysisError>> {
    /// Frames are simultaneous if they differ by less than this share of a time step.
    const SAME_INSTANT: f64 = 1e-3;
    if settings.filters_as_the_prediction() || input.settings.prescribed != Prescribed::default() {
        return None;
    }
    let settings = AnalysisSettings { smoother: Smoother::Butterworth(LowPass::MOTION), ..settings };
    let whole = trajectory_within(model, motion, &[], settings, Window::default(), &mut Findings::default()).ok()?;
    let offset = (grid.start_s - whole.grid().start_s) / grid.step_s;
    let first = offset.round().max(0.0) as usize;
    let same_steps = (whole.grid().step_s / grid.step_s - 1.0).abs() * (grid.frames as f64) < SAME_INSTANT;
    let is_inside = (offset - first as f64).abs() < SAME_INSTANT && first + grid.frames <= whole.grid().frames;
    if !(same_steps && is_inside) {
        return None;
    }
    let passed = PredictSettings {
        motion_filter: settings.smoother.low_pass(),
        motion_bandwidth_hz: motion_bandwidth(model, motion, input.soles, settings),
        ..input.settings.clone()
    };
    let found = predict(model, &whole, input.soles, &passed, findings);
    Some(found.map(|found| found.within(first..first + grid.frames, grid)).map_err(AnalysisError::from))
}

/// Analyses a complete motion with predicted ground forces. `within` is the instrumented window, if known.
///
/// # Errors
/// Bodies for which no forces can be predicted, unusable plates: see [`AnalysisError`].
pub fn analyse_predicted_trajectory(
    model: &Model,
    trajectory: Trajectory,
    plates: &[ForceRecording],
    within: Option<Window>,
    input: &PredictionInput<'_>,
    findings: &mut Findings,
) -> Result<PredictedAnalysis, AnalysisError> {
    let prediction = predict(model, &trajectory, input.soles, input.settings, findings)?;
    with_plates(model, trajectory, prediction, plates, within, input, findings, &mut Progress::default())
}

/// Both analyses: with predicted forces, and with measured ones if there are any.
#[expect(clippy::too_many_arguments, reason = "shared by both functions that predict")]
fn with_plates(
    model: &Model,
    trajectory: Trajectory,
    prediction: Prediction,
    plates: &[ForceRecording],
    within: Option<Window>,
    input: &PredictionInput<'_>,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<PredictedAnalysis, AnalysisError> {
    let filter = input.plates_filter.filter(|filter| plates.iter().all(|plate| allows(plate, *filter)));
    let source = ForceSource::Measured { filter, within };
    let mut of_plates = Findings::default();
    let measured = match plates {
        [] => None,
        _ => Some(with_forces(model, trajectory.clone(), plates, source, &mut of_plates, &mut Progress::default())?),
    };
    if let Some(measured) = &measured {
        report_plates(model, measured, within.is_some(), &mut of_plates);
    }
    for finding in of_plates.as_slice() {
        let message = format!("measured forces alongside the prediction: {}", finding.message);
        findings.add(Finding { message, ..finding.clone() });
    }
    progress.end(Stage::Plates)?;
    let analysis = with_prediction(model, trajectory, &prediction, findings);
    progress.end(Stage::Analysis)?;
    Ok(PredictedAnalysis { analysis, prediction, measured })
}

/// Checks the measured forces that the prediction is compared with. If the instrumented window is unknown, a residual
/// may be due to a foot outside the plates and is not reported. The range of the motion is checked with the prediction.
fn report_plates(model: &Model, measured: &Analysis, window_is_known: bool, findings: &mut Findings) {
    if window_is_known {
        plausibility::report_residual(measured.mass.kg * model.gravity().norm(), measured.residual, findings);
    }
    plausibility::report_loads(model, &measured.trajectory, &measured.ground, findings);
}

/// Whether the sampling rate of a plate is high enough for a filter.
fn allows(plate: &ForceRecording, filter: LowPass) -> bool {
    TimeGrid::spanning(&plate.times).is_none_or(|grid| filter.cutoff_hz < 0.5 * grid.rate_hz())
}

fn with_prediction(
    model: &Model,
    trajectory: Trajectory,
    prediction: &Prediction,
    findings: &mut Findings,
) -> Analysis {
    let (grid, ground) = (trajectory.grid(), prediction.ground.clone());
    let forces = inverse_with_residual(&mut Workspace::new(model), &trajectory, &ground.loads());
    let inside = |event: &Event| (grid.start_s..=grid.end_s()).contains(&event.time_s);
    let events: Vec<Event> = prediction.footfalls.events().into_iter().filter(inside).collect();
    if !events.iter().any(|event| event.kind == EventKind::Strike) {
        findings.report(Code::EventsNone, "no foot strike was detected in the motion inside the window");
    }
    plausibility::report_ranges(model, &trajectory, findings);
    Analysis {
        cycles: cycles(&events, grid),
        events,
        mass: Mass { kg: model.mass(), source: MassSource::Model },
        speed_m_s: over_ground(model, &trajectory, &ground, model.up()).map(|(_, speed)| speed),
        residual: residual(model, &forces),
        trajectory,
        recorded: None,
        ground,
        forces,
    }
}
