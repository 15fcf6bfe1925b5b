//! Body mass: which of the known ones is used, and how well it is known.

use super::laboratory_file::LaboratoryFile;
use super::source::{MarkerBody, MarkerSource};
use crate::analysis::{Analysis, EventKind, Mass, MassSource, PredictedAnalysis, PredictionChecks, WHOLE_BODY_SHARE};
use crate::findings::{Code, Findings};
use crate::ground::upward;
use crate::model::{Model, Side};
use crate::motion::Window;
use crate::motion::force_plate::standing_weight_n;
use crate::spatial::STANDARD_GRAVITY;
use serde::{Deserialize, Serialize};

/// Masses that differ by less, as a share, are one person's: clothes and shoes, a scale at home, a plate's calibration.
const SAME_PERSON: f64 = 0.05;

/// Whether a mass is known from more than a model. Forces that are predicted from the motion scale with the mass, so that a wrong mass
/// shows only against plates, a standing trial or a stated mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum MassKnowledge {
    /// Weighed by plates, or stated.
    Verified,
    /// The model's own.
    Unverified,
    /// Plates carry another mass than the model has.
    Contradicted,
}

impl MassKnowledge {
    pub(super) fn of(mass: Mass, checks: Option<&PredictionChecks>, is_stated: bool) -> MassKnowledge {
        match (checks.and_then(PredictionChecks::mass_agrees), is_stated, mass.source) {
            (Some(false), ..) => MassKnowledge::Contradicted,
            (Some(true), ..) | (None, true, _) | (.., MassSource::Plates | MassSource::Standing) => {
                MassKnowledge::Verified
            }
            (None, false, MassSource::Model) => MassKnowledge::Unverified,
        }
    }
}

/// The mass of a person who stands still on force plates [kg]; `None` if no plate is loaded steadily.
#[must_use]
pub fn standing_mass_kg(file: &LaboratoryFile) -> Option<f64> {
    standing_weight_n(&file.recording.plates).map(|weight_n| weight_n / STANDARD_GRAVITY)
}

/// Body mass of the built-in body [kg]: by the standing trial, as stated by the user, or as stated by the files.
pub(super) fn built_in_mass_kg(markers: &MarkerSource, findings: &mut Findings) -> Option<f64> {
    let MarkerSource { trial, standing, body, .. } = markers;
    let by_user = match body {
        MarkerBody::BuiltIn { mass_kg, .. } | MarkerBody::Model { mass_kg, .. } => *mass_kg,
        MarkerBody::Calibrated(_) => None,
    };
    let in_files = standing.as_ref().and_then(|standing| standing.subject.mass_kg).or(trial.subject.mass_kg);
    body_mass(by_user.or(in_files), standing.as_ref().and_then(standing_mass_kg), findings)
}

/// Body mass [kg]. A standing trial on plates weighs the person as recorded, with clothes and shoes, and on the scale that the ground
/// forces are compared with: it is used before a stated mass, unless the two differ too much for one person. Then a foot was off the
/// plates or the statement is of another day, and the stated mass is used. `None` if neither is known.
fn body_mass(stated_kg: Option<f64>, standing_kg: Option<f64>, findings: &mut Findings) -> Option<f64> {
    match (stated_kg, standing_kg) {
        (Some(stated), Some(standing)) if (standing / stated - 1.0).abs() <= SAME_PERSON => {
            let message = format!(
                "{standing:.2} kg stand on the plates in the standing trial and were used; {stated:.2} kg are stated"
            );
            findings.report(Code::MassStanding, message);
            Some(standing)
        }
        (Some(stated), Some(standing)) => {
            let message = format!(
                "{stated:.1} kg are stated, the plates carry {standing:.1} kg in the standing trial; the stated mass was used"
            );
            findings.report(Code::MassMismatch, message);
            Some(stated)
        }
        (Some(stated), None) => Some(stated),
        (None, Some(standing)) => {
            let message = format!("no mass is stated; {standing:.1} kg stand on the plates in the standing trial");
            findings.report(Code::MassStanding, message);
            Some(standing)
        }
        (None, None) => None,
    }
}

/// An analysis whose body is weighed over one gait cycle anywhere inside the `instrumented` window, where no cycle from strike to strike
/// was weighed: walking repeats itself, so that the mean vertical force is m g from any instant on.
pub(super) fn weighed_within(analysis: Analysis, model: &Model, instrumented: Window) -> Analysis {
    let mass = cycle_mass_kg(&analysis, model, instrumented).map(|kg| Mass { kg, source: MassSource::Plates });
    with_mass(analysis, mass)
}

