//! Analysis of one recording with measured forces: joint forces, events, gait cycles, body mass and residual.

use super::cycles::{Cycle, cycles};
use super::events::{Contact, Event, EventKind, contacts_from_force, events};
use super::feasibility::over_ground;
use super::plausibility;
use super::progress::{Progress, Stage, Stopped};
use super::residual::{Residual, residual_within};
use crate::dynamics::{Forces, JointMoments, JointPowers, ReactionReader, Workspace, inverse_with_residual};
use crate::findings::{Code, Findings, word};
use crate::ground::predict::PredictError;
use crate::ground::{self, BodyForces, GroundForces};
use crate::kinematics::{Trajectory, TrajectoryError};
use crate::model::{Model, Side};
use crate::motion::filter::LowPass;
use crate::motion::{
    ForceRecording, Motion, MotionError, SmoothSettings, Smoother, Window, check_range, interpolate, smooth,
};
use crate::numerics::mean;
use crate::spatial::Vec3;

/// How a recording is analysed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnalysisSettings {
    /// How the motion is smoothed.
    pub smoother: Smoother,
    /// Low-pass filter of the measured forces; `None` leaves them unfiltered.
    pub force_filter: Option<LowPass>,
    /// The time range to analyse.
    pub window: Window,
    /// Frame rate of the results [Hz]; `None` keeps the value of the recording.
    pub rate_hz: Option<f64>,
    /// The instrumented window, if known: outside it forces may be missing and the residual is not evaluated. `None`:
    /// the measured forces are complete at all times.
    pub instrumented: Option<Window>,
}

impl AnalysisSettings {
    /// Whether ground forces are predicted from the same motion that is analysed: the whole recording, with the
    /// low-pass filter that was used to fit the parameters of the estimator ([`LowPass::MOTION`],
    /// docs/measured/GROUND_FIT.md).
    pub(crate) fn filters_as_the_prediction(&self) -> bool {
        self.smoother == Smoother::Butterworth(LowPass::MOTION) && self.window == Window::default()
    }
}

/// Everything that was computed from one recording.
#[derive(Debug, Clone)]
pub struct Analysis {
    /// The motion that was used.
    pub trajectory: Trajectory,
    /// The recorded motion, where it was changed so that motion and forces agree (`reduce_residual`, [`super::track`]).
    pub recorded: Option<Trajectory>,
    /// The ground forces at the times of the trajectory.
    pub ground: GroundForces,
    /// Joint forces, and the reactions in the joints to ground.
    pub forces: Forces,
    /// Foot strikes and foot offs inside the trajectory, in order of time.
    pub events: Vec<Event>,
    /// Whole gait cycles inside the trajectory.
    pub cycles: Vec<Cycle>,
    /// Body mass.
    pub mass: Mass,
    /// Walking speed relative to the ground or belt [m/s], if a foot carried enough to determine it.
    pub speed_m_s: Option<f64>,
    /// Residual force and moment.
    pub residual: Option<Residual>,
}

/// Body mass and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mass {
    /// Mass [kg].
    pub kg: f64,
    /// Source of the mass.
    pub source: MassSource,
}

/// Where a mass comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize, serde::Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "lowercase")]
pub enum MassSource {
    /// Mean vertical force over whole gait cycles.
    Plates,
    /// Mean vertical force of a standing trial.
    Standing,
    /// The model's own mass.
    Model,
}

impl Analysis {
    /// The powers of the generalised forces.
    #[must_use]
    pub fn powers(&self, model: &Model) -> JointPowers<'_> {
        JointPowers::new(model, &self.trajectory, &self.forces.generalized)
    }

    /// The moments of hip, knee and ankle in three planes, from the reactions in these joints.
    #[must_use]
    pub fn joint_moments(&self, model: &Model) -> JointMoments<'_> {
        JointMoments::new(model, &self.trajectory, self.ground.loads())
    }

    /// The reactions in all joints; [`Analysis::forces`] has only the reactions of joints to ground.
    #[must_use]
    pub fn reactions(&self, model: &Model) -> ReactionReader<'_> {
        ReactionReader::new(model, &self.trajectory, self.ground.loads())
    }
}

impl MassSource {
    /// The name in files.
    #[must_use]
    pub fn word(self) -> &'static str {
        word(&self)
    }
}

