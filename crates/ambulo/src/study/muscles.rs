//! Muscle forces of a motion: static optimisation on the joint forces of an outcome, the loads that its joints carry with
//! them, and electromyograms beside the activations.
//!
//! The computation takes the motion, joint forces and ground forces that the tables show, with predicted forces where a
//! foot was not measured (`crate::muscles`, docs/MUSCLES.md).

use super::error::StudyError;
use super::knee_adduction::LegStances;
use super::outcome::Outcome;
use crate::analysis::Analysis;
use crate::findings::{Code, Findings};
use crate::model::{BySide, CoordinateId, CoordinateKind, Model};
use crate::muscles::built_in;
use crate::muscles::contact_loads::{LegLoads, condyle_distance, contact_loads};
use crate::muscles::emg::{EmgComparison, EmgEnvelope, EmgRecording, EmgSettings, EmgTrial, compare, envelopes};
use crate::muscles::path::PathWorkspace;
use crate::muscles::set::MuscleSet;
use crate::muscles::settings::{MuscleSettings, Reserves};
use crate::muscles::trial::{MuscleTrial, ReserveUse, solve_trial};
use crate::muscles::wrap::WrapRule;
use ambulo_formats::osim::OsimForceSet;
use std::collections::BTreeSet;
use std::sync::Arc;

/// A request for muscle forces.
#[derive(Debug, Clone)]
pub struct MuscleRequest {
    /// The muscles.
    pub muscles: MuscleSource,
    /// How their forces are found.
    pub settings: MuscleSettings,
    /// Motors that help them; `None` takes those of the settings.
    pub reserves: Option<OsimForceSet>,
    /// Distance between the contacts of both condyles of a knee [m]; `None` takes it from the width of the knee.
    pub condyles_m: Option<f64>,
    /// Electromyograms of the recording.
    pub emg: Option<EmgRecording>,
}

/// Whose muscles.
#[derive(Debug, Clone)]
pub enum MuscleSource {
    /// The muscles of a model, with the model as in its file. They are scaled as the body is.
    Model(Arc<ModelMuscles>),
    /// Those of the built-in body.
    BuiltIn,
}

/// A model with its muscles.
#[derive(Debug, Clone)]
pub struct ModelMuscles {
    /// The model as in its file.
    pub model: Model,
    /// Its muscles.
    pub set: MuscleSet,
}

/// Muscle forces of a motion and what follows from them.
#[derive(Debug, Clone)]
pub struct MuscleOutcome {
    /// The muscles of the body, in its size.
    pub set: MuscleSet,
    /// Whether they are those of the built-in body.
    pub is_built_in: bool,
    /// Activations, tensions, lengths and reserves.
    pub trial: MuscleTrial,
    /// Loads of hip, knee and ankle; `None` for a leg that the model does not have.
    pub loads: BySide<Option<LegLoads>>,
    /// Envelopes of the recorded channels.
    pub emg: Option<EmgTrial>,
    /// Envelopes beside activations.
    pub agreement: Vec<EmgComparison>,
    /// Coordinates inside the body that muscles cross and that no motor of the model drives.
    crossed: BTreeSet<CoordinateId>,
}

