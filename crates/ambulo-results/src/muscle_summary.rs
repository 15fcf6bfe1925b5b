//! `muscles` of `summary.json`: reserves, loads of the joints, electromyograms.

use crate::force_unit::ForceUnit;
use crate::walking_summary::{QuantitySummary, contact_load_summary};
use ambulo::model::{CoordinateKind, Side};
use ambulo::study::{MuscleOutcome, Outcome};
use serde::{Deserialize, Serialize};

/// Muscle forces of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct MuscleSummary {
    /// Whose muscles.
    pub source: MuscleOrigin,
    /// Their number.
    pub muscles: usize,
    /// The coordinate whose muscles lack most of the moment that the motion needs; `null` without motors inside the
    /// body.
    pub largest_reserve: Option<ReserveSummary>,
    /// Frames in which muscles and motors together could not give the moments.
    pub unmet_frames: usize,
    /// Over the whole stances of each leg, of the loads `hip`, `knee`, `ankle` (size of the force), `knee_medial` and
    /// `knee_lateral`: `first_peak` and `second_peak` (the largest in the first and in the second half of stance) [BW]
    /// and `impulse` [BW.s].
    pub contact_loads: Vec<QuantitySummary>,
    /// Distance between the contacts of both condyles of a knee [m]; `null` without legs.
    pub condyles_m: Option<f64>,
    /// Electromyograms beside activations.
    pub emg: Vec<EmgSummary>,
}

/// Whose muscles were used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
#[serde(rename_all = "kebab-case")]
pub enum MuscleOrigin {
    /// Those of the model.
    Model,
    /// Those of the built-in body.
    BuiltIn,
}

/// What motors added at a coordinate.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct ReserveSummary {
    /// The coordinate.
    pub coordinate: String,
    /// Unit of the generalised force.
    pub unit: ForceUnit,
    /// Largest force of its motors, without sign.
    pub largest: f64,
    /// When [s].
    pub at_s: f64,
    /// Its share of the largest generalised force of the coordinate, or of 0.05 N.m for each kilogram of body mass
    /// where that is larger.
    pub share: f64,
}

/// A channel of EMG beside the activation of its muscle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
pub struct EmgSummary {
    /// Name of the channel.
    pub channel: String,
    /// The muscle: `vastus medialis`.
    pub muscle: String,
    /// Its side: `r` or `l`.
    pub side: String,
    /// Muscles of the model whose mean activation it is compared with.
    pub model_muscles: Vec<String>,
    /// Correlation over the frames of the motion, -1 to 1; `null` where one of both is constant.
    pub r: Option<f64>,
}

/// The summary of the muscles; `None` where muscle forces were not asked for.
pub(crate) fn muscle_summary(outcome: &Outcome) -> Option<MuscleSummary> {
    let found = outcome.muscles.as_ref()?;
    let condyles_m = Side::BOTH.into_iter().find_map(|side| found.loads[side].as_ref());
    Some(MuscleSummary {
        source: if found.is_built_in { MuscleOrigin::BuiltIn } else { MuscleOrigin::Model },
        muscles: found.set.muscles.len(),
        largest_reserve: largest_reserve(outcome, found),
        unmet_frames: found.trial.unmet_frames.len(),
        contact_loads: outcome
            .contact_load_stances()
            .into_iter()
            .flat_map(|(load, legs)| contact_load_summary(load, &legs))
            .collect(),
        condyles_m: condyles_m.map(|leg| leg.knee.condyle_distance_m),
        emg: emg(found),
    })
}

fn largest_reserve(outcome: &Outcome, found: &MuscleOutcome) -> Option<ReserveSummary> {
    let (used, share) = found.weakest(&outcome.body)?;
    let coordinate = &outcome.body.coordinates()[used.coordinate.index()];
    Some(ReserveSummary {
        coordinate: coordinate.name.clone(),
        unit: ForceUnit::of_rotation(coordinate.kind == CoordinateKind::Rotation),
        largest: used.largest,
        at_s: outcome.complete().trajectory.grid().time(used.frame),
        share,
    })
}

fn emg(found: &MuscleOutcome) -> Vec<EmgSummary> {
    let of_channel = |compared: &ambulo::muscles::emg::EmgComparison| EmgSummary {
        channel: compared.channel.clone(),
        muscle: compared.muscle.to_string(),
        side: compared.side.letter().to_string(),
        model_muscles: compared.model_muscles.clone(),
        r: Some(compared.r).filter(|r| r.is_finite()),
    };
    found.agreement.iter().map(of_channel).collect()
}
