//! The recordings of the fit, prepared for repeated predictions.

use crate::validate::recording::{self, Group};
use ambulo::analysis::{Analysis, ComparedAnalyses, FootAgreement, GroundAgreement, PlateCoverage, ground_agreement};
use ambulo::findings::Findings;
use ambulo::ground::feet;
use ambulo::ground::predict::{FittedParameters, PredictSettings, Prediction, Prescribed, predict};
use ambulo::model::Side;
use ambulo::motion::Window;
use ambulo::spatial::Vec3;
use ambulo::study::{Outcome, PredictedGround};
use std::path::Path;

/// A sample is used while the measured vertical force exceeds this [N].
const LOADED_N: f64 = 20.0;
/// Its centre of pressure is used above this share of body weight.
const CENTER_LOAD_BW: f64 = 0.05;
/// Weight of a subject without markers on the trunk.
const WITHOUT_TRUNK: f64 = 0.5;

/// A recording with its footfalls found.
pub(super) struct Case {
    pub(super) subject: &'static str,
    pub(super) group: Group,
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

/// One component in one frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sample {
    /// Predicted minus measured value.
    pub(super) error: f64,
    /// Standard deviation of the prediction.
    pub(super) deviation: f64,
    /// A floor of 1 in the unit of the error.
    pub(super) unit: f64,
}

/// Samples of a stance, component by component.
pub(super) type StanceSamples = [Vec<Sample>; 6];

/// All walking recordings next to the workspace, without runs. `said` is called for each recording that is loaded.
pub(super) fn load(data: &Path, said: &mut dyn FnMut(&str)) -> Result<Vec<Case>, String> {
    let mut cases = Vec::new();
    for recording in recording::all().into_iter().filter(|recording| recording.group != Group::Running) {
        said(recording.label);
        let case = recording.read(data).and_then(|source| {
            let outcome = recording.predict(&source, Prescribed::default())?;
            let PredictedGround { prediction, measured, coverage, .. } =
                outcome.prediction.as_ref().ok_or("nothing was predicted")?;
            Ok(Case {
                subject: recording.subject,
                group: recording.group,
                prescribed: Prescribed { footfalls: Some(prediction.footfalls.clone()), ..Prescribed::default() },
                measured: measured.clone().ok_or("no plates")?,
                coverage: coverage.clone().ok_or("no plates")?,
                outcome,
            })
        });
        cases.push(case.map_err(|reason| format!("{}: {reason}", recording.label))?);
    }
    Ok(cases)
}

/// Subjects, each once, in the order of the recordings.
pub(super) fn subjects(cases: &[Case]) -> Vec<&'static str> {
    let mut names: Vec<&'static str> = Vec::new();
    for case in cases {
        if !names.contains(&case.subject) {
            names.push(case.subject);
        }
    }
    names
}

impl Case {
    fn predict(&self, parameters: &FittedParameters) -> Option<Prediction> {
        let settings = PredictSettings { prescribed: self.prescribed.clone(), parameters: *parameters };
        let Outcome { body, person, .. } = &self.outcome;
        predict(body, &self.measured.trajectory, &person.soles, &settings, &mut Findings::default()).ok()
    }

    /// Agreement of a prediction with the measured forces; `None` without a prediction.
    pub(super) fn agreement(&self, parameters: &FittedParameters) -> Option<GroundAgreement> {
        let prediction = self.predict(parameters)?;
        let found = Analysis { ground: prediction.ground.clone(), ..self.outcome.analysis.clone() };
        let (model, measured) = (&self.outcome.body, &self.measured);
        Some(ground_agreement(
            &ComparedAnalyses { model, predicted: &found, prediction: &prediction, measured },
            &self.coverage,
        ))
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

    /// Whether the recording is straight walking; turns are part of the fit but evaluated separately.
    pub(super) fn is_straight(&self) -> bool {
        self.group != Group::Turning
    }

    /// Errors against plates with their deviations, stance by stance, of a straight walk; along the world's axes.
    pub(super) fn samples(&self, parameters: &FittedParameters) -> Vec<StanceSamples> {
        let (Some(prediction), Some(agreement)) = (self.predict(parameters), self.agreement(parameters)) else {
            return Vec::new();
        };
        let stances = agreement.feet.iter().flat_map(|foot| foot.stances_s.iter().map(move |span| (foot.side, *span)));
        stances.filter_map(|(side, span)| self.of_stance(&prediction, side, span)).collect()
    }

    fn of_stance(&self, prediction: &Prediction, side: Side, [from_s, to_s]: [f64; 2]) -> Option<StanceSamples> {
        let model = &self.outcome.body;
        let weight = self.measured.mass.kg * model.gravity().norm();
        let foot = |ground| feet(model, ground).into_iter().find(|(of, _)| *of == side).map(|(_, foot)| foot);
        let (found, truth) = (foot(&prediction.ground)?, foot(&self.measured.ground)?);
        let deviation = prediction.deviations.iter().find(|deviation| deviation.side == side)?;
        let (first, count) = self.measured.trajectory.grid().inside(Window { from_s: Some(from_s), to_s: Some(to_s) });
        let mut out = StanceSamples::default();
        for i in first..first + count {
            let load = truth.force[i].y;
            if load <= LOADED_N {
                continue;
            }
            let apart = |a: &[Vec3], b: &[Vec3]| a[i] - b[i];
            let force = apart(&found.force, &truth.force);
            let center = apart(&found.center_of_pressure, &truth.center_of_pressure);
            let free_moment = apart(&found.free_moment, &truth.free_moment).y;
            let (of_force, of_center) = (deviation.force[i], deviation.center[i]);
            let parts = [
                (force.x, of_force.x, weight),
                (force.y, of_force.y, weight),
                (force.z, of_force.z, weight),
                (center.x, of_center.x, 1.0),
                (center.z, of_center.z, 1.0),
                (free_moment, deviation.free_moment[i], weight),
            ];
            for (c, (error, deviation, unit)) in parts.into_iter().enumerate() {
                let counts = c < 3 || load > CENTER_LOAD_BW * weight;
                let judged = self.group != Group::NoTrunk || !NEEDS_TRUNK.contains(&c);
                if counts && judged && error.is_finite() {
                    out[c].push(Sample { error, deviation, unit });
                }
            }
        }
        Some(out)
    }
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

/// Figures of a subject's straight walks: RMSE [% body weight], rRMSE [%] and r of upward, forward and sideways force, centre of
/// pressure along and across [mm].
pub(super) fn figures(cases: &[Case], subject: &str, parameters: &FittedParameters) -> [f64; 11] {
    let own: Vec<GroundAgreement> = cases
        .iter()
        .filter(|case| case.subject == subject && case.is_straight())
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

/// Mean of numbers.
pub(super) fn mean(values: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = values.fold((0.0, 0.0), |(sum, count), x| (sum + x, count + 1.0));
    sum / count
}
