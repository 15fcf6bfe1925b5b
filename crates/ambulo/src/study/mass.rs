//! Body mass: which of the known ones is used, and how well it is known.

use super::laboratory_file::LaboratoryFile;
use super::source::{MarkerBody, MarkerSource};
use crate::analysis::{Mass, MassSource, PredictionChecks};
use crate::findings::{Code, Findings};
use crate::motion::force_plate::standing_weight_n;
use crate::spatial::STANDARD_GRAVITY;
use serde::{Deserialize, Serialize};

/// Masses that differ by less, as a share, are one person's: clothes and shoes, a scale at home, a plate's calibration.
const SAME_PERSON: f64 = 0.05;

/// Whether a mass is known from more than a model. Forces that are predicted from the motion scale with the mass, so that a wrong mass
/// shows only against plates, a standing trial or a stated mass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "schema", derive(schemars::JsonSchema))]
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
                "the stated mass is {stated:.1} kg, force plates measured {standing:.1} kg in the standing trial; the stated mass was used"
            );
            findings.report(Code::MassStandingMismatch, message);
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
        assert!(mass == Some(60.0) && findings.has(Code::MassStandingMismatch));
        assert!(believed(Some(60.0), None).1.as_slice().is_empty());
        assert_eq!(believed(None, None).0, None);
    }
}
