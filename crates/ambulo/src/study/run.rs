//! Runs a study: from a recording to forces.

use super::error::StudyError;
use super::force_directions::ForceDirections;
use super::idle_forces::IdleForces;
use super::mass::BodyMass;
use super::measured::{Measured, StanceLoads, measured};
use super::misfits;
use super::muscles::solved;
use super::not_measured::not_measured;
use super::observation::{Observation, ObservedMotion, Origin};
use super::origin::{ForceOrigin, TrackedMarkers, Tracking};
use super::outcome::{Outcome, PredictedGround, Processing};
use super::prediction::{Found, predicted, with_markers};
use super::quality::{Measure, PlatePlace, Quality, QualityEvidence, RecordedFaults, StanceHeights};
use super::refit::refitted;
use super::region_fit::RegionFit;
use super::settings::{GroundSettings, Settings};
use super::source::Source;
use super::timing::{CenterOffset, PlateTiming, Tempo};
use super::tracked::tracked;
use super::unmeasured_leg::UnmeasuredLeg;
use crate::analysis::activity::{Activity, ActivityKind, activity};
use crate::analysis::feasibility::{self, Check, MotionAndForces, Person, PredictedForces, Reason, Verdict};
use crate::analysis::{
    self, Adjustable, Analysis, ForceSource, PredictionChecks, Progress, Stage, TimesAndDistances, analyse_measured,
    reduce_residual, times_and_distances,
};
use crate::dynamics::residual_reduction::ReducedMotion;
use crate::dynamics::{Workspace, inverse_with_residual};
use crate::findings::{Code, Findings};
use crate::ground::footfalls::{Footfall, Footfalls, footfalls};
use crate::ground::predict::predict;
use crate::ground::stances::{Stance, StanceSource};
use crate::model::anatomy::Movement;
use crate::model::{CoordinateId, Model};
use crate::motion::{DeviceRecording, Event, Smoother, Window, device_from_table};
use std::borrow::Cow;
use std::ops::ControlFlow;

/// How the forces are divided between the feet by [`GroundSettings::Tracked`].
const TRACKED: &str =
    "tracking: feet on soft ground, near the recorded motion and near a maximum a posteriori estimate";

/// Computes the forces behind a recording. Problems that still allow results are reported in `findings`. The recording
/// is dropped as soon as it is not needed any more; clone it to compute it again.
///
/// # Errors
/// Recordings that give no forces: see [`StudyError`].
///
/// A person of 72.6 kg who hangs still in the air, without ground forces; the motion needs the body weight at the root
/// joint:
///
/// ```
/// use ambulo::findings::Findings;
/// use ambulo::model::anthropometry::{Build, SegmentTable};
/// use ambulo::motion::Motion;
/// use ambulo::study::{self, GroundSettings, Settings, Source};
///
/// let build = Build { table: SegmentTable::DeLevaMale, mass: 72.6, height: 1.80, toe_joint: false };
/// let model = build.human()?.model;
/// let vertical = model.coordinate("pelvis_ty").ok_or("no such coordinate")?;
/// let times: Vec<f64> = (0..100).map(|i| 0.01 * f64::from(i)).collect();
/// let columns = vec![Some(vec![0.0; times.len()]); model.coordinates().len()];
/// let source = Source::coordinates(model, Motion { origin: "still".to_owned(), times, columns });
/// let settings = Settings { ground: GroundSettings::NoContact, ..Settings::default() };
/// let outcome = study::run(source, &settings, &mut Findings::default())?;
/// let force = &outcome.analysis.forces.generalized[vertical.index()];
/// assert!(force.iter().all(|force| (force - 72.6 * 9.80665).abs() < 1e-6));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn run(source: Source, settings: &Settings, findings: &mut Findings) -> Result<Outcome, StudyError> {
    road(source, settings, findings, &mut Progress::default())
}

/// As [`run`]; `observer` is called as each stage ends, and stops the run by [`ControlFlow::Break`].
///
/// # Errors
/// As [`run`], and [`StudyError::Stopped`] if the observer stops it.
pub fn run_observed(
    source: Source,
    settings: &Settings,
    findings: &mut Findings,
    observer: &mut dyn FnMut(Stage) -> ControlFlow<()>,
) -> Result<Outcome, StudyError> {
    road(source, settings, findings, &mut Progress::watched_by(observer))
}

