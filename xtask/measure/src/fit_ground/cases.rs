//! The recordings of the fit, prepared for repeated predictions.

use crate::validate::recording::{self, Group, Population, Recording};
use ambulo::analysis::{
    Analysis, ComparedAnalyses, ComparedStance, FootAgreement, GroundAgreement, PlateCoverage, compared_stances,
    ground_agreement,
};
use ambulo::findings::Findings;
use ambulo::ground::predict::{
    DeviationCalibration, DeviationScaling, Ends, ErrorSample, ErrorsByTraits, FittedParameters, HASTE,
    PredictSettings, Prediction, Prescribed, StanceCurve, StanceErrors, is_smoothed, predict,
};
use ambulo::motion::filter::LowPass;
use ambulo::numerics;
use ambulo::study::{Outcome, PredictedGround, Source};
use std::path::Path;

/// Centres of pressure and free moments are used above this share of body weight.
const CENTER_LOAD_BW: f64 = 0.05;
/// Weight of a subject without markers on the trunk.
const WITHOUT_TRUNK: f64 = 0.5;

/// A recording with its footfalls found.
pub(super) struct Case {
    pub(super) subject: &'static str,
    pub(super) laboratory: &'static str,
    pub(super) group: Group,
    pub(super) population: Population,
    /// Whether the numbers are fitted to this person.
    pub(super) is_first: bool,
    /// By the prediction with the shipped numbers.
    outcome: Outcome,
    prescribed: Prescribed,
    /// By plates.
    measured: Analysis,
    coverage: PlateCoverage,
}

/// Components of a foot's load that have a standard deviation.
pub(super) const COMPONENTS: [&str; 6] = [
    "force forward",
    "force up",
    "force sideways",
    "centre of pressure along",
    "centre of pressure across",
    "free moment",
];
/// Components that are not evaluated for subjects without markers on the trunk.
pub(super) const NEEDS_TRUNK: [usize; 2] = [2, 4];

/// Nothing of the estimated deviations, only what the trial itself shows.
const OF_TRIAL_ALONE: DeviationCalibration = {
    const NONE: DeviationScaling = DeviationScaling { factor: 0.0, floor: 0.0 };
    DeviationCalibration {
        force: [[NONE; 5]; 3],
        center: [NONE; 2],
        free_moment: NONE,
        of_misfit: OF_MISFIT,
        of_center_misfit: OF_CENTER_MISFIT,
        of_sideways: OF_SIDEWAYS,
        ..DeviationCalibration::UNSCALED
    }
};
/// Shares of a trial's misfit and of its sideways force in the deviation ([`DeviationCalibration`] states how they were
/// chosen).
pub(super) const OF_MISFIT: f64 = 0.5;
pub(super) const OF_CENTER_MISFIT: f64 = 0.4;
pub(super) const OF_SIDEWAYS: f64 = 0.1;
/// How much wider deviations are for each unit of haste: of 0, 0.5 and 1 for the forces forward and up that with which
/// the bands of fast walks hold most, and for the sideways force between the last two. And for a smoothed motion, of
/// which one laboratory has recordings: the excess of its vertical errors at own speed over those of the others, less
/// what the misfit of the trial shows already.
pub(super) const WIDENING: DeviationCalibration =
    DeviationCalibration { of_haste: [1.0, 1.0, 0.7], of_smoothed: 0.3, ..DeviationCalibration::UNSCALED };

/// One component in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// Elapsed share of the stance.
    pub(super) phase: f64,
    /// Predicted minus measured value.
    pub(super) error: f64,
    /// Standard deviation of the prediction.
    pub(super) deviation: f64,
    /// A floor of 1 in the unit of the error.
    pub(super) unit: f64,
    /// Standard deviation that the trial itself shows, which is added in squares.
    pub(super) of_trial: f64,
    /// Factor by which the deviation is wider than usual.
    pub(super) wider: f64,
}

/// Samples of a stance, component by component.
pub(super) type StanceSamples = [Vec<Sample>; 6];

/// Recordings, prepared.
pub(super) struct Cases {
    /// Walks of the people to whom the numbers are fitted.
    pub(super) whole: Vec<Case>,
    /// Those of all other laboratories, runs included: mean errors and deviations are fitted to their walks, too.
    pub(super) further: Vec<Case>,
    /// The straight walks with markers on the trunk once more, without their markers above the pelvis.
    pub(super) without_trunk: Vec<Case>,
}

impl Cases {
    /// Everybody.
    pub(super) fn all(&self) -> impl Iterator<Item = &Case> {
        self.whole.iter().chain(&self.further)
    }

