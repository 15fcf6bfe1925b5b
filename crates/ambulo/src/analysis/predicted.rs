//! A recording whose ground forces are predicted from its motion; where plates measured them too, both stand side by side.

use super::cycles::cycles;
use super::events::{Event, EventKind};
use super::feasibility::over_ground;
use super::plausibility;
use super::recording::{
    Analysis, AnalysisError, ForceSource, Mass, MassSource, Settings, trajectory_within, with_forces,
};
use super::residual::residual;
use crate::dynamics::{Workspace, inverse};
use crate::findings::{Code, Finding, Findings};
use crate::ground::predict::{Known, PredictSettings, Prediction, predict};
use crate::ground::upward;
use crate::kinematics::Trajectory;
use crate::model::anatomy::Sole;
use crate::model::{BySide, Model};
use crate::motion::filter::LowPass;
use crate::motion::{ForceRecording, Motion, Smoother, TimeGrid, Window};

/// Low-pass of the motion that a prediction is made from, whatever the one is that joint moments are computed with: the estimator's numbers
/// were fitted behind it, and compare nothing above (docs/GROUND_FIT.md).
const MOTION_LOW_PASS: LowPass = LowPass { order: 3, cutoff_hz: 6.0 };

/// Low-pass of the plates against which a prediction is held, whatever the motion's: 20 Hz, second order, forwards and backwards.
pub const PLATES_LOW_PASS: LowPass = LowPass { order: 2, cutoff_hz: 20.0 };

/// What a prediction needs besides the motion.
#[derive(Debug, Clone, PartialEq)]
pub struct PredictOrder<'a> {
    /// Right and left sole.
    pub soles: &'a BySide<Option<Sole>>,
    /// How forces are predicted.
    pub settings: &'a PredictSettings,
    /// Low-pass of the plates, where there are any; `None` leaves them as they are.
    pub plates_filter: Option<LowPass>,
}

/// Everything that was computed from one recording with predicted forces.
#[derive(Debug, Clone)]
pub struct PredictedAnalysis {
    /// Forces, events and cycles by the prediction.
    pub analysis: Analysis,
    /// The prediction.
    pub prediction: Prediction,
    /// The same motion with the forces that plates measured; `None` without plates.
    pub measured: Option<Analysis>,
}

impl PredictedAnalysis {
    /// Weighs the body by what plates carried: over a whole gait cycle inside the time in which they measured every foot, else in a
    /// standing trial [kg]. Without either the model's mass stays.
    pub fn weigh(&mut self, model: &Model, window_s: Option<[f64; 2]>, standing_kg: Option<f64>) {
        let gravity = model.gravity().norm();
        if let Some(measured) = &mut self.measured {
            if let Some([from, to]) = window_s {
                measured.weigh_within(Window { from_s: Some(from), to_s: Some(to) }, upward(model), gravity);
            }
            if let Some(kg) = standing_kg {
                measured.weigh_standing(kg);
            }
            if measured.mass.source != MassSource::Model {
                self.analysis.mass = measured.mass;
            }
        }
        if let Some(kg) = standing_kg {
            self.analysis.weigh_standing(kg);
        }
    }
}

