//! A trial of an AddBiomechanics subject as a source: with the file's own model, or with its markers and another body.

use super::laboratory_file::LaboratoryFile;
use super::source::{ForceTable, MarkerBody, MarkerSource, MeasuredForces, Source};
use crate::findings::{Code, Findings};
use crate::model::{ImportError, Model, from_osim};
use crate::motion::{B3dError, B3dTrial, Window};
use ambulo_formats::osim::OsimModel;
use ambulo_formats::table::Table;

/// Largest relative difference between masses of one person.
const SAME_MASS: f64 = 0.05;

/// Why a trial of an AddBiomechanics subject is no source.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum B3dSourceError {
    /// The text of the model, or the table of its forces.
    #[error(transparent)]
    Format(#[from] ambulo_formats::Error),
    /// The model.
    #[error("the model in the file")]
    Model(#[from] ImportError),
    /// The trial.
    #[error(transparent)]
    Trial(#[from] B3dError),
}

impl Source {
    /// The coordinates of the last pass with the file's own model. Ground forces come from the longest time within
    /// `window` in which none is missing; without such a time they are predicted.
    ///
    /// # Errors
    /// A model that cannot be computed, coordinates that do not belong to the model.
    pub fn of_b3d(trial: &B3dTrial<'_>, window: Window, findings: &mut Findings) -> Result<Source, B3dSourceError> {
        let document = OsimModel::read(trial.model_text()?.as_bytes())?;
        let model = from_osim(&document, findings)?;
        let motion = trial.motion(&document, &model, findings)?;
        report_stated_mass(trial, &model, findings);
        let forces = match trial.measured(window, findings) {
            Some(frames) => MeasuredForces::OnBodies(trial.forces(&model, frames)?),
            None => MeasuredForces::InRecording,
        };
        Ok(Source::coordinates(model, motion).with_forces(forces))
    }

    /// The markers of the trial and the body that follows them, with the same forces.
    ///
    /// # Errors
    /// No marker is visible.
    pub(crate) fn of_b3d_markers(
        trial: &B3dTrial<'_>,
        body: MarkerBody,
        window: Window,
        findings: &mut Findings,
    ) -> Result<Source, B3dSourceError> {
        let file =
            LaboratoryFile { subject: trial.person(findings), ..LaboratoryFile::of_markers(trial.markers(findings)?) };
        let forces = match trial.measured(window, findings) {
            Some(frames) => MeasuredForces::Table(ForceTable {
                table: Table::new("ground forces", trial.force_columns(frames)?)?,
                loads: None,
            }),
            None => MeasuredForces::InRecording,
        };
        let markers = MarkerSource { trial: file, standing: None, body, plates: Vec::new() };
        Ok(Source::markers(markers).with_forces(forces))
    }
}

/// Reports a stated mass that differs from the model's. The forces are computed with the model; the plates show which
/// mass is right.
fn report_stated_mass(trial: &B3dTrial<'_>, model: &Model, findings: &mut Findings) {
    let Some(stated_kg) = trial.person(findings).mass_kg else { return };
    let model_kg = model.mass();
    if (stated_kg - model_kg).abs() > SAME_MASS * model_kg {
        let message = format!(
            "the file states {stated_kg:.1} kg, its model has {model_kg:.1} kg; forces are computed with the model"
        );
        findings.report(Code::B3dStatedMass, message);
    }
}