fn road(
    mut source: Source,
    settings: &Settings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Outcome, StudyError> {
    let muscles = source.muscles.take();
    let knee_width_m = source.knee_width_m();
    let (observed, motion) = source.observe(settings, findings, progress)?;
    let not_measured = unmeasured(&observed, &motion, findings);
    let motion = if settings.refit { refitted(&observed, motion, settings, findings) } else { motion };
    let device = device(&observed, findings)?;
    let recorded = recorded_faults(&observed.model, &motion);
    let processing = processing(&observed, recorded.is_none(), settings, findings);
    let (observed, found, mass) = weighed(observed, motion, processing, settings, findings, progress)?;
    let Found { analysis, prediction, measured_events, loads, processing } = found;
    let timing = plate_timing(&observed, &analysis, prediction.as_ref(), loads.as_ref(), &processing, findings);
    let directions = ForceDirections::of(&observed, &analysis.trajectory);
    directions.report(findings);
    let Observation { model, person, origin, idle, .. } = observed;
    let force_origin = force_origin(&origin, prediction.as_ref(), settings);
    let (analysis, reduction) =
        residual_reduced(&model, analysis, processing, settings, &force_origin, findings, progress)?;
    let subject = origin.subject();
    let (partly_measured, place_is_derived) = (origin.partly_measured(), matches!(origin, Origin::Sensors));
    let tracking = tracking(origin, measured_events);
    misfits::report(tracking.as_ref().map_or(&[], Tracking::regions), findings);
    let computed = Computed {
        subject,
        body: reduction.as_ref().map_or(model, |reduced| reduced.model.clone()),
        device: device.map(|device| worn(&device, &analysis, findings)),
        partly_measured,
        place_is_derived,
        tracking,
        person,
        analysis,
        prediction,
        loads,
        reduction,
        mass,
        idle,
        timing,
        directions,
        recorded,
        not_measured,
        processing,
        force_origin,
    };
    let mut outcome = computed.judged(settings, findings);
    outcome.muscles = muscles.map(|request| solved(request, knee_width_m, &outcome, findings)).transpose()?;
    report_sliding(&outcome, settings, findings);
    progress.end(Stage::Feasibility)?;
    Ok(outcome)
}

/// Forces and body mass. If force plates carry another mass than a given model has, and no mass is stated, the model
/// with the weighed mass is used.
fn weighed(
    mut observed: Observation,
    motion: ObservedMotion,
    processing: analysis::AnalysisSettings,
    settings: &Settings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<(Observation, Found, BodyMass), StudyError> {
    let kept = observed.takes_weighed_mass().then(|| (motion.clone(), findings.clone()));
    let mut found = forces(&observed, motion, processing, settings, findings, progress)?;
    let mut mass = body_mass(&observed, &found.analysis, findings);
    if let Some(((motion, before), kg)) = kept.zip(mass.in_place_of_the_models()) {
        *findings = before;
        observed.scale_to(kg, findings)?;
        found = forces(&observed, motion, processing, settings, findings, progress)?;
        mass = body_mass(&observed, &found.analysis, findings);
    }
    Ok((observed, found, mass))
}

/// Everything that was computed, before it is judged.
struct Computed {
    /// Checksum of the name of the person in the file.
    subject: Option<u64>,
    body: Model,
    person: Person,
    analysis: Analysis,
    prediction: Option<PredictedGround>,
    /// The stances of measured forces.
    loads: Option<StanceLoads>,
    reduction: Option<ReducedMotion>,
    device: Option<Vec<Vec<f64>>>,
    mass: BodyMass,
    idle: IdleForces,
    /// The clock of the recording by its force plates.
    timing: PlateTiming,
    directions: ForceDirections,
    tracking: Option<Tracking>,
    /// Whether the place of the person follows from the feet on the ground.
    place_is_derived: bool,
    /// Times in which a force plate measured only a part of a foot's load [s].
    partly_measured: Vec<[f64; 2]>,
    recorded: Option<RecordedFaults>,
    /// Coordinates that are not measured, and whether they are held.
    not_measured: Vec<(CoordinateId, bool)>,
    processing: analysis::AnalysisSettings,
    force_origin: ForceOrigin,
}

/// What is found out about data and movement.
struct Judgement {
    activity: Activity,
    strides: TimesAndDistances,
    stances: Vec<Stance>,
    verdict: Verdict,
    quality: Quality,
}

impl Computed {
    /// With activity, verdict and quality.
    fn judged(self, settings: &Settings, findings: &mut Findings) -> Outcome {
        let Judgement { activity, strides, stances, verdict, quality } = self.judgement(settings, findings);
        let Computed { body, analysis, force_origin, .. } = self;
        let loads = self.loads.as_ref();
        Outcome {
            stances,
            completed: loads.and_then(|loads| loads.complete(&body, &analysis)),
            force_delay_s: self.timing.delay.map(|delay| delay.delay_s),
            quality,
            mass: self.mass.after_reduction(body.mass()),
            tracking: self.tracking,
            activity,
            times_and_distances: strides,
            body,
            person: self.person,
            analysis,
            force_origin: loads.and_then(StanceLoads::rule).map_or(force_origin, |rule| ForceOrigin::Mixed { rule }),
            prediction: self.prediction,
            residual_reduction: self.reduction,
            device: self.device,
            not_measured: self.not_measured.into_iter().map(|(id, _)| id).collect(),
            verdict,
            processing: Processing::of(&self.processing),
            subject: self.subject,
            muscles: None,
        }
    }

    fn judgement(&self, settings: &Settings, findings: &mut Findings) -> Judgement {
        let Computed { body, person, analysis, mass, processing, force_origin, .. } = self;
        let (loads, prediction, tracking) = (self.loads.as_ref(), self.prediction.as_ref(), self.tracking.as_ref());
        let falls = stances(body, person, analysis, prediction, loads, *processing);
        let activity = recognised(body, person, analysis, &falls, force_origin, findings);
        let judged = Judged {
            activity: activity.kind,
            stances: &falls,
            cutoff_hz: processing.smoother.cutoff_hz(),
            model: body,
            person,
            analysis,
            device: self.device.as_deref(),
            checks: prediction.map(|found| &found.checks),
        };
        let verdict = judged.verdict(settings, force_origin, &self.partly_measured, findings);
        let verdict = without_faults_of_data(verdict, tracking, mass, &self.idle, force_origin);
        let verdict = self.directions.set_aside(verdict, force_origin);
        let stances = loads.map_or_else(|| stances_of(analysis, prediction), |loads| loads.stances.clone());
        let unmeasured_leg = UnmeasuredLeg::of(&stances, &self.idle);
        unmeasured_leg.iter().for_each(|leg| leg.report(findings));
        let strides = times_and_distances(body, &person.soles, analysis);
        let measured = *force_origin == ForceOrigin::Measured;
        let place_of = || PlatePlace::of(body, &analysis.trajectory, &person.soles, &analysis.ground);
        let place = measured.then(place_of).flatten();
        place.iter().for_each(|place| place.report(findings));
        let (center_offset, lost_forces) = (self.center_offset(&stances, findings), lost_forces(findings));
        // The clock of a computed motion is known.
        let by_gait = || {
            self.recorded.as_ref()?;
            tempo_of_gait(body, person, analysis, &falls, &strides, activity.kind, findings)
        };
        let evidence = QualityEvidence {
            height_m: person.height_m,
            lost_forces,
            recorded: self.recorded.as_ref(),
            smoothed: (processing.smoother, analysis.trajectory.grid().rate_hz()),
            is_too_short: feasibility::inner_frames(analysis.trajectory.grid()).is_empty(),
            force_origin: *force_origin,
            is_never_complete: loads.is_some_and(StanceLoads::are_incomplete) && analysis.residual.is_none(),
            tracking,
            place_is_derived: self.place_is_derived,
            mass,
            not_measured: &self.not_measured,
            model: body,
            idle: &self.idle,
            unmeasured_leg: unmeasured_leg.as_ref(),
            directions: &self.directions,
            heights: StanceHeights::of(body, &analysis.trajectory, &person.soles, &falls, activity.kind),
            place,
            center_offset,
            verdict: &verdict,
            delay: self.timing.delay.filter(|_| measured),
            tempo: self.timing.tempo.or_else(by_gait),
            shown: prediction.and_then(|found| found.checks.get("motion_bandwidth")),
        };
        Judgement { quality: evidence.quality(), activity, strides, stances, verdict }
    }
}

impl Computed {
    /// Where plates measured the centre of pressure, against where the motion needs it, if the whole body is known: a
    /// trunk that was not recorded may lean.
    fn center_offset(&self, stances: &[Stance], findings: &mut Findings) -> Option<CenterOffset> {
        let trunk = [Movement::TrunkLean, Movement::TrunkObliquity];
        let mut of_trunk = trunk.into_iter().filter_map(|movement| self.body.anatomy().coordinate(movement, None));
        let is_recorded = of_trunk.all(|(id, _)| self.not_measured.iter().all(|(open, _)| *open != id));
        let is_known = is_recorded && !findings.has(Code::CalibrationTrunkUpright);
        if self.force_origin != ForceOrigin::Measured || !is_known {
            return None;
        }
        let found = CenterOffset::of(&self.body, &self.analysis, &self.person.soles, stances)?;
        found.report(findings);
        Some(found)
    }
}

/// Coordinates that nothing recorded determines. Recorded coordinates are what they are.
fn unmeasured(observed: &Observation, motion: &ObservedMotion, findings: &mut Findings) -> Vec<(CoordinateId, bool)> {
    match (&observed.origin, motion) {
        (Origin::Markers(_) | Origin::Skeleton(_) | Origin::Sensors, ObservedMotion::Recorded(motion)) => {
            not_measured(&observed.model, motion, findings)
        }
        _ => Vec::new(),
    }
}

/// Messages about measured forces of which a part is missing or wrong.
fn lost_forces(findings: &Findings) -> Vec<String> {
    let of_size = [Code::PlatesShearGain, Code::PlatesSkewed, Code::PlatesUnequal];
    let of_lost = [&[Code::PlatesStillChannel, Code::PlatesClipped, Code::PlatesLost][..], &of_size].concat();
    let lost = findings.as_slice().iter().filter(|finding| of_lost.contains(&finding.code));
    lost.map(|finding| finding.message.clone()).collect()
}

/// Faults of a recorded motion, before it is smoothed.
fn recorded_faults(model: &Model, motion: &ObservedMotion) -> Option<RecordedFaults> {
    match motion {
        ObservedMotion::Recorded(motion) => Some(RecordedFaults::of(model, motion)),
        ObservedMotion::Complete(_) => None,
    }
}

/// The body mass by every source.
fn body_mass(observation: &Observation, analysis: &Analysis, findings: &mut Findings) -> BodyMass {
    let weighed = observation.weighed_in_motion(&analysis.trajectory);
    let mass = BodyMass::of(observation.model.mass(), &observation.known_mass, weighed, analysis.mass.source);
    mass.report(findings);
    mass.report_statement(observation.person.height_m, findings);
    mass
}

/// Checks the clock against measured forces, also those that a prediction is compared with; reports a fault.
fn plate_timing(
    observed: &Observation,
    analysis: &Analysis,
    prediction: Option<&PredictedGround>,
    loads: Option<&StanceLoads>,
    processing: &analysis::AnalysisSettings,
    findings: &mut Findings,
) -> PlateTiming {
    let measured = match prediction {
        Some(predicted) => predicted.measured.as_ref(),
        None => Some(analysis).filter(|_| !matches!(observed.origin, Origin::Simulation { .. })),
    };
    let stances = loads.filter(|_| analysis.recorded.is_none()).map(|loads| &loads.footfalls);
    let timing = |measured| PlateTiming::of(observed, measured, stances, processing);
    let found = measured.and_then(timing).unwrap_or_default();
    found.delay.iter().for_each(|delay| delay.report(findings));
    found.tempo.iter().for_each(|tempo| tempo.report(findings));
    found
}

fn device(observed: &Observation, findings: &mut Findings) -> Result<Option<DeviceRecording>, StudyError> {
    let device = observed.device.as_ref().map(|table| device_from_table(&observed.model, table, findings));
    device.transpose().map_err(StudyError::Device)
}

/// The moments of a worn device on the frames of the motion.
fn worn(device: &DeviceRecording, analysis: &Analysis, findings: &mut Findings) -> Vec<Vec<f64>> {
    let grid = analysis.trajectory.grid();
    device.report_cover(grid, findings);
    device.on(grid)
}

fn report_missing_cycles(analysis: &Analysis, findings: &mut Findings) {
    if analysis.cycles.is_empty() {
        let message = "no whole gait cycle in the window: cycles.csv and the figure were not written";
        findings.report(Code::CyclesNone, message);
    }
}

/// The stances in this motion, which are detected if they are not known.
fn stances<'p>(
    model: &Model,
    person: &Person,
    analysis: &Analysis,
    prediction: Option<&'p PredictedGround>,
    loads: Option<&'p StanceLoads>,
    processing: analysis::AnalysisSettings,
) -> Cow<'p, Footfalls> {
    let of_measured = loads.filter(|_| analysis.recorded.is_none()).map(|loads| &loads.footfalls);
    let known = prediction.and_then(|found| found.stances(analysis, processing)).or(of_measured);
    let detect = || footfalls(model, &analysis.trajectory, &person.soles, &mut Findings::default());
    known.map_or_else(|| Cow::Owned(detect()), Cow::Borrowed)
}

