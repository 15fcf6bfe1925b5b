//! Muscle forces of a motion: static optimisation on the joint forces of an outcome, the loads that its joints carry
//! with them, and electromyograms beside the activations.
//!
//! The computation takes the motion, joint forces and ground forces that the tables show, with predicted forces where a
//! foot was not measured (`crate::muscles`, docs/MUSCLES.md).

use super::error::StudyError;
use super::knee_adduction::LegStances;
use super::muscle_outcome::MuscleOutcome;
use super::muscle_request::{MuscleRequest, MuscleSource};
use super::outcome::Outcome;
use crate::analysis::Analysis;
use crate::findings::{Code, Findings};
use crate::model::{BySide, CoordinateId, Model};
use crate::muscles::built_in;
use crate::muscles::contact_loads::{LegLoads, condyle_distance, contact_loads};
use crate::muscles::emg::{EmgComparison, EmgEnvelope, EmgRecording, EmgSettings, EmgTrial, compare, envelopes};
use crate::muscles::path::PathWorkspace;
use crate::muscles::set::MuscleSet;
use crate::muscles::settings::Reserves;
use crate::muscles::trial::{MuscleTrial, solve_trial};
use crate::muscles::wrap::WrapRule;
use std::collections::BTreeSet;

/// The muscle forces of an outcome; `knee_width_m` where it was measured.
///
/// # Errors
/// A body that has no place for the muscles, settings that name what the body does not have.
pub(super) fn solved(
    request: MuscleRequest,
    knee_width_m: Option<f64>,
    outcome: &Outcome,
    findings: &mut Findings,
) -> Result<MuscleOutcome, StudyError> {
    let (body, analysis) = (&outcome.body, outcome.complete());
    let (set, is_built_in) = match &request.muscles {
        MuscleSource::Model(own) => (own.set.scaled(&own.model, body, &body.scale_factors())?, false),
        MuscleSource::BuiltIn => (built_in::muscle_set(body)?, true),
    };
    let mut settings = request.settings;
    if let Some(listed) = &request.reserves {
        settings.reserves = Reserves::Listed(MuscleSet::actuators_of(&listed.actuators, body)?);
    }
    let knee_m = knee_width_m.unwrap_or(KNEE_WIDTH * outcome.person.height_m);
    let condyles_m = request.condyles_m.unwrap_or_else(|| condyle_distance(Some(knee_m)));
    let condyles_m = BySide { right: condyles_m, left: condyles_m };
    let solve = |analysis: &Analysis| -> Result<(MuscleTrial, BySide<Option<LegLoads>>), StudyError> {
        let Analysis { trajectory, forces, ground, .. } = analysis;
        let trial = solve_trial(body, &set, &settings, trajectory, &forces.generalized)?;
        let reader = trial.reader(body, trajectory, &ground.loads());
        let loads = contact_loads(body, trajectory, &reader, condyles_m);
        Ok((trial, loads))
    };
    let (trial, loads) = solve(analysis)?;
    let measured = outcome.prediction.as_ref().and_then(|found| found.measured.as_ref());
    let measured_loads = measured.map(solve).transpose()?.map(|(_, loads)| loads);
    let emg = request.emg.and_then(|recording| envelopes_of(recording, findings));
    let agreement = emg.as_ref().map_or_else(Vec::new, |emg| agreement(&emg.envelopes, &set, &trial, analysis));
    let crossed = crossed(body, &set);
    let solved = MuscleOutcome { set, is_built_in, trial, loads, measured_loads, emg, agreement, crossed };
    solved.report(body, analysis, findings);
    Ok(solved)
}

/// Width of a knee that was not measured, as a share of stature: 90 mm at 1.75 m, our choice.
const KNEE_WIDTH: f64 = 0.09 / 1.75;

/// Coordinates inside the body that muscles cross and that no motor of the model drives.
fn crossed(body: &Model, set: &MuscleSet) -> BTreeSet<CoordinateId> {
    let roots = body.bodies().iter().filter(|part| part.joint.parent.is_none());
    let of_roots: BTreeSet<CoordinateId> = roots.flat_map(|root| root.joint.coordinates()).collect();
    let driven: BTreeSet<CoordinateId> = set.actuators.iter().map(|motor| motor.coordinate).collect();
    let paths = PathWorkspace::new(body, set, WrapRule::Exact);
    let all = (0..paths.muscles()).flat_map(|muscle| paths.coordinates(muscle).to_vec());
    all.filter(|coordinate| !of_roots.contains(coordinate) && !driven.contains(coordinate)).collect()
}

/// The envelopes of a trial. Channels that hold no signal of a muscle, and recordings that cannot be used, are
/// reported.
fn envelopes_of(recording: EmgRecording, findings: &mut Findings) -> Option<EmgTrial> {
    let trial = match envelopes(&[recording], &EmgSettings::default()) {
        Ok(found) => found.into_iter().next()?,
        Err(reason) => {
            findings.report(Code::EmgUnused, format!("the electromyograms are not used: {reason}"));
            return None;
        }
    };
    let others = trial.envelopes.iter().filter(|envelope| !envelope.signal.is_muscle());
    let silent: Vec<String> = others.map(|envelope| format!("`{}`", envelope.channel)).collect();
    if !silent.is_empty() {
        let message = format!("no signal of a muscle in the channels {}: they are not used", silent.join(", "));
        findings.report(Code::EmgSilent, message);
    }
    Some(trial)
}

fn agreement(
    envelopes: &[EmgEnvelope],
    set: &MuscleSet,
    trial: &MuscleTrial,
    analysis: &Analysis,
) -> Vec<EmgComparison> {
    let muscles = set.muscles.iter().zip(&trial.muscles);
    let activations: Vec<(&str, &[f64])> =
        muscles.map(|(muscle, series)| (muscle.name.as_str(), series.activation.as_slice())).collect();
    compare(envelopes, &activations, analysis.trajectory.grid(), 0.0)
}

impl Outcome {
    /// First peak, second peak [body weights] and impulse [body weights x s] of the loads of the joints in each whole
    /// stance of each leg: `hip`, `knee` and `ankle` (size of the force), `knee_medial` and `knee_lateral` (force along
    /// the shank on a condyle). Empty without muscle forces.
    #[must_use]
    pub fn contact_load_stances(&self) -> Vec<(&'static str, BySide<LegStances>)> {
        let Some(MuscleOutcome { loads, .. }) = &self.muscles else { return Vec::new() };
        let weight_n = self.complete().mass.kg * self.body.gravity().norm();
        let over = |value: &dyn Fn(&LegLoads, usize) -> f64| {
            BySide::from_fn(|side| {
                let at = |frame| loads[side].as_ref().map_or(f64::NAN, |leg| value(leg, frame) / weight_n);
                self.over_stances(side, at)
            })
        };
        let size = |joint: usize| over(&move |leg, frame| leg.joints[joint].in_child[frame].force.norm());
        vec![
            ("hip", size(0)),
            ("knee", size(1)),
            ("ankle", size(2)),
            ("knee_medial", over(&|leg, frame| leg.knee.medial[frame])),
            ("knee_lateral", over(&|leg, frame| leg.knee.lateral[frame])),
        ]
    }
}