    /// All laboratories, in the order of the recordings.
    pub(super) fn laboratories(&self) -> Vec<&'static str> {
        named(self.all().map(|case| case.laboratory))
    }
}

/// Names, each once, in their order.
pub(super) fn named(all: impl Iterator<Item = &'static str>) -> Vec<&'static str> {
    let mut names = Vec::new();
    for name in all {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// All recordings next to the workspace, without jumps. `said` is called for each recording that is loaded.
pub(super) fn load(data: &Path, said: &mut dyn FnMut(&str)) -> Result<Cases, String> {
    let mut cases = Cases { whole: Vec::new(), further: Vec::new(), without_trunk: Vec::new() };
    let first = recording::all().into_iter().map(|recording| (recording, recording.group != Group::Running));
    let further = recording::further().into_iter().map(|recording| (recording, false));
    for (recording, is_first) in first.chain(further).filter(|(recording, _)| recording.group != Group::Jumping) {
        said(recording.label);
        let failed = |reason| format!("{}: {reason}", recording.label);
        let whole = recording.read(data).and_then(|source| Case::new(&recording, is_first, &source)).map_err(failed)?;
        if is_first && recording.group == Group::Walking && recording.has_markers() {
            let source = recording.read_without_trunk(data, &whole.outcome);
            cases
                .without_trunk
                .push(source.and_then(|source| Case::new(&recording, is_first, &source)).map_err(failed)?);
        }
        if is_first { &mut cases.whole } else { &mut cases.further }.push(whole);
    }
    Ok(cases)
}

/// Subjects, each once, in the order of the recordings.
pub(super) fn subjects(cases: &[Case]) -> Vec<&'static str> {
    named(cases.iter().map(|case| case.subject))
}

impl Case {
    fn new(recording: &Recording, is_first: bool, source: &Source) -> Result<Case, String> {
        let outcome = recording.predict(source, Prescribed::default())?;
        let PredictedGround { prediction, measured, coverage, .. } =
            outcome.prediction.as_ref().ok_or("nothing was predicted")?;
        Ok(Case {
            subject: recording.subject,
            laboratory: recording.laboratory,
            group: recording.group,
            population: recording.population,
            is_first,
            prescribed: Prescribed { footfalls: Some(prediction.footfalls.clone()), ..Prescribed::default() },
            measured: measured.clone().ok_or("no plates")?,
            coverage: coverage.clone().ok_or("no plates")?,
            outcome,
        })
    }

    fn predict(&self, parameters: &FittedParameters) -> Option<Prediction> {
        let settings = PredictSettings {
            prescribed: self.prescribed.clone(),
            parameters: *parameters,
            person: None,
            motion_filter: Some(LowPass::MOTION),
            motion_bandwidth_hz: self.bandwidth_hz(),
        };
        let Outcome { body, person, .. } = &self.outcome;
        predict(body, &self.measured.trajectory, &person.soles, &settings, &mut Findings::default()).ok()
    }

    /// The bandwidth of its motion [Hz].
    fn bandwidth_hz(&self) -> Option<f64> {
        self.outcome.prediction.as_ref()?.prediction.motion_bandwidth_hz
    }

    /// Agreement of a prediction with the measured forces; `None` without a prediction.
    pub(super) fn agreement(&self, parameters: &FittedParameters) -> Option<GroundAgreement> {
        self.compared(parameters, |compared| ground_agreement(compared, &self.coverage))
    }

    /// Stances of a prediction and of the plates.
    pub(super) fn stances(&self, parameters: &FittedParameters) -> Vec<ComparedStance> {
        self.compared(parameters, |compared| compared_stances(compared, &self.coverage)).unwrap_or_default()
    }

    fn compared<T>(&self, parameters: &FittedParameters, compare: impl Fn(&ComparedAnalyses<'_>) -> T) -> Option<T> {
        let prediction = self.predict(parameters)?;
        let found = Analysis { ground: prediction.ground.clone(), ..self.outcome.analysis.clone() };
        let (model, measured) = (&self.outcome.body, &self.measured);
        Some(compare(&ComparedAnalyses { model, predicted: &found, prediction: &prediction, measured }))
    }

    /// The cost that the fit minimises: errors of the feet divided by their criteria, 1 if all are just met.
    fn cost(&self, agreement: &GroundAgreement) -> f64 {
        let of_foot = |foot: &FootAgreement| {
            let (up, forward, sideways) = (foot.vertical, foot.fore_aft, foot.lateral);
            let center = foot.center_of_pressure;
            let with_trunk = up.rrmse / 0.04
                + up.rmse_bw / 0.05
                + 0.3 * (1.0 - up.r) / 0.01
                + forward.rrmse / 0.085
                + 0.5 * center.fore_aft_weighted_mm / 12.0;
            let of_trunk =
                sideways.rrmse / 0.12 + 0.3 * (1.0 - sideways.r) / 0.12 + 0.5 * center.lateral_weighted_mm / 12.0;
            if self.group == Group::NoTrunk { with_trunk } else { with_trunk + of_trunk }
        };
        mean(agreement.feet.iter().map(of_foot))
    }

    /// Whether the recording is straight walking; others are part of the fit but evaluated separately.
    pub(super) fn is_straight(&self) -> bool {
        matches!(self.group, Group::Walking | Group::NoTrunk | Group::FastWalking)
    }

    /// Body weight [N] and stature [m].
    fn size(&self) -> [f64; 2] {
        let model = &self.outcome.body;
        [self.measured.mass.kg * model.gravity().norm(), model.stature().height_m]
    }

    /// Errors against plates with their deviations, stance by stance.
    pub(super) fn samples(&self, parameters: &FittedParameters) -> Vec<StanceSamples> {
        let with = |calibration| self.stances(&FittedParameters { calibration, ..*parameters });
        let of_trial = with(OF_TRIAL_ALONE);
        let pairs = with(DeviationCalibration::UNSCALED);
        pairs.iter().zip(&of_trial).map(|(stance, of_trial)| self.of_stance(stance, of_trial)).collect()
    }

    /// `of_trial` is the same stance with the standard deviations that the trial itself shows.
    fn of_stance(&self, stance: &ComparedStance, of_trial: &ComparedStance) -> StanceSamples {
        let [weight, _] = self.size();
        let mut out = StanceSamples::default();
        let (haste, is_smoothed) = (stance.traits[HASTE], is_smoothed(self.bandwidth_hz()));
        let wider = |c: usize| if c < 3 { WIDENING.widening(c, haste, is_smoothed) } else { 1.0 };
        for (s, of_trial) in stance.samples.iter().zip(&of_trial.samples) {
            let [up, forward, sideways] =
                [0, 1, 2].map(|k| (s.predicted[k] - s.measured[k], s.deviation[k], weight, of_trial.deviation[k]));
            let [along, across] =
                [0, 1].map(|k| (s.center_off[k], s.center_deviation[k], 1.0, of_trial.center_deviation[k]));
            let free_moment = (s.free_moment_off, s.free_moment_deviation, weight, 0.0);
            let parts = [forward, up, sideways, along, across, free_moment];
            for (c, (error, deviation, unit, of_trial)) in parts.into_iter().enumerate() {
                let counts = c < 3 || s.measured[0] > CENTER_LOAD_BW * weight;
                let judged = self.group != Group::NoTrunk || !NEEDS_TRUNK.contains(&c);
                if counts && judged && error.is_finite() {
                    let wider = wider(c);
                    out[c].push(Sample { phase: s.detected_phase, error, deviation, unit, of_trial, wider });
                }
            }
        }
        out
    }
}

/// Errors of each stance of each case, in the order of [`StanceErrors`].
pub(super) type CaseErrors = Vec<Vec<[Vec<ErrorSample>; 5]>>;

/// Errors of the estimate with these parameters.
pub(super) fn errors(cases: &[&Case], parameters: &FittedParameters) -> CaseErrors {
    let of_case = |case: &&Case| {
        let [weight_n, stature_m] = case.size();
        case.stances(parameters).into_iter().map(|stance| stance.errors(weight_n, stature_m)).collect()
    };
    cases.iter().map(of_case).collect()
}

/// Mean errors of walking over the cases for which `stays` states so: of the forces with their change with the traits,
/// from all walks with markers on the trunk. The centre of pressure along the way is that of the straight walks of the
/// people to whom the numbers are fitted, each with the same weight: with all laboratories its error grew by an eighth
/// in children. That across is not repeated by a person or a laboratory left out.
pub(super) fn mean_errors(cases: &[&Case], errors: &CaseErrors, stays: &dyn Fn(&Case) -> bool) -> ErrorsByTraits {
    let rounded = |curve: StanceCurve| StanceCurve(curve.0.map(|value| (1e5 * value).round() / 1e5));
    let walks = |case: &Case| stays(case) && !matches!(case.group, Group::NoTrunk | Group::Running);
    let all = weighted_samples(cases, errors, &walks, &|case| case.laboratory);
    let forces = [0, 1, 2].map(|axis| StanceCurve::through_by_traits(&all[axis], axis).map(rounded));
    let first = |case: &Case| stays(case) && case.is_first && case.group == Group::Walking;
    let straight = weighted_samples(cases, errors, &first, &|case| case.subject);
    let center = [rounded(StanceCurve::through(&straight[3], Ends::Free)), StanceCurve::NONE];
    let force = forces.map(|curves| curves[0]);
    let changes = forces.map(|[_, changes @ ..]| changes);
    ErrorsByTraits { usual: StanceErrors { force, center }, changes }
}

/// Samples of the chosen cases, in the order of [`StanceErrors`]: every group has the same weight, in it every person,
/// and in them every stance.
fn weighted_samples(
    cases: &[&Case],
    errors: &CaseErrors,
    counts: &dyn Fn(&Case) -> bool,
    group: &dyn Fn(&Case) -> &'static str,
) -> [Vec<ErrorSample>; 5] {
    let chosen: Vec<_> = cases.iter().zip(errors).filter(|(case, own)| counts(case) && !own.is_empty()).collect();
    let people =
        |name: &str| named(chosen.iter().filter(|(case, _)| group(case) == name).map(|(case, _)| case.subject)).len();
    let stances = |subject: &str| -> usize {
        chosen.iter().filter(|(case, _)| case.subject == subject).map(|(_, own)| own.len()).sum()
    };
    let mut all: [Vec<ErrorSample>; 5] = Default::default();
    for (case, own) in &chosen {
        let share = 1.0 / (people(group(case)) * stances(case.subject)) as f64;
        for stance in *own {
            for (all, own) in all.iter_mut().zip(stance) {
                all.extend(own.iter().map(|sample| ErrorSample { weight: share * sample.weight, ..*sample }));
            }
        }
    }
    all
}

/// The laboratory of a subject.
pub(super) fn laboratory(cases: &[Case], subject: &str) -> &'static str {
    cases.iter().find(|case| case.subject == subject).map_or("", |case| case.laboratory)
}

/// Whether a subject has a straight walk at a usual speed with markers on the trunk.
pub(super) fn is_judged(cases: &[Case], subject: &str) -> bool {
    cases.iter().any(|case| case.subject == subject && case.group == Group::Walking)
}

/// Weight of a subject.
pub(super) fn importance(cases: &[Case], subject: &str) -> f64 {
    let without = cases.iter().any(|case| case.subject == subject && case.group == Group::NoTrunk);
    if without { WITHOUT_TRUNK } else { 1.0 }
}

/// Cost of a subject: the mean over its recordings.
pub(super) fn subject_cost(cases: &[Case], subject: &str, parameters: &FittedParameters) -> f64 {
    let own = cases.iter().filter(|case| case.subject == subject);
    mean(own.map(|case| case.agreement(parameters).map_or(f64::INFINITY, |agreement| case.cost(&agreement))))
}

/// Cost of several subjects.
pub(super) fn cost(cases: &[Case], subjects: &[&str], parameters: &FittedParameters) -> f64 {
    let all = || subjects.iter().map(|subject| importance(cases, subject));
    let sum: f64 =
        subjects.iter().zip(all()).map(|(subject, counts)| counts * subject_cost(cases, subject, parameters)).sum();
    sum / all().sum::<f64>()
}

/// Figures of a subject's straight walks, fast ones included: RMSE [% body weight], rRMSE [%] and r of upward, forward
/// and sideways force, centre of pressure along and across [mm].
pub(super) fn figures(cases: &[Case], subject: &str, parameters: &FittedParameters) -> [f64; 11] {
    let own: Vec<GroundAgreement> = cases
        .iter()
        .filter(|case| case.subject == subject && case.group != Group::Turning)
        .filter_map(|case| case.agreement(parameters))
        .collect();
    let of_foot = |foot: &FootAgreement| {
        let [up, forward, sideways] =
            [foot.vertical, foot.fore_aft, foot.lateral].map(|f| [100.0 * f.rmse_bw, 100.0 * f.rrmse, f.r]);
        let center = foot.center_of_pressure;
        let center = [center.fore_aft_weighted_mm, center.lateral_weighted_mm];
        [&up[..], &forward, &sideways, &center].concat()
    };
    std::array::from_fn(|k| mean(own.iter().map(|agreement| mean(agreement.feet.iter().map(|foot| of_foot(foot)[k])))))
}

/// Mean of numbers; NaN without any, so that a fit without cases is not the best one.
pub(super) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let all: Vec<f64> = values.collect();
    if all.is_empty() { f64::NAN } else { numerics::mean(&all) }
}