/// Why a recording could not be analysed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum AnalysisError {
    /// The recorded motion is unusable.
    #[error(transparent)]
    Motion(MotionError),
    /// The recorded forces are unusable.
    #[error(transparent)]
    Ground(MotionError),
    /// The motion cannot be completed to a trajectory.
    #[error(transparent)]
    Trajectory(#[from] TrajectoryError),
    /// The ground forces cannot be predicted.
    #[error(transparent)]
    Prediction(#[from] PredictError),
    /// The observer stopped the computation.
    #[error(transparent)]
    Stopped(#[from] Stopped),
}

/// A mean vertical force within this share of the model's weight is accepted as the weight of the whole body.
pub(super) const WHOLE_BODY_SHARE: f64 = 0.05;
/// A larger difference between plates and model gives a warning (an issue of scaling or of the plates).
const MASS_MISMATCH: f64 = 0.03;

/// Analyses recorded coordinates with measured forces: smoothing, inverse dynamics, events, cycles, body mass and
/// residual. It is the inner step of [`crate::study::run`] for measured forces.
///
/// The window is limited to the time that the force recordings cover, with a finding.
///
/// # Errors
/// Unusable recordings: see [`MotionError`], [`TrajectoryError`].
pub fn analyse(
    model: &Model,
    motion: &Motion,
    plates: &[ForceRecording],
    settings: AnalysisSettings,
    findings: &mut Findings,
) -> Result<Analysis, AnalysisError> {
    let trajectory = trajectory_of_measured(model, motion, plates, settings, findings)?;
    let source = ForceSource::Measured { filter: settings.force_filter, within: settings.instrumented };
    analyse_trajectory(model, trajectory, plates, source, findings)
}

/// The motion, smoothed and completed, during the time that the force recordings cover; with a finding if that is not
/// the whole window.
///
/// # Errors
/// A motion that cannot be smoothed: see [`AnalysisError`].
pub(crate) fn trajectory_of_measured(
    model: &Model,
    motion: &Motion,
    plates: &[ForceRecording],
    settings: AnalysisSettings,
    findings: &mut Findings,
) -> Result<Trajectory, AnalysisError> {
    let window = covered(motion, plates, settings.window, findings);
    trajectory_within(model, motion, plates, settings, window, findings)
}

/// The whole motion, smoothed and completed.
///
/// # Errors
/// A motion that cannot be smoothed: see [`AnalysisError`].
pub(crate) fn recorded_trajectory(
    model: &Model,
    motion: &Motion,
    smoother: Smoother,
) -> Result<Trajectory, AnalysisError> {
    let (window, rate_hz) = (Window::default(), None);
    let settings = AnalysisSettings { smoother, force_filter: None, window, rate_hz, instrumented: None };
    trajectory_within(model, motion, &[], settings, window, &mut Findings::default())
}

/// Smooths and completes the motion inside a window; `plates` only serve the error message.
pub(super) fn trajectory_within(
    model: &Model,
    motion: &Motion,
    plates: &[ForceRecording],
    settings: AnalysisSettings,
    window: Window,
    findings: &mut Findings,
) -> Result<Trajectory, AnalysisError> {
    check_range(motion, settings.window).map_err(AnalysisError::Motion)?;
    let smoothing = SmoothSettings { smoother: settings.smoother, window, rate_hz: settings.rate_hz };
    let smoothed = smooth(model, motion, smoothing, findings)
        .map_err(|e| AnalysisError::Motion(with_requested_window(e, settings.window, motion, plates)))?;
    Ok(Trajectory::complete(model, smoothed, findings)?)
}

/// Where the ground forces come from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ForceSource {
    /// Force plates. They also give the body mass if they measured whole cycles.
    Measured {
        /// Low-pass filter of the forces; `None` leaves them unfiltered.
        filter: Option<LowPass>,
        /// The instrumented window, if known.
        within: Option<Window>,
    },
    /// An exact simulation of the same model; the mass is the model's.
    Simulated,
}

/// Analyses a complete recorded or synthetic motion with its ground forces: [`analyse`] without smoothing.
///
/// # Errors
/// Unusable forces: see [`MotionError`].
pub fn analyse_trajectory(
    model: &Model,
    trajectory: Trajectory,
    plates: &[ForceRecording],
    source: ForceSource,
    findings: &mut Findings,
) -> Result<Analysis, AnalysisError> {
    analyse_measured(model, trajectory, plates, source, findings, &mut Progress::default())
}

pub(crate) fn analyse_measured(
    model: &Model,
    trajectory: Trajectory,
    plates: &[ForceRecording],
    source: ForceSource,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Analysis, AnalysisError> {
    let analysis = with_forces(model, trajectory, plates, source, findings, progress)?;
    if !plates.is_empty() {
        plausibility::report_residual(analysis.mass.kg * model.gravity().norm(), analysis.residual, findings);
    }
    plausibility::report_loads(model, &analysis.trajectory, &analysis.ground, findings);
    plausibility::report_ranges(model, &analysis.trajectory, findings);
    progress.end(Stage::Analysis)?;
    Ok(analysis)
}

/// The analysis itself, without the checks whether motion and forces belong together.
pub(super) fn with_forces(
    model: &Model,
    trajectory: Trajectory,
    plates: &[ForceRecording],
    source: ForceSource,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Analysis, AnalysisError> {
    let (filter, within) = match source {
        ForceSource::Measured { filter, within } => (filter, within),
        ForceSource::Simulated => (None, None),
    };
    let ground = ground::measured(model, &trajectory, plates, filter, findings).map_err(AnalysisError::Ground)?;
    report_sides(model, &ground, findings);
    progress.end(Stage::Ground)?;
    let forces = inverse_with_residual(&mut Workspace::new(model), &trajectory, &ground.loads());
    progress.end(Stage::InverseDynamics)?;
    let up = model.up();
    let vertical = vertical_by_side(model, plates, up);
    let contacts: Vec<(Side, Vec<Contact>)> =
        vertical.iter().map(|(side, (times, force))| (*side, contacts_from_force(times, force))).collect();
    let grid = trajectory.grid();
    let inside = |event: &Event| (grid.start_s..=grid.end_s()).contains(&event.time_s);
    let events: Vec<Event> = events(&contacts).into_iter().filter(inside).collect();
    let cycles = cycles(&events, grid);
    if !plates.is_empty() && !events.iter().any(|e| e.kind == EventKind::Strike) {
        findings.report(Code::EventsNone, "no foot strike was detected in the forces inside the window");
    }
    let mass = match source {
        ForceSource::Measured { .. } => mass(model, &vertical, &cycles_for_mass(&cycles, &events, findings), findings),
        ForceSource::Simulated => Mass { kg: model.mass(), source: MassSource::Model },
    };
    let speed_m_s = over_ground(model, &trajectory, &ground, up).map(|(_, speed)| speed);
    let (first, frames) = grid.inside(within.unwrap_or_default());
    let residual = residual_within(model, &forces, first..first + frames);
    Ok(Analysis { trajectory, recorded: None, ground, forces, events, cycles, mass, speed_m_s, residual })
}

/// Puts the requested time range into the error of a range that is too short, with the time that motion and forces both
/// cover.
fn with_requested_window(
    error: MotionError,
    requested: Window,
    motion: &Motion,
    plates: &[ForceRecording],
) -> MotionError {
    let (found, expected) = match error {
        MotionError::TooShort { found, expected, .. } => (found, expected),
        MotionError::Outside { .. } => (0, 1),
        other => return other,
    };
    let whole = Window { from_s: motion.times.first().copied(), to_s: motion.times.last().copied() };
    let both = plates.iter().fold(whole, |window, plate| window.overlap(recorded(plate)));
    let (first_s, last_s) = (both.from_s.unwrap_or(f64::NAN), both.to_s.unwrap_or(f64::NAN));
    let (from_s, to_s) = (requested.from_s.unwrap_or(first_s), requested.to_s.unwrap_or(last_s));
    let forces = plates.iter().map(recorded).reduce(Window::overlap);
    let span = |window: Window| [window.from_s.unwrap_or(f64::NAN), window.to_s.unwrap_or(f64::NAN)];
    match forces {
        Some(forces) if first_s > last_s || requested == Window::default() => {
            MotionError::NoCommonTime { found, motion_s: span(whole), forces_s: span(forces) }
        }
        _ => MotionError::TooShort { found, expected, from_s, to_s, first_s, last_s }.or_outside(),
    }
}

pub(super) fn recorded(plate: &ForceRecording) -> Window {
    Window { from_s: plate.times.first().copied(), to_s: plate.times.last().copied() }
}

/// Reports loads that `grf.mot`, which has one foot per side, cannot represent.
fn report_sides(model: &Model, ground: &GroundForces, findings: &mut Findings) {
    let side_of = |b: &BodyForces| model.anatomy().body_side(b.body);
    let name = |b: &BodyForces| model.bodies()[b.body.index()].name.as_str();
    for name in ground.bodies.iter().filter(|b| side_of(b).is_none()).map(name) {
        let message =
            format!("the load on `{name}`, which belongs to neither side, is used but not written to grf.mot");
        findings.report(Code::LoadsNoSide, message);
    }
    for side in Side::BOTH {
        let bodies: Vec<&str> = ground.bodies.iter().filter(|b| side_of(b) == Some(side)).map(name).collect();
        if bodies.len() > 1 {
            let message = format!(
                "loads act on {} on the {side} side; grf.mot contains their sum, on the body with the largest load",
                bodies.join(" and ")
            );
            findings.report(Code::LoadsSeveralBodies, message);
        }
    }
}

/// The window, limited to the time that the plates recorded.
fn covered(motion: &Motion, plates: &[ForceRecording], window: Window, findings: &mut Findings) -> Window {
    let mut covered = window;
    for plate in plates {
        covered = covered.overlap(recorded(plate));
    }
    let end = |w: Window| w.to_s.or(motion.times.last().copied()).unwrap_or(f64::INFINITY);
    let start = |w: Window| w.from_s.or(motion.times.first().copied()).unwrap_or(f64::NEG_INFINITY);
    let motion_ends = motion.times.last().copied().unwrap_or(f64::INFINITY);
    let motion_starts = motion.times.first().copied().unwrap_or(f64::NEG_INFINITY);
    if end(covered) < end(window).min(motion_ends) || start(covered) > start(window).max(motion_starts) {
        let message = format!(
            "the forces were only recorded from {:.3} s to {:.3} s; the rest of the motion was left out",
            start(covered),
            end(covered)
        );
        findings.report(Code::LoadsShorterThanMotion, message);
    }
    covered
}

pub(crate) type TimedForce = (Vec<f64>, Vec<f64>);

/// Times and total vertical force [N] of each measured foot, as recorded.
pub(crate) fn vertical_by_side(model: &Model, plates: &[ForceRecording], up: Vec3) -> Vec<(Side, TimedForce)> {
    let mut list = Vec::new();
    for side in Side::BOTH {
        let of_side = |p: &&ForceRecording| model.anatomy().body_side(p.body) == Some(side);
        let mut plates = plates.iter().filter(of_side);
        let Some(first) = plates.next() else { continue };
        let vertical = |p: &ForceRecording| p.force.iter().map(|f| zero_if_unknown(f.dot(&up))).collect::<Vec<f64>>();
        let mut total = vertical(first);
        for plate in plates {
            let other = vertical(plate);
            for (sum, &t) in total.iter_mut().zip(&first.times) {
                *sum += interpolate(&plate.times, &other, t);
            }
        }
        list.push((side, (first.times.clone(), total)));
    }
    list
}

fn zero_if_unknown(x: f64) -> f64 {
    if x.is_finite() { x } else { 0.0 }
}

/// The cycles with foot off and foot strike of the other foot; in other cycles it may have been outside the plates.
fn cycles_for_mass(cycles: &[Cycle], events: &[Event], findings: &mut Findings) -> Vec<Cycle> {
    let is_complete = |cycle: &&Cycle| {
        let other = |e: &&Event| e.side != cycle.side && e.time_s > cycle.start_s && e.time_s < cycle.end_s;
        [EventKind::Strike, EventKind::Off].iter().all(|kind| events.iter().filter(other).any(|e| e.kind == *kind))
    };
    let (whole, partial): (Vec<&Cycle>, Vec<&Cycle>) = cycles.iter().partition(is_complete);
    for cycle in partial {
        let message = format!(
            "{} cycle {} ({:.3} to {:.3} s): no foot off and foot strike of the other foot were measured; it may have \
             been outside the plates, so this cycle does not give the body mass",
            cycle.side, cycle.number, cycle.start_s, cycle.end_s
        );
        findings.report(Code::CyclesOtherFootUnseen, message);
    }
    whole.into_iter().copied().collect()
}

/// m = mean vertical force / g over whole cycles, if this is near the model's mass; else the model's mass.
fn mass(model: &Model, vertical: &[(Side, TimedForce)], cycles: &[Cycle], findings: &mut Findings) -> Mass {
    let (stated, g) = (model.mass(), model.gravity().norm());
    let weighed: Vec<f64> = cycles.iter().filter_map(|c| cycle_mean(vertical, c)).map(|f| f / g).collect();
    if weighed.is_empty() {
        return Mass { kg: stated, source: MassSource::Model };
    }
    let mean = mean(&weighed);
    if (mean / stated - 1.0).abs() > WHOLE_BODY_SHARE {
        return Mass { kg: stated, source: MassSource::Model };
    }
    if (mean / stated - 1.0).abs() > MASS_MISMATCH {
        let message = format!(
            "the force plates measure {mean:.1} kg over whole cycles, the model has {stated:.1} kg; results are \
             normalised by the measured mass, the dynamics use the model's. hint: scale the model to this person"
        );
        findings.report(Code::MassMismatch, message);
    }
    Mass { kg: mean, source: MassSource::Plates }
}

/// Mean of the total vertical force over a cycle [N], by the trapezium rule on the recorded samples.
pub fn cycle_mean(vertical: &[(Side, TimedForce)], cycle: &Cycle) -> Option<f64> {
    let mut mean = 0.0;
    for (_, (times, force)) in vertical {
        let mut area = 0.0;
        for (t, f) in times.windows(2).zip(force.windows(2)) {
            let (from, to) = (t[0].max(cycle.start_s), t[1].min(cycle.end_s));
            if to > from {
                let at = |x: f64| f[0] + (f[1] - f[0]) * (x - t[0]) / (t[1] - t[0]);
                area += 0.5 * (at(from) + at(to)) * (to - from);
            }
        }
        mean += area / (cycle.end_s - cycle.start_s);
    }
    (!vertical.is_empty()).then_some(mean)
}
