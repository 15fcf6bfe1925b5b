//! Bodies that were calibrated or scaled from one standing trial, for all trials of the person.

use super::subject::{BodySource, MarkerTrialError, Subject};
use crate::findings::Findings;
use crate::kinematics::calibration::PersonMeasurements;
use crate::model::Model;
use crate::model::marker_set::MarkerSet;
use std::sync::{Mutex, PoisonError};

/// Most bodies that are kept; each trial with another weighed mass needs its own body.
const MOST: usize = 4;

/// The bodies of one standing trial. A body is calibrated once for each marker set and each statement about the person,
/// a model is scaled once for each mass.
#[derive(Debug, Default)]
pub struct KnownBodies(Mutex<Vec<KnownBody>>);

#[derive(Debug)]
struct KnownBody {
    made_from: MadeFrom,
    subject: Subject,
    findings: Findings,
}

/// Sources of a body in addition to the standing trial.
#[derive(Debug)]
enum MadeFrom {
    BuiltIn { person: Box<PersonMeasurements>, set: Option<MarkerSet> },
    Model { model: Model, mass: Option<f64> },
}

impl MadeFrom {
    /// `None` for a body that needs no standing trial, or more than that: the trials of a protocol.
    fn of(body: &BodySource<'_>) -> Option<MadeFrom> {
        match *body {
            BodySource::BuiltIn { person, set } => {
                Some(MadeFrom::BuiltIn { person: Box::new(person.clone()), set: set.cloned() })
            }
            BodySource::Model { model, mass, protocol: None } => Some(MadeFrom::Model { model: model.clone(), mass }),
            BodySource::Model { protocol: Some(_), .. } | BodySource::Calibrated(_) => None,
        }
    }

    fn is_of(&self, body: &BodySource<'_>) -> bool {
        match (self, body) {
            (MadeFrom::BuiltIn { person, set }, BodySource::BuiltIn { person: own, set: own_set }) => {
                **person == **own && set.as_ref() == *own_set
            }
            (MadeFrom::Model { model, mass }, BodySource::Model { model: own, mass: own_mass, protocol: None }) => {
                mass == own_mass && model == *own
            }
            _ => false,
        }
    }
}

impl KnownBodies {
    /// The body of this source, and the findings of making it; `make` makes it if it is not known.
    pub(super) fn subject(
        &self,
        body: &BodySource<'_>,
        findings: &mut Findings,
        make: impl FnOnce(&mut Findings) -> Result<Subject, MarkerTrialError>,
    ) -> Result<Subject, MarkerTrialError> {
        // Another thread waits for a body that is being made instead of making it as well.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(body) = known.iter().find(|known| known.made_from.is_of(body)) {
            body.findings.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
            return Ok(body.subject.clone());
        }
        let Some(made_from) = MadeFrom::of(body) else { return make(findings) };
        let mut own = Findings::default();
        let made = make(&mut own);
        own.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
        let subject = made?;
        known.truncate(MOST - 1);
        known.insert(0, KnownBody { made_from, subject: subject.clone(), findings: own });
        Ok(subject)
    }
}