/// The clock by the gait, for activities with steps on one level.
fn tempo_of_gait(
    body: &Model,
    person: &Person,
    analysis: &Analysis,
    stances: &Footfalls,
    strides: &TimesAndDistances,
    activity: ActivityKind,
    findings: &mut Findings,
) -> Option<Tempo> {
    let walks = matches!(activity, ActivityKind::Walk | ActivityKind::Turn);
    let found = Tempo::of_gait(body, &person.soles, analysis, stances, strides, person.leg_length_m);
    let found = found.filter(|_| walks)?;
    found.report(findings);
    Some(found)
}

/// Recognises the activity; reports a recording without a whole gait cycle, and ground forces that are predicted for an
/// activity without validation.
fn recognised(
    model: &Model,
    person: &Person,
    analysis: &Analysis,
    stances: &Footfalls,
    force_origin: &ForceOrigin,
    findings: &mut Findings,
) -> Activity {
    report_missing_cycles(analysis, findings);
    let found = activity(model, &analysis.trajectory, &person.soles, person.leg_length_m, stances);
    report_untested_prediction(found.kind, force_origin, findings);
    found
}

/// Drops reasons against the movement that errors of the data explain: a body that does not follow its markers, force
/// plates that carry another weight than the body's, measured forces that belong to no foot. No movement changes the
/// mean force on the ground from the weight.
fn without_faults_of_data(
    verdict: Verdict,
    tracking: Option<&Tracking>,
    mass: &BodyMass,
    idle: &IdleForces,
    force_origin: &ForceOrigin,
) -> Verdict {
    let mut verdict = misfits::set_aside(verdict, tracking.map_or(&[], Tracking::regions));
    let carried = mass.in_motion().filter(|_| *force_origin == ForceOrigin::Measured);
    let of_weight = |reason: &Reason| matches!(reason.check, Check::Support | Check::Acceleration | Check::Pull);
    if let Some(carried) = carried.filter(|carried| Measure::Mass.is_bad(mass.disagreement(carried))) {
        let why = format!(
            "the force plates carry {:.1} kg, the body has {:.1} kg: body or plates are wrong, whatever the movement",
            carried.kg, mass.kg
        );
        verdict.set_aside(of_weight, why);
    }
    if let Some(why) = idle.undecided() {
        verdict.set_aside(|_| false, why);
    }
    verdict
}

