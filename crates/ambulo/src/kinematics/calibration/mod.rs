//! From markers to a subject's body: joint centres, segment frames, lengths, and where each marker stands.
//!
//! From a standing trial, or from the walk itself. In every frame the landmarks that were seen give joint centres and segment axes;
//! medians over the frames give lengths, the places of the markers on their segments, and the fixed parts of the joints.
//!
//! | part | how |
//! |---|---|
//! | pelvis | axes through the iliac spines, turned back by the tilt of upright standing |
//! | hip centre | Harrington 2007's regression on width and depth of the pelvis between its markers |
//! | knee | midway between the epicondyles; else half the knee's breadth inside the lateral marker, at right angles to the line to the hip, in the plane of the wand (Plug-in-Gait's construction); without a wand, in the frontal plane of the pelvis |
//! | ankle | the same with the malleoli and the shank's wand; without one, in the plane of the knee axis |
//! | thigh, shank | y from the lower to the upper joint, z along the knee axis as far as it is at right angles to that |
//! | foot | upright while it stands flat; x from heel to toe |
//! | trunk | the landmarks' usual places fitted to those seen, then y from the lumbar joint to the shoulders |
//! | arm | elbow half its breadth inside the lateral marker, along the normal of the plane of shoulder, elbow and wrist |
//!
//! The knee's hinge turns about z of the thigh; what the shank deviates from it beside flexion (its varus) is a fixed part of the
//! joint. The ankle's hinge lies along the line of the malleoli, wherever the shank's torsion puts it; what the flat foot deviates
//! beside flexion is a fixed part too. So a model stands as the subject stood.
//!
//! On a walk the joints then put the places of the markers right by least squares (`refinement`): a knee that only flexes shows which way
//! its axis lies against wand and epicondyle.
//!
//! Sources: Harrington, Zavatsky, Lawson, Yuan, Theologis 2007, J Biomech 40:595 (unverified beside the numbers); Kadaba 1990 and Davis
//! 1991 for the construction with wands, as Plug-in-Gait has it (unverified). Tilt of the standing pelvis: see
//! [`STANDING_TILT`](crate::model::full_body::STANDING_TILT).
//! Not handled: functional joint centres; wrists and heads that move; braces.
//! Pinned by: tests/calibration.rs

mod assembly;
mod axes;
mod error;
mod feet;
mod legs;
mod pelvis;
mod person;
mod reference;
mod refinement;
mod report;
mod sight;
mod trunk;
mod upright;

pub use error::CalibrationError;
pub use person::{Measures, PersonMeasurements};
pub use reference::Trial;
pub use report::{CalibrationReport, MarkerPlace, SegmentScale};
pub use upright::assume_upright_trunk;

use crate::findings::{Code, Findings};
use crate::model::anthropometry::{Build, Human};
use crate::model::full_body::full_body;
use crate::model::marker_set::Recognised;
use crate::motion::MarkerRecording;
use sight::Sight;
use std::collections::BTreeMap;

/// A subject's body.
#[derive(Debug, Clone)]
pub struct Calibrated {
    /// The body: joints, masses and soles of the subject, the recording's markers where they stand.
    pub human: Human,
    /// How much each marker counts in a fit, by its name: [`FitSettings::weights`](super::marker_fit::FitSettings::weights).
    pub weights: BTreeMap<String, f64>,
    /// What came of it.
    pub report: CalibrationReport,
}

/// The subject's body from a recording in world axes, of a person standing or walking.
///
/// # Errors
/// Markers that are missing or never seen together, lengths that no walker has: see [`CalibrationError`].
pub fn calibrate(
    recording: &MarkerRecording,
    trial: Trial,
    recognised: &Recognised,
    person: &PersonMeasurements,
    findings: &mut Findings,
) -> Result<Calibrated, CalibrationError> {
    if person.table.is_undivided() {
        return Err(CalibrationError::NoPelvis { table: person.table.name() });
    }
    let sight = Sight::new(recording, recognised);
    let frames = reference::frames(&sight, trial, findings);
    let mut assumptions = Vec::new();
    let pelvis = pelvis::find(&sight, &frames)?;
    let legs = legs::find(&sight, &frames, &pelvis, person, &mut assumptions)?;
    let height = match person.height {
        Some(height) => height,
        None => legs::stature(&legs, person.table, &mut assumptions)?,
    };
    let build = Build { table: person.table, mass: person.mass, height, toe_joint: true };
    let generic = full_body(&build)?;
    let feet = feet::find(&sight, &frames, trial, &legs, &generic.dimensions, &mut assumptions);
    let trunk = trunk::find(&sight, &frames, &pelvis, &generic.dimensions, person, &mut assumptions);
    let parts = assembly::Parts { pelvis: &pelvis, legs: &legs, feet: &feet, trunk: &trunk };
    let mut calibrated = assembly::assemble(&sight, &frames, &generic, &parts, assumptions)?;
    if trial == Trial::Moving {
        refinement::refine(&mut calibrated, recording)?;
    }
    for assumption in &calibrated.report.assumptions {
        findings.report(Code::CalibrationAssumed, assumption.clone());
    }
    Ok(calibrated)
}
