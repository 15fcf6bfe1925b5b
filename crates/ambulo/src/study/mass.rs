//! Body mass: which of the known ones is used, and how well it is known.

use super::laboratory_file::LaboratoryFile;
use super::source::{MarkerBody, MarkerSource};
use crate::analysis::{BodyInMotion, Mass, MassSource, PredictionChecks};
use crate::findings::{Code, Findings};
use crate::ground::upward;
use crate::kinematics::{Trajectory, each_body_motion};
use crate::motion::force_plate::standing_weight_n;
use crate::motion::{ForceRecording, SmoothSettings, Smoother, Window, smooth};
use crate::spatial::{STANDARD_GRAVITY, Vec3};
use serde::{Deserialize, Serialize};

/// Masses that differ by less, as a share, are one person's: clothes and shoes, a scale at home, a plate's calibration.
const SAME_PERSON: f64 = 0.05;

/// A shorter time on force plates weighs nobody [s].
const SHORTEST_WEIGHING_S: f64 = 0.3;
/// Standard error of the change of the velocity of the mass centre, which markers show [m/s].
const VELOCITY_ERROR_M_S: f64 = 0.1;
/// Less is no person [kg].
const LEAST_PERSON_KG: f64 = 5.0;

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

/// A mass by ground forces and motion.
pub(super) struct WeighedInMotion {
    pub(super) kg: f64,
    /// Standard error.
    pub(super) error_kg: f64,
    /// The time of the measurement.
    pub(super) span_s: [f64; 2],
}

/// The mass of a person who moves on force plates: m = Σ F / Σ (g + a), upward, over the longest time in which every loaded foot is on a
/// plate, with the acceleration a of the body's mass centre. `None` if that time is short.
pub(super) fn weighed_in_motion(
    body: &BodyInMotion,
    forces: &[ForceRecording],
    smoother: Smoother,
) -> Option<WeighedInMotion> {
    let model = &body.subject.model;
    let [from, to] = *body.on_plates.windows.first().filter(|[from, to]| to - from >= SHORTEST_WEIGHING_S)?;
    let (unheard, whole) = (&mut Findings::default(), Window::default());
    let smoothed =
        smooth(model, &body.fit.motion, SmoothSettings { smoother, window: whole, rate_hz: None }, unheard).ok()?;
    let trajectory = Trajectory::complete(model, &smoothed, unheard).ok()?;
    let (up, grid) = (upward(model), trajectory.grid());
    let (first, frames) = grid.inside(Window { from_s: Some(from), to_s: Some(to) });
    let mut needed = 0.0;
    each_body_motion(model, &trajectory, |frame, bodies| {
        if (first..first + frames).contains(&frame) {
            let weighted = model
                .bodies()
                .iter()
                .zip(bodies)
                .map(|(body, motion)| body.inertia.mass() * motion.acceleration.linear);
            needed += weighted.sum::<Vec3>().dot(&up) / model.mass() + model.gravity().norm();
        }
    });
    let mean = |force: &ForceRecording| {
        let inside = force.times.iter().zip(&force.force).filter(|(time, _)| (from..=to).contains(*time));
        let upward: Vec<f64> = inside.map(|(_, force)| force.dot(&up)).collect();
        upward.iter().sum::<f64>() / upward.len().max(1) as f64
    };
    let kg = forces.iter().map(mean).sum::<f64>() / (needed / frames as f64);
    let error_kg = kg * VELOCITY_ERROR_M_S / (model.gravity().norm() * (to - from));
    (kg.is_finite() && kg > LEAST_PERSON_KG).then_some(WeighedInMotion { kg, error_kg, span_s: [from, to] })
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