/// Reports loaded feet that slide where forces were predicted; a refit may hold them.
fn report_sliding(outcome: &Outcome, settings: &Settings, findings: &mut Findings) {
    let is_predicted = matches!(outcome.force_origin, ForceOrigin::Predicted { .. });
    let slides = outcome.verdict.fit.sliding_m_s.filter(|speed| Measure::Sliding.is_bad(*speed));
    if let Some(speed) = slides.filter(|_| is_predicted && !settings.refit) {
        let message = format!(
            "soles that carry the body slide at {speed:.2} m/s or more for three quarters of the time: predicted \
             forces and centres of pressure are worse than their deviations say"
        );
        findings.report(Code::PredictionFeetSlide, message);
    }
}

/// Reports ground forces that are predicted for an activity without validation.
fn report_untested_prediction(activity: ActivityKind, force_origin: &ForceOrigin, findings: &mut Findings) {
    if matches!(force_origin, ForceOrigin::Predicted { .. }) && !activity.has_validated_prediction() {
        let tested = match activity {
            ActivityKind::Squat | ActivityKind::Jump | ActivityKind::StairsUp | ActivityKind::StairsDown => {
                "; this activity was tested on synthetic motions only, and its forces on each foot may be wrong"
            }
            _ => "",
        };
        let message = format!(
            "activity: {activity}; predicted ground forces were compared with force plates only for walking, turning, \
             standing and running{tested}"
        );
        findings.report(Code::PredictionUntested, message);
    }
}