/// Analyses a recording with predicted ground forces: as [`super::analyse`], without plates. `plates`, if there are any, are only
/// compared with. `stage` is called with a name as each stage ends.
///
/// # Errors
/// Recordings that cannot be used, bodies that no forces can be predicted for: see [`AnalysisError`].
pub fn analyse_predicted(
    model: &Model,
    motion: &Motion,
    plates: &[ForceRecording],
    settings: Settings,
    order: &PredictOrder<'_>,
    findings: &mut Findings,
    stage: &mut dyn FnMut(&'static str),
) -> Result<PredictedAnalysis, AnalysisError> {
    let trajectory = trajectory_within(model, motion, &[], settings, settings.window, findings)?;
    stage("smooth");
    let prediction = match prediction_of_whole_motion(model, motion, settings, trajectory.grid(), order, findings) {
        Some(prediction) => prediction?,
        None => predict(model, &trajectory, order.soles, order.settings, findings)?,
    };
    stage("prediction");
    with_plates(model, trajectory, prediction, plates, settings.instrumented, order, findings, stage)
}

/// The prediction from all that was recorded around the window, behind the low-pass that predictions are made for, whatever that of the
/// motion is. `None` where the recording around the window cannot be used, or parts of the answer are given.
fn prediction_of_whole_motion(
    model: &Model,
    motion: &Motion,
    settings: Settings,
    grid: TimeGrid,
    order: &PredictOrder<'_>,
    findings: &mut Findings,
) -> Option<Result<Prediction, AnalysisError>> {
    /// Frames are the same instants if they differ by less than this share of a step.
    const SAME_INSTANT: f64 = 1e-3;
    let is_the_same =
        settings.smoother == Smoother::Butterworth(MOTION_LOW_PASS) && settings.window == Window::default();
    if is_the_same || order.settings.known != Known::default() {
        return None;
    }
    let settings = Settings { smoother: Smoother::Butterworth(MOTION_LOW_PASS), ..settings };
    let whole = trajectory_within(model, motion, &[], settings, Window::default(), &mut Findings::default()).ok()?;
    let offset = (grid.start_s - whole.grid().start_s) / grid.step_s;
    let first = offset.round().max(0.0) as usize;
    let same_steps = (whole.grid().step_s / grid.step_s - 1.0).abs() * (grid.frames as f64) < SAME_INSTANT;
    let is_inside = (offset - first as f64).abs() < SAME_INSTANT && first + grid.frames <= whole.grid().frames;
    if !(same_steps && is_inside) {
        return None;
    }
    let found = predict(model, &whole, order.soles, order.settings, findings);
    Some(found.map(|found| found.within(first..first + grid.frames, grid)).map_err(AnalysisError::from))
}

/// The same for a motion that is complete. `within` is the time in which plates measured everything, if that is known.
///
/// # Errors
/// Bodies that no forces can be predicted for, plates that cannot be used: see [`AnalysisError`].
pub fn analyse_predicted_trajectory(
    model: &Model,
    trajectory: Trajectory,
    plates: &[ForceRecording],
    within: Option<Window>,
    order: &PredictOrder<'_>,
    findings: &mut Findings,
    stage: &mut dyn FnMut(&'static str),
) -> Result<PredictedAnalysis, AnalysisError> {
    let prediction = predict(model, &trajectory, order.soles, order.settings, findings)?;
    stage("prediction");
    with_plates(model, trajectory, prediction, plates, within, order, findings, stage)
}

/// Both analyses: with the prediction, and with plates if there are any.
#[expect(clippy::too_many_arguments, reason = "the two ways to a prediction meet here")]
fn with_plates(
    model: &Model,
    trajectory: Trajectory,
    prediction: Prediction,
    plates: &[ForceRecording],
    within: Option<Window>,
    order: &PredictOrder<'_>,
    findings: &mut Findings,
    stage: &mut dyn FnMut(&'static str),
) -> Result<PredictedAnalysis, AnalysisError> {
    let filter = order.plates_filter.filter(|filter| plates.iter().all(|plate| allows(plate, *filter)));
    let source = ForceSource::Measured { filter, within };
    let mut of_plates = Findings::default();
    let measured = match plates {
        [] => None,
        _ => Some(with_forces(model, trajectory.clone(), plates, source, &mut of_plates, &mut |_| ())?),
    };
    if let Some(measured) = &measured {
        report_plates(model, measured, within.is_some(), &mut of_plates);
    }
    for finding in of_plates.as_slice() {
        let message = format!("plates beside the prediction: {}", finding.message);
        findings.add(Finding { message, ..finding.clone() });
    }
    stage("plates");
    let analysis = with_prediction(model, trajectory, &prediction, findings);
    stage("analysis");
    Ok(PredictedAnalysis { analysis, prediction, measured })
}

/// Judges the plates that the prediction is compared with. Where it is not known when they measured every foot, a residual may be due
/// to a foot off the plates and is not reported. The range of the motion is judged with the prediction.
fn report_plates(model: &Model, measured: &Analysis, window_is_known: bool, findings: &mut Findings) {
    if window_is_known {
        plausibility::report_residual(model, measured, findings);
    }
    plausibility::report_loads(model, measured, findings);
}

/// Whether a sensor is fast enough for a filter.
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
    let forces = inverse(&mut Workspace::new(model), &trajectory, &ground.loads());
    let inside = |event: &Event| (grid.start_s..=grid.end_s()).contains(&event.time_s);
    let events: Vec<Event> = prediction.footfalls.events().into_iter().filter(inside).collect();
    if !events.iter().any(|event| event.kind == EventKind::Strike) {
        findings.report(Code::EventsNone, "no foot strike was found in the motion inside the window");
    }
    plausibility::report_ranges(model, &trajectory, findings);
    Analysis {
        cycles: cycles(&events, grid),
        events,
        mass: Mass { kg: model.mass(), source: MassSource::Model },
        speed_m_s: over_ground(model, &trajectory, &ground, upward(model)).map(|over| over.speed),
        residual: residual(model, &forces),
        trajectory,
        adjusted: false,
        ground,
        forces,
        verdict: None,
    }
}