/// An analysis whose mass is that of the standing trial [kg], where no whole gait cycle was weighed.
pub(super) fn weighed_standing(analysis: Analysis, standing_kg: Option<f64>) -> Analysis {
    with_mass(analysis, standing_kg.map(|kg| Mass { kg, source: MassSource::Standing }))
}

/// A prediction whose body is weighed by what plates carried: over a whole gait cycle inside the instrumented window [s], otherwise in a
/// standing trial [kg]. Without either the mass of the model stays.
pub(super) fn weighed_prediction(
    predicted: PredictedAnalysis,
    model: &Model,
    window_s: Option<[f64; 2]>,
    standing_kg: Option<f64>,
) -> PredictedAnalysis {
    let PredictedAnalysis { mut analysis, prediction, measured } = predicted;
    let measured = measured.map(|measured| {
        let measured = match window_s {
            Some([from, to]) => weighed_within(measured, model, Window { from_s: Some(from), to_s: Some(to) }),
            None => measured,
        };
        weighed_standing(measured, standing_kg)
    });
    if let Some(mass) = measured.as_ref().map(|measured| measured.mass).filter(|mass| mass.source != MassSource::Model) {
        analysis.mass = mass;
    }
    PredictedAnalysis { analysis: weighed_standing(analysis, standing_kg), prediction, measured }
}

/// Mean vertical force over g, over one mean gait cycle from the beginning of a window [kg]; `None` if the window is shorter.
fn cycle_mass_kg(analysis: &Analysis, model: &Model, window: Window) -> Option<f64> {
    let (from, to) = (window.from_s?, window.to_s?);
    let strikes = |side: Side| {
        let of_side = move |e: &&crate::motion::Event| e.side == side && e.kind == EventKind::Strike;
        analysis.events.iter().filter(of_side).map(|e| e.time_s).collect::<Vec<f64>>()
    };
    let overlapping = |pair: &[f64]| (pair[0] < to && pair[1] > from).then_some(pair[1] - pair[0]);
    let periods: Vec<f64> = Side::BOTH
        .into_iter()
        .flat_map(|side| strikes(side).windows(2).filter_map(overlapping).collect::<Vec<_>>())
        .collect();
    let period = periods.iter().sum::<f64>() / periods.len() as f64;
    let grid = analysis.trajectory.grid();
    let (first, frames) = grid.inside(Window { from_s: Some(from), to_s: Some(from + period) });
    let has_a_cycle = period <= to - from;
    if !has_a_cycle || frames == 0 {
        return None;
    }
    let up = upward(model);
    let vertical = |i: usize| analysis.ground.bodies.iter().map(|b| b.force[i].dot(&up)).sum::<f64>();
    let mean = (first..first + frames).map(vertical).sum::<f64>() / frames as f64;
    Some(mean / model.gravity().norm())
}

/// Takes a mass in place of the model's. One that is more than 5 % off the model's is not the whole body's, or not this person's.
fn with_mass(analysis: Analysis, mass: Option<Mass>) -> Analysis {
    let believed = mass.filter(|mass| {
        analysis.mass.source == MassSource::Model && (mass.kg / analysis.mass.kg - 1.0).abs() <= WHOLE_BODY_SHARE
    });
    Analysis { mass: believed.unwrap_or(analysis.mass), ..analysis }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn believed(stated: Option<f64>, standing: Option<f64>) -> (Option<f64>, Findings) {
        let mut findings = Findings::default();
        (body_mass(stated, standing, &mut findings), findings)
    }

    #[test]
    fn the_plates_are_believed_where_they_weigh_the_same_person() {
        let (mass, findings) = believed(Some(32.1), Some(31.07));
        assert!(mass == Some(31.07) && findings.has(Code::MassStanding));
        assert_eq!(believed(None, Some(60.0)).0, Some(60.0));
    }

    #[test]
    fn a_person_beside_the_plates_is_not_weighed_by_them() {
        let (mass, findings) = believed(Some(60.0), Some(41.0));
        assert!(mass == Some(60.0) && findings.has(Code::MassMismatch));
        assert!(believed(Some(60.0), None).1.as_slice().is_empty());
        assert_eq!(believed(None, None).0, None);
    }
}