/// The motion, forces and limits that a verdict judges.
struct Judged<'a> {
    activity: ActivityKind,
    stances: &'a Footfalls,
    cutoff_hz: Option<f64>,
    model: &'a Model,
    person: &'a Person,
    analysis: &'a Analysis,
    device: Option<&'a [Vec<f64>]>,
    checks: Option<&'a PredictionChecks>,
}

impl Judged<'_> {
    /// Whether a person could do this, and whether predicted forces can be right.
    ///
    /// Frames that force plates do not cover are judged on forces that are predicted from the motion.
    fn verdict(
        &self,
        settings: &Settings,
        force_origin: &ForceOrigin,
        partly_measured: &[[f64; 2]],
        findings: &mut Findings,
    ) -> Verdict {
        let Judged { activity, stances, cutoff_hz, model, person, analysis, device, checks } = *self;
        let Analysis { trajectory, forces, ground, .. } = analysis;
        let evidence = MotionAndForces {
            model,
            trajectory,
            forces,
            ground,
            device,
            predicted: None,
            partly_measured,
            stances: Some(stances),
            activity,
            cutoff_hz,
            forces_are_predicted: matches!(force_origin, ForceOrigin::Predicted { .. }),
        };
        let mut of_measured = Findings::default();
        let mut verdict = feasibility::check(&evidence, person, &settings.thresholds, &mut of_measured);
        let is_incomplete = *force_origin == ForceOrigin::Measured && verdict.frames_unmeasured > 0;
        let prediction =
            || predict(model, trajectory, &person.soles, &settings.prediction, &mut Findings::default()).ok();
        if let Some(prediction) = is_incomplete.then(prediction).flatten() {
            let ground = &prediction.ground;
            let forces = &inverse_with_residual(&mut Workspace::new(model), trajectory, &ground.loads());
            let evidence = MotionAndForces { predicted: Some(PredictedForces { ground, forces }), ..evidence };
            verdict = feasibility::check(&evidence, person, &settings.thresholds, findings);
        } else {
            of_measured.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
        }
        if matches!(force_origin, ForceOrigin::Simulated { .. }) && activity == ActivityKind::Walk {
            verdict.likeness = feasibility::likeness(model, trajectory, person);
        }
        verdict.add_unsupported(checks.map_or(&[], |checks| &checks.reasons));
        verdict
    }
}