impl MuscleRequest {
    /// The muscle forces of an outcome.
    ///
    /// # Errors
    /// A body that has no place for the muscles, settings that name what the body does not have.
    pub(super) fn solve(self, outcome: &Outcome, findings: &mut Findings) -> Result<MuscleOutcome, StudyError> {
        let (body, analysis) = (&outcome.body, outcome.complete());
        let Analysis { trajectory, forces, ground, .. } = analysis;
        let (set, is_built_in) = match &self.muscles {
            MuscleSource::Model(own) => (own.set.scaled(&own.model, body, &body.scale_factors())?, false),
            MuscleSource::BuiltIn => (built_in::muscle_set(body)?, true),
        };
        let mut settings = self.settings;
        if let Some(listed) = &self.reserves {
            settings.reserves = Reserves::Listed(MuscleSet::actuators_of(&listed.actuators, body)?);
        }
        let trial = solve_trial(body, &set, &settings, trajectory, &forces.generalized)?;
        let reader = trial.reader(body, trajectory, &ground.loads());
        let usual_m = condyle_distance(Some(KNEE_WIDTH * outcome.person.height_m));
        let condyles_m = BySide::from_fn(|_| self.condyles_m.unwrap_or(usual_m));
        let loads = contact_loads(body, trajectory, &reader, condyles_m);
        let emg = self.emg.and_then(|recording| envelopes_of(recording, findings));
        let agreement = emg.as_ref().map_or_else(Vec::new, |emg| agreement(&emg.envelopes, &set, &trial, analysis));
        let crossed = crossed(body, &set);
        let solved = MuscleOutcome { set, is_built_in, trial, loads, emg, agreement, crossed };
        solved.report(body, analysis, findings);
        Ok(solved)
    }
}

impl MuscleOutcome {
    /// The coordinate whose muscles lack most of the moment that the motion needs, with the share that they lack.
    /// Coordinates of joints to ground are left out, because what they need is the residual of inverse dynamics, coordinates
    /// that no muscle crosses, and those that a motor of the model drives.
    #[must_use]
    pub fn weakest(&self, body: &Model) -> Option<(ReserveUse, f64)> {
        let least = LEAST_MOMENT * body.mass();
        let share = |used: ReserveUse| (used, used.largest / used.net.max(least));
        let all = self.trial.reserve_use().into_iter().filter(|used| self.crossed.contains(&used.coordinate));
        all.map(share).max_by(|(_, a), (_, b)| a.total_cmp(b))
    }

    /// Warns where strength was not enough, and where paths have no load to share.
    fn report(&self, body: &Model, analysis: &Analysis, findings: &mut Findings) {
        let Some((used, share)) = self.weakest(body).filter(|(_, share)| *share > LARGE_RESERVE) else { return };
        let coordinate = &body.coordinates()[used.coordinate.index()];
        let unit = if coordinate.kind == CoordinateKind::Rotation { "N.m" } else { "N" };
        let message = format!(
            "the muscles are too weak at {} at {:.2} s: motors add up to {:.1} {unit}, {:.0} % of the largest moment \
             there",
            coordinate.name,
            analysis.trajectory.grid().time(used.frame),
            used.largest,
            100.0 * share
        );
        findings.report(Code::MusclesReserves, message);
    }
}

/// Width of a knee as a share of stature: 90 mm at 1.75 m, our choice; it scales the distance of the condyles.
const KNEE_WIDTH: f64 = 0.09 / 1.75;
/// Motors that add more than this share of the largest moment of a coordinate are a warning: our choice.
const LARGE_RESERVE: f64 = 0.1;
/// Least moment that a share is taken of, in N.m for each kilogram of body mass: smaller ones are noise.
const LEAST_MOMENT: f64 = 0.05;

/// Coordinates inside the body that muscles cross and that no motor of the model drives.
fn crossed(body: &Model, set: &MuscleSet) -> BTreeSet<CoordinateId> {
    let roots = body.bodies().iter().filter(|part| part.joint.parent.is_none());
    let of_roots: BTreeSet<CoordinateId> = roots.flat_map(|root| root.joint.coordinates()).collect();
    let driven: BTreeSet<CoordinateId> = set.actuators.iter().map(|motor| motor.coordinate).collect();
    let paths = PathWorkspace::new(body, set, WrapRule::Exact);
    let all = (0..paths.muscles()).flat_map(|muscle| paths.coordinates(muscle).to_vec());
    all.filter(|coordinate| !of_roots.contains(coordinate) && !driven.contains(coordinate)).collect()
}

/// The envelopes of a trial. Channels that hold no signal of a muscle, and recordings that cannot be used, are reported.
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
