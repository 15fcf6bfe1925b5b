//! Built-in bodies that were calibrated from one standing trial, for all trials of the person.

use super::marker_trial::{MarkerTrialError, Subject};
use crate::findings::Findings;
use crate::kinematics::calibration::PersonMeasurements;
use crate::model::marker_set::MarkerSet;
use std::sync::{Mutex, PoisonError};

/// Bodies that are kept; trials that weigh the person anew need a body each.
const MOST: usize = 4;

/// The bodies of one standing trial. A body is calibrated once for each marker set and each statement about the person.
#[derive(Debug, Default)]
pub struct KnownBodies(Mutex<Vec<KnownBody>>);

#[derive(Debug)]
struct KnownBody {
    person: PersonMeasurements,
    set: Option<MarkerSet>,
    subject: Subject,
    findings: Findings,
}

impl KnownBodies {
    /// The body of this person, and the findings of its calibration; `calibrate` makes it if it is not known.
    pub(super) fn subject(
        &self,
        person: &PersonMeasurements,
        set: Option<&MarkerSet>,
        findings: &mut Findings,
        calibrate: impl FnOnce(&mut Findings) -> Result<Subject, MarkerTrialError>,
    ) -> Result<Subject, MarkerTrialError> {
        // Another thread waits for a body that is being calibrated instead of calibrating it as well.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(body) = known.iter().find(|body| body.person == *person && body.set.as_ref() == set) {
            body.findings.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
            return Ok(body.subject.clone());
        }
        let mut own = Findings::default();
        let calibrated = calibrate(&mut own);
        own.as_slice().iter().for_each(|finding| findings.add(finding.clone()));
        let subject = calibrated?;
        known.truncate(MOST - 1);
        known.insert(
            0,
            KnownBody { person: person.clone(), set: set.cloned(), subject: subject.clone(), findings: own },
        );
        Ok(subject)
    }
}