/// Filters and time range for this recording.
fn processing(
    observation: &Observation,
    is_complete: bool,
    settings: &Settings,
    findings: &mut Findings,
) -> analysis::AnalysisSettings {
    let whole = Window::default();
    let as_it_is = analysis::AnalysisSettings {
        smoother: Smoother::Off,
        force_filter: None,
        window: whole,
        rate_hz: None,
        instrumented: None,
    };
    if is_complete {
        return as_it_is;
    }
    let force_filter = match observation.is_predicted(settings) {
        true => settings.comparison_filter.filter(|_| !observation.forces.is_empty()),
        false => settings.force_filter.of(&observation.model, &observation.forces, settings.smoother),
    };
    let window = if settings.window == whole { known_window(&observation.origin, findings) } else { settings.window };
    analysis::AnalysisSettings {
        smoother: settings.smoother,
        force_filter,
        window,
        rate_hz: settings.rate_hz,
        instrumented: observation.origin.instrumented(),
    }
}

/// The time to analyse by default: all of it, or the longest time without a long gap of markers.
fn known_window(origin: &Origin, findings: &mut Findings) -> Window {
    let Some([from, to]) = origin.followed().and_then(|followed| followed.body.longest_without_gap_s()) else {
        return Window::default();
    };
    let message = format!(
        "markers are missing, or were left out as outliers, for too long outside of {from:.3} to {to:.3} s; only this \
         time was analysed"
    );
    findings.report(Code::MarkersWindow, message);
    Window { from_s: Some(from), to_s: Some(to) }
}

/// Ground forces and joint forces.
fn forces(
    observation: &Observation,
    motion: ObservedMotion,
    processing: analysis::AnalysisSettings,
    settings: &Settings,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<Found, StudyError> {
    let Observation { model, forces, .. } = observation;
    match motion {
        ObservedMotion::Complete(trajectory) => {
            let source = ForceSource::Simulated;
            let analysis = analyse_measured(model, trajectory, forces, source, findings, progress)?;
            Ok(Found { analysis, prediction: None, measured_events: Vec::new(), loads: None, processing })
        }
        ObservedMotion::Recorded(motion) if observation.is_predicted(settings) => {
            let found = predicted(observation, motion, processing, settings, findings, progress)?;
            match settings.ground {
                GroundSettings::Tracked => tracked(found, observation, findings, progress),
                _ => Ok(found),
            }
        }
        ObservedMotion::Recorded(motion) => {
            let Measured { analysis, loads, processing } =
                measured(observation, &motion, processing, settings, findings, progress)?;
            let (mut analysis, measured_events) = with_markers(analysis, observation);
            analysis.cycles = loads.single(analysis.cycles);
            Ok(Found { analysis, prediction: None, measured_events, loads: Some(loads), processing })
        }
    }
}

/// The stances of predicted forces; none of other forces.
fn stances_of(analysis: &Analysis, prediction: Option<&PredictedGround>) -> Vec<Stance> {
    let Some(found) = prediction else { return Vec::new() };
    let grid = analysis.trajectory.grid();
    let (first, last) = (grid.start_s, grid.end_s());
    let stance = |fall: &Footfall| {
        let span = [fall.strike_s.unwrap_or(first), fall.off_s.unwrap_or(last)];
        Stance::within(fall.side, span, StanceSource::Predicted, grid)
    };
    found.prediction.footfalls.falls.iter().filter_map(stance).collect()
}

fn force_origin(origin: &Origin, prediction: Option<&PredictedGround>, settings: &Settings) -> ForceOrigin {
    match (origin, prediction) {
        (Origin::Simulation { rule }, _) => ForceOrigin::Simulated { rule },
        (_, Some(PredictedGround { tracked: Some(_), .. })) => ForceOrigin::Predicted { rule: TRACKED },
        (_, Some(predicted)) => ForceOrigin::Predicted { rule: predicted.prediction.rule },
        _ if settings.ground == GroundSettings::NoContact => ForceOrigin::None,
        _ => ForceOrigin::Measured,
    }
}

/// Residual reduction, if requested. Predicted forces scale with the mass of the body, so they cannot correct it.
fn residual_reduced(
    model: &Model,
    analysis: Analysis,
    processing: analysis::AnalysisSettings,
    settings: &Settings,
    force_origin: &ForceOrigin,
    findings: &mut Findings,
    progress: &mut Progress<'_>,
) -> Result<(Analysis, Option<ReducedMotion>), StudyError> {
    let Some(adjustable) = settings.residual_reduction else {
        progress.end(Stage::ResidualReduction)?;
        return Ok((analysis, None));
    };
    let (adjustable, instrumented) = match force_origin {
        ForceOrigin::Predicted { .. } => (Adjustable::Motion, None),
        _ => (adjustable, processing.instrumented),
    };
    let processing = analysis::AnalysisSettings { instrumented, ..processing };
    let (analysis, reduced) = reduce_residual(model, analysis, &processing, adjustable, findings)?;
    progress.end(Stage::ResidualReduction)?;
    Ok((analysis, reduced))
}

fn tracking(origin: Origin, measured_events: Vec<Event>) -> Option<Tracking> {
    match origin {
        Origin::Markers(followed) => Some(Tracking::Markers(Box::new(TrackedMarkers {
            regions: RegionFit::of(&followed.body.subject.model, &followed.body.fit, &followed.body.subject.weights),
            body: followed.body,
            listed_events: followed.listed,
            measured_events,
        }))),
        Origin::Skeleton(tracking) => Some(*tracking),
        Origin::Coordinates | Origin::Sensors | Origin::Simulation { .. } => None,
    }
}
